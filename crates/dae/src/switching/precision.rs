//! How well an interval is known where its guards look: what may have switched before a run ends,
//! and sizes of unknowns in intervals that see little of them.
//!
//! Scales are made for a whole run: what a weight could do in all of it may be 10⁹ times what a gap leaves it. A method
//! that follows places to its tolerance of such a scale knows nothing of when the gap closes. An interval in which a
//! guard's output stays that small is solved once more, with sizes of its own.

use std::ops::ControlFlow;

use super::{IntervalEnd, ModeInterval, Switching};
use crate::{
    Dense, Direction, Guard, Observer, Progress, Run, SolveError, System, Trajectory, UnknownKind,
    pieces::ROUNDING, run::Instant,
};

/// An output that has strayed from its level by less than this part of what tolerances are made for is
/// solved for again.
const SMALL: f64 = 1e-3;
/// Least size of what balances determine, which they do no better than to roundings of what they balance.
const LEAST_BALANCED: f64 = 1e-5;
/// Least size of all others.
const LEAST: f64 = 1e-20;

/// Roundings of its rate that an unknown at rest collects.
const COLLECTED: f64 = 64.0;

/// By how much more than it takes a run is to be longer.
const AMPLE: f64 = 2.0;
/// Longest margin in parts of the run: what takes longer rests, or settles on its level.
const LONGEST_MARGIN: f64 = 0.05;

/// How much longer the last `interval` would have to be for outputs on their way out to be seen beyond the levels
/// of their guards, if by the error of the method they may be there before its end \[s\]. `threshold` is as in
/// [`IntervalEnd::threshold`](super::IntervalEnd::threshold).
pub(super) fn end_margin(
    interval: &ModeInterval,
    dense: &dyn Dense,
    run: &Run,
    threshold: f64,
) -> Option<f64> {
    let system = interval.system.as_ref();
    let of_guard = |guard: &Guard| {
        let outward = match guard.direction {
            Direction::Rising => 1.0,
            Direction::Falling => -1.0,
            Direction::Either => return None,
        };
        let signal = dense.signal(system, guard.output);
        let last = signal.panels.last().filter(|panel| panel.length() > 0.0)?;
        let left = outward * (guard.level - last.value(last.end));
        let speed = outward * last.slope(last.end);
        let largest = signal.noise / (ROUNDING * f64::EPSILON);
        let span = AMPLE * (left.max(0.0) + AMPLE * run.rtol * largest) / speed;
        let is_near =
            speed > 0.0 && left <= threshold * largest && span <= LONGEST_MARGIN * run.t_end;
        is_near.then_some(span)
    };
    interval.guards.iter().filter_map(of_guard).reduce(f64::max)
}

/// The sizes with which an interval is to be solved again; `None` where those of the `run` have done. What has strayed
/// by no more than the roundings of its rate is at rest, and has no size.
pub(super) fn smaller_sizes(
    interval: &ModeInterval,
    run: &Run,
    trajectory: &Trajectory,
) -> Option<Vec<f64>> {
    let system = interval.system.as_ref();
    let before = |unknown: usize| run.tolerance_scaling.get(unknown).copied().unwrap_or(1.0);
    let mut found: Option<Vec<f64>> = None;
    let mut collected: Option<Vec<f64>> = None;
    let middle = 0.5 * trajectory.t_end / system.time_scale;
    let instants = [0.0, middle]
        .map(|time| Instant::new(system, trajectory.dense.sample(system, &[time]), (time, time)));
    for guard in &interval.guards {
        let output = system.outputs.at(guard.output);
        let scale = output.scale.abs();
        let terms = || output.unknowns.terms().map(|(at, factor)| (at, scale * factor.abs()));
        let unit: f64 = terms().map(|(at, factor)| factor * before(at)).sum();
        let strays = |at: &Instant| (at.value(system, guard.output) - guard.level).abs();
        if instants.iter().any(|own| strays(own) > 2.0 * SMALL * unit) {
            continue;
        }
        let held = held(trajectory.dense.as_ref(), system, guard.output, guard.level);
        if !(held > 0.0 && held < SMALL * unit) {
            continue;
        }
        let rest = collected.get_or_insert_with(|| collected_roundings(system, trajectory));
        let sizes = found.get_or_insert_with(|| (0..system.len()).map(before).collect());
        for (at, factor) in terms() {
            let least = match system.unknowns[at].kind {
                UnknownKind::Algebraic => LEAST_BALANCED,
                UnknownKind::Differential if held <= factor * rest[at] => continue,
                UnknownKind::Differential => LEAST,
            };
            sizes[at] = sizes[at].min((held / factor).max(least));
        }
    }
    found.filter(|sizes| sizes.iter().enumerate().any(|(at, &own)| own < SMALL * before(at)))
}

/// What the rounding of its rate at the start of an interval makes of each unknown in all of it.
fn collected_roundings(system: &System, trajectory: &Trajectory) -> Vec<f64> {
    let start = trajectory.dense.sample(system, &[0.0]);
    let mut inputs = vec![0.0; system.inputs.len()];
    system.inputs_at(0.0, 0.0, &mut inputs);
    let mut rates = vec![0.0; system.len()];
    for (matrix, values) in [(&system.jacobian, &start), (&system.input_matrix, &inputs)] {
        for (row, column, factor) in matrix.triplet_iter() {
            rates[row] += (factor * values[column]).abs();
        }
    }
    let length = trajectory.t_end / system.time_scale;
    rates.into_iter().map(|rate| COLLECTED * f64::EPSILON * rate * length).collect()
}

/// The most that an output has strayed from its level, or had to be summed up of.
fn held(dense: &dyn Dense, system: &System, output: usize, level: f64) -> f64 {
    let signal = dense.signal(system, output);
    let terms = signal.noise / (ROUNDING * f64::EPSILON);
    let gap = |coefficients: &[f64]| {
        let (constant, rest) = coefficients.split_first().unwrap_or((&0.0, &[]));
        (constant - level).abs() + rest.iter().map(|own| own.abs()).sum::<f64>()
    };
    signal.panels.iter().map(|panel| gap(&panel.coefficients)).fold(terms, f64::max)
}

/// By how many roundings a state is perturbed: more than an interval's own errors leave in it.
const SHAKES: f64 = 64.0;
/// Part of its state that an interval must have changed to be perturbed by so much; one that changes
/// less is perturbed by less in proportion. What is thrown back from so near that its way out and back
/// is less than a rounding would else never come to rest.
const CHANGE: f64 = 1e-4;
/// Most intervals that a perturbed run may have for each interval of the run, and beyond: with more it is another run.
const INTERVALS: usize = 2;
const MORE_INTERVALS: usize = 64;

/// The same intervals, each of which begins where the one before ended but for its last digits.
#[derive(Debug)]
pub(super) struct Perturbed<'s> {
    pub(super) inner: &'s dyn Switching,
}

impl Perturbed<'_> {
    /// Most intervals of the perturbed run where there are so many in the run.
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
        let perturbed = |(at, value): (usize, &f64)| {
            // The signs follow the places, so that a run repeats to the bit.
            let sign = if (at * at + at / 2).is_multiple_of(3) { 1.0 } else { -1.0 };
            value * (1.0 + sign * SHAKES * f64::EPSILON * part)
        };
        let state: Vec<f64> = end.state.iter().enumerate().map(perturbed).collect();
        self.inner.next(&IntervalEnd { state: &state, ..*end })
    }
}

/// Tells the observer of a run, which is over, that its perturbed one is under way.
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
