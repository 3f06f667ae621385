//! A matrix of a few rows, and of as many columns as there are.

use std::ops::{Add, AddAssign, Mul, Sub, SubAssign};

use diffsol::{DefaultDenseMatrix, DenseMatrix, Matrix, Scale, VectorIndex, matrix::MatrixCommon};
use diffsol_la::{Dense, DenseRef, LaError, matrix::MAX_SMALL_COLS};

use super::{
    Column, Indices, ROWS, Single, StackVector,
    vector::{StackVectorMut, axpy},
};
use crate::methods::stepping::algebra::{Algebra as _, Slice};

/// A dense matrix of at most [`ROWS`] rows.
#[derive(Debug, Clone)]
pub(in crate::methods) struct StackMatrix {
    pub(super) columns: Vec<Column>,
    rows: usize,
}

impl StackMatrix {
    /// `new` of all numbers and those of another matrix in their places.
    fn each(&mut self, other: &Self, new: impl Fn(f64, f64) -> f64) {
        let pairs = self.columns.as_flattened_mut().iter_mut().zip(other.columns.as_flattened());
        for (own, other) in pairs {
            *own = new(*own, *other);
        }
    }

    /// The row and the column of a number, counted down the columns.
    fn row_and_column(&self, at: usize) -> (usize, usize) {
        (at % self.rows, at / self.rows)
    }
}

impl DefaultDenseMatrix for StackVector {
    type M = StackMatrix;
}

impl MatrixCommon for StackMatrix {
    type V = StackVector;
    type T = f64;
    type C = Single;
    type Inner = Vec<Column>;

    fn nrows(&self) -> usize {
        self.rows
    }

    fn ncols(&self) -> usize {
        self.columns.len()
    }

    fn inner(&self) -> &Vec<Column> {
        &self.columns
    }
}

impl Mul<Scale<f64>> for StackMatrix {
    type Output = Self;

    fn mul(mut self, factor: Scale<f64>) -> Self {
        self.values_mut().iter_mut().for_each(|own| *own *= factor.value());
        self
    }
}

impl Mul<Scale<f64>> for &StackMatrix {
    type Output = StackMatrix;

    fn mul(self, factor: Scale<f64>) -> StackMatrix {
        self.clone() * factor
    }
}

impl AddAssign<&Self> for StackMatrix {
    fn add_assign(&mut self, other: &Self) {
        self.each(other, |own, other| own + other);
    }
}

impl SubAssign<&Self> for StackMatrix {
    fn sub_assign(&mut self, other: &Self) {
        self.each(other, |own, other| own - other);
    }
}

impl Add<&Self> for StackMatrix {
    type Output = Self;

    fn add(mut self, other: &Self) -> Self {
        self += other;
        self
    }
}

impl Sub<&Self> for StackMatrix {
    type Output = Self;

    fn sub(mut self, other: &Self) -> Self {
        self -= other;
        self
    }
}

impl Matrix for StackMatrix {
    type Sparsity = Dense<Self>;
    type SparsityRef<'a> = DenseRef<'a, Self>;

