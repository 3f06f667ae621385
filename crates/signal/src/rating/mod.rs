//! How well a model meets a test, by ISO/TS 18571.

mod magnitude;

use serde::Serialize;
use thiserror::Error;

use crate::Channel;

/// The steps at which both curves are compared \[s\]; the slopes are averaged over nine of them.
const STEP: f64 = 1e-4;
/// The shortest curve that has a rating, in samples.
const FEWEST: usize = 20;
/// The longest one; the time of warping grows with the square.
const MOST: usize = 20_000;
/// Weights of corridor, phase, magnitude and slope.
const WEIGHTS: [f64; 4] = [0.4, 0.2, 0.2, 0.2];

/// How well a model meets a test, by the scores of ISO/TS 18571: each between 0 and 1, where 1 is met.
///
/// Both curves are read at steps of 0.1 ms on the lines between their samples. The corridor is that of the curves as
/// they are. The phase is told by the shift of the model, by up to a fifth of the length, with the largest
/// correlation; magnitude and slope are compared behind that shift.
///
/// # References
///
/// `iso18571` in `docs/references.bib`. The constants are those of a public implementation, with which all scores agree
/// (`tests/it/rating_reference.py`); the specification itself was not at hand.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Rating {
    /// How much of the time the model keeps within 5 % of the measured peak, and in part within 50 %.
    pub corridor: f64,
    /// How little it is shifted: 1 without a shift, 0 from 20 % of the length on.
    pub phase: f64,
    /// How little the areas differ where both are warped onto each other: 0 from 50 % on.
    pub magnitude: f64,
    /// How little the slopes differ: 0 from twice the measured ones on.
    pub slope: f64,
    /// How much later the model is than the test \[s\].
    pub later: f64,
}

dashpot_units::words! {
    /// Why there is no rating.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
    #[non_exhaustive]
    pub enum Unrated, pub fn code(self) {
        /// The common part is shorter than 2 ms.
        #[error("the curves have less than 2 ms in common")]
        TooShort = "too-short",
        /// It is longer than 2 s.
        #[error("the curves have more than 2 s in common, and an impact is shorter")]
        TooLong = "too-long",
        /// The test is zero throughout.
        #[error("what was measured is zero throughout")]
        Zero = "zero",
    }
}

/// Half widths of both corridors in parts of the measured peak.
const INNER: f64 = 0.05;
const OUTER: f64 = 0.5;
/// The largest shift in parts of the length.
const MOST_SHIFT: f64 = 0.2;
/// A correlation that is larger by less than this is the same: rounding moves nothing.
const SAME: f64 = 1e-12;
/// Slopes are means over so many samples, and over as many as there are towards an end.
const MEANS: usize = 9;
/// The difference of slopes in parts of those of the test from which on the score is 0.
const MOST_SLOPE: f64 = 2.0;

/// Two curves at the same even steps.
#[derive(Debug, Clone, Copy)]
struct Pair<'p> {
    test: &'p [f64],
    model: &'p [f64],
}

impl Rating {
    /// That of a model beside a test, over a window \[s\] in which both have samples.
    ///
    /// # Errors
    ///
    /// [`Unrated`].
    pub fn of(test: &Channel, model: &Channel, window: (f64, f64)) -> Result<Self, Unrated> {
        let count = ((window.1 - window.0) / STEP * (1.0 + 1e-12)).floor();
        if count < (FEWEST - 1) as f64 {
            return Err(Unrated::TooShort);
        }
        if count >= MOST as f64 {
            return Err(Unrated::TooLong);
        }
        let mut places = Vec::new();
        let mut at = 0.0;
        while at <= count {
            places.push((window.0 + at * STEP).min(window.1));
            at += 1.0;
        }
        let read = |own: &Channel| places.iter().map(|time| own.value(*time)).collect::<Vec<_>>();
        let (test, model) = (read(test), read(model));
        if test.iter().all(|own| *own == 0.0) {
            return Err(Unrated::Zero);
        }
        Ok(Self::of_pair(Pair { test: &test, model: &model }))
    }

