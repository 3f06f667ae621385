//! Which mode of one model answers to which of another.

use crate::linear::Line;

/// A mode of each of two models; one of them may be missing.
pub(super) type Aligned<'l> = (Option<&'l Line>, Option<&'l Line>);

/// Pairs of the lines of two models in rising order of the rate: all of the shorter list, each with
/// one of the longer so that the ratios of their rates are as near to 1 as can be, all in all.
pub(super) fn aligned<'l>(
    first: &'l [Line],
    second: &'l [Line],
) -> impl Iterator<Item = Aligned<'l>> {
    let is_swapped = first.len() > second.len();
    let (short, long) = if is_swapped { (second, first) } else { (first, second) };
    let partners = partners(short, long);
    let mut taken = partners.into_iter().zip(short).peekable();
    long.iter().enumerate().map(move |(at, line)| {
        let partner = taken.next_if(|own| own.0 == at).map(|own| own.1);
        if is_swapped { (Some(line), partner) } else { (partner, Some(line)) }
    })
}

/// For each line of the shorter list the number of its partner, found by dynamic programming.
fn partners(short: &[Line], long: &[Line]) -> Vec<usize> {
    let spare = long.len() - short.len();
    let log = |line: &Line| line.rate.high().ln();
    // `cost[i][skip]`: of the first i of the shorter list with `skip` of the longer one left out.
    let mut cost = vec![vec![0.0; spare + 1]];
    for (i, line) in short.iter().enumerate() {
        let mut next = vec![f64::INFINITY; spare + 1];
        let mut best = f64::INFINITY;
        for skip in 0..=spare {
            best = f64::min(best, cost[i][skip]);
            next[skip] = best + (log(line) - log(&long[i + skip])).abs();
        }
        cost.push(next);
    }
    let mut skip = spare;
    let mut found: Vec<usize> = (0..short.len())
        .rev()
        .map(|i| {
            skip =
                (0..=skip).min_by(|&a, &b| cost[i + 1][a].total_cmp(&cost[i + 1][b])).unwrap_or(0);
            i + skip
        })
        .collect();
    found.reverse();
    found
}
