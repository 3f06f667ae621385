//! What there is to say about each test at a minimum.

use dashpot_signal::clipped_rows;

use super::{
    Curve, Kind, OtherZero, Test, TestFit,
    residuals::{Own, Task},
};

/// Fewer rows before the impact tell no noise.
pub(super) const FEWEST: usize = 8;
/// What the filter smears of an impact to before it lies within so many periods of its design frequency.
const SMEARED: f64 = 2.0;

/// Rows before the impact contradict a zero that is off by more than this part of the peak, and by so many standard
/// errors of their mean, by the scatter of the means of so many blocks: filtered rows follow each other.
const ZERO_OFF: f64 = 0.005;
const ERRORS: f64 = 6.0;
const BLOCKS: usize = 8;

/// What is left of a record is more than noise beyond so many times that, where its rows tell it; else where the statistic
/// of Durbin and Watson is below this, which is 2 of noise that is white.
const NOISY: f64 = 1.5;
const FOLLOWING: f64 = 1.0;
/// It is more than noise that is stated beyond so many times that, as it is rounded, and so many standard deviations of a
/// mean square, each `√(2/rows)` of it; beyond [`NOISY`] at the latest, and beyond the third where rows follow each other.
const BEYOND_STATED: f64 = 1.1;
const FOLLOWING_STATED: f64 = 1.25;
const BEYOND_CHANCE: f64 = 4.0;
/// Fewer rows tell no such statistic.
const FEWEST_FOLLOWING: usize = 20;
/// More than this part of the peak is much of a record; less than this is no more than the error of solutions.
const MISSED: f64 = 0.03;
const EXACT: f64 = 1e-6;

/// The sum of squares of differences of neighbouring rows over that of the rows.
///
/// Source: J. Durbin, G. S. Watson, Biometrika 37 (1950) 409–428.
fn durbin_watson(left: &[f64]) -> f64 {
    let steps: f64 = left.windows(2).map(|two| (two[1] - two[0]).powi(2)).sum();
    let square: f64 = left.iter().map(|own| own * own).sum();
    if left.len() < FEWEST_FOLLOWING || square <= 0.0 { 2.0 } else { steps / square }
}

/// The standard deviation in medians of the magnitude of normal deviates.
const OF_MEDIAN: f64 = 1.4826;

/// The standard deviation of normal deviates about zero, by the median of their magnitudes.
pub(super) fn deviation(left: &[f64]) -> f64 {
    OF_MEDIAN * median(&left.iter().map(|own| own.abs()).collect::<Vec<_>>())
}

/// The same about their median.
pub(super) fn deviation_at_rest(rows: &[f64]) -> f64 {
    let middle = median(rows);
    deviation(&rows.iter().map(|own| own - middle).collect::<Vec<_>>())
}

fn median(rows: &[f64]) -> f64 {
    let mut sorted = rows.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(0.0)
}

fn mean(rows: &[f64]) -> f64 {
    rows.iter().sum::<f64>() / rows.len() as f64
}

/// Whether more is left in rows than noise of a standard deviation that is stated, or else was read, or than any that is
/// white.
pub(super) fn is_structured(left: &[f64], stated: Option<f64>, read: Option<f64>) -> bool {
    let rows = left.len() as f64;
    let is_beyond = |square: f64, noise: f64| {
        left.iter().map(|own| own * own).sum::<f64>() > rows * square * noise * noise
    };
    let by_chance = 1.0 + BEYOND_CHANCE * (2.0 / rows).sqrt();
    // Rows that follow each other are no chance.
    let most = if durbin_watson(left) < FOLLOWING { FOLLOWING_STATED } else { NOISY };
    match (stated, read.filter(|own| *own > 0.0)) {
        (Some(noise), _) => {
            is_beyond(by_chance.max(BEYOND_STATED.powi(2)).min(most.powi(2)), noise)
        }
        (None, Some(noise)) => is_beyond(NOISY.powi(2), noise),
        (None, None) => durbin_watson(left) < FOLLOWING,
    }
}

