//! A lower bound on the residual of every passive network, for all times, by duality.
//!
//! Least squares over sums of terms `a(τ)` with strengths that are not negative are a convex problem. For any direction
//! `r` with `a(τ)ᵀr ≤ 0` for all `τ`, no such sum comes nearer to the rows `b` than `bᵀr / ‖r‖`. The residual of the
//! nearest sum is the best direction; one that is found on a grid is moved by a small part of `b` until the condition
//! holds between the points of the grid and beyond it as well, which Taylor's theorem with bounded second derivatives
//! tells interval by interval.
//!
//! Source: R. Hettich, K. O. Kortanek, Semi-infinite programming, SIAM Review 35 (1993) 380: exchange method, duality.

use nalgebra::DVector;

use super::{
    kernel::{Scale, Term},
    problem::Problem,
};
use crate::nnls::NonNegative;

/// Times in each decade that are looked at first, and those at which the condition is looked at between them.
const PER_DECADE: f64 = 6.0;
const SCANNED_PER_DECADE: f64 = 24.0;
/// They reach so far beyond the record.
const BEYOND: f64 = 1e3;
/// The condition is proven up to so far beyond it; what is beyond that differs by no more than this.
const REACH: f64 = 1e12;
/// Second derivatives fall with the distance from the record, from so many times its ends on.
const FALLS: f64 = 8.0;
/// The part of the bound that may be lost where the condition is made to hold.
const LOSS: f64 = 1e-3;
/// Exchanges of times, halvings of the distance to a maximum, and doublings of what is taken off.
const ROUNDS: usize = 20;
const HALVINGS: usize = 24;
const DOUBLINGS: usize = 8;
/// An interval of this length that is not proven yet, or so many of them, prove nothing.
const SHORTEST: f64 = 1e-7;
const MOST_INTERVALS: usize = 200_000;
/// A residual below this part of the rows is rounding.
const ROUNDING: f64 = 1e-9;

/// The root of the mean square, in the weights of the rows, that every passive network leaves at least; 0 where none
/// can be proven.
pub(super) fn lower_bound(problem: &Problem) -> f64 {
    let problem = &problem.aligned();
    let all = Family::of(problem);
    let (low, high) = (all.finest / BEYOND, all.longest * BEYOND);
    let mut times = spread(low, high, PER_DECADE);
    let target = &problem.target;
    for round in 1..=ROUNDS {
        let terms = [Term::Spring, Term::Dashpot].into_iter();
        let terms: Vec<Term> = terms.chain(times.iter().map(|own| Term::Branch(*own))).collect();
        let minimum = NonNegative::new(problem.columns(&terms), target.clone()).minimum(&[]);
        let passive = minimum.passive();
        let left = -minimum.residual;
        if left.norm() <= ROUNDING * target.norm() {
            break;
        }
        let (excess, peaks) = all.peaks(&left, (low, high));
        let least = LOSS * left.norm_squared() / target.norm_squared();
        if excess <= least || round == ROUNDS {
            return all.proven(&left, least.max(1.2 * excess));
        }
        let taken = passive.iter().filter_map(|at| terms[*at].time());
        times = taken.chain(peaks).chain([low, high]).collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
    }
    0.0
}

/// Times at equal ratios.
fn spread(low: f64, high: f64, per_decade: f64) -> Vec<f64> {
    let step = std::f64::consts::LN_10 / per_decade;
    let logs = (0..).map(|at| low.ln() + step * f64::from(at));
    logs.take_while(|log| *log < high.ln() + step).map(f64::exp).collect()
}

/// All branches of a problem, scaled so that they have limits at both ends.
struct Family<'p> {
    problem: &'p Problem,
    scale: Scale,
    /// Bounds of the second derivatives of each row by the logarithm of the time.
    curvature: Vec<f64>,
    finest: f64,
    longest: f64,
}

