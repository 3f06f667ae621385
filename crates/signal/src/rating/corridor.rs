//! How much of the time a model keeps to corridors about the test.

use super::Pair;

/// Half widths of both corridors in parts of the measured peak.
const INNER: f64 = 0.05;
const OUTER: f64 = 0.5;

/// The mean over all samples of 1 within the inner corridor, 0 outside of the outer one, and the square of how far it
/// is from the outer one between them.
pub(super) fn score(pair: Pair<'_>) -> f64 {
    let peak = pair.test.iter().map(|own| own.abs()).fold(0.0, f64::max);
    let one = |(test, model): (f64, f64)| {
        let off = (test - model).abs() / peak;
        ((OUTER - off) / (OUTER - INNER)).clamp(0.0, 1.0).powi(2)
    };
    pair.values().map(one).sum::<f64>() / pair.test.len() as f64
}