/// A row belongs to the impact that differs from the first one by more than this part of the peak.
const QUIET: f64 = 0.1;

/// When a record leaves its first value \[s\]; `None` where it never does.
fn leaves(test: &Test) -> Option<f64> {
    let first = test.rows.first()?.1;
    let peak = largest(test.rows.iter().map(|row| row.1 - first)).abs();
    Some(test.rows.iter().find(|row| (row.1 - first).abs() > QUIET * peak)?.0)
}

/// What the rows before the impact read at zero where a fitted zero contradicts them: until that of the model begins, of which
/// `left` is the model less the rows, or where it leaves too few of them, that of the record.
fn other_zero(test: &Test, left: &[f64], own: Own, [model, record]: [f64; 2]) -> Option<OtherZero> {
    let first = test.rows.first()?.1;
    let peak = largest(test.rows.iter().map(|row| row.1 - first)).abs();
    let before = |until: f64| test.rows.iter().take_while(move |row| row.0 < until);
    let mut left: Vec<f64> = before(model).zip(left).map(|row| *row.1).collect();
    if left.len() < FEWEST {
        left = before(record).map(|row| own.offset - row.1).collect();
        // A record that begins with the impact rises evenly until it has left its first value.
        let (early, late) = left.split_at(left.len() / 2);
        if (median(late) - median(early)).abs() > 0.25 * QUIET * peak {
            return None;
        }
    }
    let (rows, median) = (left.len(), median(&left));
    let blocks: Vec<f64> = left.chunks(rows.div_ceil(BLOCKS).max(1)).map(mean).collect();
    let (count, middle) = (blocks.len() as f64, mean(&blocks));
    let square = blocks.iter().map(|own| (own - middle).powi(2)).sum::<f64>();
    let least = f64::max(ZERO_OFF * peak, ERRORS * (square / (count * (count - 1.0))).sqrt());
    let is_apart = test.is_offset && rows >= FEWEST && median.abs() > least;
    is_apart.then_some(OtherZero { rows, median: own.offset - median })
}

/// To which side of its first value a curve goes more than twice as far as to the other: 1 or −1.
fn side(values: impl Iterator<Item = f64> + Clone) -> Option<f64> {
    let first = values.clone().next()?;
    let (low, high) = values.fold((0.0, 0.0), |(low, high): (f64, f64), own| {
        (low.min(own - first), high.max(own - first))
    });
    (high > -2.0 * low || -low > 2.0 * high).then_some(if high > -low { 1.0 } else { -1.0 })
}

/// The value of the largest magnitude, with its sign.
fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |most: f64, own| if own.abs() > most.abs() { own } else { most })
}

