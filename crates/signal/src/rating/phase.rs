//! How much later a model is than the test.

use super::Pair;

/// The largest shift in parts of the length.
const MOST: f64 = 0.2;
/// A correlation that is larger by less than this is the same: rounding moves nothing.
const SAME: f64 = 1e-12;

/// By how many steps the model is later: the shift with the largest correlation; of equal ones the smallest, of two as
/// small the one by which it is later.
pub(super) fn shift(pair: Pair<'_>) -> isize {
    let most = (MOST * pair.test.len() as f64).floor();
    let (mut best, mut found) = (correlation(pair), 0);
    let mut by: isize = 1;
    while by as f64 <= most {
        for own in [by, -by] {
            let correlation = correlation(pair.shifted(own));
            if correlation > best + SAME {
                (best, found) = (correlation, own);
            }
        }
        by += 1;
    }
    found
}

/// 1 without a shift, 0 from a fifth of the length on.
pub(super) fn score(shift: isize, length: usize) -> f64 {
    (1.0 - shift.unsigned_abs() as f64 / (MOST * length as f64)).max(0.0)
}

/// Correlation about both means; −1 where one of both is constant, which tells no shift.
fn correlation(pair: Pair<'_>) -> f64 {
    let count = pair.test.len() as f64;
    let mean = |own: &[f64]| own.iter().sum::<f64>() / count;
    let (of_test, of_model) = (mean(pair.test), mean(pair.model));
    let mut sums = [0.0; 3];
    for (test, model) in pair.values() {
        let (test, model) = (test - of_test, model - of_model);
        sums[0] += test * model;
        sums[1] += test * test;
        sums[2] += model * model;
    }
    let size = (sums[1] * sums[2]).sqrt();
    if size > 0.0 { sums[0] / size } else { -1.0 }
}
