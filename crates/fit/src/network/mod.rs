//! Numbers of any model, to curves that were measured on it.
//!
//! What is solved is behind a closure: numbers in, curves out. Tests share the numbers; each has its own clock and its
//! own zero, which are fitted beside them. Unknowns are logarithms of the numbers, searched within their bounds from
//! the scene's own values and from others spread over the bounds.

mod certainty;
mod residuals;
mod starts;

use nalgebra::{DMatrix, DVector};
use thiserror::Error;

pub use self::certainty::Interval;
use self::{certainty::intervals, residuals::Task, starts::starts};
use crate::optimum::{Optimum, least_squares};

/// A curve over time.
pub trait Curve {
    /// The value at a time \[s\]: before the start what is there at rest, behind the end what is there last.
    fn value(&self, time: f64) -> f64;

    /// Time of the largest magnitude \[s\], and that with its sign.
    fn peak(&self) -> (f64, f64);
}

/// The curve of a test, by its number, where the numbers have these values in SI units.
pub type Model<'m> = dyn Fn(usize, &[f64]) -> Result<Box<dyn Curve>, String> + Sync + 'm;

/// A number that is fitted.
#[derive(Debug, Clone, PartialEq)]
pub struct Number {
    /// The lower bound, positive.
    pub low: f64,
    /// The upper bound.
    pub high: f64,
    /// Where the search begins first.
    pub start: f64,
}

/// A test: rows of time \[s\] and value in SI units, and what may be off with them.
#[derive(Debug, Clone, PartialEq)]
pub struct Test {
    /// The rows.
    pub rows: Vec<(f64, f64)>,
    /// Whether its clock may be off.
    pub is_shifted: bool,
    /// Whether its zero may be off.
    pub is_offset: bool,
}

/// What is asked of a fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NetworkSettings {
    /// From how many starts the search begins; 1 is the scene's own values alone.
    pub starts: usize,
    /// The seed of the others.
    pub seed: u64,
    /// Whether rows that are far off count by their magnitude, in place of its square.
    pub is_robust: bool,
}

/// Why nothing was fitted.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum NetworkFault {
    /// Too few rows for so many unknowns.
    #[error("{rows} rows do not determine {unknowns} unknowns")]
    TooFew {
        /// Rows of all tests.
        rows: usize,
        /// Numbers, clocks and zeros.
        unknowns: usize,
    },
    /// A test that is nothing but zeros.
    #[error("test {} is zero throughout", .test + 1)]
    Nothing {
        /// Its number from 0.
        test: usize,
    },
    /// The model cannot be solved at any start.
    #[error("the model cannot be solved: {reason}")]
    Unsolved {
        /// Why not.
        reason: String,
    },
}

/// What was found of a test.
#[derive(Debug, Clone, PartialEq)]
pub struct TestFit {
    /// How much later the rows are than the model \[s\].
    pub shift: f64,
    /// What the rows read at zero.
    pub offset: f64,
    /// Root of the mean square of what is left.
    pub rms: f64,
    /// The largest magnitude that was measured, with its sign, less the offset.
    pub measured_peak: f64,
    /// The largest magnitude of the model, with its sign.
    pub model_peak: f64,
    /// What is left, row by row: the model less the rows.
    pub residual: Vec<f64>,
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
    /// How many starts led to it, and how many were solved.
    pub reached: [usize; 2],
    /// Other minima that noise does not tell from it.
    pub others: Vec<Other>,
    /// Rows that count by their magnitude, because they are far off.
    pub outliers: usize,
    /// How many rows stand for one that is independent.
    pub correlation: f64,
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
        is_known.then(|| certainty::factor(variance))
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
/// let test = Test { rows: rows.collect(), is_shifted: true, is_offset: true };
/// let number = Number { low: 0.1, high: 10.0, start: 5.0 };
/// let settings = NetworkSettings { starts: 3, seed: 1, is_robust: true };
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
    checked(numbers, tests)?;
    let mut fit = search(numbers, tests, settings, model)?;
    if tests.len() > 1 {
        for test in 0..tests.len() {
            fit.tests[test].held_out = held_out(numbers, tests, test, &fit, model);
        }
    }
    Ok(fit)
}

