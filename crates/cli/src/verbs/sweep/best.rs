//! The best designs of a sweep: those that keep all limits by the largest margin.

use dashpot_analysis::Judgement;
use dashpot_report::Table;

use super::{
    Swept,
    figures::unit,
    titles::{capital, quantity},
    words,
};
use crate::output::list;
use dashpot_report::numbers::percent_signed;

/// So many are shown.
const MOST: usize = 10;
/// Digits of a value.
const DIGITS: usize = 4;

/// A point with what is left to its limits.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Design {
    pub(super) point: usize,
    /// Whether it keeps all limits for certain.
    pub(super) passes: bool,
    /// The smallest margin to any limit, in parts of its bound.
    pub(super) margin: f64,
}

impl Design {
    /// `smallest margin 12 %`.
    pub(super) fn margin_in_words(&self) -> String {
        format!("smallest margin {}", percent_signed(self.margin))
    }
}

/// The points that keep all limits, the largest of the smallest margins first; where none does, those that come
/// nearest to it. Empty without limits.
pub(super) fn best(swept: &Swept) -> Vec<Design> {
    let report = &swept.report;
    let judged = list((0..report.limits.len()).map(|at| report.judged(at)));
    let design = |point: usize| {
        let margins = report.limits.iter().map(|(column, limit)| {
            let value = report.values[point * report.columns.len() + column];
            // Of a bound of zero only the sign of what is left is known.
            let plain = || limit.bound.judge(value, None, false) == Judgement::Pass;
            let margin = || if plain() { 0.0 } else { f64::NEG_INFINITY };
            value.is_finite().then(|| limit.bound.margin(value).unwrap_or_else(margin))
        });
        let margin = margins.collect::<Option<Vec<f64>>>()?.into_iter().reduce(f64::min)?;
        let passes = judged.iter().all(|own| own[point] == Some(Judgement::Pass));
        Some(Design { point, passes, margin })
    };
    let mut all: Vec<Design> = (0..report.points()).filter_map(design).collect();
    if all.iter().any(|own| own.passes) {
        all.retain(|own| own.passes);
    }
    all.sort_by(|one, other| other.margin.total_cmp(&one.margin));
    all.truncate(MOST);
    all
}

/// The best designs with what they are, what they reach, and their smallest margin.
pub(super) fn best_table(swept: &Swept, designs: &[Design]) -> Table {
    let report = &swept.report;
    let mut columns: Vec<usize> = report.limits.iter().map(|own| own.0).collect();
    columns.dedup();
    let names = swept.varied.variations.iter().map(|own| own.name.clone());
    let measures = columns.iter().map(|at| words::name(&report.columns[*at]));
    let header = names.chain(measures).chain(["smallest margin".to_owned()]);
    let row = |own: &Design| {
        let values = columns.iter().map(|at| {
            let value = report.values[own.point * report.columns.len() + at];
            unit(report, *at).text(value, DIGITS)
        });
        let given = swept.values_at(own.point).into_iter();
        list(given.chain(values).chain([percent_signed(own.margin)]))
    };
    let is_kept = designs.first().is_some_and(|own| own.passes);
    let is_whole = report.unevaluated().is_empty();
    let caption = match (is_kept, is_whole) {
        (true, true) => "Best designs",
        (true, false) => "Best of the designs that could be evaluated",
        (false, true) => "No design keeps all limits: the nearest ones",
        (false, false) => "No design that could be evaluated keeps all limits: the nearest ones",
    };
    let of = match &columns[..] {
        [only] => format!(", by the margin of {}", quantity(&report.columns[*only])),
        _ => ", by the smallest margin to any limit".to_owned(),
    };
    Table::new(capital(&(caption.to_owned() + &of)), header, designs.iter().map(row))
}
