//! The same run with its last digits shaken.

use std::ops::ControlFlow;

use super::{IntervalEnd, ModeInterval, Switching};
use crate::{Observer, Progress, SolveError};

/// By how many roundings a state is shaken: more than an interval's own errors leave in it.
const SHAKES: f64 = 64.0;
/// Part of its state that an interval must have changed to be shaken by so much; one that changes
/// less is shaken by less in proportion. What is thrown back from so near that its way out and back
/// is less than a rounding would else never come to rest.
const CHANGE: f64 = 1e-4;
/// Most intervals that a shaken run may have for each interval of the run, and beyond: with more it
/// is another run.
const INTERVALS: usize = 2;
const MORE_INTERVALS: usize = 64;

/// The same intervals, each of which begins where the one before ended but for its last digits.
#[derive(Debug)]
pub(super) struct Perturbed<'s> {
    pub(super) inner: &'s dyn Switching,
}

impl Perturbed<'_> {
    /// Most intervals of the shaken run where there are so many in the run.
    pub(super) fn most_intervals(intervals: usize) -> usize {
        INTERVALS * intervals + MORE_INTERVALS
    }
}

impl Switching for Perturbed<'_> {
    fn first(&self, threshold: f64) -> Result<ModeInterval, SolveError> {
        self.inner.first(threshold)
    }

    fn next(&self, end: &IntervalEnd<'_>) -> Result<ModeInterval, SolveError> {
        let part = (change(&end.interval.system.initial, end.state) / CHANGE).min(1.0);
        let shake = |(at, value): (usize, &f64)| {
            // The signs follow the places, so that a run repeats to the bit.
            let sign = if (at * at + at / 2).is_multiple_of(3) { 1.0 } else { -1.0 };
            value * (1.0 + sign * SHAKES * f64::EPSILON * part)
        };
        let state: Vec<f64> = end.state.iter().enumerate().map(shake).collect();
        self.inner.next(&IntervalEnd { state: &state, ..*end })
    }
}

/// Tells the observer of a run, which is over, that its shaken one is under way.
pub(super) struct Afterwards<'r> {
    /// Where the run has ended, and with how many steps.
    pub(super) end: Progress,
    pub(super) observer: &'r mut dyn Observer,
}

impl Observer for Afterwards<'_> {
    fn progress(&mut self, progress: Progress) -> ControlFlow<()> {
        let steps = self.end.steps + progress.steps;
        self.observer.progress(Progress { steps, ..self.end })
    }
}

/// The largest part by which an interval has changed any of its values; of small ones, in parts of
/// the largest, or of their scale.
fn change(start: &[f64], end: &[f64]) -> f64 {
    let floor = end.iter().fold(0.0_f64, |most, value| most.max(value.abs())).min(1.0);
    let parts = start.iter().zip(end).map(|(start, end)| {
        let change = (end - start).abs();
        if change > 0.0 { change / end.abs().max(floor) } else { 0.0 }
    });
    parts.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_way_out_and_back_hardly_changes_a_state_and_a_long_one_does() {
        assert!(change(&[0.25, 1e-9], &[0.25, -1e-9]) < 1e-8);
        // Of what flies far away and of what is at rest there is nothing to be told.
        assert!((change(&[1e9, 0.0, 0.5], &[1e9, 0.0, -0.5]) - 1.0).abs() < 1e-15);
        assert!((change(&[1e-9, -1e-9], &[1e-9, 1e-9]) - 2.0).abs() < 1e-15);
        assert!(change(&[0.0], &[0.0]).abs() < 1e-300);
    }
}