impl<'p> Family<'p> {
    fn of(problem: &'p Problem) -> Self {
        let (scale, (finest, longest)) = (problem.scale(), problem.span());
        Self { problem, scale, curvature: problem.curvature(scale), finest, longest }
    }

    /// The scaled branch at the logarithm of a time, in the direction `along`: its value, its derivative and what
    /// rounding may be of them.
    fn at(&self, along: &DVector<f64>, log: f64) -> (f64, f64, f64) {
        let rows = self.problem.rows();
        let (mut value, mut slope) = (vec![0.0; rows], vec![0.0; rows]);
        self.problem.term(Term::Branch(log.exp()), &mut value, &mut slope);
        let (mut sum, mut change, mut size) = (0.0, 0.0, 0.0);
        for ((own, value), slope) in along.iter().zip(&value).zip(&slope) {
            sum += own * value;
            change += own * slope;
            size += (own * value).abs();
        }
        let (factor, growth) = self.scale.at(log);
        (factor * sum, factor * change + growth * sum, 16.0 * f64::EPSILON * factor * size)
    }

    /// The part of the rows that has to be taken off `left` to meet the condition where it was looked at, and the
    /// times at which it is missed most.
    fn peaks(&self, left: &DVector<f64>, (low, high): (f64, f64)) -> (f64, Vec<f64>) {
        let part = |value: f64, of_rows: f64| match value {
            value if value <= 0.0 => 0.0,
            value if of_rows > 0.0 => value / of_rows,
            _ => f64::INFINITY,
        };
        let target = &self.problem.target;
        let ends = self.problem.columns(&[Term::Spring, Term::Dashpot]);
        let ends = ends.column_iter().map(|own| part(own.dot(left), own.dot(target)));
        let mut excess = ends.fold(0.0, f64::max);
        let mut look = |log: f64| {
            let own = self.at(left, log);
            excess = part(own.0, self.at(target, log).0).max(excess);
            own
        };
        look((self.finest / REACH).ln());
        look((self.longest * REACH).ln());
        let logs = spread(low, high, SCANNED_PER_DECADE).into_iter().map(f64::ln);
        let all: Vec<(f64, f64)> = logs.map(|log| (log, look(log).1)).collect();
        let mut peaks = Vec::new();
        for pair in all.windows(2).filter(|pair| pair[0].1 > 0.0 && pair[1].1 <= 0.0) {
            let (mut from, mut to) = (pair[0].0, pair[1].0);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (from + to);
                if self.at(left, middle).1 > 0.0 { from = middle } else { to = middle }
            }
            if look(from).0 > 0.0 {
                peaks.push(from.exp());
            }
        }
        (excess, peaks)
    }

    /// The bound where so much of the rows is taken off `left`, or more if that does not suffice.
    fn proven(&self, left: &DVector<f64>, least: f64) -> f64 {
        let target = &self.problem.target;
        let mut part = least;
        for _ in 0..DOUBLINGS {
            let along = left - part * target;
            let bound = target.dot(&along) / along.norm();
            if bound.is_nan() || bound <= 0.0 {
                break;
            }
            if self.is_met(&along) {
                return bound / (target.len() as f64).sqrt();
            }
            part *= 2.0;
        }
        0.0
    }

    /// Whether no term has a positive product with `along`, whatever its time.
    fn is_met(&self, along: &DVector<f64>) -> bool {
        let ends = self.problem.columns(&[Term::Spring, Term::Dashpot]);
        if ends.column_iter().any(|own| own.dot(along) > 0.0) {
            return false;
        }
        let pairs = along.iter().zip(&self.curvature);
        let curved: f64 = pairs.map(|(own, curvature)| own.abs() * curvature).sum();
        let (from, to) = (self.finest / REACH, self.longest * REACH);
        let is_beyond = |time: f64| {
            let (value, _, rounding) = self.at(along, time.ln());
            value + rounding + FALLS / REACH * curved <= 0.0
        };
        if !is_beyond(from) || !is_beyond(to) {
            return false;
        }
        let mut open = vec![(from.ln(), to.ln())];
        for _ in 0..MOST_INTERVALS {
            let Some((low, high)) = open.pop() else { return true };
            let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
            let (value, slope, rounding) = self.at(along, middle);
            if value > 0.0 || half < SHORTEST {
                return false;
            }
            let short = FALLS * high.exp() / self.finest;
            let long = FALLS * self.longest / low.exp();
            let curved = curved * short.min(long).min(1.0);
            if half > 1.0 || value + rounding + (slope.abs() + 0.5 * curved * half) * half > 0.0 {
                open.extend([(low, middle), (middle, high)]);
            }
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use super::{super::record::Record, *};

    fn records() -> Vec<Vec<Record>> {
        let pairs: Vec<(f64, f64)> = [0.1, 0.4, 1.0, 3.0, 9.0].map(|t| (t, 2.0)).to_vec();
        let history = |first: f64| {
            let rows = [[-0.5, first, 0.1], [0.0, 0.8, 1.0], [0.7, 1.2, 2.0], [2.0, 1.2, 3.0]];
            [&rows[..], &[[5.0, -0.4, 1.0]]].concat()
        };
        let [storage, loss] = [Record::Storage(pairs.clone()), Record::Loss(pairs.clone())];
        let relaxation = Record::Relaxation(pairs.clone());
        vec![
            vec![relaxation.clone()],
            vec![Record::Creep(pairs.clone())],
            vec![storage.clone()],
            vec![storage.clone(), loss],
            vec![relaxation.clone(), storage],
            vec![Record::Strained(history(0.3))],
            vec![Record::Strained(history(0.0)), relaxation],
            vec![Record::Stressed(history(0.3)), Record::Creep(pairs)],
        ]
    }

    #[test]
    fn second_derivatives_stay_within_their_bounds() {
        for (records, shift) in records().iter().flat_map(|own| [0.0, -0.03].map(|t| (own, t))) {
            let problem = Problem::of(records, &vec![shift; records.len()]).aligned();
            let all = Family::of(&problem);
            let step = 1e-3;
            for row in 0..problem.rows() {
                let mut along = DVector::zeros(problem.rows());
                along[row] = 1.0;
                for log in (-160..160).map(|at| 0.1 * f64::from(at)) {
                    let [low, high] = [-step, step].map(|step| all.at(&along, log + step).1);
                    let second = (high - low) / (2.0 * step);
                    let (short, long) = (log.exp() / all.finest, all.longest / log.exp());
                    let most = all.curvature[row] * (FALLS * short.min(long)).min(1.0);
                    assert!(
                        second.abs() <= most * 1.001 + 1e-11,
                        "{records:?} {row} {log}: {second} {most}"
                    );
                }
            }
        }
    }

    #[test]
    fn histories_have_a_bound_just_below_the_nearest_network() {
        let noise = |at: u32| f64::from(at * at % 37) / 370.0 - 0.05;
        let rows = |of: fn(f64) -> f64| -> Vec<[f64; 3]> {
            let row = |at: u32| (0.1 * f64::from(at), 1.0 + noise(at));
            let answer = |(t, own): (f64, f64)| [t, (t / 0.3).min(1.0), of(t) * own];
            (0..200).map(row).map(answer).collect()
        };
        let relaxing = Record::Strained(rows(|t| 1.0 + 2.0 * t / (0.1 + t) * (-t / 2.0).exp()));
        let creeping = Record::Stressed(rows(|t| 0.1 * t + 1.0 - (-t / 2.0).exp()));
        for record in [relaxing, creeping] {
            let problem = Problem::of(&[record], &[0.0]);
            let bound = lower_bound(&problem);
            let dense = super::super::floor::Dense::of(&problem).minimum().residual;
            let nearest = dense.norm() / (problem.rows() as f64).sqrt();
            assert!(bound < nearest && bound > 0.95 * nearest, "{bound} {nearest}");
        }
    }
}
