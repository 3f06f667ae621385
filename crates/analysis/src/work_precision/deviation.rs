//! How far a measure of one run is from that of another.

use std::collections::HashMap;

use super::{Deviation, MeasureDeviation};
use crate::{MeasureReport, RunReport};

/// Differences below so many roundings are none.
const ROUNDINGS: f64 = 64.0;

/// The difference between two values of a measure relative to the true size, or where that is zero, to
/// that of the run: infinite if only one has a value, `None` if neither has.
pub(super) fn apart(truth: &MeasureReport, run: &MeasureReport) -> Option<f64> {
    match (truth.value, run.value) {
        (None, None) => None,
        (Some(truth_value), Some(value)) => {
            let size = size(truth, run);
            Some(if size > 0.0 { (value - truth_value).abs() / size } else { 0.0 })
        }
        _ => Some(f64::INFINITY),
    }
}

/// What errors of a measure are relative to.
pub(super) fn size(truth: &MeasureReport, run: &MeasureReport) -> f64 {
    if truth.size > 0.0 { truth.size } else { run.size }
}

/// How well each measure of `truth` is known, relative: its bound where `is_bounded`, else its
/// difference from `witness`; infinite where nothing tells.
pub(super) fn known(
    truth: &[MeasureReport],
    witness: Option<&[MeasureReport]>,
    is_bounded: bool,
) -> Vec<f64> {
    let others: HashMap<&str, &MeasureReport> =
        witness.into_iter().flatten().map(|own| (own.key.as_str(), own)).collect();
    let of = |own: &MeasureReport| {
        let rounding = ROUNDINGS * f64::EPSILON;
        let bound = own.error.filter(|error| is_bounded && error.is_finite());
        let bound = bound.map(|error| if own.size > 0.0 { error / own.size } else { 0.0 });
        let agreement = || {
            let other = others.get(own.key.as_str())?;
            Some(apart(own, other)?.max(rounding))
        };
        match own.value {
            None => 0.0,
            Some(_) => bound.or_else(agreement).unwrap_or(f64::INFINITY),
        }
    };
    truth.iter().map(of).collect()
}

/// The errors of all measures of `run`, in the order of `truth`.
pub(super) fn measures(
    truth: &[MeasureReport],
    known: &[f64],
    run: &RunReport,
) -> Vec<MeasureDeviation> {
    let others = run.by_key();
    let of = |(own, &known_within): (&MeasureReport, &f64)| {
        let Some(other) = others.get(own.key.as_str()) else {
            return MeasureDeviation { deviation: None, bar: None, warned: false };
        };
        let deviation = apart(own, other).map(|value| Deviation { value, known_within });
        let size = size(own, other);
        let bar = other.error.map(|error| if size > 0.0 { error / size } else { 0.0 });
        let warned = other.excess > 1.0 || other.error.is_some_and(f64::is_infinite);
        MeasureDeviation { deviation, bar, warned }
    };
    truth.iter().zip(known).map(of).collect()
}
