//! The direct solver of small dense matrices: factors `P A = L U` with partial pivoting.

use diffsol::LaLinearOp as LinearOp;
use diffsol_la::{
    LaError, LinearSolver,
    error::LinearSolverError,
    matrix::{Matrix, MatrixCommon},
};

use super::{Column, ROWS, Single, StackMatrix, StackVector};
use crate::methods::stepping::algebra::Algebra;

/// The factors of a small matrix, in its own places, but for `U`'s diagonal, of which the reciprocals are kept.
#[derive(Debug)]
pub(in crate::methods) struct StackFactor {
    factors: StackMatrix,
    /// The row that each step exchanges with its own.
    pivots: [usize; ROWS],
    reciprocals: Column,
    /// Whether there are factors, and none of the pivots is zero.
    is_regular: bool,
}

impl Algebra for StackMatrix {
    type Factor = StackFactor;

    fn values(&self) -> &[f64] {
        self.columns.as_flattened()
    }

    fn values_mut(&mut self) -> &mut [f64] {
        self.columns.as_flattened_mut()
    }

    fn place(&self, row: usize, column: usize) -> Option<usize> {
        Some(column * ROWS + row)
    }
}

impl Default for StackFactor {
    fn default() -> Self {
        Self {
            factors: StackMatrix::zeros(0, 0, Single),
            pivots: [0; ROWS],
            reciprocals: [0.0; ROWS],
            is_regular: false,
        }
    }
}

impl StackFactor {
    fn factorise(&mut self) {
        let (size, columns) = (self.factors.nrows(), &mut self.factors.columns);
        self.is_regular = true;
        for at in 0..size {
            let mut pivot = at;
            for row in at + 1..size {
                if columns[at][row].abs() > columns[at][pivot].abs() {
                    pivot = row;
                }
            }
            self.pivots[at] = pivot;
            for column in columns.iter_mut() {
                column.swap(at, pivot);
            }
            let reciprocal = columns[at][at].recip();
            self.is_regular &= reciprocal.is_finite();
            self.reciprocals[at] = reciprocal;
            let (lower, later) = columns.split_at_mut(at + 1);
            let lower = &mut lower[at];
            for factor in &mut lower[at + 1..size] {
                *factor *= reciprocal;
            }
            for column in later {
                eliminate(column, at, &lower[..size]);
            }
        }
    }
}

/// Takes the entry at `at` times the factors behind it off the entries there.
fn eliminate(column: &mut Column, at: usize, factors: &[f64]) {
    let own = column[at];
    for (entry, factor) in column[at + 1..].iter_mut().zip(&factors[at + 1..]) {
        *entry -= factor * own;
    }
}

impl LinearSolver<StackMatrix> for StackFactor {
    fn set_linearisation<C>(&mut self, op: &C)
    where
        C: LinearOp<T = f64, V = StackVector, M = StackMatrix, C = Single>,
    {
        op.matrix_inplace(&mut self.factors);
        self.factorise();
    }

    fn set_sparsity<C>(&mut self, op: &C)
    where
        C: LinearOp<T = f64, V = StackVector, M = StackMatrix, C = Single>,
    {
        self.factors = StackMatrix::zeros(op.nrows(), op.ncols(), Single);
        self.is_regular = false;
    }

    fn solve_in_place(&self, x: &mut StackVector) -> Result<(), LaError> {
        if !self.is_regular {
            return Err(LinearSolverError::LuSolveFailed.into());
        }
        let (size, columns, x) = (self.factors.nrows(), &self.factors.columns, &mut x.numbers);
        for at in 0..size {
            x.swap(at, self.pivots[at]);
        }
        for (at, column) in columns.iter().enumerate() {
            eliminate(x, at, &column[..size]);
        }
        for (at, column) in columns.iter().enumerate().rev() {
            x[at] *= self.reciprocals[at];
            let own = x[at];
            for (entry, factor) in x[..at].iter_mut().zip(column) {
                *entry -= factor * own;
            }
        }
        Ok(())
    }

    /// Only adjoint equations, of which there are none here, would ask for it.
    fn solve_transpose_in_place(&self, _x: &mut StackVector) -> Result<(), LaError> {
        let reason = "transposed small systems are not solved".to_owned();
        Err(LinearSolverError::Other(reason).into())
    }
}
