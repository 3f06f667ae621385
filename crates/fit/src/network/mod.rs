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
mod starts;
mod told;
mod watch;

use std::ops::ControlFlow;

use nalgebra::{DMatrix, DVector};

pub use self::{
    bands::{Band, Read},
    certainty::{Interval, Source},
    jump::Later,
    problem::{Curve, Kind, Known, Model, NetworkFault, NetworkSettings, Number, Profile, Test},
    repeats::Scatter,
    watch::{Phase, Search, Watch},
};
use self::{certainty::certainty, residuals::Task, starts::starts, watch::Watched};
use crate::optimum::{Optimum, least_squares, sum};

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
#[derive(Debug, Clone, Copy, PartialEq)]
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
/// Rounds in which noise, and the samples between which curves jump, are found anew.
const ROUNDS: usize = 3;
/// The standard deviation in medians of the magnitude of normal deviates.
const OF_MEDIAN: f64 = 1.4826;

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
    let scale = settings.is_robust.then_some(FAR);
    watched.begin(Phase::Refinement);
    let best = settled(&mut task, first, scale);
    watched.begin(Phase::Certainty);
    let certainty = certainty(&task, &best, scale, settings.profile);
    let left = task.left(&best.unknowns);
    let outliers = scale.map_or(0, |far| left.iter().filter(|own| own.abs() > far).count());
    let noise = found[0].cost * (SAME + 4.0 * certainty.correlation / rows as f64);
    let is_low = |own: &Optimum| own.cost - found[0].cost <= noise + f64::MIN_POSITIVE;
    let distance = |own: &Optimum| {
        let [one, other] = [own, &found[0]].map(|own| &own.unknowns[..numbers.len()]);
        // Parts of a model that are alike may have changed places.
        if is_low(own) { apart(&sorted(one), &sorted(other)) } else { apart(one, other) }
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

/// The largest difference of two sets of numbers.
fn apart(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(one, other)| (one - other).abs()).fold(0.0, f64::max)
}

fn sorted(all: &[f64]) -> Vec<f64> {
    let mut all = all.to_vec();
    all.sort_by(f64::total_cmp);
    all
}

/// The minimum of the robust sum beyond a scale, with the rows of each test counted in their noise.
fn settled(task: &mut Task<'_>, first: Optimum, scale: Option<f64>) -> Optimum {
    let mut best = first;
    for _ in 0..ROUNDS {
        let units = units(task, &best.unknowns, scale.is_some());
        task.count_in(&units);
        let has_jumps = task.place_jumps(&mut best.unknowns, scale);
        if task.is_ended() {
            break;
        }
        let [low, high] = task.bounds();
        best = least_squares(task, [&low, &high], &best.unknowns, scale).unwrap_or(best);
        if !has_jumps {
            break;
        }
    }
    best
}

/// What the rows of each test are counted in: their noise where it is known, or repeats tell it, else the standard deviation that what is
/// left of them at a minimum stands for.
fn units(task: &Task<'_>, unknowns: &[f64], is_robust: bool) -> Vec<f64> {
    let left = task.left(unknowns);
    let taken = task.unknowns() as f64 / left.len() as f64;
    let parts = task.parts().zip(task.tests()).enumerate();
    let unit = |(test, (rows, own)): (usize, (std::ops::Range<usize>, &Test))| {
        if let Some(noise) = own.noise {
            return noise;
        }
        if let Some(scatter) = task.scatter(test, unknowns) {
            return scatter.deviation;
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
    let task = Task::new(numbers, &rest, &of_rest).ok()?.watched(watched);
    let unknowns = nearest(&task, &found)?;
    if watched.is_stopped() {
        return None;
    }
    // What was measured of it besides stands as it was measured.
    let means = tests[test].known.iter().map(|own| own.mean);
    let values: Vec<f64> = task.values(&unknowns).into_iter().chain(means).collect();
    let alone = [Test { gain: None, known: Vec::new(), ..tests[test].clone() }];
    let of_test = |_: usize, _: &[f64]| model(test, &values);
    let task = Task::new(&[], &alone, &of_test).ok()?;
    let told = task.told(&nearest(&task, &[])?).pop()?;
    Some(HeldOut { peak: told.model_peak / told.measured_peak - 1.0, rms: told.rms })
}

/// The unknowns at the minimum that is found from these values of the numbers.
fn nearest(task: &Task<'_>, values: &[f64]) -> Option<Vec<f64>> {
    let start = task.begin(values).ok()?;
    if start.is_empty() {
        return Some(start);
    }
    let [low, high] = task.bounds();
    Some(least_squares(task, [&low, &high], &start, None)?.unknowns)
}

#[cfg(test)]
mod tests;
