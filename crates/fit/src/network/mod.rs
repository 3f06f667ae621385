//! Numbers of any model, to curves that were measured on it.
//!
//! What is solved is behind a closure: numbers in, curves out. Tests share the numbers; each has its own clock and its
//! own zero, which are fitted beside them. Unknowns are logarithms of the numbers, searched within their bounds from
//! the scene's own values and from others spread over the bounds.

mod bands;
mod certainty;
mod problem;
mod profile;
mod record;
mod residuals;
mod starts;
mod told;
mod watch;

use std::ops::ControlFlow;

use nalgebra::{DMatrix, DVector};

pub use self::{
    bands::{Band, Read},
    certainty::{Interval, Source},
    problem::{Curve, Known, Model, NetworkFault, NetworkSettings, Number, Test},
    watch::{Phase, Search, Watch},
};
use self::{certainty::certainty, residuals::Task, starts::starts, watch::Watched};
use crate::optimum::{Optimum, least_squares};

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
    /// Root of the mean square of what is left.
    pub rms: f64,
    /// Standard deviation of what is left of a sample before the filter; without a filter of the rows.
    pub noise: f64,
    /// The same before the impact alone; `None` where fewer than eight rows tell it.
    pub noise_at_rest: Option<f64>,
    /// The largest magnitude that was measured, with its sign, less the offset.
    pub measured_peak: f64,
    /// The largest magnitude of the model behind the filter, with its sign.
    pub model_peak: f64,
    /// What is left, row by row: the model less the rows.
    pub residual: Vec<f64>,
    /// Half of the band that the uncertainty of the numbers gives to the model, row by row; `None` where it depends on
    /// what the tests do not determine.
    pub band: Vec<Option<f64>>,
    /// The peak of the model in parts of the measured one, less 1, where the numbers are fitted to the other tests
    /// alone; `None` where there is no other.
    pub held_out: Option<f64>,
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
    /// Whether the search ended at a minimum.
    pub is_converged: bool,
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
    /// The factor between a product of powers of the numbers, by their exponents, and the ends of its 95 % interval;
    /// `None` where the tests do not determine it.
    pub fn interval_of(&self, exponents: &[f64]) -> Option<f64> {
        let gradient = DVector::from_column_slice(exponents);
        let variance = gradient.dot(&(&self.determined * &gradient));
        let null = &self.undetermined;
        let is_known = null.ncols() == 0 || null.tr_mul(&gradient).amax() < KNOWN * gradient.amax();
        is_known.then(|| (self.quantile * variance.max(0.0).sqrt()).exp())
    }
}

/// A product takes no part in what is not determined where its exponents have less than this part of it.
const KNOWN: f64 = 1e-3;

/// Starts whose sums differ by less than this part are at the same minimum.
const SAME: f64 = 1e-4;
/// Numbers that differ by more than this in their logarithms are others.
const APART: f64 = 0.02;
/// Residuals beyond so many standard deviations are far off.
const FAR: f64 = 3.0;
/// What is left of a test counts in no smaller parts of its peak than this.
const LEAST: f64 = 1e-12;
/// The standard deviation in medians of the magnitude of normal deviates.
const OF_MEDIAN: f64 = 1.4826;

/// Fits numbers to tests.
///
/// # Examples
///
/// The rate of a decay, by a clock that is half a second late:
///
/// ```
/// use dashpot_fit::network::{Curve, NetworkSettings, Number, Test, fit};
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
/// let settings = NetworkSettings { starts: 3, seed: 1, is_robust: true, is_profiled: false };
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
    let mut fit = search((numbers, tests), settings, model, &watched)?;
    for at in 0..tests.len() {
        if tests.len() > 1 && watched.begin(Phase::LeftOut { at, of: tests.len() }) {
            fit.tests[at].held_out = held_out((numbers, tests), at, &fit, model, &watched);
        }
    }
    fit.is_stopped = watched.is_stopped();
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

