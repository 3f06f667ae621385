//! Profile likelihood: how much worse all tests are met with one number held, and all others fitted to that.
//!
//! Source: A. Raue et al., Bioinformatics 25 (2009) 1923–1929.

use nalgebra::DMatrix;

use super::residuals::Task;
use crate::optimum::{Optimum, Residuals, least_squares, sum};

/// The first step of a number without a standard deviation, in logarithms, and the longest.
const FIRST: f64 = 0.1;
const LONGEST: f64 = 1.0;
/// An end is found to this part of its distance.
const NEAR: f64 = 0.02;
/// A refit has converged where a step lowers the sum by less than this part of the rise to an end.
const ENOUGH: f64 = 1e-3;
/// Refits begin by so many rooms between bounds inside of them: the optimiser hardly leaves one that it begins on.
const INSIDE: f64 = 0.01;
/// Refits on the way to an end.
const MOST: usize = 14;
/// A step grows by no more than this.
const GROWTH: f64 = 3.0;

/// The surroundings of a minimum.
pub(super) struct Valley<'v, 't> {
    task: &'v Task<'t>,
    best: &'v Optimum,
    scale: Option<f64>,
    bounds: [Vec<f64>; 2],
    cost: f64,
    variance: f64,
    quantile: f64,
}

/// A problem with one number held.
struct Held<'h> {
    problem: &'h Task<'h>,
    at: usize,
    value: f64,
    /// See [`Residuals::cost_change`].
    change: f64,
}

impl Held<'_> {
    fn whole(&self, others: &[f64]) -> Vec<f64> {
        let mut all = others.to_vec();
        all.insert(self.at, self.value);
        all
    }
}

impl Residuals for Held<'_> {
    fn cost_change(&self) -> f64 {
        self.change
    }

    fn is_stopped(&self, steps: usize, cost: f64) -> bool {
        self.problem.is_stopped(steps, cost)
    }

    fn residual(&self, unknowns: &[f64]) -> Vec<f64> {
        self.problem.residual(&self.whole(unknowns))
    }

    fn jacobian(&self, unknowns: &[f64]) -> DMatrix<f64> {
        self.problem.slopes(&self.whole(unknowns), Some(self.at)).remove_column(self.at)
    }
}

fn without(all: &[f64], at: usize) -> Vec<f64> {
    let others = all.iter().enumerate().filter(|own| own.0 != at);
    others.map(|own| *own.1).collect()
}

impl<'v, 't> Valley<'v, 't> {
    /// That of a minimum of the robust sum beyond a scale, by the variance of a row and the standard deviations to the
    /// end of an interval.
    pub(super) fn new(
        task: &'v Task<'t>,
        best: &'v Optimum,
        scale: Option<f64>,
        (variance, quantile): (f64, f64),
    ) -> Self {
        let bounds = task.bounds();
        let cost = sum(&task.left(&best.unknowns), scale);
        Self { task, best, scale, bounds, cost, variance, quantile }
    }

    /// How far a sum is above the minimum, in standard deviations.
    fn rise(&self, cost: f64) -> f64 {
        (2.0 * (cost - self.cost) / self.variance).max(0.0).sqrt()
    }

    /// By what part the rise to the ends of an interval departs from what the covariance tells, the larger of both
    /// sides; `None` where there is no solution, or a bound is nearer.
    pub(super) fn departs(&self, at: usize, covariance: &[f64]) -> Option<f64> {
        let mut most = 0.0_f64;
        for sign in [-1.0, 1.0] {
            let step = sign * self.quantile / covariance[at].sqrt();
            let moved = self.best.unknowns.iter().zip(covariance);
            let moved: Vec<f64> = moved.map(|(own, other)| own + step * other).collect();
            if moved[at] < self.bounds[0][at] || moved[at] > self.bounds[1][at] {
                return None;
            }
            let rise = self.rise(sum(&self.task.left(&moved), self.scale));
            most = most.max((rise / self.quantile - 1.0).abs());
        }
        most.is_finite().then_some(most)
    }

