//! When a test is looked at.

use super::history::{History, Instant};

/// Part of the fastest time, and of each phase, at which the first look is taken.
const EARLY: f64 = 0.01;
/// Distance from a corner, relative to its time, below which instants run together.
const DISTINCT: f64 = 16.0 * f64::EPSILON;

/// About `points` instants of a test: logarithmic in the time since the last corner of the history,
/// from a hundredth of `fastest` \[s\] on. Every corner but the last is looked at from both sides.
pub(super) fn instants(history: &History, fastest: f64, points: usize) -> Vec<Instant> {
    let corners = history.corners();
    let phases = corners.len().saturating_sub(1).max(1);
    let count = (points / phases).max(2);
    let mut all = Vec::with_capacity(points + 2 * corners.len());
    for pair in corners.windows(2) {
        let (start, end) = (pair[0].time, pair[1].time);
        all.extend([Instant::before(start), Instant::after(start)]);
        let first = (EARLY * fastest.min(end - start)).max(DISTINCT * start);
        let offsets = logarithmic(first, end - start, count);
        let mut last = start;
        for time in offsets.into_iter().map(|offset| start + offset) {
            if time > last && time < end {
                all.push(Instant::after(time));
                last = time;
            }
        }
    }
    all.push(Instant::before(history.end()));
    all
}

/// `count` values from `first` to `last`, two or more, each a constant factor above the one before.
pub(super) fn logarithmic(first: f64, last: f64, count: usize) -> Vec<f64> {
    let steps = count.max(2) - 1;
    let decades = (last / first).ln();
    (0..=steps)
        .map(|at| match at {
            0 => first,
            _ if at == steps => last,
            _ => first * (decades * (at as f64 / steps as f64)).exp(),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rheometer::history::Side;

    #[test]
    fn both_sides_of_each_corner_are_looked_at() {
        let all = instants(&History::pulse(1.0, 0.0, 5.0, 20.0), 1e-3, 40);
        assert!(all.windows(2).all(|pair| pair[0].time <= pair[1].time));
        let sides = |time: f64| -> Vec<Side> {
            let at = all.iter().filter(|instant| (instant.time - time).abs() < 1e-14);
            at.map(|instant| instant.side).collect()
        };
        assert_eq!(sides(0.0), [Side::Before, Side::After]);
        assert_eq!(sides(5.0), [Side::Before, Side::After]);
        assert_eq!(sides(20.0), [Side::Before]);
        assert!((all[2].time - 1e-5).abs() < 1e-18);
        assert!((40..=46).contains(&all.len()), "{}", all.len());
    }

    #[test]
    fn times_that_run_together_are_left_out() {
        let all = instants(&History::pulse(1.0, 0.0, 1e12, 2e12), 1e-9, 100);
        let after: Vec<f64> =
            all.iter().map(|instant| instant.time).filter(|&time| time > 1e12).collect();
        assert!(after.windows(2).all(|pair| pair[0] < pair[1]));
    }
}
