//! The direct solver of sparse matrices: banded where an order of the unknowns makes the band narrow.

use diffsol::{
    FaerContext, FaerSparseLU, FaerSparseMat, FaerVec, LaLinearOp as LinearOp, Matrix,
    matrix::MatrixCommon,
};
use diffsol_la::{
    LinearSolver,
    error::{LaError, LinearSolverError},
};

use super::{
    algebra::{Algebra, Slice},
    banded::Banded,
};

/// Distance from the diagonal up to which a band is narrow. Lattices are solved faster this way up to
/// a reach of about 67; at 99 the general factorisation is 3.5 times as fast.
const NARROW: usize = 48;

/// The factors of a sparse matrix.
#[derive(Default)]
pub(in crate::methods) enum SparseFactor {
    /// No pattern is known yet.
    #[default]
    Empty,
    /// Those of a matrix whose band is narrow, and room for its values.
    Banded(Box<(Banded, FaerSparseMat<f64>)>),
    /// Those of any other.
    General(Box<FaerSparseLU<f64>>),
}

impl SparseFactor {
    /// Room for a matrix with the operator's pattern.
    fn of<C>(op: &C, banded: impl Fn(&FaerSparseMat<f64>) -> Option<Banded>) -> Self
    where
        C: LinearOp<T = f64, V = FaerVec<f64>, M = FaerSparseMat<f64>, C = FaerContext>,
    {
        let (rows, columns) = (op.nrows(), op.ncols());
        let matrix = FaerSparseMat::new_from_sparsity(rows, columns, op.sparsity(), *op.context());
        if let Some(banded) = banded(&matrix) {
            return Self::Banded(Box::new((banded, matrix)));
        }
        let mut general = FaerSparseLU::default();
        LinearSolver::set_sparsity(&mut general, op);
        Self::General(Box::new(general))
    }
}

/// The entries `(row, column)` of a matrix, in the order of their values.
fn entries(matrix: &FaerSparseMat<f64>) -> impl Iterator<Item = (usize, usize)> + Clone {
    matrix.inner().iter().take(1).flat_map(|pattern| {
        (0..pattern.ncols()).flat_map(move |column| {
            pattern.row_idx()[pattern.col_range(column)].iter().map(move |&row| (row, column))
        })
    })
}

impl LinearSolver<FaerSparseMat<f64>> for SparseFactor {
    fn set_linearisation<C>(&mut self, op: &C)
    where
        C: LinearOp<T = f64, V = FaerVec<f64>, M = FaerSparseMat<f64>, C = FaerContext>,
    {
        match self {
            Self::Empty => {}
            Self::Banded(own) => {
                let (factors, matrix) = own.as_mut();
                op.matrix_inplace(matrix);
                if factors.factorise(matrix.values()).is_err() {
                    *self = Self::of(op, |matrix| {
                        Banded::whole(matrix.nrows(), entries(matrix), NARROW)
                    });
                    self.set_linearisation(op);
                }
            }
            Self::General(own) => LinearSolver::set_linearisation(own.as_mut(), op),
        }
    }

    fn set_sparsity<C>(&mut self, op: &C)
    where
        C: LinearOp<T = f64, V = FaerVec<f64>, M = FaerSparseMat<f64>, C = FaerContext>,
    {
        *self = Self::of(op, |matrix| Banded::reduced(matrix.nrows(), entries(matrix), NARROW));
    }

    fn solve_in_place(&self, x: &mut FaerVec<f64>) -> Result<(), LaError> {
        match self {
            Self::Empty => Err(LinearSolverError::LuNotInitialized.into()),
            Self::Banded(own) if own.0.solve(x.slice_mut()) => Ok(()),
            Self::Banded(_) => Err(LinearSolverError::LuSolveFailed.into()),
            Self::General(own) => own.solve_in_place(x),
        }
    }

    /// Only adjoint equations, of which there are none here, would ask for it.
    fn solve_transpose_in_place(&self, x: &mut FaerVec<f64>) -> Result<(), LaError> {
        match self {
            Self::Empty => Err(LinearSolverError::LuNotInitialized.into()),
            Self::Banded(_) => {
                let reason = "transposed banded systems are not solved".to_owned();
                Err(LinearSolverError::Other(reason).into())
            }
            Self::General(own) => own.solve_transpose_in_place(x),
        }
    }
}