    /// The ends of the interval of a number with about this covariance of its logarithm with all unknowns; `None` for one
    /// that is not reached within the bounds.
    pub(super) fn ends(&self, at: usize, covariance: &[f64]) -> [Option<f64>; 2] {
        let deviation = covariance[at].sqrt();
        let is_usable = deviation.is_finite() && deviation > 0.0;
        let step = if is_usable { (self.quantile * deviation).min(LONGEST) } else { FIRST };
        [-step, step].map(|step| self.end(at, step, covariance).map(f64::exp))
    }

    fn end(&self, at: usize, step: f64, covariance: &[f64]) -> Option<f64> {
        let from = self.best.unknowns[at];
        let bound = if step < 0.0 { self.bounds[0][at] } else { self.bounds[1][at] };
        let room = (bound - from).abs();
        let (mut inside, mut outside, mut was_inside) = ((0.0, 0.0), None, None);
        let mut distance = step.abs().min(room);
        // All others follow the one that is held on a line, as far as is known: the next refit begins there.
        let is_usable = covariance[at] > 0.0;
        let slope = |own: &f64| if is_usable { own / covariance[at] } else { 0.0 };
        let mut slopes: Vec<f64> = covariance.iter().map(slope).collect();
        for _ in 0..MOST {
            if distance <= 0.0 || self.task.is_ended() {
                return None;
            }
            let value = from + distance.copysign(step);
            let start = self.best.unknowns.iter().zip(&slopes).enumerate().map(|(at, own)| {
                let moved = own.0 + own.1 * (value - from);
                let moved = if moved.is_finite() { moved } else { *own.0 };
                let [low, high] = [0, 1].map(|side: usize| self.bounds[side][at]);
                let inside = INSIDE * (high - low);
                moved.clamp(low + inside, high - inside)
            });
            let rise = match self.held(at, value, &start.collect::<Vec<f64>>()) {
                Some((rise, unknowns)) => {
                    let moved = unknowns.iter().zip(&self.best.unknowns);
                    slopes = moved.map(|(own, best)| (own - best) / (value - from)).collect();
                    rise
                }
                // What cannot be solved is no better.
                None => f64::INFINITY,
            };
            if (rise / self.quantile - 1.0).abs() < NEAR {
                return Some(value);
            }
            if rise < self.quantile {
                if distance >= room {
                    return None;
                }
                inside = (distance, rise);
            } else {
                outside = Some((distance, rise));
            }
            // An end that stays twice draws the next place nearer (the Illinois rule).
            let is_inside = rise < self.quantile;
            if was_inside.replace(is_inside) == Some(is_inside) {
                let kept = if is_inside { outside.as_mut() } else { Some(&mut inside) };
                if let Some((_, own)) = kept {
                    *own = f64::midpoint(*own, self.quantile);
                }
            }
            distance = match outside {
                None => (distance * (self.quantile / rise).clamp(1.1, GROWTH)).min(room),
                Some((far, high)) if high.is_finite() => {
                    let part = (self.quantile - inside.1) / (high - inside.1);
                    inside.0 + (far - inside.0) * part.clamp(0.05, 0.95)
                }
                Some((far, _)) => 0.5 * (inside.0 + far),
            };
        }
        outside.map(|_| from + distance.copysign(step))
    }

    /// The rise with an unknown held at a value, and the unknowns there.
    fn held(&self, at: usize, value: f64, start: &[f64]) -> Option<(f64, Vec<f64>)> {
        // What is sought is where the sum has risen by so much.
        let change = (ENOUGH * self.variance * self.quantile.powi(2) / self.cost).min(ENOUGH);
        let problem = Held { problem: self.task, at, value, change };
        let others = without(start, at);
        if others.is_empty() {
            let cost = sum(&problem.residual(&[]), self.scale);
            return cost.is_finite().then(|| (self.rise(cost), vec![value]));
        }
        let bounds = [0, 1].map(|side: usize| without(&self.bounds[side], at));
        let found = least_squares(&problem, [&bounds[0], &bounds[1]], &others, self.scale)?;
        let cost = sum(&problem.residual(&found.unknowns), self.scale);
        Some((self.rise(cost), problem.whole(&found.unknowns)))
    }
}