fn search(
    (numbers, tests): (&[Number], &[Test]),
    settings: NetworkSettings,
    model: &Model<'_>,
    watched: &Watched<'_>,
) -> Result<NetworkFit, NetworkFault> {
    let mut task = Task::new(numbers, tests, model)
        .map_err(|(test, fault)| NetworkFault::Filter { test, fault })?
        .watched(watched);
    let (rows, unknowns) = (task.rows(), task.unknowns());
    if rows <= unknowns {
        return Err(NetworkFault::TooFew { rows, unknowns });
    }
    let mut found: Vec<Optimum> = Vec::new();
    let mut reason = String::new();
    let bounds = task.bounds();
    let bounds = [&bounds[0][..], &bounds[1][..]];
    let starts = starts(numbers, settings);
    let of = starts.len();
    for (at, values) in starts.into_iter().enumerate() {
        if !watched.begin(Phase::Start { at, of }) {
            break;
        }
        match task.begin(&values) {
            Ok(start) => found.extend(least_squares(&task, bounds, &start, None)),
            Err(own) => reason = own,
        }
    }
    found.sort_by(|one, other| one.cost.total_cmp(&other.cost));
    let Some(first) = found.first().cloned() else {
        return Err(NetworkFault::Unsolved { reason });
    };
    let units = units(&task, &first.unknowns, settings.is_robust);
    task.count_in(&units);
    let scale = settings.is_robust.then_some(FAR);
    let again = watched.begin(Phase::Refinement);
    let again = again.then(|| least_squares(&task, bounds, &first.unknowns, scale)).flatten();
    let best = again.unwrap_or(first);
    watched.begin(Phase::Certainty);
    let certainty = certainty(&task, &best, scale, settings.is_profiled);
    let left = task.left(&best.unknowns);
    let outliers = scale.map_or(0, |far| left.iter().filter(|own| own.abs() > far).count());
    let noise = found[0].cost * (SAME + 4.0 * certainty.correlation / rows as f64);
    let is_low = |own: &Optimum| own.cost - found[0].cost <= noise + f64::MIN_POSITIVE;
    let distance = |own: &Optimum| {
        let each = own.unknowns.iter().zip(&found[0].unknowns).take(numbers.len());
        each.map(|(one, other)| (one - other).abs()).fold(0.0, f64::max)
    };
    // Along what is not determined there are others anyhow.
    let is_apart = |own: &Optimum| certainty.undetermined.ncols() == 0 && distance(own) > APART;
    let is_same =
        |own: &&Optimum| if distance(own) > APART { !is_apart(own) && is_low(own) } else { true };
    let reached = found.iter().filter(is_same).count();
    let others = found.iter().filter(|own| is_low(own) && is_apart(own));
    let others = others.map(|own| Other {
        values: task.values(&own.unknowns),
        cost: own.cost / found[0].cost.max(f64::MIN_POSITIVE),
    });
    let mut fit = NetworkFit {
        tests: task.told(&best.unknowns),
        is_converged: best.is_converged,
        is_stopped: watched.is_stopped(),
        reached: [reached, found.len()],
        others: others.collect(),
        outliers,
        numbers: certainty.numbers,
        correlation: certainty.correlation,
        quantile: certainty.quantile,
        determined: certainty.determined,
        undetermined: certainty.undetermined,
    };
    for test in 0..tests.len() {
        let bands = fit.bands(&|values| task.samples(test, values, &best.unknowns));
        let half = |own: Option<Band>| own.and_then(|own| own.half);
        fit.tests[test].band = bands.unwrap_or_default().into_iter().map(half).collect();
    }
    Ok(fit)
}

/// What the rows of each test are counted in: their noise where it is known, else the standard deviation that what is
/// left of them at a minimum stands for.
fn units(task: &Task<'_>, unknowns: &[f64], is_robust: bool) -> Vec<f64> {
    let left = task.left(unknowns);
    let taken = task.unknowns() as f64 / left.len() as f64;
    let parts = task.parts().zip(task.tests()).enumerate();
    let unit = |(test, (rows, own)): (usize, (std::ops::Range<usize>, &Test))| {
        if let Some(noise) = own.noise {
            return noise;
        }
        let left = &left[rows];
        let square = left.iter().map(|own| own * own).sum::<f64>() / left.len() as f64;
        let plain = (square / (1.0 - taken).max(0.1)).sqrt();
        let mut sorted: Vec<f64> = left.iter().map(|own| own.abs()).collect();
        sorted.sort_by(f64::total_cmp);
        let median = OF_MEDIAN * sorted.get(sorted.len() / 2).copied().unwrap_or(0.0);
        let own = if is_robust && median > 0.0 { median } else { plain };
        task.unit(test) * own.max(LEAST)
    };
    parts.map(unit).collect()
}

/// How far the peak of the model is from that of a test to which nothing but its clock and its zero was fitted.
fn held_out(
    (numbers, tests): (&[Number], &[Test]),
    test: usize,
    fit: &NetworkFit,
    model: &Model<'_>,
    watched: &Watched<'_>,
) -> Option<f64> {
    let others: Vec<usize> = (0..tests.len()).filter(|own| *own != test).collect();
    let rest: Vec<Test> = others.iter().map(|own| tests[*own].clone()).collect();
    let begun = numbers.iter().zip(&fit.numbers);
    let begun: Vec<Number> =
        begun.map(|(own, found)| Number { start: found.value, ..own.clone() }).collect();
    let of_rest = |at: usize, values: &[f64]| model(others[at], values);
    let rest_task = Task::new(&begun, &rest, &of_rest).ok()?.watched(watched);
    let start = rest_task.begin(&begun.iter().map(|own| own.start).collect::<Vec<_>>()).ok()?;
    let bounds = rest_task.bounds();
    let found = least_squares(&rest_task, [&bounds[0], &bounds[1]], &start, None)?;
    if watched.is_stopped() {
        return None;
    }
    let values = rest_task.values(&found.unknowns);
    let task = Task::new(numbers, tests, model).ok()?;
    Some(task.peak_at(test, &values, fit.tests[test].shift)? / fit.tests[test].measured_peak - 1.0)
}

#[cfg(test)]
mod tests;
