//! A system whose balances are solved wherever its slopes are asked for.

use nalgebra::DMatrix;
use nalgebra_sparse::CsrMatrix;

use super::{
    super::MOST_EXPLICIT,
    drives::{Drives, Excursion},
};
use crate::{System, UnknownKind, frequency::free_rates};

/// Newton steps in a row.
const STEPS: usize = 25;
/// Newton steps, in parts of unknowns of size 1 and more, that may be rounding.
const SETTLED: f64 = 1e-11;
/// Residuals below this many times their rounding error are zero.
const ROUNDING: f64 = 8.0;

/// A system as ordinary differential equations: its algebraic unknowns are found from the others.
#[derive(Debug)]
pub(super) struct Reduced<'s> {
    system: &'s System,
    /// Start of the span, dimensionless.
    origin: f64,
    drives: Drives<'s>,
    differential: Vec<usize>,
    algebraic: Vec<usize>,
    /// The place of each unknown among the algebraic ones.
    place: Vec<Option<usize>>,
    /// Whether a law depends on an algebraic unknown.
    is_coupled: bool,
    /// The block of the algebraic unknowns, row by row, and what is left of it while it is eliminated.
    block: Vec<f64>,
    matrix: Vec<f64>,
    residual: Vec<f64>,
    sizes: Vec<f64>,
    inputs: Vec<f64>,
    /// How often slopes were asked for.
    pub(super) calls: usize,
}

/// An eigenvalue of the linearised equations.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rate {
    /// How fast it dies away.
    pub(super) decay: f64,
    /// Its magnitude.
    pub(super) size: f64,
}

/// That the balances have no solution that was found.
#[derive(Debug, Clone, Copy)]
pub(super) struct Unbalanced;

impl<'s> Reduced<'s> {
    /// The equations over the span between two times.
    pub(super) fn new(system: &'s System, span: (f64, f64)) -> Self {
        let of_kind = |kind: UnknownKind| {
            let unknowns = system.unknowns.iter().enumerate();
            unknowns.filter(|own| own.1.kind == kind).map(|own| own.0).collect::<Vec<usize>>()
        };
        let algebraic = of_kind(UnknownKind::Algebraic);
        let mut place = vec![None; system.len()];
        algebraic.iter().enumerate().for_each(|(at, &unknown)| place[unknown] = Some(at));
        let is_coupled =
            system.terms.iter().any(|term| term.columns().iter().any(|&at| place[at].is_some()));
        let count = algebraic.len();
        let mut own = Self {
            system,
            origin: span.0,
            drives: Drives::new(system, span),
            differential: of_kind(UnknownKind::Differential),
            place,
            is_coupled,
            block: vec![0.0; count * count],
            matrix: vec![0.0; count * count],
            residual: vec![0.0; count],
            sizes: vec![0.0; count],
            inputs: vec![0.0; system.inputs.len()],
            calls: 0,
            algebraic,
        };
        for (row, &unknown) in own.algebraic.iter().enumerate() {
            for (column, value) in entries(&system.jacobian, unknown) {
                if let Some(column) = own.place[column] {
                    own.block[row * count + column] += value;
                }
            }
        }
        own
    }

    /// The algebraic unknowns, in order.
    pub(super) fn algebraic(&self) -> &[usize] {
        &self.algebraic
    }

    /// The differential unknowns, in order.
    pub(super) fn differential(&self) -> &[usize] {
        &self.differential
    }

    /// Sets the differential entries of `y`.
    pub(super) fn set(&self, own: &[f64], y: &mut [f64]) {
        self.differential.iter().zip(own).for_each(|(&at, own)| y[at] = *own);
    }

    /// Solves the balances at the time `t` in the span, where the differential unknowns are `own`, for the algebraic entries of
    /// `y`, which are a first guess, and sets the others; then the rates of the differential ones, in their order, are `slopes`.
    pub(super) fn slopes(
        &mut self,
        t: f64,
        (own, y): (&[f64], &mut [f64]),
        slopes: &mut [f64],
    ) -> Result<(), Unbalanced> {
        self.calls += 1;
        self.set(own, y);
        self.balance(t, y)?;
        self.rates_at(y, slopes);
        Ok(())
    }

    /// The same if an input were what the polynomial is that it is farthest from.
    pub(super) fn slopes_without(
        &mut self,
        excursion: &Excursion,
        y: &mut [f64],
        slopes: &mut [f64],
    ) -> Result<(), Unbalanced> {
        self.calls += 1;
        self.drives.values(self.origin + excursion.time, &mut self.inputs);
        self.inputs[excursion.input] = excursion.smooth;
        self.balance_inputs(y)?;
        self.rates_at(y, slopes);
        Ok(())
    }

