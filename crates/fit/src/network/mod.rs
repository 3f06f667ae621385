//! Numbers of any model, to curves that were measured on it.
//!
//! What is solved is behind a closure: numbers in, curves out. Tests share the numbers; each has its own clock and its
//! own zero, which are fitted beside them. Unknowns are logarithms of the numbers, searched within their bounds from
//! the scene's own values and from others spread over the bounds.

mod bands;
mod certainty;
mod jump;
mod problem;
mod profile;
mod record;
mod repeats;
mod residuals;
mod search;
mod told;
mod watch;

use std::ops::ControlFlow;

use nalgebra::{DMatrix, DVector};
use serde::Serialize;

pub use self::{
    bands::{Band, NoBand, Read},
    certainty::{Interval, Source},
    jump::Later,
    problem::{Curve, Kind, Known, Model, NetworkFault, NetworkSettings, Number, Profile, Test},
    repeats::Scatter,
    search::Convergence,
    watch::{Phase, Search, Watch},
};
use self::{
    residuals::Task,
    search::{descended, search},
    watch::Watched,
};
use crate::optimum::{least_squares, sum};

/// What was found of a test.
#[derive(Debug, Clone, PartialEq)]
pub struct TestFit {
    /// How much later the rows are than the model \[s\].
    pub shift: f64,
    /// What the rows read at zero.
    pub offset: f64,
    /// What the rows read in place of 1.
    pub gain: f64,
    /// Its own numbers, in SI units.
    pub known: Vec<f64>,
    /// By how much the model jumps as it starts, where that alone puts the clock between two samples.
    pub jump: Option<f64>,
    /// Where the model jumps again, and its clock is as it would be without that.
    pub later_jump: Option<Later>,
    /// Root of the mean square of what is left; of moduli in parts of them.
    pub rms: f64,
    /// How many independent rows it has: behind a filter fewer than samples.
    pub rows: usize,
    /// Mean square of what is left of these, each as large as a sample before the filter.
    pub mean_square: f64,
    /// Standard deviation of what is left of a sample before the filter; without a filter of the rows.
    pub noise: f64,
    /// The same before the impact alone; `None` where fewer than eight rows tell it.
    pub noise_at_rest: Option<f64>,
    /// Whether what is left is more than noise: more than the noise that is known, or where none is, rows that follow each
    /// other as noise does not.
    pub is_structured: bool,
    /// Whether that is so much of its peak that the model does not describe it.
    pub is_missed: bool,
    /// Whether it goes to the other side than the model, as if its sign were turned.
    pub is_opposed: bool,
    /// Rows at the end of the range of what they were recorded with: how far the truth goes beyond is not known.
    pub clipped: usize,
    /// What the rows before the impact read, where the fitted zero is none of them.
    pub other_zero: Option<OtherZero>,
    /// What it differs by from other records of the same test, where that was repeated.
    pub scatter: Option<Scatter>,
    /// The largest magnitude that was measured, with its sign, less the offset.
    pub measured_peak: f64,
    /// The largest magnitude of the model behind the filter, with its sign.
    pub model_peak: f64,
    /// What is left, row by row: the model less the rows, of moduli the logarithm of one over the other.
    pub residual: Vec<f64>,
    /// Half of the band that the uncertainty of the numbers gives to the model, row by row; `None` where it depends on
    /// what the tests do not determine.
    pub band: Vec<Option<f64>>,
    /// How far the model is from it where the numbers are fitted to the other tests alone; `None` where there is no
    /// other.
    pub held_out: Option<HeldOut>,
}

/// Rows before the impact that contradict the zero that was fitted.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct OtherZero {
    /// How many there are.
    pub rows: usize,
    /// What they read at zero, the median, in SI units.
    pub median: f64,
}

/// How far a model is from a test to which nothing but its clock and its zero was fitted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeldOut {
    /// The peak of the model in parts of the measured one, less 1.
    pub peak: f64,
    /// Root of the mean square of what is left; of moduli in parts of them.
    pub rms: f64,
}

