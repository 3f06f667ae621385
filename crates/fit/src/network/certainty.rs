//! How well tests determine numbers: the covariance at the minimum, with rows that follow each other counted for what
//! they tell.

use nalgebra::{DMatrix, DVector};

use super::residuals::Task;
use crate::optimum::Residuals;

/// Standard deviations of a two-sided 95 % interval.
const SIGMAS: f64 = 1.959_963_984_540_054;
/// Directions in which the sum of squares rises by less than this part of the largest rise are not determined.
const FLAT: f64 = 1e-10;
/// A number that has more than this part of such a direction is not determined.
const TAKES_PART: f64 = 1e-3;
/// A number is on its bound where it is nearer than this, in logarithms.
const ON_BOUND: f64 = 1e-6;
/// An interval whose ends differ by a larger factor determines nothing.
const IDENTIFIED: f64 = 2.0;

/// A number and its 95 % interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// The value.
    pub value: f64,
    /// The ends; `None` where the tests do not determine it.
    pub ends: Option<[f64; 2]>,
    /// Whether it is on one of its bounds, so that the interval is none.
    pub is_on_bound: bool,
}

impl Interval {
    /// Whether the tests determine it: within a factor of two.
    pub fn is_identified(&self) -> bool {
        !self.is_on_bound && self.ends.is_some_and(|[low, high]| high <= IDENTIFIED * low)
    }
}

/// What is known of a minimum.
pub(super) struct Certainty {
    pub(super) numbers: Vec<Interval>,
    /// How many rows stand for one that is independent.
    pub(super) correlation: f64,
    pub(super) determined: DMatrix<f64>,
    pub(super) undetermined: DMatrix<f64>,
}

/// The intervals of all numbers.
pub(super) fn intervals(task: &Task<'_>, unknowns: &[f64]) -> Certainty {
    let left = task.left(unknowns);
    let jacobian = task.jacobian(unknowns);
    let rows = left.len() as f64;
    let correlation = task.parts().map(|own| correlation(&left[own])).fold(1.0, f64::max);
    let free = (rows - jacobian.ncols() as f64).max(1.0);
    let square: f64 = left.iter().map(|own| own * own).sum();
    let variance = correlation * square / free;
    let count = task.numbers().len();
    let (determined, undetermined) = directions(jacobian, count, variance);
    let numbers = task.values(unknowns).into_iter().zip(task.numbers()).enumerate();
    let numbers = numbers.map(|(at, (value, number))| {
        let is_known = undetermined.row(at).iter().all(|own| own.abs() < TAKES_PART);
        let factor = factor(determined[(at, at)]);
        let ends = (is_known && factor.is_finite()).then(|| [value / factor, value * factor]);
        let near = |bound: f64| (value / bound).ln().abs() < ON_BOUND;
        Interval { value, ends, is_on_bound: near(number.low) || near(number.high) }
    });
    Certainty { numbers: numbers.collect(), correlation, determined, undetermined }
}

/// The factor from a value to the ends of its interval, by the variance of its logarithm.
pub(super) fn factor(variance: f64) -> f64 {
    (SIGMAS * variance.max(0.0).sqrt()).exp()
}

/// The covariance of so many numbers along the directions that rows determine, and the other directions.
fn directions(
    mut jacobian: DMatrix<f64>,
    count: usize,
    variance: f64,
) -> (DMatrix<f64>, DMatrix<f64>) {
    if !jacobian.iter().all(|own| own.is_finite()) {
        return (DMatrix::zeros(count, count), DMatrix::identity(count, count));
    }
    let unit = |own: f64| if own > 0.0 { own } else { 1.0 };
    let lengths: Vec<f64> = jacobian.column_iter().map(|own| unit(own.norm())).collect();
    for (mut column, length) in jacobian.column_iter_mut().zip(&lengths) {
        column /= *length;
    }
    let own = jacobian.tr_mul(&jacobian).symmetric_eigen();
    let largest = own.eigenvalues.max();
    let mut determined = DMatrix::zeros(count, count);
    let mut open = Vec::new();
    for (value, vector) in own.eigenvalues.iter().zip(own.eigenvectors.column_iter()) {
        let direction = DVector::from_fn(count, |at, _| vector[at] / lengths[at]);
        if *value <= FLAT * largest {
            open.push(&direction / unit(direction.norm()));
        } else {
            determined += &direction * direction.transpose() * (variance / value);
        }
    }
    let undetermined =
        if open.is_empty() { DMatrix::zeros(count, 0) } else { DMatrix::from_columns(&open) };
    (determined, undetermined)
}

/// How many rows that follow each other stand for one: one and twice the sum of autocorrelations up to the first that
/// is not positive.
fn correlation(left: &[f64]) -> f64 {
    let mean = left.iter().sum::<f64>() / left.len().max(1) as f64;
    let square: f64 = left.iter().map(|own| (own - mean).powi(2)).sum();
    if square <= 0.0 {
        return 1.0;
    }
    let mut sum = 1.0;
    for lag in 1..left.len() / 2 {
        let pairs = left.iter().zip(&left[lag..]);
        let own: f64 =
            pairs.map(|(one, other)| (one - mean) * (other - mean)).sum::<f64>() / square;
        if own <= 0.0 {
            break;
        }
        sum += 2.0 * own;
    }
    sum
}
