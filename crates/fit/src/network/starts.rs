//! Where a search begins.

use dashpot_numerics::Stream;

use super::Number;

/// Values between the bounds, each of which has a part of every range that no other has (a Latin hypercube of
/// logarithms).
pub(super) fn spread(numbers: &[Number], count: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut stream = Stream::new(seed);
    let columns: Vec<Vec<f64>> = numbers
        .iter()
        .map(|own| {
            let mut parts: Vec<usize> = (0..count).collect();
            (1..count).rev().for_each(|at| parts.swap(at, stream.below(at + 1)));
            let value = |part: usize| {
                let share = (part as f64 + stream.share()) / count as f64;
                own.low * (own.high / own.low).powf(share)
            };
            parts.into_iter().map(value).collect()
        })
        .collect();
    (0..count).map(|at| columns.iter().map(|own| own[at]).collect()).collect()
}
