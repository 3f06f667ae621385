//! A vector of a few numbers, and a column of a matrix to be written.

use std::ops::{Add, AddAssign, Div, Index, IndexMut, Mul, MulAssign, Sub, SubAssign};

use diffsol::{Scale, Vector, VectorCommon, VectorView, VectorViewMut};

use super::{Column, Indices, ROWS, Single};
use crate::methods::stepping::algebra::Slice;

/// A vector of at most [`ROWS`] numbers. It is its own view: it is no longer than what points to one would save.
#[derive(Debug, Clone, Copy)]
pub(in crate::methods) struct StackVector {
    pub(super) numbers: Column,
    pub(super) len: usize,
}

/// A vector that is written where it lies.
#[derive(Debug)]
pub(in crate::methods) struct StackVectorMut<'a>(pub(super) &'a mut Column);

/// `a x + b y` in place of `y`, where `y` is not read if `b` is 0.
pub(super) fn axpy(a: f64, x: &Column, b: f64, y: &mut Column) {
    if b == 0.0 {
        each(y, x, |_, x| a * x);
    } else {
        each(y, x, |y, x| a * x + b * y);
    }
}

fn each(y: &mut Column, x: &Column, new: impl Fn(f64, f64) -> f64) {
    for (y, x) in y.iter_mut().zip(x) {
        *y = new(*y, *x);
    }
}

impl StackVector {
    fn of(numbers: &[f64]) -> Self {
        let mut own = Self { numbers: [0.0; ROWS], len: numbers.len() };
        own.slice_mut().copy_from_slice(numbers);
        own
    }

    /// `new` of each number and its partner.
    fn with(mut self, other: &Self, new: impl Fn(f64, f64) -> f64) -> Self {
        each(&mut self.numbers, &other.numbers, new);
        self
    }
}

impl Slice for StackVector {
    fn slice(&self) -> &[f64] {
        &self.numbers[..self.len]
    }

    fn slice_mut(&mut self) -> &mut [f64] {
        &mut self.numbers[..self.len]
    }
}

impl VectorCommon for StackVector {
    type T = f64;
    type C = Single;
    type Inner = Column;

    fn inner(&self) -> &Column {
        &self.numbers
    }
}

impl VectorCommon for StackVectorMut<'_> {
    type T = f64;
    type C = Single;
    type Inner = Column;

    fn inner(&self) -> &Column {
        self.0
    }
}

/// The operators of vectors and their references.
macro_rules! operators {
    ($trait:ident, $method:ident, $assign_trait:ident, $assign:ident, $operator:tt) => {
        operators!($trait, $method, $operator, StackVector, StackVector);
        operators!($trait, $method, $operator, StackVector, &StackVector);
        operators!($trait, $method, $operator, &StackVector, StackVector);
        operators!($trait, $method, $operator, &StackVector, &StackVector);
        operators!($assign_trait, $assign, $operator, StackVector);
        operators!($assign_trait, $assign, $operator, &StackVector);
    };
    ($trait:ident, $method:ident, $operator:tt, $left:ty, $right:ty) => {
        impl $trait<$right> for $left {
            type Output = StackVector;

            fn $method(self, right: $right) -> StackVector {
                self.with(&right, |left, right| left $operator right)
            }
        }
    };
    ($trait:ident, $method:ident, $operator:tt, $right:ty) => {
        impl $trait<$right> for StackVector {
            fn $method(&mut self, right: $right) {
                each(&mut self.numbers, &right.numbers, |left, right| left $operator right);
            }
        }

        impl $trait<$right> for StackVectorMut<'_> {
            fn $method(&mut self, right: $right) {
                each(self.0, &right.numbers, |left, right| left $operator right);
            }
        }
    };
}
operators!(Add, add, AddAssign, add_assign, +);
operators!(Sub, sub, SubAssign, sub_assign, -);

impl Mul<Scale<f64>> for StackVector {
    type Output = Self;

    fn mul(mut self, factor: Scale<f64>) -> Self {
        self *= factor;
        self
    }
}

impl Mul<Scale<f64>> for &StackVector {
    type Output = StackVector;

    fn mul(self, factor: Scale<f64>) -> StackVector {
        *self * factor
    }
}

impl Div<Scale<f64>> for StackVector {
    type Output = Self;

    fn div(mut self, divisor: Scale<f64>) -> Self {
        self.mul_assign(Scale(divisor.value().recip()));
        self
    }
}

impl MulAssign<Scale<f64>> for StackVector {
    fn mul_assign(&mut self, factor: Scale<f64>) {
        StackVectorMut(&mut self.numbers).mul_assign(factor);
    }
}

impl MulAssign<Scale<f64>> for StackVectorMut<'_> {
    fn mul_assign(&mut self, factor: Scale<f64>) {
        self.0.iter_mut().for_each(|own| *own *= factor.value());
    }
}

impl Index<usize> for StackVector {
    type Output = f64;

    fn index(&self, at: usize) -> &f64 {
        &self.slice()[at]
    }
}

impl IndexMut<usize> for StackVector {
    fn index_mut(&mut self, at: usize) -> &mut f64 {
        &mut self.slice_mut()[at]
    }
}

impl VectorView<'_> for StackVector {
    type Owned = Self;

    fn get_index(&self, at: usize) -> f64 {
        self[at]
    }

    fn squared_norm(&self, y: &Self, atol: &Self, rtol: f64) -> f64 {
        Vector::squared_norm(self, y, atol, rtol)
    }

    fn into_owned(self) -> Self {
        self
    }
}