    /// See [`Drives::excursions`]; the times are those in the span.
    pub(super) fn excursions(&self, (start, end): (f64, f64), degree: usize) -> Vec<Excursion> {
        let whole = (self.origin + start, self.origin + end);
        let in_span = |own: Excursion| Excursion { time: own.time - self.origin, ..own };
        self.drives.excursions(whole, degree).map(in_span).collect()
    }

    /// The rates where balances are solved for the inputs as they are.
    fn rates_at(&self, y: &[f64], slopes: &mut [f64]) {
        for (slope, &row) in slopes.iter_mut().zip(&self.differential) {
            let own = entries(&self.system.jacobian, row).map(|(at, factor)| factor * y[at]);
            let given = entries(&self.system.input_matrix, row);
            let given = given.map(|(at, factor)| factor * self.inputs[at]);
            *slope = own.sum::<f64>() + given.sum::<f64>();
        }
    }

    /// The rates of the linearised equations at the time `t` in the span, where the
    /// unknowns are `state`; `None` where the laws have no finite slopes there, or the eigenvalues are not found. Of many
    /// unknowns it is a bound of all of them.
    pub(super) fn rates(&mut self, t: f64, state: &[f64]) -> Option<Vec<Rate>> {
        if self.system.len() > MOST_EXPLICIT {
            return Some(vec![self.bound()]);
        }
        let mut y = state.to_vec();
        self.balance(t, &mut y).ok()?;
        let all = free_rates(self.system, &self.linearised(&y))?;
        Some(all.iter().map(|rate| Rate { decay: -rate.re, size: rate.norm() }).collect())
    }

    /// A rate that no eigenvalue of the matrix of a linear system without balances exceeds: `|λ|² ≤ ‖J²‖∞`, which is sharp
    /// for chains of masses and springs. Where no rate depends on its own unknown nothing dies away.
    fn bound(&self) -> Rate {
        let jacobian = &self.system.jacobian;
        let mut row = vec![0.0; self.system.len()];
        let mut sum = |at: usize| {
            for (middle, factor) in entries(jacobian, at) {
                entries(jacobian, middle).for_each(|(to, value)| row[to] += factor * value);
            }
            let reached = entries(jacobian, at).flat_map(|own| entries(jacobian, own.0));
            reached.map(|own| std::mem::take(&mut row[own.0]).abs()).sum::<f64>()
        };
        let size = (0..self.system.len()).map(&mut sum).fold(0.0, f64::max).sqrt();
        let is_damped = jacobian.triplet_iter().any(|(row, column, _)| row == column);
        Rate { decay: if is_damped { size } else { 0.0 }, size }
    }

    /// `J` with the slopes of the laws at `y`.
    fn linearised(&self, y: &[f64]) -> DMatrix<f64> {
        let mut whole = DMatrix::zeros(y.len(), y.len());
        self.system.jacobian.triplet_iter().for_each(|(row, column, value)| {
            whole[(row, column)] += value;
        });
        for term in &self.system.terms {
            let slopes = term.slopes(y, &self.inputs);
            for (argument, slope) in term.arguments.iter().zip(slopes) {
                for &(unknown, factor) in argument.unknowns.terms() {
                    whole[(term.row, unknown)] += slope * argument.scale * factor;
                }
            }
        }
        whole
    }

    /// Solves the balances alone.
    pub(super) fn balance(&mut self, t: f64, y: &mut [f64]) -> Result<(), Unbalanced> {
        self.drives.values(self.origin + t, &mut self.inputs);
        self.balance_inputs(y)
    }

    /// The same for the inputs as they are.
    fn balance_inputs(&mut self, y: &mut [f64]) -> Result<(), Unbalanced> {
        if self.algebraic.is_empty() {
            return Ok(());
        }
        let mut last = f64::INFINITY;
        for _ in 0..STEPS {
            self.residuals(y);
            let is_zero =
                |(residual, size): (&f64, &f64)| residual.abs() <= ROUNDING * f64::EPSILON * size;
            if self.residual.iter().zip(&self.sizes).all(is_zero) {
                return Ok(());
            }
            self.matrix.copy_from_slice(&self.block);
            if self.is_coupled {
                self.add_slopes(y);
            }
            eliminate(&mut self.matrix, &mut self.residual).ok_or(Unbalanced)?;
            let mut change = 0.0_f64;
            for (&unknown, step) in self.algebraic.iter().zip(&self.residual) {
                y[unknown] -= step;
                change = change.max(step.abs() / (1.0 + y[unknown].abs()));
            }
            // Steps that no longer shrink are what the rounding of the laws' arguments makes.
            let is_settled =
                change <= ROUNDING * f64::EPSILON || change <= SETTLED && change > 0.5 * last;
            if !self.is_coupled || is_settled {
                return Ok(());
            }
            last = change;
        }
        Err(Unbalanced)
    }

