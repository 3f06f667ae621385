//! The three matrix worlds that the integrators run in, behind one private trait.

use diffsol::{
    DiffsolError, FaerSparseMat, FaerVec, LinearSolver, Matrix, NalgebraLU, NalgebraMat,
    NalgebraVec, Vector, VectorCommon,
    matrix::{MatrixCommon, sparsity::MatrixSparsityRef},
};
use nalgebra_sparse::CsrMatrix;

use super::factor::SparseFactor;

/// Unknowns up to which dense matrices are faster than sparse ones.
pub(super) const DENSE_UP_TO: usize = 30;

/// A vector whose numbers lie in one slice.
pub(in crate::methods) trait Slice {
    /// The numbers.
    fn slice(&self) -> &[f64];
    /// The numbers, to be written.
    fn slice_mut(&mut self) -> &mut [f64];
}

impl Slice for NalgebraVec<f64> {
    fn slice(&self) -> &[f64] {
        self.inner().as_slice()
    }

    fn slice_mut(&mut self) -> &mut [f64] {
        self.inner_mut().as_mut_slice()
    }
}

impl Slice for FaerVec<f64> {
    fn slice(&self) -> &[f64] {
        self.inner().col_as_slice(0)
    }

    fn slice_mut(&mut self) -> &mut [f64] {
        self.inner_mut().col_as_slice_mut(0)
    }
}

/// A matrix type and the direct solver that belongs to it.
pub(in crate::methods) trait Algebra: Matrix<T = f64, V: Slice> {
    type Factor: LinearSolver<Self>;

    /// The stored values.
    fn values(&self) -> &[f64];

    /// The stored values, to be written.
    fn values_mut(&mut self) -> &mut [f64];

    /// Where the entry of a row and a column is stored, if it is.
    fn place(&self, row: usize, column: usize) -> Option<usize>;
}

impl Algebra for NalgebraMat<f64> {
    type Factor = NalgebraLU<f64>;

    fn values(&self) -> &[f64] {
        self.inner().as_slice()
    }

    fn values_mut(&mut self) -> &mut [f64] {
        self.inner_mut().as_mut_slice()
    }

    fn place(&self, row: usize, column: usize) -> Option<usize> {
        Some(column * self.nrows() + row)
    }
}

impl Algebra for FaerSparseMat<f64> {
    type Factor = SparseFactor;

    fn values(&self) -> &[f64] {
        self.inner().first().map_or(&[], |only| only.val())
    }

    fn values_mut(&mut self) -> &mut [f64] {
        self.inner_mut().first_mut().map_or(&mut [], |only| only.val_mut())
    }

    fn place(&self, row: usize, column: usize) -> Option<usize> {
        let only = self.inner().first()?;
        only.col_range(column).find(|&at| only.row_idx()[at] == row)
    }
}

/// What every operator says of itself: its `context`, and the number of its rows and columns.
macro_rules! square_operator {
    ($operator:ty, $size:expr) => {
        impl<M: Algebra> diffsol::Op for $operator {
            type T = f64;
            type V = M::V;
            type M = M;
            type C = M::C;

            fn context(&self) -> &M::C {
                &self.context
            }

            fn nstates(&self) -> usize {
                let size: fn(&Self) -> usize = $size;
                size(self)
            }

            fn nout(&self) -> usize {
                self.nstates()
            }

            fn nparams(&self) -> usize {
                0
            }
        }
    };
}
pub(super) use square_operator;

/// The matrix with the given entries `(row, column, value)`.
pub(super) fn matrix<M: Algebra>(
    size: usize,
    entries: impl Iterator<Item = (usize, usize, f64)>,
) -> Result<M, DiffsolError> {
    let (places, values): (Vec<_>, Vec<_>) = entries.map(|(i, j, x)| ((i, j), x)).unzip();
    Ok(M::try_from_triplets(size, size, places, values, M::C::default())?)
}

/// The pattern of a matrix, if it is sparse.
pub(super) fn pattern<M: Algebra>(matrix: &M) -> Option<M::Sparsity> {
    matrix.sparsity().map(|pattern| MatrixSparsityRef::to_owned(&pattern))
}

/// The entries `(row, column, value)` of a stored matrix.
pub(super) fn entries(matrix: &CsrMatrix<f64>) -> impl Iterator<Item = (usize, usize, f64)> {
    matrix.triplet_iter().map(|(i, j, &x)| (i, j, x))
}

/// The rows of a matrix, with numbers of columns of half the width: large systems are limited by what
/// is read from memory.
#[derive(Debug, Clone)]
pub(super) struct Rows<'s> {
    /// Where each row ends, then the columns of all entries.
    places: Vec<u32>,
    values: &'s [f64],
}

impl<'s> Rows<'s> {
    /// The rows of a stored matrix; `None` where it has 2³² entries or more.
    pub(super) fn of(matrix: &'s CsrMatrix<f64>) -> Option<Self> {
        let (offsets, columns, values) = matrix.csr_data();
        let mut places = Vec::with_capacity(matrix.nrows() + columns.len());
        for &number in offsets[1..].iter().chain(columns) {
            places.push(u32::try_from(number).ok()?);
        }
        Some(Self { places, values })
    }

    /// `y = A x`.
    pub(super) fn multiply(&self, x: &[f64], y: &mut [f64]) {
        self.sums(y, |column, value| value * x[column as usize]);
    }

    /// `y = |A| |x|`.
    pub(super) fn magnitudes(&self, x: &[f64], y: &mut [f64]) {
        self.sums(y, |column, value| (value * x[column as usize]).abs());
    }

    /// The sum of `term` over the entries of each row.
    fn sums(&self, sums: &mut [f64], term: impl Fn(u32, f64) -> f64) {
        let (ends, columns) = self.places.split_at(sums.len());
        let mut start = 0;
        for (&end, sum) in ends.iter().zip(sums) {
            let place = start..end as usize;
            let entries = columns[place.clone()].iter().zip(&self.values[place]);
            *sum = entries.map(|(&column, &value)| term(column, value)).sum();
            start = end as usize;
        }
    }
}