    fn of_pair(pair: Pair<'_>) -> Self {
        let shift = pair.shift();
        let shifted = pair.shifted(shift);
        Self {
            corridor: pair.corridor(),
            phase: (1.0 - shift.unsigned_abs() as f64 / (MOST_SHIFT * pair.test.len() as f64))
                .max(0.0),
            magnitude: magnitude::score(shifted),
            slope: shifted.slope(),
            later: shift as f64 * STEP,
        }
    }

    /// The weighted sum of all four: 0.4 of the corridor, 0.2 of each other.
    pub fn overall(&self) -> f64 {
        let parts = [self.corridor, self.phase, self.magnitude, self.slope];
        parts.iter().zip(WEIGHTS).map(|(own, weight)| own * weight).sum()
    }

    /// What the overall rating is called: `poor`, `fair` above 0.58, `good` above 0.80, `excellent` above 0.94.
    pub fn grade(&self) -> &'static str {
        match self.overall() {
            own if own > 0.94 => "excellent",
            own if own > 0.80 => "good",
            own if own > 0.58 => "fair",
            _ => "poor",
        }
    }
}

impl<'p> Pair<'p> {
    /// What both have in common where the model is so many steps earlier.
    fn shifted(self, steps: isize) -> Self {
        let count = self.test.len();
        let by = steps.unsigned_abs();
        let (early, late) = (..count - by, by..);
        let Self { test, model } = self;
        if steps < 0 {
            Self { test: &test[late], model: &model[early] }
        } else {
            Self { test: &test[early], model: &model[late] }
        }
    }

    fn values(self) -> impl Iterator<Item = (f64, f64)> + use<'p> {
        self.test.iter().copied().zip(self.model.iter().copied())
    }

    /// How much of the time the model keeps to corridors about the test: the mean over all samples of 1 within the inner
    /// one, 0 outside of the outer one, and the square of how far it is from the outer one between them.
    fn corridor(self) -> f64 {
        let peak = self.test.iter().map(|own| own.abs()).fold(0.0, f64::max);
        let one = |(test, model): (f64, f64)| {
            let off = (test - model).abs() / peak;
            ((OUTER - off) / (OUTER - INNER)).clamp(0.0, 1.0).powi(2)
        };
        self.values().map(one).sum::<f64>() / self.test.len() as f64
    }

    /// By how many steps the model is later: the shift with the largest correlation; of equal ones the smallest, of two as
    /// small the one by which it is later.
    fn shift(self) -> isize {
        let most = (MOST_SHIFT * self.test.len() as f64).floor();
        let (mut best, mut found) = (self.correlation(), 0);
        let mut by: isize = 1;
        while by as f64 <= most {
            for own in [by, -by] {
                let correlation = self.shifted(own).correlation();
                if correlation > best + SAME {
                    (best, found) = (correlation, own);
                }
            }
            by += 1;
        }
        found
    }

    /// Correlation about both means; −1 where one of both is constant, which tells no shift.
    fn correlation(self) -> f64 {
        let count = self.test.len() as f64;
        let mean = |own: &[f64]| own.iter().sum::<f64>() / count;
        let (of_test, of_model) = (mean(self.test), mean(self.model));
        let mut sums = [0.0; 3];
        for (test, model) in self.values() {
            let (test, model) = (test - of_test, model - of_model);
            sums[0] += test * model;
            sums[1] += test * test;
            sums[2] += model * model;
        }
        let size = (sums[1] * sums[2]).sqrt();
        if size > 0.0 { sums[0] / size } else { -1.0 }
    }

    /// By the sums of absolute differences of both slopes, and of those of the test.
    fn slope(self) -> f64 {
        let [test, model] = [self.test, self.model].map(|own| smooth(&differences(own)));
        let off = test.iter().zip(&model).map(|(test, model)| (test - model).abs()).sum();
        falling(off, test.iter().map(|own| own.abs()).sum(), MOST_SLOPE)
    }
}

/// A score that falls with the difference of two curves in parts of the measured one, from 1 to 0 at `most`.
fn falling(difference: f64, measured: f64, most: f64) -> f64 {
    if difference == 0.0 {
        return 1.0;
    }
    (1.0 - difference / (most * measured)).max(0.0)
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

#[cfg(test)]
mod tests;
