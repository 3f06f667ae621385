//! How far the slopes of a model are off.

use super::{Pair, falling};

/// Slopes are means over so many samples, and over as many as there are towards an end.
const MEANS: usize = 9;
/// The difference of both in parts of the test from which on the score is 0.
const MOST: f64 = 2.0;

/// By the sums of absolute differences of both slopes, and of those of the test.
pub(super) fn score(pair: Pair<'_>) -> f64 {
    let [test, model] = [pair.test, pair.model].map(|own| smooth(&differences(own)));
    let off = test.iter().zip(&model).map(|(test, model)| (test - model).abs()).sum();
    falling(off, test.iter().map(|own| own.abs()).sum(), MOST)
}

/// Central differences per step, at the ends one-sided ones.
fn differences(values: &[f64]) -> Vec<f64> {
    let last = values.len() - 1;
    let one = |at: usize| {
        let (from, to) = (at.saturating_sub(1), (at + 1).min(last));
        (values[to] - values[from]) / (to - from) as f64
    };
    (0..=last).map(one).collect()
}

fn smooth(values: &[f64]) -> Vec<f64> {
    let last = values.len() - 1;
    let one = |at: usize| {
        let half = (MEANS / 2).min(at).min(last - at);
        let around = &values[at - half..=at + half];
        around.iter().sum::<f64>() / around.len() as f64
    };
    (0..=last).map(one).collect()
}