impl VectorViewMut<'_> for StackVectorMut<'_> {
    type Owned = StackVector;
    type View = StackVector;
    type Index = Indices;

    fn copy_from(&mut self, other: &StackVector) {
        *self.0 = other.numbers;
    }

    fn copy_from_view(&mut self, other: &StackVector) {
        *self.0 = other.numbers;
    }

    fn axpy(&mut self, alpha: f64, x: &StackVector, beta: f64) {
        axpy(alpha, &x.numbers, beta, self.0);
    }

    fn set_index(&mut self, at: usize, value: f64) {
        self.0[at] = value;
    }

    fn fill_index(&mut self, at: usize, value: f64) {
        self.0[at] = value;
    }
}

impl Vector for StackVector {
    type View<'a> = Self;
    type ViewMut<'a> = StackVectorMut<'a>;
    type Index = Indices;

    fn context(&self) -> &Single {
        &Single
    }

    fn inner_mut(&mut self) -> &mut Column {
        &mut self.numbers
    }

    fn set_index(&mut self, at: usize, value: f64) {
        self[at] = value;
    }

    fn fill_index(&mut self, at: usize, value: f64) {
        self[at] = value;
    }

    fn get_index(&self, at: usize) -> f64 {
        self[at]
    }

    fn norm(&self, power: i32) -> f64 {
        let sum: f64 = self.slice().iter().map(|own| own.abs().powi(power)).sum();
        if power == 2 { sum.sqrt() } else { sum.powf(f64::from(power).recip()) }
    }

    fn squared_norm(&self, y: &Self, atol: &Self, rtol: f64) -> f64 {
        let sizes = y.slice().iter().zip(atol.slice());
        let parts = self.slice().iter().zip(sizes);
        let sum: f64 = parts.map(|(own, (y, atol))| (own / (y.abs() * rtol + atol)).powi(2)).sum();
        sum / self.len as f64
    }

    fn len(&self) -> usize {
        self.len
    }

    fn from_element(len: usize, value: f64, _context: Single) -> Self {
        assert!(len <= ROWS, "a vector on the stack has at most {ROWS} numbers");
        Self { numbers: [value; ROWS], len }
    }

    fn fill(&mut self, value: f64) {
        self.numbers = [value; ROWS];
    }

    fn as_view(&self) -> Self {
        *self
    }

    fn as_view_mut(&mut self) -> StackVectorMut<'_> {
        StackVectorMut(&mut self.numbers)
    }

    fn get_batch(&self, _only: usize) -> Self {
        *self
    }

    fn get_batch_mut(&mut self, _only: usize) -> StackVectorMut<'_> {
        self.as_view_mut()
    }

    fn for_each_batch_mut_host<const M: usize, const N: usize>(
        mut_args: [&mut Self; M],
        args: [&Self; N],
        mut f: impl FnMut([&mut [f64]; M], [&[f64]; N], usize),
    ) {
        f(mut_args.map(Slice::slice_mut), args.map(Slice::slice), 0);
    }

    fn copy_from(&mut self, other: &Self) {
        self.numbers = other.numbers;
    }

    fn copy_from_view(&mut self, other: &Self) {
        self.numbers = other.numbers;
    }

    fn from_vec(numbers: Vec<f64>, _context: Single) -> Self {
        Self::of(&numbers)
    }

    fn from_slice(numbers: &[f64], _context: Single) -> Self {
        Self::of(numbers)
    }

    fn clone_as_vec(&self) -> Vec<f64> {
        self.slice().to_vec()
    }

    fn axpy(&mut self, alpha: f64, x: &Self, beta: f64) {
        axpy(alpha, &x.numbers, beta, &mut self.numbers);
    }

    fn axpy_v(&mut self, alpha: f64, x: &Self, beta: f64) {
        axpy(alpha, &x.numbers, beta, &mut self.numbers);
    }

    fn batched_axpy(&mut self, alpha: &Self, x: &Self, beta: f64) {
        axpy(alpha[0], &x.numbers, beta, &mut self.numbers);
    }

    fn component_mul_assign(&mut self, other: &Self) {
        each(&mut self.numbers, &other.numbers, |own, other| own * other);
    }

    fn component_div_assign(&mut self, other: &Self) {
        each(&mut self.numbers, &other.numbers, |own, other| own / other);
    }

    fn root_finding(&self, later: &Self) -> (bool, f64, i32) {
        let is_at_root = later.slice().contains(&0.0);
        let (mut part, mut at) = (0.0, -1);
        for ((own, later), index) in self.slice().iter().zip(later.slice()).zip(0..) {
            let own_part = (later / (later - own)).abs();
            if own * later < 0.0 && own_part > part {
                (part, at) = (own_part, index);
            }
        }
        (is_at_root, part, at)
    }

    fn assign_at_indices(&mut self, indices: &Indices, value: f64) {
        indices.0.iter().for_each(|&at| self[at] = value);
    }

    fn copy_from_indices(&mut self, other: &Self, indices: &Indices) {
        indices.0.iter().for_each(|&at| self[at] = other[at]);
    }

    fn gather(&mut self, other: &Self, indices: &Indices) {
        for (own, &at) in self.slice_mut().iter_mut().zip(&indices.0) {
            *own = other[at];
        }
    }

    fn scatter(&self, indices: &Indices, other: &mut Self) {
        for (own, &at) in self.slice().iter().zip(&indices.0) {
            other[at] = *own;
        }
    }
}