    /// The residuals of the balances, and the sums of the magnitudes of their terms.
    fn residuals(&mut self, y: &[f64]) {
        for ((&row, residual), size) in
            self.algebraic.iter().zip(&mut self.residual).zip(&mut self.sizes)
        {
            (*residual, *size) = (0.0, 0.0);
            let own = entries(&self.system.jacobian, row).map(|(at, factor)| factor * y[at]);
            let given = entries(&self.system.input_matrix, row);
            for term in own.chain(given.map(|(at, factor)| factor * self.inputs[at])) {
                *residual += term;
                *size += term.abs();
            }
        }
        for term in &self.system.terms {
            if let Some(at) = self.place[term.row] {
                let value = term.value(y, &self.inputs);
                self.residual[at] += value;
                self.sizes[at] += value.abs();
            }
        }
    }

    /// Adds the slopes of the laws to the matrix of the balances.
    fn add_slopes(&mut self, y: &[f64]) {
        let count = self.algebraic.len();
        for term in &self.system.terms {
            let Some(row) = self.place[term.row] else { continue };
            let slopes = term.slopes(y, &self.inputs);
            for (argument, slope) in term.arguments.iter().zip(slopes) {
                for &(unknown, factor) in argument.unknowns.terms() {
                    if let Some(column) = self.place[unknown] {
                        self.matrix[row * count + column] += slope * argument.scale * factor;
                    }
                }
            }
        }
    }
}

fn entries(matrix: &CsrMatrix<f64>, row: usize) -> impl Iterator<Item = (usize, f64)> {
    let offsets = matrix.row_offsets();
    let range = offsets[row]..offsets[row + 1];
    let columns = matrix.col_indices()[range.clone()].iter().copied();
    columns.zip(matrix.values()[range].iter().copied())
}

/// Replaces `right` by the solution of the square `matrix`, given row by row, which is used up; `None` where
/// there is none.
fn eliminate(matrix: &mut [f64], right: &mut [f64]) -> Option<()> {
    let count = right.len();
    for column in 0..count {
        let size = |row: usize| matrix[row * count + column].abs();
        let pivot = (column..count).max_by(|&one, &other| size(one).total_cmp(&size(other)))?;
        if !(size(pivot) > 0.0 && size(pivot).is_finite()) {
            return None;
        }
        if pivot != column {
            (0..count).for_each(|at| matrix.swap(pivot * count + at, column * count + at));
            right.swap(pivot, column);
        }
        for row in column + 1..count {
            let factor = matrix[row * count + column] / matrix[column * count + column];
            if factor != 0.0 {
                for at in column..count {
                    matrix[row * count + at] -= factor * matrix[column * count + at];
                }
                right[row] -= factor * right[column];
            }
        }
    }
    for row in (0..count).rev() {
        let known: f64 = (row + 1..count).map(|at| matrix[row * count + at] * right[at]).sum();
        right[row] = (right[row] - known) / matrix[row * count + row];
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::problems;

    #[test]
    fn elimination_exchanges_rows() {
        let mut matrix = [0.0, 2.0, 1.0, 4.0];
        let mut right = [6.0, 13.0];
        eliminate(&mut matrix, &mut right).unwrap();
        assert_eq!(right.map(f64::to_bits), [1.0, 3.0].map(f64::to_bits));
        assert!(eliminate(&mut [1.0, 2.0, 2.0, 4.0], &mut [1.0, 1.0]).is_none());
    }

    #[test]
    fn balances_hold_wherever_slopes_are_told() {
        for problem in problems::all() {
            let system = &problem.system;
            let t = 0.3 * problem.t_end / system.time_scale;
            let mut reduced = Reduced::new(system, (t, t));
            let mut y = problem.exact(0.3 * problem.t_end);
            let exact = y.clone();
            for &at in &reduced.algebraic.clone() {
                y[at] *= 0.9;
            }
            let own: Vec<f64> = reduced.differential().iter().map(|&at| y[at]).collect();
            reduced.slopes(0.0, (&own, &mut y), &mut own.clone()).unwrap();
            let gap = y.iter().zip(&exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(gap < 1e-9, "{}: {gap:e}", problem.name);
        }
    }
}
