//! What the right-hand sides have beside `J y` on one smooth span: the driving functions, and the terms
//! that are not linear, in the form that the integrators ask for.

use std::cell::{Ref, RefCell};

use super::algebra::Algebra;
use crate::{Input, Piece, System, Term};

/// An input during a span, and the column of `B` that it drives.
#[derive(Debug, Clone)]
pub(super) struct Drive {
    piece: Piece,
    derivative: u32,
    input: usize,
}

impl Drive {
    /// An input of `system` on the span that begins at `start`.
    pub(super) fn of(system: &System, input: usize, start: f64) -> Self {
        let Input { waveform, derivative } = system.inputs[input];
        Self { piece: *system.waveforms[waveform].piece_at(start), derivative, input }
    }

    pub(super) fn input(&self) -> usize {
        self.input
    }

    /// The `order`-th derivative of the input at `t`.
    pub(super) fn value(&self, order: u32, t: f64) -> f64 {
        self.piece.derivative(self.derivative + order, t)
    }

    /// Whether it stays the same on the span.
    pub(super) fn is_constant(&self) -> bool {
        self.piece.is_constant(self.derivative)
    }

    /// Adds the `order`-th derivative at `t` to the rows of the input's `column` in `B`.
    pub(super) fn add(&self, order: u32, t: f64, column: &[(usize, f64)], out: &mut [f64]) {
        let value = self.value(order, t);
        for &(row, factor) in column {
            out[row] += factor * value;
        }
    }
}

/// Which slopes of the laws to take.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Slopes {
    /// The laws' own; where one is not finite, that of a narrow secant.
    Own,
    /// As `Own`, and the narrow secant also where a slope is zero, so that balances which only laws
    /// with a flat point determine stay regular there.
    Filled,
    /// Secants over one unit to both sides: the coarse course of the laws.
    Coarse,
}

/// Half the width of a narrow secant in units of the argument.
const NARROW: f64 = 1e-4;

/// The terms on one smooth span.
pub(super) struct Terms<'s> {
    system: &'s System,
    /// The inputs that the terms depend on.
    used: Vec<usize>,
    drives: Vec<Drive>,
    /// All inputs at the time last asked for; zero where no term depends on them.
    inputs: RefCell<Vec<f64>>,
}

/// Where the slopes of the terms belong in a matrix, in the order in which they are visited; `None`
/// for those that have no place there.
#[derive(Debug, Clone)]
pub(super) struct Places(Vec<Option<usize>>);

impl<'s> Terms<'s> {
    /// The terms of `system`, if it has any; [`enter`](Self::enter) must follow.
    pub(super) fn of(system: &'s System) -> Option<Self> {
        if system.is_linear() {
            return None;
        }
        let arguments = system.terms.iter().flat_map(|term| &term.arguments);
        let mut used: Vec<usize> = arguments
            .flat_map(|argument| argument.inputs.terms().iter().map(|input| input.0))
            .collect();
        used.sort_unstable();
        used.dedup();
        let inputs = RefCell::new(vec![0.0; system.inputs.len()]);
        Some(Self { system, used, drives: Vec::new(), inputs })
    }

    /// Enters the span that begins at `start`.
    pub(super) fn enter(&mut self, start: f64) {
        let drive = |&input: &usize| Drive::of(self.system, input, start);
        self.drives = self.used.iter().map(drive).collect();
    }