fn checked(numbers: &[Number], tests: &[Test]) -> Result<(), NetworkFault> {
    let is_nothing = |own: &Test| own.rows.iter().all(|row| row.1 == 0.0);
    if let Some(test) = tests.iter().position(is_nothing) {
        return Err(NetworkFault::Nothing { test });
    }
    let rows: usize = tests.iter().map(|own| own.rows.len()).sum();
    let own = tests.iter().map(|own| usize::from(own.is_shifted) + usize::from(own.is_offset));
    let unknowns = numbers.len() + own.sum::<usize>();
    if rows <= unknowns { Err(NetworkFault::TooFew { rows, unknowns }) } else { Ok(()) }
}

fn search(
    numbers: &[Number],
    tests: &[Test],
    settings: NetworkSettings,
    model: &Model<'_>,
) -> Result<NetworkFit, NetworkFault> {
    let task = Task::new(numbers, tests, model);
    let mut found: Vec<Optimum> = Vec::new();
    let mut reason = String::new();
    for values in starts(numbers, settings) {
        match task.begin(&values) {
            Ok((start, bounds)) => {
                let bounds = [&bounds[0][..], &bounds[1][..]];
                found.extend(least_squares(&task, bounds, &start, None));
            }
            Err(own) => reason = own,
        }
    }
    found.sort_by(|one, other| one.cost.total_cmp(&other.cost));
    let Some(mut best) = found.first().cloned() else {
        return Err(NetworkFault::Unsolved { reason });
    };
    let outliers = if settings.is_robust { robust(&task, &mut best) } else { 0 };
    let certainty = intervals(&task, &best.unknowns);
    let noise = found[0].cost * (SAME + 4.0 * certainty.correlation / task.rows() as f64);
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
    Ok(NetworkFit {
        tests: task.told(&best.unknowns),
        is_converged: best.is_converged,
        reached: [reached, found.len()],
        others: others.collect(),
        outliers,
        numbers: certainty.numbers,
        correlation: certainty.correlation,
        determined: certainty.determined,
        undetermined: certainty.undetermined,
    })
}

/// Goes on from a minimum with rows that are far off counted by their magnitude; returns how many they are.
fn robust(task: &Task<'_>, best: &mut Optimum) -> usize {
    let Some(scale) = task.scale(&best.unknowns).filter(|own| *own > 0.0) else { return 0 };
    let scale = FAR * scale;
    let Ok((_, bounds)) = task.begin(&task.values(&best.unknowns)) else { return 0 };
    let bounds = [&bounds[0][..], &bounds[1][..]];
    let Some(own) = least_squares(task, bounds, &best.unknowns, Some(scale)) else { return 0 };
    let left = task.left(&own.unknowns);
    let outliers = left.iter().filter(|own| own.abs() > scale).count();
    *best = own;
    outliers
}

/// How far the peak of the model is from that of a test to which nothing but its clock and its zero was fitted.
fn held_out(
    numbers: &[Number],
    tests: &[Test],
    test: usize,
    fit: &NetworkFit,
    model: &Model<'_>,
) -> Option<f64> {
    let others: Vec<usize> = (0..tests.len()).filter(|own| *own != test).collect();
    let rest: Vec<Test> = others.iter().map(|own| tests[*own].clone()).collect();
    let begun = numbers.iter().zip(&fit.numbers);
    let begun: Vec<Number> =
        begun.map(|(own, found)| Number { start: found.value, ..own.clone() }).collect();
    let settings = NetworkSettings { starts: 1, seed: 0, is_robust: false };
    let of_rest = |at: usize, values: &[f64]| model(others[at], values);
    let found = search(&begun, &rest, settings, &of_rest).ok()?;
    let values: Vec<f64> = found.numbers.iter().map(|own| own.value).collect();
    let peak = model(test, &values).ok()?.peak().1;
    Some(peak / fit.tests[test].measured_peak - 1.0)
}

#[cfg(test)]
mod tests;
