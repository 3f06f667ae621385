//! The points of a sweep as a table for people: parameters in the units of the command line, measures with the
//! digits that their errors justify.

use dashpot_analysis::{Judgement, sweep::SweepReport};
use dashpot_report::Table;

use super::{Swept, figures, words};
use crate::output::list;
use dashpot_report::numbers::{Unit, digits};

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
    let told = told(report);
    let names = variations.iter().zip(&axes).map(|(own, (unit, _))| match unit.as_str() {
        "1" | "" => own.name.clone(),
        unit => format!("{}\n{unit}", own.name),
    });
    let measures = told.iter().map(|own| own.name(report));
    let header = names.chain(measures);
    let row = |point: usize| {
        let places = swept.varied.places(&swept.grid.places(point)).into_iter().enumerate();
        let own = places.map(|(at, place)| match variations[at].words.get(place) {
            Some(word) => word.clone(),
            None => words::short(axes[at].1[place]),
        });
        list(own.chain(told.iter().map(|own| own.cell(report, point))))
    };
    let points = report.points();
    let shown = match points {
        0..=MOST_SHOWN => points,
        _ if swept.varied.is_of_rows() => FIRST_SHOWN,
        _ => 0,
    };
    let more = points - shown;
    let caption =
        if more > 0 { format!("The first {shown} designs") } else { "All points".to_owned() };
    (Table::new(caption, header, (0..shown).map(row)), more)
}

/// What stands in a column of the table.
enum Told {
    /// The values of a column of the sweep.
    Values(usize, Unit),
    /// The verdicts on a limit.
    Verdicts(usize, Vec<Option<Judgement>>),
}

/// What limits are on first, each with its verdicts behind it.
fn told(report: &SweepReport) -> Vec<Told> {
    let mut columns = words::told(report);
    columns.extend(report.limits.iter().map(|own| own.0));
    columns.sort_unstable();
    columns.dedup();
    columns.sort_by_key(|at| report.limits.iter().all(|own| own.0 != *at));
    let with_verdicts = columns.into_iter().flat_map(|at| {
        let limits = (0..report.limits.len()).filter(move |&limit| report.limits[limit].0 == at);
        let verdicts = limits.map(|limit| Told::Verdicts(limit, report.judged(limit)));
        [Told::Values(at, figures::unit(report, at))].into_iter().chain(verdicts)
    });
    with_verdicts.collect()
}

impl Told {
    fn name(&self, report: &SweepReport) -> String {
        match self {
            Self::Values(at, unit) => {
                format!("{}\n{}", in_lines(&words::name(&report.columns[*at])), unit.symbol)
            }
            Self::Verdicts(at, _) => {
                let (column, own) = &report.limits[*at];
                format!("verdict\n{}", words::level_of(&report.columns[*column], own))
            }
        }
    }

    fn cell(&self, report: &SweepReport, point: usize) -> String {
        match self {
            Self::Values(at, unit) => {
                let at = point * report.columns.len() + at;
                let (value, error) = (report.values[at], report.errors[at]);
                let error = Some(error).filter(|own| own.is_finite());
                match value {
                    own if !own.is_finite() => NONE.to_owned(),
                    own if error.is_some_and(|error| own.abs() <= error) => "0".to_owned(),
                    _ => unit.number(value, digits(value, error, MOST_DIGITS)),
                }
            }
            Self::Verdicts(_, judged) => judged[point].map_or(NONE, Judgement::word).to_owned(),
        }
    }
}

/// A key in lines: what is measured below what it is of.
fn in_lines(key: &str) -> String {
    key.rsplit_once('.').map_or(key.to_owned(), |(of, measure)| format!("{of}\n{measure}"))
}
