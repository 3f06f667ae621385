//! Curves that jump as they start, such as the force of a dashpot that is struck.
//!
//! Samples tell between which two of them the jump was and no more, so what is left of them is a step function of the
//! clock. Here it is decided which sample is the first behind the jump. From there the clock is a number that was
//! measured besides: the middle of the step between the two, with half of that for a standard deviation. With it the clock
//! takes part in the fit, in which no sample changes sides. An error of at most one standard deviation adds no more to
//! that of the estimate than its variance allows, so intervals hold the truth with at least what they state wherever in its
//! step an impact falls. The deviation of what is even over the step, step/√12, holds that on the average alone: at its ends
//! it comes down to 82 in place of 95 of 100, where the rest of the curve tells as much of the clock.

use serde::Serialize;

use super::{
    Curve, Kind,
    residuals::{Own, Task},
    sum,
};

/// A curve jumps as it starts where that is more than this part of its peak.
const JUMPS: f64 = 0.05;
/// So many of the steepest steps of a record are taken for that jump at first.
const STEEPEST: usize = 4;
/// A jump of less than so many standard deviations of a sample takes no part of its own.
const FEWEST: f64 = 2.0;
/// A rise within a step of the recorder that is as large in this many halvings of it is a jump.
const HALVINGS: usize = 30;
/// So many samples to either side are looked at.
const LOOKED: usize = 4;
/// So many samples further than those beside a later jump take no part.
const BESIDE: usize = 1;

/// Where the jump of a curve lies among the samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Jump {
    /// The first sample behind it.
    pub(super) first: usize,
    /// Between which times it is \[s\].
    pub(super) ends: [f64; 2],
    /// Mean and standard deviation of its time \[s\].
    pub(super) mean: f64,
    pub(super) deviation: f64,
}

/// A jump of a curve behind its start.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Later {
    /// When on the clock of the record \[s\].
    pub time: f64,
    /// By how much, in the unit of the record.
    pub height: f64,
}

impl Jump {
    /// That before a sample; none before the first.
    fn before(first: usize, times: &[f64]) -> Option<Self> {
        let ends = [*times.get(first.checked_sub(1)?)?, *times.get(first)?];
        let mean = 0.5 * (ends[0] + ends[1]);
        let deviation = 0.5 * (ends[1] - ends[0]);
        (deviation > 0.0).then_some(Self { first, ends, mean, deviation })
    }

    /// How far a time is from the mean, in standard deviations.
    pub(super) fn off(&self, time: f64) -> f64 {
        (time - self.mean) / self.deviation
    }
}