/// Another minimum that is about as low.
#[derive(Debug, Clone, PartialEq)]
pub struct Other {
    /// The numbers there.
    pub values: Vec<f64>,
    /// Its sum of squares in parts of the lowest.
    pub cost: f64,
}

/// Numbers that were fitted.
#[derive(Debug, Clone, PartialEq)]
pub struct NetworkFit {
    /// The numbers, each with its interval.
    pub numbers: Vec<Interval>,
    /// The tests.
    pub tests: Vec<TestFit>,
    /// Whether the search ended at the lowest minimum.
    pub convergence: Convergence,
    /// Whether who watched it ended it: this is the best that was met so far.
    pub is_stopped: bool,
    /// How many starts led to it, and how many were solved.
    pub reached: [usize; 2],
    /// Other minima that noise does not tell from it.
    pub others: Vec<Other>,
    /// Rows that count by their magnitude, because they are far off.
    pub outliers: usize,
    /// How many rows stand for one that is independent.
    pub correlation: f64,
    /// Standard deviations to the ends of an interval.
    pub quantile: f64,
    /// Covariance of the logarithms of the numbers, along what is determined.
    pub determined: DMatrix<f64>,
    /// Directions of these logarithms that the tests do not determine, in columns.
    pub undetermined: DMatrix<f64>,
}

impl NetworkFit {
    /// Whether the search ended at the lowest minimum.
    pub fn is_converged(&self) -> bool {
        self.convergence == Convergence::Reached
    }

    /// Whether the tests determine a number, by its position: nothing speaks [against](Self::reservation) the minimum,
    /// and noise tells that from any other by this number.
    pub fn is_identified(&self, at: usize) -> bool {
        self.reservation().is_none() && self.numbers[at].is_identified() && self.is_alone(at)
    }

    /// The factor between a product of powers of the numbers, by their exponents, and the ends of its 95 % interval;
    /// `None` where the tests do not determine it, or nothing is [claimed](Self::reservation) of the numbers.
    pub fn interval_of(&self, exponents: &[f64]) -> Option<f64> {
        let gradient = DVector::from_column_slice(exponents);
        let variance = gradient.dot(&(&self.determined * &gradient));
        let null = &self.undetermined;
        let is_known = self.reservation().is_none()
            && (null.ncols() == 0 || null.tr_mul(&gradient).amax() < KNOWN * gradient.amax());
        is_known.then(|| (self.quantile * variance.max(0.0).sqrt()).exp())
    }
}

/// What changes by less than this, in logarithms, along a direction takes no part in it.
const KNOWN: f64 = 1e-3;

/// Fits numbers to tests.
///
/// # Examples
///
/// The rate of a decay, by a clock that is half a second late:
///
/// ```
/// use dashpot_fit::network::{Curve, NetworkSettings, Number, Profile, Test, fit};
///
/// struct Decay(f64);
/// impl Curve for Decay {
///     fn value(&self, time: f64) -> f64 {
///         if time < 0.0 { 0.0 } else { time * (-self.0 * time).exp() }
///     }
///     fn peak(&self) -> (f64, f64) {
///         (1.0 / self.0, self.value(1.0 / self.0))
///     }
/// }
/// let rows = (0..400).map(|at| 0.01 * f64::from(at)).map(|t| (t + 0.5, Decay(2.0).value(t)));
/// let test =
///     Test { rows: rows.collect(), is_shifted: true, is_offset: true, ..Test::default() };
/// let number = Number { low: 0.1, high: 10.0, start: 5.0 };
/// let settings = NetworkSettings { starts: 3, seed: 1, is_robust: true, profile: Profile::WhereNeeded };
/// let own = fit(&[number], &[test], settings, &|_, values| Ok(Box::new(Decay(values[0]))))?;
/// assert!((own.numbers[0].value - 2.0).abs() < 1e-4 && (own.tests[0].shift - 0.5).abs() < 1e-4);
/// # Ok::<(), dashpot_fit::network::NetworkFault>(())
/// ```
///
/// # Errors
///
/// What cannot be fitted.
pub fn fit(
    numbers: &[Number],
    tests: &[Test],
    settings: NetworkSettings,
    model: &Model<'_>,
) -> Result<NetworkFit, NetworkFault> {
    fit_watched(numbers, tests, settings, model, &|_| ControlFlow::Continue(()))
}

