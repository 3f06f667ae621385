//! How far the heights of a model are off, where its times are warped onto those of the test.

use super::{Pair, falling};

/// Half width of the band in which times are warped, in parts of the length.
const BAND: f64 = 0.1;
/// The difference of both in parts of the test from which on the score is 0.
const MOST: f64 = 0.5;

/// Whence a place of the warping path is reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum From {
    Both,
    Test,
    Model,
}

/// By the sums of absolute differences and of the absolute test along the path on which the sum of squared
/// differences is least.
pub(super) fn score(pair: Pair<'_>) -> f64 {
    let (mut off, mut size) = (0.0, 0.0);
    walk(pair, |test, model| {
        off += (test - model).abs();
        size += test.abs();
    });
    falling(off, size, MOST)
}

/// Visits both values at each place of the path.
fn walk(pair: Pair<'_>, mut visit: impl FnMut(f64, f64)) {
    let count = pair.test.len();
    let mut half = 0;
    while ((half + 1) as f64) < BAND * count as f64 {
        half += 1;
    }
    let path = Warped::of(pair, half);
    let (mut at_test, mut at_model) = (count - 1, count - 1);
    loop {
        visit(pair.test[at_test], pair.model[at_model]);
        if at_test + at_model == 0 {
            return;
        }
        match path.from(at_test, at_model) {
            From::Both => (at_test, at_model) = (at_test - 1, at_model - 1),
            From::Test => at_test -= 1,
            From::Model => at_model -= 1,
        }
    }
}

/// Whence each place of the band is reached at least cost.
struct Warped {
    half: usize,
    from: Vec<From>,
}

impl Warped {
    fn of(pair: Pair<'_>, half: usize) -> Self {
        let width = 2 * half + 1;
        let count = pair.test.len();
        let mut from = vec![From::Both; width * count];
        // Costs of the row before and of this one; the place of the model is `at + k − half`.
        let mut before = vec![f64::INFINITY; width];
        let mut row = before.clone();
        for (at, test) in pair.test.iter().enumerate() {
            row.fill(f64::INFINITY);
            let low = half.saturating_sub(at);
            let high = width.min(count + half - at);
            for k in low..high {
                let cost = (test - pair.model[at + k - half]).powi(2);
                let beside = |of: &[f64], k: Option<usize>| {
                    k.and_then(|k| of.get(k)).copied().unwrap_or(f64::INFINITY)
                };
                if at == 0 && k == half {
                    row[k] = cost;
                    continue;
                }
                let mut best = (beside(&before, Some(k)), From::Both);
                for (own, whence) in [
                    (beside(&before, Some(k + 1)), From::Test),
                    (beside(&row, k.checked_sub(1)), From::Model),
                ] {
                    if own < best.0 {
                        best = (own, whence);
                    }
                }
                row[k] = best.0 + cost;
                from[at * width + k] = best.1;
            }
            std::mem::swap(&mut before, &mut row);
        }
        Self { half, from }
    }

    fn from(&self, at_test: usize, at_model: usize) -> From {
        self.from[at_test * (2 * self.half + 1) + at_model + self.half - at_test]
    }
}
