//! The points of a sweep as a table for people: parameters in the units of the command line, measures with the
//! digits that their errors justify.

use dashpot_analysis::Judgement;
use dashpot_plot::Table;

use super::{Swept, figures, words};
use crate::{numbers::digits, output::list};

/// So many points are shown; of more the first designs of a list, and none of a grid, which figures show.
const MOST_SHOWN: usize = 50;
/// So many designs of a longer list.
const FIRST_SHOWN: usize = 10;
/// Digits of a value, whatever its error.
const MOST_DIGITS: usize = 5;
/// What stands where there is no value.
const NONE: &str = "–";

/// The first points, and how many more there are.
pub(super) fn table(swept: &Swept) -> (Table, usize) {
    let (report, variations) = (&swept.report, &swept.varied.variations);
    let axes = list((0..variations.len()).map(|at| swept.in_unit(at)));
    let told = list(words::told(report).into_iter().map(|at| (at, figures::unit(report, at))));
    let judged = list((0..report.limits.len()).map(|at| report.judged(at)));
    let names = variations.iter().zip(&axes).map(|(own, (unit, _))| match unit.as_str() {
        "1" | "" => own.name.clone(),
        unit => format!("{}\n{unit}", own.name),
    });
    let measures = told.iter().map(|(at, unit)| {
        format!("{}\n{}", in_lines(&words::name(&report.columns[*at])), unit.symbol)
    });
    let limits = report.limits.iter().map(|(column, own)| {
        format!("{}\n{}", in_lines(&own.key), words::level_of(report, *column, own))
    });
    let header = list(names.chain(measures).chain(limits));
    let row = |point: usize| {
        let places = swept.varied.places(&swept.grid.places(point)).into_iter().enumerate();
        let own = places.map(|(at, place)| match variations[at].words.get(place) {
            Some(word) => word.clone(),
            None => words::short(axes[at].1[place]),
        });
        let values = told.iter().map(|(at, unit)| {
            let at = point * report.columns.len() + at;
            let (value, error) = (report.values[at], report.errors[at]);
            let error = Some(error).filter(|own| own.is_finite());
            let text = || unit.number(value, digits(value, error, MOST_DIGITS));
            match value {
                own if !own.is_finite() => NONE.to_owned(),
                own if error.is_some_and(|error| own.abs() <= error) => "0".to_owned(),
                _ => text(),
            }
        });
        let judged = judged.iter().map(|own| own[point].map_or(NONE, Judgement::word).to_owned());
        list(own.chain(values).chain(judged))
    };
    let header = list(header.iter().map(String::as_str));
    let points = report.points();
    let shown = match points {
        0..=MOST_SHOWN => points,
        _ if swept.varied.is_of_rows() => FIRST_SHOWN,
        _ => 0,
    };
    let more = points - shown;
    let caption =
        if more > 0 { format!("The first {shown} designs") } else { "All points".to_owned() };
    (Table::new(caption, &header, (0..shown).map(row)), more)
}

/// A key in lines: what is measured below what it is of.
fn in_lines(key: &str) -> String {
    key.rsplit_once('.').map_or(key.to_owned(), |(of, measure)| format!("{of}\n{measure}"))
}