    fn sparsity(&self) -> Option<DenseRef<'_, Self>> {
        None
    }

    fn context(&self) -> &Single {
        &Single
    }

    fn inner_mut(&mut self) -> &mut Vec<Column> {
        &mut self.columns
    }

    fn partition_indices_by_zero_diagonal(&self) -> (Indices, Indices) {
        let (zero, other) = (0..self.rows).partition(|&at| self.columns[at][at] == 0.0);
        (Indices::from_vec(zero, Single), Indices::from_vec(other, Single))
    }

    fn gemv(&self, alpha: f64, x: &StackVector, beta: f64, y: &mut StackVector) {
        self.gemv_cols(0, self.columns.len(), alpha, x.slice(), beta, y);
    }

    fn copy_from(&mut self, other: &Self) {
        self.columns.copy_from_slice(&other.columns);
    }

    fn zeros(rows: usize, columns: usize, _context: Single) -> Self {
        assert!(rows <= ROWS, "a matrix on the stack has at most {ROWS} rows");
        Self { columns: vec![[0.0; ROWS]; columns], rows }
    }

    fn new_from_sparsity(
        rows: usize,
        columns: usize,
        _sparsity: Option<Dense<Self>>,
        context: Single,
    ) -> Self {
        Self::zeros(rows, columns, context)
    }

    fn from_diagonal(diagonal: &StackVector) -> Self {
        let mut own = Self::zeros(diagonal.len, diagonal.len, Single);
        for (at, value) in diagonal.slice().iter().enumerate() {
            own.columns[at][at] = *value;
        }
        own
    }

    fn set_column(&mut self, column: usize, from: &StackVector) {
        self.columns[column] = from.numbers;
    }

    fn add_column_to_vector(&self, column: usize, to: &mut StackVector) {
        axpy(1.0, &self.columns[column], 1.0, &mut to.numbers);
    }

    fn add_columns_to_batched_vector(&self, to: &mut StackVector) {
        assert_eq!(self.columns.len(), 1, "one vector takes one column");
        self.add_column_to_vector(0, to);
    }

    fn set_data_with_indices(&mut self, to: &Indices, from: &Indices, data: &StackVector) {
        for (&to, &from) in to.0.iter().zip(&from.0) {
            let (row, column) = self.row_and_column(to);
            self.columns[column][row] = data[from];
        }
    }

    fn gather(&mut self, other: &Self, indices: &Indices) {
        for (at, &from) in indices.0.iter().enumerate() {
            let ((row, column), (from_row, from_column)) =
                (self.row_and_column(at), other.row_and_column(from));
            self.columns[column][row] = other.columns[from_column][from_row];
        }
    }

    fn scale_add_and_assign(&mut self, x: &Self, beta: f64, y: &Self) {
        self.copy_from(x);
        self.each(y, |own, y| own + beta * y);
    }

    fn triplet_iter(
        &self,
    ) -> (impl Iterator<Item = (usize, usize)> + '_, impl Iterator<Item = f64> + '_) {
        let places =
            (0..self.columns.len()).flat_map(|at| (0..self.rows).map(move |row| (row, at)));
        let values = self.columns.iter().flat_map(|column| column[..self.rows].iter().copied());
        (places, values)
    }

    fn try_from_triplets(
        rows: usize,
        columns: usize,
        places: Vec<(usize, usize)>,
        values: Vec<f64>,
        context: Single,
    ) -> Result<Self, LaError> {
        let mut own = Self::zeros(rows, columns, context);
        for ((row, column), value) in places.into_iter().zip(values) {
            own.columns[column][row] = value;
        }
        Ok(own)
    }
}

impl DenseMatrix for StackMatrix {
    fn update_backward_diff(&mut self, order: usize, difference: &StackVector) {
        let mut highest = difference.numbers;
        axpy(-1.0, &self.columns[order + 1], 1.0, &mut highest);
        self.columns[order + 2] = highest;
        for at in (0..=order + 1).rev() {
            let next = self.columns[at + 1];
            axpy(1.0, &next, 1.0, &mut self.columns[at]);
        }
    }

    fn mul_cols_by(&mut self, count: usize, right: &[f64]) {
        let mut old = [[0.0; ROWS]; MAX_SMALL_COLS];
        old[..count].copy_from_slice(&self.columns[..count]);
        for (own, factors) in self.columns.iter_mut().zip(right.chunks_exact(count)) {
            *own = [0.0; ROWS];
            for (old, factor) in old.iter().zip(factors) {
                axpy(*factor, old, 1.0, own);
            }
        }
    }

    fn gemv_cols(
        &self,
        start: usize,
        end: usize,
        alpha: f64,
        x: &[f64],
        beta: f64,
        y: &mut StackVector,
    ) {
        let mut sum = [0.0; ROWS];
        for (column, factor) in self.columns[start..end].iter().zip(x) {
            axpy(*factor, column, 1.0, &mut sum);
        }
        axpy(alpha, &sum, beta, &mut y.numbers);
    }

    fn column(&self, at: usize) -> StackVector {
        StackVector { numbers: self.columns[at], len: self.rows }
    }

    fn column_mut(&mut self, at: usize) -> StackVectorMut<'_> {
        StackVectorMut(&mut self.columns[at])
    }

    fn set_index(&mut self, row: usize, column: usize, value: f64) {
        self.columns[column][row] = value;
    }

    fn set_index_batch(&mut self, _only: usize, row: usize, column: usize, value: f64) {
        self.columns[column][row] = value;
    }

    fn get_index(&self, row: usize, column: usize) -> f64 {
        self.columns[column][row]
    }

    fn resize_cols(&mut self, columns: usize) {
        self.columns.resize(columns, [0.0; ROWS]);
    }

    fn from_vec(rows: usize, columns: usize, values: Vec<f64>, context: Single) -> Self {
        let mut own = Self::zeros(rows, columns, context);
        for (column, values) in own.columns.iter_mut().zip(values.chunks_exact(rows)) {
            column[..rows].copy_from_slice(values);
        }
        own
    }
}
