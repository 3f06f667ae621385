//! The passive network that is nearest to records, on a grid of times.
//!
//! Every network of springs and dashpots is, from outside, a sum of terms with strengths that are not negative. On a
//! dense grid of times the nearest sum is the solution of a convex problem.

use nalgebra::DVector;

use super::{kernel::Term, problem::Problem, record::Form, spectrum::Spectrum};
use crate::nnls::{Minimum, NonNegative};

/// Grid times in each decade.
const PER_DECADE: f64 = 6.0;
/// Grid times beyond the record, in parts of its shortest time and multiples of its longest.
const BEYOND: f64 = 30.0;
/// More grid times are not looked at; wider records have a coarser grid.
const MOST_TIMES: f64 = 400.0;

/// The terms that are looked at: spring, dashpot, and branches on a grid of times.
#[derive(Debug, Clone)]
pub(super) struct Dense {
    pub(super) terms: Vec<Term>,
    pub(super) problem: NonNegative,
}

/// Position of the spring among the terms.
pub(super) const SPRING: usize = 0;
/// Position of the dashpot.
pub(super) const DASHPOT: usize = 1;

impl Dense {
    /// The dense problem of records, with branches far beyond what they tell of.
    pub(super) fn of(problem: &Problem) -> Self {
        Self::until(problem, problem.range.1 * BEYOND)
    }

    /// The same with branches up to this time \[s\].
    pub(super) fn until(problem: &Problem, high: f64) -> Self {
        Self::between(problem, (problem.range.0 / BEYOND, high))
    }

    /// The same with the branches that a problem may have.
    pub(super) fn within(problem: &Problem) -> Self {
        Self::between(problem, problem.limits)
    }

    fn between(problem: &Problem, (low, high): (f64, f64)) -> Self {
        let steps = (PER_DECADE * (high / low).log10()).min(MOST_TIMES).ceil().max(1.0);
        let places = (0..).map(f64::from).take_while(|own| *own <= steps);
        let branches = places.map(|own| Term::Branch(low * (high / low).powf(own / steps)));
        let terms: Vec<Term> = [Term::Spring, Term::Dashpot].into_iter().chain(branches).collect();
        let mut columns = problem.columns(&terms);
        if problem.is_solid && problem.form == Form::Kelvin {
            columns.column_mut(DASHPOT).fill(0.0);
        }
        Self { problem: NonNegative::new(columns, problem.target.clone()), terms }
    }

    pub(super) fn minimum(&self) -> Minimum {
        self.problem.minimum(&[])
    }

    /// The terms that a minimum has, those that are next to each other on the grid as one.
    pub(super) fn spectrum(&self, minimum: &Minimum) -> Spectrum {
        let mut branches: Vec<(f64, f64)> = Vec::new();
        let mut last = None;
        for (at, (term, value)) in self.terms.iter().zip(&minimum.values).enumerate() {
            let Term::Branch(time) = *term else { continue };
            if *value <= 0.0 {
                continue;
            }
            if let Some(own) = branches.last_mut().filter(|_| last == Some(at - 1)) {
                let sum = own.1 + value;
                *own = (((own.1 * own.0.ln() + value * time.ln()) / sum).exp(), sum);
                // Where a third one follows, it begins another.
                last = None;
            } else {
                branches.push((time, *value));
                last = Some(at);
            }
        }
        Spectrum { spring: minimum.values[SPRING], dashpot: minimum.values[DASHPOT], branches }
    }
}

/// Steps of refinement, until one wins less than this part.
const STEPS: usize = 40;
const SETTLED: f64 = 1e-4;

/// The nearest network: that on the grid of times, or where it comes nearer one of fewer terms between them.
#[derive(Debug, Clone)]
pub(super) struct Nearest {
    /// The terms on the grid, those that are next to each other as one, refined.
    pub(super) start: Spectrum,
    /// What it leaves of the rows.
    pub(super) left: DVector<f64>,
}

impl Nearest {
    /// That of a problem; `None` where it has no terms.
    pub(super) fn of(problem: &Problem) -> Option<Self> {
        let dense = Dense::within(problem);
        let minimum = dense.minimum();
        let mut start = dense.spectrum(&minimum);
        start.terms().next()?;
        let residual = start.refine(problem, STEPS, SETTLED);
        let is_nearer = residual.norm() < minimum.residual.norm();
        Some(Self { start, left: if is_nearer { residual } else { minimum.residual } })
    }
}

/// How far a curve is from rows, in their weights: parts of values, or of the largest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Misfit {
    /// Root of the mean square.
    pub rms: f64,
    /// The largest.
    pub largest: f64,
}

impl Misfit {
    pub(super) fn of(residual: &[f64]) -> Self {
        let square: f64 = residual.iter().map(|own| own * own).sum();
        let largest = residual.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
        Self { rms: (square / residual.len().max(1) as f64).sqrt(), largest }
    }

    pub(super) fn of_vector(residual: &DVector<f64>) -> Self {
        Self::of(residual.as_slice())
    }
}