impl Task<'_> {
    /// What is left of a row of a test beyond the error of solutions, in its unit.
    pub(super) fn solved_to(&self, test: usize) -> f64 {
        let is_relative = self.tests()[test].kind == Kind::Modulus;
        let peak = if is_relative { 1.0 } else { self.record(test).peak };
        EXACT * peak / self.unit(test)
    }

    /// The largest magnitude of a curve as it would be recorded, by a clock that is so late.
    fn peak_of(&self, test: usize, curve: &dyn Curve, shift: f64) -> f64 {
        let own = &self.tests()[test];
        if own.filter.is_none() && own.kind == Kind::Blow {
            curve.peak().1
        } else {
            largest(self.recorded(test, curve, shift).into_iter())
        }
    }

    /// The samples of a test where the shared numbers have these values, and what it has to itself is as at a minimum.
    pub(super) fn samples(
        &self,
        test: usize,
        values: &[f64],
        unknowns: &[f64],
    ) -> Option<Vec<Option<f64>>> {
        let own = self.own(test, unknowns);
        let known = self.values_of(test, unknowns).split_off(self.numbers().len());
        let curve = self.solved(test, &[values, &known].concat()).ok()?;
        let samples = self.recorded(test, curve.as_ref(), own.shift).into_iter();
        Some(samples.map(|value| Some(own.gain * value)).collect())
    }

    /// Until when the filtered record of a test rests \[s\]: until the impact begins, and no longer than it is near its first
    /// value, as a model that is wrong may begin later. Minus infinity where it is not one of an impact.
    fn rests_until(&self, test: usize, shift: f64) -> f64 {
        let own = &self.tests()[test];
        if own.kind != Kind::Blow {
            return f64::NEG_INFINITY;
        }
        let until = leaves(own).map_or(shift, |leaves| leaves.min(shift));
        until - own.filter.map_or(0.0, |own| SMEARED / own.0.design_frequency())
    }

    /// How many rows of a test are of samples before the impact.
    pub(super) fn rows_at_rest(&self, test: usize, unknowns: &[f64]) -> usize {
        self.rows_before(test, self.rests_until(test, self.own(test, unknowns).shift))
    }

    /// What there is to say about each test.
    pub(super) fn told(&self, unknowns: &[f64]) -> Vec<TestFit> {
        let left = self.left(unknowns);
        let taken = self.unknowns() as f64 / left.len() as f64;
        let told = |(at, rows): (usize, std::ops::Range<usize>)| {
            let own = self.own(at, unknowns);
            let curve = self.curve(at, unknowns).ok()?;
            let test = &self.tests()[at];
            let residual = self.differences(at, curve.as_ref(), own);
            let square: f64 = residual.iter().map(|own| own * own).sum();
            let (left, unit) = (&left[rows], self.unit(at));
            let mean_square =
                |rows: &[f64]| rows.iter().map(|own| own * own).sum::<f64>() / rows.len() as f64;
            let resting = &left[..self.rows_at_rest(at, unknowns)];
            let rests = [own.shift, f64::INFINITY].map(|begins| self.rests_until(at, begins));
            let at_rest = (resting.len() >= FEWEST).then(|| unit * deviation_at_rest(resting));
            let scatter = self.scatter(at, unknowns);
            let noise = unit * (mean_square(left) / (1.0 - taken).max(0.1)).sqrt();
            let rms = (square / residual.len() as f64).sqrt();
            let measured_peak = largest(test.rows.iter().map(|row| row.1 - own.offset));
            let part = if test.kind == Kind::Modulus { rms } else { rms / measured_peak.abs() };
            let read = scatter.map(|own| own.deviation).or(at_rest).map(|own| own / unit);
            let stated = test.noise.map(|own| own / unit);
            let model = test.rows.iter().zip(&residual).map(|(row, left)| row.1 + left);
            let sides = side(test.rows.iter().map(|row| row.1)).zip(side(model));
            let is_opposed =
                test.kind != Kind::Modulus && sides.is_some_and(|own| own.0 * own.1 < 0.0);
            let is_structured = part > EXACT && is_structured(left, stated, read);
            Some(TestFit {
                shift: own.shift,
                offset: own.offset,
                gain: own.gain,
                known: self.values_of(at, unknowns)[self.numbers().len()..].to_vec(),
                jump: self
                    .record(at)
                    .jump
                    .map(|_| own.gain * (curve.value(0.0) - curve.value(-self.record(at).step))),
                later_jump: self.later_jump(at, curve.as_ref(), own),
                rms,
                rows: left.len(),
                mean_square: unit * unit * mean_square(left),
                noise,
                noise_at_rest: at_rest,
                clipped: if test.kind == Kind::Blow { clipped_rows(&test.rows) } else { 0 },
                other_zero: other_zero(test, &residual, own, rests),
                is_structured,
                is_missed: is_opposed
                    || is_structured && part > MISSED && durbin_watson(left) < FOLLOWING,
                is_opposed,
                scatter,
                measured_peak,
                model_peak: own.gain * self.peak_of(at, curve.as_ref(), own.shift),
                residual,
                band: Vec::new(),
                held_out: None,
            })
        };
        self.parts().enumerate().filter_map(told).collect()
    }
}
