//! How well tests determine numbers: the covariance at the minimum, with rows that follow each other counted for what
//! they tell.

use dashpot_numerics::decompositions::symmetric;
use nalgebra::{DMatrix, DVector};

use super::{Profile, profile::Valley, residuals::Task};
use crate::{
    optimum::{Optimum, Residuals},
    student::within_95,
};

/// Directions in which the sum of squares rises by less than this part of the largest rise are not determined.
const FLAT: f64 = 1e-10;
/// A number that has more than this part of such a direction is not determined.
pub(super) const TAKES_PART: f64 = 1e-3;
/// A number is on its bound where it is nearer than this, in logarithms.
const ON_BOUND: f64 = 1e-6;
/// An interval whose ends differ by a larger factor determines nothing.
const IDENTIFIED: f64 = 2.0;
/// The sum of squares may rise to the end of an interval by so much more or less, in standard deviations, than its
/// covariance tells.
const CURVED: f64 = 0.15;

/// What an interval is from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source {
    /// The covariance at the minimum.
    Covariance,
    /// The profile likelihood: how much worse all tests are met with the number held elsewhere.
    Profile,
}

/// A number and its 95 % interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// The value.
    pub value: f64,
    /// The ends; `None` where the tests do not determine it within its bounds.
    pub ends: [Option<f64>; 2],
    /// What they are from.
    pub source: Source,
    /// Whether it is on one of its bounds.
    pub is_on_bound: bool,
}

impl Interval {
    /// Whether the tests determine it: within a factor of two.
    pub fn is_identified(&self) -> bool {
        let [Some(low), Some(high)] = self.ends else { return false };
        !self.is_on_bound && high <= IDENTIFIED * low
    }
}

/// What is known of a minimum.
pub(super) struct Certainty {
    pub(super) numbers: Vec<Interval>,
    /// How many rows stand for one that is independent.
    pub(super) correlation: f64,
    /// Standard deviations to the ends of an interval.
    pub(super) quantile: f64,
    pub(super) determined: DMatrix<f64>,
    pub(super) undetermined: DMatrix<f64>,
}

/// The intervals of all numbers, at a minimum of the robust sum beyond a scale; of the profile likelihood where that is asked for.
pub(super) fn certainty(
    task: &Task<'_>,
    best: &Optimum,
    scale: Option<f64>,
    profile: Profile,
) -> Certainty {
    let left = task.left(&best.unknowns);
    let correlation = task.parts().map(|own| correlation(&left[own])).fold(1.0, f64::max);
    let (spread, quantile) = spread(task, &left, scale, correlation);
    let measured = task.parts().last().map_or(0, |own| own.end);
    let mut jacobian = task.jacobian(&best.unknowns);
    let deviation = (spread * correlation).sqrt();
    jacobian.rows_mut(0, measured).scale_mut(deviation.recip());
    let count = task.numbers().len();
    let (covariance, undetermined) = directions(jacobian, count);
    let valley = Valley::new(task, best, scale, (deviation * deviation, quantile));
    let numbers = task.values(&best.unknowns).into_iter().zip(task.numbers()).enumerate();
    let numbers = numbers.map(|(at, (value, number))| {
        let is_known = undetermined.row(at).iter().all(|own| own.abs() < TAKES_PART);
        let own = covariance[(at, at)].max(0.0).sqrt();
        let is_known = is_known && own.is_finite() && best.is_converged;
        let near = |bound: f64| (value / bound).ln().abs() < ON_BOUND;
        let is_on_bound = near(number.low) || near(number.high);
        let column: Vec<f64> = covariance.column(at).iter().copied().collect();
        let is_curved =
            || !task.is_ended() && valley.departs(at, &column).is_none_or(|by| by > CURVED);
        let factor = (quantile * own).exp();
        let is_enough = || match profile {
            Profile::Never => true,
            Profile::WhereNeeded => !is_curved(),
            Profile::Always => false,
        };
        // On a bound it is where it was held, not where the tests put it.
        let is_known = is_known && !is_on_bound;
        let (ends, source) = if is_known && is_enough() {
            ([Some(value / factor), Some(value * factor)], Source::Covariance)
        } else if profile != Profile::Never && is_known {
            (valley.ends(at, &column), Source::Profile)
        } else {
            ([None; 2], Source::Covariance)
        };
        Interval { value, ends, source, is_on_bound }
    });
    Certainty {
        numbers: numbers.collect(),
        correlation,
        quantile,
        determined: covariance.view((0, 0), (count, count)).into_owned(),
        undetermined,
    }
}

/// The variance of a row, in units of its test, and how many standard deviations 95 % are. Where noise is known it is
/// no smaller than that. Rows beyond the scale count as the robust sum does.
///
/// Source: P. J. Huber, Robust Statistics (1981), 7.6.
fn spread(task: &Task<'_>, left: &[f64], scale: Option<f64>, correlation: f64) -> (f64, f64) {
    let far = scale.unwrap_or(f64::INFINITY);
    let rows = left.len() as f64;
    let square: f64 = left.iter().map(|own| own.clamp(-far, far).powi(2)).sum();
    let inside = left.iter().filter(|own| own.abs() <= far).count() as f64 / rows;
    let unknowns = task.unknowns() as f64;
    let spread = square / (rows - unknowns).max(1.0) / (inside * inside);
    if task.tests().iter().all(|own| own.noise.is_some()) && spread * correlation <= 1.0 {
        return (correlation.recip(), within_95(f64::INFINITY));
    }
    (spread.max(f64::MIN_POSITIVE), within_95((rows / correlation - unknowns).max(1.0)))
}

/// The covariance along the directions that rows of unit variance determine, and the other directions of so many
/// numbers.
fn directions(mut jacobian: DMatrix<f64>, count: usize) -> (DMatrix<f64>, DMatrix<f64>) {
    let all = jacobian.ncols();
    let unit = |own: f64| if own > 0.0 { own } else { 1.0 };
    let lengths: Vec<f64> = jacobian.column_iter().map(|own| unit(own.norm())).collect();
    for (mut column, length) in jacobian.column_iter_mut().zip(&lengths) {
        column /= *length;
    }
    let Some(own) = symmetric(&jacobian.tr_mul(&jacobian)) else {
        return (DMatrix::zeros(all, all), DMatrix::identity(count, count));
    };
    let largest = own.eigenvalues.max();
    let mut covariance = DMatrix::zeros(all, all);
    let mut open = Vec::new();
    for (value, vector) in own.eigenvalues.iter().zip(own.eigenvectors.column_iter()) {
        let direction = DVector::from_fn(all, |at, _| vector[at] / lengths[at]);
        if *value <= FLAT * largest {
            let of_numbers = direction.rows(0, count).into_owned();
            let norm = unit(of_numbers.norm());
            open.push(of_numbers / norm);
        } else {
            covariance += &direction * direction.transpose() * value.recip();
        }
    }
    let undetermined =
        if open.is_empty() { DMatrix::zeros(count, 0) } else { DMatrix::from_columns(&open) };
    (covariance, undetermined)
}

/// How many rows that follow each other stand for one: one and twice the sum of autocorrelations up to the first that
/// is not positive.
pub(super) fn correlation(left: &[f64]) -> f64 {
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
