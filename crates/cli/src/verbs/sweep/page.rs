//! The page of a sweep.

use dashpot_analysis::Judgement;
use dashpot_report::{Page, ReportFigure, Table};

use super::{
    Form, Swept,
    best::{best, best_table},
    figures::unit,
    kept, points,
    titles::{capital, quantity},
    words,
};
use crate::{input::title, output::list, said};
use dashpot_report::numbers::counted;
use dashpot_studies::{origin, sketch};

/// Digits of what is computed.
const DIGITS: usize = 4;

/// Everything that a sweep says, on one page with these figures.
pub(super) fn page(swept: &Swept, figures: Vec<ReportFigure>) -> Page {
    let (limits, best) = (limits(swept), best(swept));
    let tables = [
        Table::list("What varies", swept.varied.in_words()),
        limits,
        best_table(swept, &best),
        extremes(swept),
        points::table(swept).0,
        Table::list("Remarks", said::notes(&swept.scene)),
    ];
    let details = [settings(swept), Table::list("How it was solved", words::solving(swept))];
    let has_rows = |table: &Table| !table.rows.is_empty();
    Page {
        title: title(&swept.scene).to_owned(),
        warnings: list(said::warnings(&swept.scene, &[]).into_iter().chain(words::warned(swept))),
        verdict: verdict(swept, &best),
        network: sketch::figure(&swept.scene),
        tables: tables.into_iter().filter(has_rows).collect(),
        figures,
        details: details.into_iter().filter(has_rows).collect(),
        scene_text: swept.scene.text.to_string(),
    }
}

/// How many points there are, how many keep the limits, and the best of them.
pub(super) fn verdict(swept: &Swept, best: &[super::best::Design]) -> Vec<String> {
    let count = swept.report.points();
    let what = if swept.varied.is_of_rows() { "design" } else { "point" };
    let missing = swept.report.unevaluated().count;
    let solved = counted(count, what);
    let mut lines = vec![match missing {
        0 => format!("{solved} solved"),
        missing => format!("{solved}, {missing} of them not evaluated"),
    }];
    lines.extend(kept::kept(swept));
    if let Some(first) = best.first().filter(|_| !swept.report.limits.is_empty()) {
        let word = if first.passes { "best" } else { "nearest to passing" };
        let among = if missing > 0 { " of those evaluated" } else { "" };
        let margin = first.margin_in_words();
        lines.push(format!("{word}{among}: {}, {margin}", swept.at(first.point)));
    }
    lines
}

/// How many points keep each limit.
fn limits(swept: &Swept) -> Table {
    let report = &swept.report;
    let header = ["measure", "limit", "pass", "fail", "undecided", "no value"];
    let row = |at: usize| {
        let (column, limit) = &report.limits[at];
        let judged = report.judged(at);
        let count = |which: &str| {
            let words = judged.iter().map(|own| own.map_or("no value", Judgement::word));
            words.filter(|own| *own == which).count().to_string()
        };
        let name = capital(&quantity(&report.columns[*column]));
        let bound = words::limit(&report.columns[*column], limit);
        list([name, bound].into_iter().chain(header[2..].iter().map(|own| count(own))))
    };
    Table::new("Limits", &header, (0..report.limits.len()).map(row))
}

/// The lowest and the highest value of each measure, and where they are.
fn extremes(swept: &Swept) -> Table {
    let report = &swept.report;
    let row = |at: usize| {
        let known = || report.column(at).enumerate().filter(|own| own.1.is_finite());
        let ends = [
            known().min_by(|one, other| one.1.total_cmp(&other.1)),
            known().max_by(|one, other| one.1.total_cmp(&other.1)),
        ];
        let unit = unit(report, at);
        let told = |own: Option<(usize, f64)>| match own {
            Some((point, value)) => [unit.text(value, DIGITS), swept.at(point)],
            None => ["–".to_owned(), String::new()],
        };
        let name = capital(&quantity(&report.columns[at]));
        list([name].into_iter().chain(ends.into_iter().flat_map(told)))
    };
    let header = ["measure", "lowest", "at", "highest", "at"];
    Table::new("Lowest and highest", &header, words::told(report).into_iter().map(row))
}

fn settings(swept: &Swept) -> Table {
    let form = match swept.varied.form {
        Form::Combined | Form::Mixed(_) => "all combinations",
        Form::Listed => "the rows of a table",
        Form::Sampled => "a Latin hypercube",
    };
    let own = [
        ("scene", swept.scene.file.clone().unwrap_or_default()),
        ("points", format!("{}, {form}", swept.report.points())),
    ];
    let asked = swept.asked.iter().map(|(name, value)| (*name, value.clone()));
    let rows = own.into_iter().chain(asked).filter(|own| !own.1.is_empty());
    let rows = rows.map(|(name, value)| vec![name.to_owned(), value]);
    Table::plain("Settings", rows.chain(origin::rows(&swept.scene, &crate::input::load)))
}