    /// The inputs at `t`.
    fn inputs(&self, t: f64) -> Ref<'_, [f64]> {
        if !self.drives.is_empty() {
            let mut inputs = self.inputs.borrow_mut();
            for drive in &self.drives {
                inputs[drive.input()] = drive.value(0, t);
            }
        }
        Ref::map(self.inputs.borrow(), Vec::as_slice)
    }

    /// Adds the terms to their rows.
    pub(super) fn add_values(&self, t: f64, y: &[f64], out: &mut [f64]) {
        let inputs = self.inputs(t);
        for term in &self.system.terms {
            out[term.row] += term.value(y, &inputs);
        }
    }

    /// Adds the product of the slopes at `y` with `v`.
    pub(super) fn add_product(
        &self,
        (t, y): (f64, &[f64]),
        kind: Slopes,
        v: &[f64],
        out: &mut [f64],
    ) {
        let inputs = self.inputs(t);
        for term in &self.system.terms {
            let slopes = slopes(term, y, &inputs, kind);
            for (slope, argument) in slopes.iter().zip(&term.arguments) {
                out[term.row] += slope * argument.unknowns.at(v);
            }
        }
    }

    /// Adds the slopes at `y` to the `values` of the matrix to which `places` belong.
    pub(super) fn add_slopes(
        &self,
        (t, y): (f64, &[f64]),
        kind: Slopes,
        places: &Places,
        values: &mut [f64],
    ) {
        let inputs = self.inputs(t);
        let mut places = places.0.iter();
        for term in &self.system.terms {
            for (slope, argument) in slopes(term, y, &inputs, kind).iter().zip(&term.arguments) {
                for (&(_, coefficient), place) in argument.unknowns.terms().iter().zip(&mut places)
                {
                    if let Some(place) = *place {
                        values[place] += slope * coefficient;
                    }
                }
            }
        }
    }

    /// Adds what the `order`-th rates of the inputs do to that of the terms, with the slopes at `y`.
    pub(super) fn add_drive(
        &self,
        order: u32,
        (t, y): (f64, &[f64]),
        kind: Slopes,
        out: &mut [f64],
    ) {
        if self.drives.is_empty() {
            return;
        }
        let inputs = self.inputs(t);
        let mut rates = vec![0.0; inputs.len()];
        for drive in &self.drives {
            rates[drive.input()] = drive.value(order, t);
        }
        for term in &self.system.terms {
            let slopes = slopes(term, y, &inputs, kind);
            for (slope, argument) in slopes.iter().zip(&term.arguments) {
                out[term.row] += slope * argument.inputs.at(&rates);
            }
        }
    }

    /// Adds to each row the size of its terms and of what the rounding of their arguments makes of
    /// them, in parts of `ε`, from the sizes of unknowns and of inputs.
    pub(super) fn add_sizes(
        &self,
        (t, y): (f64, &[f64]),
        (unknowns, inputs): (&[f64], &[f64]),
        out: &mut [f64],
    ) {
        let now = self.inputs(t);
        for term in &self.system.terms {
            let value = term.value(y, &now);
            out[term.row] += value.abs();
            let at = term.arguments.each_ref().map(|own| own.at(y, &now));
            for (k, argument) in term.arguments.iter().enumerate() {
                let size =
                    argument.unknowns.magnitude_at(unknowns) + argument.inputs.magnitude_at(inputs);
                let blur = f64::EPSILON * (argument.scale * size).abs();
                let shifted = |by: f64| {
                    let mut moved = at;
                    moved[k] += by;
                    (term.factor * term.law.value(moved) - value).abs() / f64::EPSILON
                };
                out[term.row] += shifted(blur).max(shifted(-blur));
            }
        }
    }

    /// Adds to each row `Σ |slope · coefficient · size|` over the arguments' unknowns and inputs.
    pub(super) fn add_magnitudes(
        &self,
        (t, y): (f64, &[f64]),
        (unknowns, inputs): (&[f64], &[f64]),
        out: &mut [f64],
    ) {
        let now = self.inputs(t);
        for term in &self.system.terms {
            let slopes = slopes(term, y, &now, Slopes::Own);
            for (slope, argument) in slopes.iter().zip(&term.arguments) {
                let size =
                    argument.unknowns.magnitude_at(unknowns) + argument.inputs.magnitude_at(inputs);
                out[term.row] += slope.abs() * size;
            }
        }
    }

    /// Where the slopes belong in `matrix`, which holds those over the unknowns that are `wanted`.
    pub(super) fn places<M: Algebra>(&self, matrix: &M, wanted: impl Fn(usize) -> bool) -> Places {
        let place = |(row, column)| wanted(column).then(|| matrix.place(row, column)).flatten();
        Places(pattern(self.system).map(place).collect())
    }
}

/// The entries `(row, column)` that the terms' slopes have, in the order in which they are visited;
/// one may come more than once.
pub(super) fn pattern(system: &System) -> impl Iterator<Item = (usize, usize)> {
    system.terms.iter().flat_map(|term| {
        let unknowns = term.arguments.iter().flat_map(|argument| argument.unknowns.terms());
        unknowns.map(|&(column, _)| (term.row, column))
    })
}