impl Task<'_> {
    /// Where the search for the clock of a test begins. For an impact where peaks stand together, or the jump of the curve is one of
    /// the steepest steps of the record, whichever leaves less of the rows. From one jump a search does not come to
    /// another.
    pub(super) fn start_of_clock(&self, test: usize, curve: &dyn Curve) -> f64 {
        let (record, rows) = (self.record(test), &self.tests()[test].rows);
        if self.tests()[test].kind != Kind::Blow {
            return 0.0;
        }
        let peak = curve.peak();
        let aligned = record.peak_time - peak.0;
        let height = curve.value(0.0) - curve.value(-record.step);
        if height.abs() <= JUMPS * peak.1.abs() {
            return aligned;
        }
        let step = |pair: &[(f64, f64)]| {
            ((pair[1].1 - pair[0].1) * height.signum(), 0.5 * (pair[0].0 + pair[1].0))
        };
        let mut steps: Vec<(f64, f64)> = rows.windows(2).map(step).collect();
        steps.sort_by(|one, other| other.0.total_cmp(&one.0));
        let tried = steps.iter().take(STEEPEST).map(|own| own.1);
        let left = |late: f64| self.left_of_line(test, curve, late);
        let best =
            tried.map(|late| (left(late), late)).fold((left(aligned), aligned), |best, own| {
                if own.0 < best.0 { own } else { best }
            });
        best.1
    }

    /// What the nearest multiple of a curve, by a clock that is so late, and the nearest zero leave of the rows: the
    /// sum of squares.
    fn left_of_line(&self, test: usize, curve: &dyn Curve, late: f64) -> f64 {
        let model = self.recorded(test, curve, late);
        let rows = &self.tests()[test].rows;
        let count = rows.len() as f64;
        let means = [model.iter().sum::<f64>(), rows.iter().map(|own| own.1).sum()];
        let [model_mean, mean] = means.map(|own| own / count);
        let mut sums = [0.0; 3];
        for (model, row) in model.iter().zip(rows) {
            let (one, other) = (model - model_mean, row.1 - mean);
            sums[0] += one * one;
            sums[1] += one * other;
            sums[2] += other * other;
        }
        let [own, both, measured] = sums;
        if own > 0.0 { measured - both.max(0.0).powi(2) / own } else { measured }
    }

    /// Finds the jumps of all tests at a minimum, and puts their clocks between the samples. Whether there are any.
    pub(super) fn place_jumps(&mut self, unknowns: &mut [f64], scale: Option<f64>) -> bool {
        let mut has_jumps = false;
        for test in 0..self.tests().len() {
            let jump = self.jump(test, unknowns, scale);
            self.set_jump(test, jump);
            self.set_skipped(test, self.beside_jumps(test, unknowns));
            has_jumps |= !self.record(test).skipped.is_empty();
            if let (Some(jump), Some(at)) = (jump, self.places(test).shift) {
                let length = self.record(test).length;
                unknowns[at] = (unknowns[at] * length).clamp(jump.ends[0], jump.ends[1]) / length;
            }
        }
        has_jumps || self.jumps().next().is_some()
    }

    /// The largest jump of a curve behind its start, as where it is touched again: when it is on the clock of the record
    /// \[s\], and its height. None of a test whose clock is right, or of one that is no impact.
    pub(super) fn later_jump(&self, test: usize, curve: &dyn Curve, own: Own) -> Option<Later> {
        self.places(test).shift.filter(|_| self.tests()[test].kind == Kind::Blow)?;
        let all = self.later_jumps(test, curve, own).into_iter().map(|own| own.1);
        all.max_by(|one, other| one.height.abs().total_cmp(&other.height.abs()))
    }

    /// All of them, each with the sample before it.
    fn later_jumps(&self, test: usize, curve: &dyn Curve, own: Own) -> Vec<(usize, Later)> {
        let record = self.record(test);
        let least = (JUMPS * curve.peak().1.abs()).max(FEWEST * record.unit);
        let value = |time: f64| own.gain * curve.value(time - own.shift);
        let pairs = record.recorder.times().windows(2).enumerate();
        let behind = pairs.filter(|(_, pair)| pair[0] - own.shift > record.step);
        let jump = |(at, pair): (usize, &[f64])| {
            Some((at, jump_between([pair[0], pair[1]], least, &value)?))
        };
        behind.filter_map(jump).collect()
    }

    /// Rows beside later jumps: which of them lie behind these depends on all numbers, by steps.
    fn beside_jumps(&self, test: usize, unknowns: &[f64]) -> Vec<usize> {
        let own = &self.tests()[test];
        if own.kind != Kind::Blow || own.filter.is_some() {
            return Vec::new();
        }
        let Ok(curve) = self.curve(test, unknowns) else { return Vec::new() };
        let all = self.later_jumps(test, curve.as_ref(), self.own(test, unknowns));
        let beside =
            |at: usize| at.saturating_sub(BESIDE)..=(at + 1 + BESIDE).min(own.rows.len() - 1);
        all.into_iter().flat_map(|own| beside(own.0)).collect()
    }

    /// The jump of a test by what its samples tell of it, each counted in their noise.
    fn jump(&mut self, test: usize, unknowns: &[f64], scale: Option<f64>) -> Option<Jump> {
        self.places(test).shift.filter(|_| self.tests()[test].kind == Kind::Blow)?;
        let curve = self.curve(test, unknowns).ok()?;
        let (own, record) = (self.own(test, unknowns), self.record(test));
        let height = own.gain * (curve.value(0.0) - curve.value(-record.step));
        if height.abs() < FEWEST * record.unit {
            return None;
        }
        let times = record.recorder.times().to_vec();
        let around = times.partition_point(|time| *time < own.shift);
        let near = around.saturating_sub(LOOKED)..=around + LOOKED;
        let near: Vec<Jump> = near.filter_map(|first| Jump::before(first, &times)).collect();
        let mut costs = Vec::with_capacity(near.len());
        for jump in &near {
            self.set_jump(test, Some(*jump));
            costs.push(sum(&self.left_of(test, curve.as_ref(), own), scale));
        }
        let least = costs.iter().copied().fold(f64::INFINITY, f64::min);
        let best = near[costs.iter().position(|own| *own <= least)?];
        // Where noise leaves it open which sample is the first, the clock may be in either step.
        let weights: Vec<f64> = costs.iter().map(|own| (least - own).exp()).collect();
        let all: f64 = weights.iter().sum();
        let mean = |of: &dyn Fn(&Jump) -> f64| {
            near.iter().zip(&weights).map(|(own, weight)| weight * of(own)).sum::<f64>() / all
        };
        let centre = mean(&|own| own.mean);
        let variance = mean(&|own| own.deviation.powi(2) + (own.mean - centre).powi(2));
        let is_taken = |at: &usize| weights[*at] > TAKEN;
        let taken = || (0..near.len()).filter(is_taken);
        let ends = [near[taken().next()?].ends[0], near[taken().next_back()?].ends[1]];
        Some(Jump { first: best.first, ends, mean: centre, deviation: variance.sqrt() })
    }
}

/// The jump of at least this height between two times, if there is one.
fn jump_between(mut ends: [f64; 2], least: f64, value: &dyn Fn(f64) -> f64) -> Option<Later> {
    let mut values = ends.map(value);
    for _ in 0..HALVINGS {
        if (values[1] - values[0]).abs() < least {
            return None;
        }
        let time = f64::midpoint(ends[0], ends[1]);
        let middle = value(time);
        let is_first = (middle - values[0]).abs() > (values[1] - middle).abs();
        let side = usize::from(is_first);
        (ends[side], values[side]) = (time, middle);
    }
    let height = values[1] - values[0];
    (height.abs() >= least).then_some(Later { time: ends[1], height })
}

/// Lets the samples of what jumps rise over the step of the recorder that leads to the jump, so that they depend
/// continuously on its time.
pub(super) fn ramped(values: &mut [f64], times: &[f64], value: &dyn Fn(f64) -> f64) {
    let least = JUMPS * values.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
    for at in 1..values.len() {
        let ends = [times[at - 1], times[at]];
        if (values[at] - values[at - 1]).abs() < least || least <= 0.0 {
            continue;
        }
        if let Some(own) = jump_between(ends, least, value) {
            values[at - 1] += own.height * (ends[1] - own.time) / (ends[1] - ends[0]);
        }
    }
}

/// Steps that are less likely than this in parts of the likeliest are left out.
const TAKEN: f64 = 1e-3;
