//! Two runs side by side.

use crate::RunReport;

/// How far two runs are apart in one measure.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    /// Key of the measure.
    pub key: String,
    /// `|a − b|` over the larger of both measures' sizes, to which their errors refer as well; 0 where
    /// both are zero.
    pub relative: f64,
}

/// The differences in all measures that have a value in both runs, in the order of the first.
pub fn differences(one: &RunReport, other: &RunReport) -> Vec<Difference> {
    let others = other.by_key();
    one.measures
        .iter()
        .filter_map(|measure| {
            let a = measure.value?;
            let opposite = others.get(measure.key.as_str())?;
            let b = opposite.value?;
            let relative = over((a - b).abs(), measure.size.max(opposite.size));
            Some(Difference { key: measure.key.clone(), relative })
        })
        .collect()
}

/// A difference over the size of what differs; 0 where that is zero.
pub(crate) fn over(difference: f64, size: f64) -> f64 {
    if size > 0.0 { difference / size } else { 0.0 }
}
