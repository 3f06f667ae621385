use diffsol::{
    DenseMatrix, LaLinearOp as LinearOp, Matrix, NalgebraMat, Scale, Vector, VectorIndex,
    VectorViewMut, matrix::MatrixCommon,
};
use diffsol_la::LinearSolver;

use super::{factor::StackFactor, *};
use crate::methods::stepping::algebra::{Algebra, Slice};

struct Stored(StackMatrix);

impl LinearOp for Stored {
    type T = f64;
    type V = StackVector;
    type M = StackMatrix;
    type C = Single;

    fn nrows(&self) -> usize {
        self.0.nrows()
    }

    fn ncols(&self) -> usize {
        self.0.ncols()
    }

    fn context(&self) -> &Single {
        &Single
    }

    fn matrix_inplace(&self, matrix: &mut StackMatrix) {
        matrix.copy_from(&self.0);
    }

    fn sparsity(&self) -> Option<<StackMatrix as Matrix>::Sparsity> {
        None
    }
}

/// The numbers that each operation of vectors and matrices of three rows makes of others.
fn worked<M: Algebra + DenseMatrix>() -> Vec<Vec<f64>> {
    let context = M::C::default;
    let vector = |numbers: [f64; 3]| M::V::from_vec(numbers.to_vec(), context());
    let matrix = |from: f64, columns: usize| {
        let values = (0..3 * columns).map(|at| (from + at as f64).sin()).collect();
        <M as DenseMatrix>::from_vec(3, columns, values, context())
    };
    let (x, y, z) = (vector([1.0, -2.0, 3.0]), vector([0.5, 0.25, -4.0]), vector([2.0, 0.0, 1.0]));
    let mut found = vec![
        x.clone() + &y,
        x.clone() - &y,
        x.clone() + y.clone(),
        x.clone() - y.as_view(),
        x.clone() * Scale(3.0),
        x.clone() / Scale(4.0),
    ];
    let mut own = |change: &dyn Fn(&mut M::V)| {
        let mut changed = y.clone();
        change(&mut changed);
        found.push(changed);
    };
    own(&|y| y.axpy(2.0, &x, -0.5));
    own(&|y| y.axpy_v(2.0, &x.as_view(), 0.0));
    own(&|y| y.batched_axpy(&M::V::from_vec(vec![0.5], context()), &x, 1.0));
    own(&|y| y.component_mul_assign(&x));
    own(&|y| y.component_div_assign(&x));
    own(&|y| y.as_view_mut().axpy(0.1, &x, 1.0));
    own(&|y| *y += &x);
    own(&|y| *y -= x.as_view());
    own(&|y| y.fill(7.0));
    own(&|y| y.for_each_elem([&x], |y, [x], _, at| *y += 2.0 * x[at]));
    let indices = |all: &[usize]| <M::V as Vector>::Index::from_vec(all.to_vec(), context());
    own(&|y| y.assign_at_indices(&indices(&[0, 2]), 5.0));
    own(&|y| y.copy_from_indices(&x, &indices(&[1])));
    own(&|y| y.gather(&x, &indices(&[2, 0, 1])));
    own(&|y| x.scatter(&indices(&[2, 0, 1]), y));
    let (square, history) = (matrix(1.0, 3), matrix(2.0, 5));
    own(&|y| square.gemv(0.5, &x, 2.0, y));
    own(&|y| history.gemv_cols(1, 4, -1.0, &[0.3, 0.2, 0.1], 1.0, y));
    own(&|y| square.add_column_to_vector(1, y));
    let mut numbers: Vec<Vec<f64>> = found.iter().map(Vector::clone_as_vec).collect();
    numbers.push(vec![x.norm(1), x.norm(2), x.norm(3), x.squared_norm(&y, &z, 0.3), x.dot(&y)]);
    for later in [&y, &z] {
        let (is_root, part, at) = x.root_finding(later);
        numbers.push(vec![f64::from(u8::from(is_root)), part, f64::from(at)]);
    }
    let values = |matrix: &M| matrix.triplet_iter().1.collect::<Vec<f64>>();
    let mut moved = history.clone();
    moved.update_backward_diff(2, &x);
    numbers.push(values(&moved));
    moved.mul_cols_by(2, &[1.0, 2.0, 3.0, 4.0]);
    moved.column_mut(3).copy_from(&y);
    moved.ger_cols(0, 2, 0.5, &[1.0, -1.0], &x);
    numbers.push(values(&moved));
    moved.resize_cols(3);
    numbers.push(values(&(moved.clone() + &square)));
    numbers.push(values(&((moved.clone() - &square) * Scale(2.0))));
    let mut combined = square.clone();
    combined.scale_add_and_assign(&moved, -3.0, &square);
    combined.set_column(0, &z);
    numbers.push(values(&combined));
    let mut placed = M::from_diagonal(&x);
    placed.set_data_with_indices(&indices(&[1, 5]), &indices(&[2, 0]), &x);
    numbers.push(values(&placed));
    let mut gathered = <M as Matrix>::zeros(3, 1, context());
    gathered.gather(&square, &indices(&[4, 8, 0]));
    numbers.push(values(&gathered));
    let (zero, other) = M::from_diagonal(&z).partition_indices_by_zero_diagonal();
    numbers
        .extend([zero, other].map(|all| all.clone_as_vec().iter().map(|at| *at as f64).collect()));
    numbers
}

#[test]
fn vectors_and_matrices_work_as_those_of_any_size() {
    let (own, other) = (worked::<StackMatrix>(), worked::<NalgebraMat<f64>>());
    assert_eq!(own.len(), other.len());
    for (at, (own, other)) in own.iter().zip(&other).enumerate() {
        assert_eq!(own.len(), other.len(), "{at}");
        for (own, other) in own.iter().zip(other) {
            assert!((own - other).abs() <= 4.0 * f64::EPSILON * other.abs(), "{at}: {own} {other}");
        }
    }
}

/// What is left of `A x − b` where a factorisation has solved it for `x`.
fn left(size: usize, value: impl Fn(usize, usize) -> f64) -> Option<f64> {
    let mut matrix = StackMatrix::zeros(size, size, Single);
    for (row, column) in (0..size).flat_map(|row| (0..size).map(move |column| (row, column))) {
        matrix.set_index(row, column, value(row, column));
    }
    let stored = Stored(matrix);
    let mut factor = StackFactor::default();
    factor.set_sparsity(&stored);
    factor.set_linearisation(&stored);
    let right = StackVector::from_vec((0..size).map(|at| 1.0 + at as f64).collect(), Single);
    let mut solved = right;
    factor.solve_in_place(&mut solved).ok()?;
    let mut left = right;
    stored.0.gemv(-1.0, &solved, 1.0, &mut left);
    Some(left.slice().iter().fold(0.0, |most, own| own.abs().max(most)))
}

#[test]
fn small_systems_are_solved_with_pivots() {
    for size in 1..=ROWS {
        let waves =
            left(size, |row, column| (1.0 + 1.3 * row as f64 * (2.0 + column as f64)).sin());
        assert!(waves.unwrap() < 1e-10, "{size} {waves:?}");
        // Without an exchange of rows the first pivot would be zero.
        let turned = left(size, |row, column| f64::from(u8::from(row + column == size - 1)));
        assert_eq!(turned, Some(0.0), "{size}");
    }
    assert_eq!(left(3, |row, _| row as f64), None);
}