/// The same, with somebody who is told of each step and may end the search: then this is the best so far, by the
/// covariance there, and nothing was left out.
///
/// # Errors
///
/// What cannot be fitted.
pub fn fit_watched(
    numbers: &[Number],
    tests: &[Test],
    settings: NetworkSettings,
    model: &Model<'_>,
    watch: &Watch<'_>,
) -> Result<NetworkFit, NetworkFault> {
    checked(numbers, tests)?;
    let watched = Watched::new(watch);
    let mut task = Task::new(numbers, tests, model)
        .map_err(|(test, fault)| NetworkFault::Filter { test, fault })?
        .watched(&watched);
    let mut fit = search((numbers, tests), settings, &mut task)?;
    for at in 0..tests.len() {
        if tests.len() > 1 && watched.begin(Phase::LeftOut { at, of: tests.len() }) {
            fit.tests[at].held_out = held_out((numbers, tests), at, &fit, model, &watched);
        }
    }
    fit.is_stopped = watched.is_stopped();
    if fit.is_stopped {
        fit.numbers.iter_mut().for_each(|own| own.ends = [None; 2]);
    }
    Ok(fit)
}

fn checked(numbers: &[Number], tests: &[Test]) -> Result<(), NetworkFault> {
    let is_nothing = |own: &Test| own.rows.iter().all(|row| row.1 == 0.0);
    if let Some(test) = tests.iter().position(is_nothing) {
        return Err(NetworkFault::Nothing { test });
    }
    let rows: usize = tests.iter().map(|own| own.rows.len()).sum();
    let own: usize = tests.iter().map(|own| own.unknowns() - own.priors()).sum();
    let unknowns = numbers.len() + own;
    if rows <= unknowns { Err(NetworkFault::TooFew { rows, unknowns }) } else { Ok(()) }
}

/// How far the model is from a test where the numbers are fitted to all others.
fn held_out(
    (numbers, tests): (&[Number], &[Test]),
    test: usize,
    fit: &NetworkFit,
    model: &Model<'_>,
    watched: &Watched<'_>,
) -> Option<HeldOut> {
    // A record of the same test tells of it what it tells itself.
    let is_other = |own: &usize| {
        let is_repeat =
            tests[*own].repeated.is_some_and(|group| tests[test].repeated == Some(group));
        *own != test && !is_repeat
    };
    let others: Vec<usize> = (0..tests.len()).filter(is_other).collect();
    if others.is_empty() {
        return None;
    }
    let rest: Vec<Test> = others.iter().map(|own| tests[*own].clone()).collect();
    let found = fit.numbers.iter().map(|own| own.value).collect::<Vec<_>>();
    let of_rest = |at: usize, values: &[f64]| model(others[at], values);
    let mut task = Task::new(numbers, &rest, &of_rest).ok()?.watched(watched);
    let unknowns = nearest(&mut task, &found)?;
    if watched.is_stopped() {
        return None;
    }
    // What was measured of it besides stands as it was measured.
    let means = tests[test].known.iter().map(|own| own.mean);
    let values: Vec<f64> = task.values(&unknowns).into_iter().chain(means).collect();
    let alone = [Test { gain: None, known: Vec::new(), ..tests[test].clone() }];
    let of_test = |_: usize, _: &[f64]| model(test, &values);
    let mut task = Task::new(&[], &alone, &of_test).ok()?;
    let unknowns = nearest(&mut task, &[])?;
    let told = task.told(&unknowns).pop()?;
    Some(HeldOut { peak: told.model_peak / told.measured_peak - 1.0, rms: told.rms })
}

/// The unknowns at the minimum that is found from these values of the numbers.
fn nearest(task: &mut Task<'_>, values: &[f64]) -> Option<Vec<f64>> {
    let start = task.begin(values).ok()?;
    if start.is_empty() {
        return Some(start);
    }
    let [low, high] = task.bounds();
    let start = descended(task, &start)?.unknowns;
    Some(least_squares(task, [&low, &high], &start, None)?.unknowns)
}

#[cfg(test)]
mod tests;