#[cfg(test)]
mod tests {
    use diffsol::Vector;
    use nalgebra::{DMatrix, DVector};

    use super::*;
    use crate::methods::stepping::algebra::{matrix, pattern};

    struct Stored(FaerSparseMat<f64>);

    impl LinearOp for Stored {
        type T = f64;
        type V = FaerVec<f64>;
        type M = FaerSparseMat<f64>;
        type C = FaerContext;

        fn nrows(&self) -> usize {
            self.0.nrows()
        }

        fn ncols(&self) -> usize {
            self.0.ncols()
        }

        fn context(&self) -> &FaerContext {
            self.0.context()
        }

        fn matrix_inplace(&self, matrix: &mut FaerSparseMat<f64>) {
            matrix.values_mut().copy_from_slice(self.0.values());
        }

        fn sparsity(&self) -> Option<<FaerSparseMat<f64> as Matrix>::Sparsity> {
            pattern(&self.0)
        }
    }

    /// The factors of a matrix, and the largest error of a solution whose numbers are those from 1.
    fn solved(
        size: usize,
        entries: &[(usize, usize, f64)],
    ) -> (SparseFactor, Result<f64, LaError>) {
        let stored = Stored(matrix(size, entries.iter().copied()).unwrap());
        let mut factor = SparseFactor::default();
        factor.set_sparsity(&stored);
        factor.set_linearisation(&stored);
        let mut dense = DMatrix::zeros(size, size);
        entries.iter().for_each(|&(row, column, value)| dense[(row, column)] += value);
        let truth = DVector::from_fn(size, |row, _| (row + 1) as f64);
        let right = (dense * &truth).as_slice().to_vec();
        let mut vector = FaerVec::from_vec(right, FaerContext::default());
        let error = factor.solve_in_place(&mut vector).map(|()| {
            let errors = vector.slice().iter().zip(truth.iter()).map(|(own, true_)| own - true_);
            errors.fold(0.0_f64, |most, error| most.max(error.abs()))
        });
        (factor, error)
    }

    /// Links between next neighbours in a row; or of three to all others, which have none among themselves.
    fn links(size: usize, is_star: bool) -> Vec<(usize, usize, f64)> {
        let mut entries: Vec<_> = (0..size).map(|at| (at, at, 5.0 + at as f64)).collect();
        for at in 1..size {
            for other in if is_star { 0..3.min(at) } else { at - 1..at } {
                entries.extend([(at, other, 1.0), (other, at, -1.0)]);
            }
        }
        entries
    }

    #[test]
    fn long_and_thin_matrices_are_solved_as_bands_and_others_in_general() {
        for (is_star, size) in [(false, 200), (true, 200), (true, 20), (false, 1)] {
            let (factor, error) = solved(size, &links(size, is_star));
            let is_narrow = !is_star || size < NARROW;
            assert_eq!(matches!(factor, SparseFactor::Banded(_)), is_narrow, "{size}");
            assert_eq!(matches!(factor, SparseFactor::General(_)), !is_narrow, "{size}");
            // The diagonal outweighs the rest of all rows but three, so the condition is about the size.
            let error = error.unwrap();
            assert!(error < 1e3 * f64::EPSILON * size as f64, "{is_star} {size}: {error:e}");
        }
    }

    #[test]
    fn what_is_not_to_be_eliminated_is_solved_all_the_same() {
        let mut entries = links(50, false);
        // One of the rows with two neighbours, of which every other one is eliminated otherwise.
        for at in 20..22 {
            entries.iter_mut().filter(|own| own.0 == at && own.1 == at).for_each(|own| own.2 = 0.0);
        }
        let error = solved(50, &entries).1.unwrap();
        assert!(error < 1e-11, "{error:e}");
    }

    #[test]
    fn what_cannot_be_solved_is_an_error() {
        let mut entries = links(50, false);
        entries.iter_mut().filter(|entry| entry.0 == 20).for_each(|entry| entry.2 = 0.0);
        assert!(solved(50, &entries).1.is_err());
        let mut nothing = FaerVec::from_vec(vec![1.0], FaerContext::default());
        assert!(SparseFactor::default().solve_in_place(&mut nothing).is_err());
    }
}