/// The slopes of a term over its arguments in their own units.
fn slopes(term: &Term, y: &[f64], inputs: &[f64], kind: Slopes) -> [f64; 2] {
    let own = if kind == Slopes::Coarse { [f64::NAN; 2] } else { term.slopes(y, inputs) };
    let mut slopes = [0.0; 2];
    for (k, argument) in term.arguments.iter().enumerate() {
        if argument.unknowns.is_zero() && argument.inputs.is_zero() {
            continue;
        }
        let missing = !own[k].is_finite() || (own[k] == 0.0 && kind == Slopes::Filled);
        slopes[k] = if missing {
            secant(term, k, y, inputs, if kind == Slopes::Coarse { 1.0 } else { NARROW })
        } else {
            own[k] * argument.scale
        };
    }
    slopes
}

/// The slope over `width` units to both sides of argument `k`, in its units.
fn secant(term: &Term, k: usize, y: &[f64], inputs: &[f64], width: f64) -> f64 {
    let at = term.arguments.each_ref().map(|own| own.at(y, inputs));
    let value = |units: f64| {
        let mut moved = at;
        moved[k] += units * term.arguments[k].scale;
        term.law.value(moved)
    };
    term.factor * (value(width) - value(-width)) / (2.0 * width)
}

#[cfg(test)]
mod tests {
    use diffsol::{FaerSparseMat, NalgebraMat, NonLinearOp, NonLinearOpJacobian, Vector};

    use super::super::{
        algebra::Slice,
        equations::Equations,
        stack::{ROWS, StackMatrix},
    };
    use super::*;
    use crate::tests::problems;

    /// Compares the Jacobian, its product and difference quotients at a state of every problem of at most so many rows.
    fn compare<M: Algebra>(most: usize) {
        let all = problems::all();
        let fitting = |system: &System| !system.is_linear() && system.len() <= most;
        let fitting: Vec<_> = all.iter().filter(|problem| fitting(&problem.system)).collect();
        assert!(!fitting.is_empty());
        for problem in fitting {
            let system = &problem.system;
            let mut equations = Equations::<M>::new(system).unwrap();
            equations.enter(0.0, &system.initial);
            let state: Vec<f64> = problem.exact(0.1 * problem.t_end);
            let vector = |numbers: Vec<f64>| M::V::from_vec(numbers, M::C::default());
            let at = vector(state.clone());
            let pattern = equations.jacobian_sparsity();
            let size = system.len();
            let mut jacobian = M::new_from_sparsity(size, size, pattern, M::C::default());
            // Twice, because the matrix is used again and again.
            for _ in 0..2 {
                equations.jacobian_inplace(&at, 0.0, &mut jacobian);
            }
            let mut out = [(); 4].map(|()| vector(vec![0.0; size]));
            for column in 0..size {
                let unit = |h: f64| {
                    let mut unit = vec![0.0; size];
                    unit[column] = h;
                    unit
                };
                equations.jac_mul_inplace(&at, 0.0, &vector(unit(1.0)), &mut out[0]);
                jacobian.gemv(1.0, &vector(unit(1.0)), 0.0, &mut out[1]);
                let h = 1e-5;
                for (k, h) in [(2, h), (3, -h)] {
                    let moved = state.iter().zip(unit(h)).map(|(a, b)| a + b).collect();
                    NonLinearOp::call_inplace(&equations, &vector(moved), 0.0, &mut out[k]);
                }
                for row in 0..size {
                    let [product, entry, above, below] = out.each_ref().map(|v| v.slice()[row]);
                    let quotient = (above - below) / (2.0 * h);
                    let what = format!("{} ({row}, {column})", problem.name);
                    assert!((product - entry).abs() < 1e-14, "{what}: {product} {entry}");
                    assert!((quotient - entry).abs() < 1e-7, "{what}: {quotient} {entry}");
                }
            }
        }
    }

    #[test]
    fn slopes_are_those_of_the_values_in_dense_matrices() {
        compare::<NalgebraMat<f64>>(usize::MAX);
    }

    #[test]
    fn slopes_are_those_of_the_values_in_sparse_matrices() {
        compare::<FaerSparseMat<f64>>(usize::MAX);
    }

    #[test]
    fn slopes_are_those_of_the_values_in_matrices_on_the_stack() {
        compare::<StackMatrix>(ROWS);
    }
}
