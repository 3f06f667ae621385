//! Newton's iteration for the modal form, with residuals in twice the digits of a double, and the
//! bound of what is left.

use dashpot_numerics::{Accumulator, two_sum};
use nalgebra::DMatrix;

use super::{Complex, bounds::enclose, modes::Modes};

/// Most iterations; convergence is quadratic until rounding stops it.
const ITERATIONS: usize = 6;
/// Defect relative to the matrix below which another iteration would be of no use to doubles.
const ENOUGH: f64 = 1e-26;
/// Corrections of the basis above this are not trusted to be in the range of Newton's method.
const TRUST: f64 = 1e-3;

/// Corrections that are still above this in the end show that two blocks cannot be told apart.
const SETTLED: f64 = 1e-8;

/// Improves `X` and `D` of `Ā X = X D`, sets the bounds `modes.defect` and `modes.dual_defect`, and
/// returns pairs of modes that should share a block: where the eigenvalues are as close as the
/// couplings are large, there is no Newton's method (rates that are equal but for rounding).
///
/// With `E = X⁻¹ (Ā X − X D)` the next basis is `X (1 + F)`, `D_i F_ij − F_ij D_j = −E_ij` off the
/// blocks, and `D_i + E_ii` the next blocks.
pub(super) fn refine(matrix: &DMatrix<f64>, modes: &mut Modes) -> Vec<(usize, usize)> {
    let mut best: Option<(f64, Modes, DMatrix<Complex>)> = None;
    for _ in 0..ITERATIONS {
        let coupling = &modes.dual * residual(matrix, modes);
        modes.defect = coupling.map(Complex::norm);
        let size = relative(modes, &coupling).max();
        let before = best.as_ref().map_or(f64::INFINITY, |(size, ..)| *size);
        if size.is_nan() || size >= 0.5 * before {
            break;
        }
        let enough = size <= ENOUGH * matrix.amax();
        let turn = correction(modes, &coupling);
        best = Some((size, modes.clone(), turn.clone()));
        if enough {
            break;
        }
        step(modes, &coupling, turn);
    }
    let Some((_, kept, turn)) = best else {
        modes.defect.fill(f64::INFINITY);
        return Vec::new();
    };
    *modes = kept;
    modes.dual_defect = dual_defect(modes);
    modes.defect += rounding(matrix, modes);
    modes.defect = enclose_matrix(&modes.dual_defect, &modes.defect);
    let turn = relative(modes, &turn);
    let size = modes.len();
    let places = (0..size).flat_map(|j| (0..size).map(move |i| (i, j)));
    places.filter(|&place| turn[place].is_nan() || turn[place] > SETTLED).collect()
}

/// Sizes of the entries of a matrix between modes, as if all modes were of unit length.
fn relative(modes: &Modes, matrix: &DMatrix<Complex>) -> DMatrix<f64> {
    let lengths: Vec<f64> = modes.basis.column_iter().map(|column| column.norm()).collect();
    let size = modes.len();
    DMatrix::from_fn(size, size, |i, j| matrix[(i, j)].norm() * (lengths[i] / lengths[j]))
}

/// `F`; not finite where eigenvalues of two blocks that are coupled are equal.
fn correction(modes: &Modes, coupling: &DMatrix<Complex>) -> DMatrix<Complex> {
    let size = modes.len();
    let mut turn = DMatrix::<Complex>::zeros(size, size);
    for j in &modes.blocks {
        for i in modes.blocks.iter().filter(|i| i.start != j.start) {
            for (b, column) in j.range().enumerate() {
                for (a, row) in i.range().enumerate().rev() {
                    let mut rest = -coupling[(row, column)];
                    for k in a + 1..i.len() {
                        rest -= i.matrix[(a, k)] * turn[(i.start + k, column)];
                    }
                    for k in 0..b {
                        rest += turn[(row, j.start + k)] * j.matrix[(k, b)];
                    }
                    if rest != Complex::default() {
                        turn[(row, column)] = rest / (i.matrix[(a, a)] - j.matrix[(b, b)]);
                    }
                }
            }
        }
    }
    turn
}

/// One correction of basis, dual and blocks.
fn step(modes: &mut Modes, coupling: &DMatrix<Complex>, mut turn: DMatrix<Complex>) {
    let sizes = relative(modes, &turn);
    for (turn, &size) in turn.iter_mut().zip(sizes.iter()) {
        if size.is_nan() || size >= TRUST {
            *turn = Complex::default();
        }
    }
    for block in &mut modes.blocks {
        for j in 0..block.len() {
            for i in 0..block.len() {
                block.correct(i, j, coupling[(block.start + i, block.start + j)]);
            }
        }
    }
    let change = &modes.basis * &turn;
    for (high, (low, change)) in
        modes.basis.iter_mut().zip(modes.basis_low.iter_mut().zip(change.iter()))
    {
        let (re, re_rest) = two_sum(high.re, low.re + change.re);
        let (im, im_rest) = two_sum(high.im, low.im + change.im);
        *high = Complex::new(re, im);
        *low = Complex::new(re_rest, im_rest);
    }
    modes.dual -= turn * &modes.dual;
    modes.mirror();
}

/// A bound of `|1 − X̃ X|`, where `X̃` is the approximate inverse `modes.dual`.
fn dual_defect(modes: &Modes) -> DMatrix<f64> {
    let size = modes.len();
    let rest = DMatrix::identity(size, size) - &modes.dual * &modes.basis;
    let noise = modes.dual.map(Complex::norm) * modes.basis.map(Complex::norm);
    rest.map(Complex::norm) + noise * ((size as f64 + 8.0) * f64::EPSILON)
}

/// A bound of `|(1 − R)⁻¹ M|` for `|R| ≤ contraction` and `|M| ≤ first`.
pub(super) fn enclose_matrix(contraction: &DMatrix<f64>, first: &DMatrix<f64>) -> DMatrix<f64> {
    let (rows, columns) = first.shape();
    let apply = |bound: &[f64]| {
        (contraction * DMatrix::from_column_slice(rows, columns, bound)).as_slice().to_vec()
    };
    DMatrix::from_vec(rows, columns, enclose(first.as_slice(), apply))
}

/// `Ā X − X D` with each entry summed in twice the digits.
fn residual(matrix: &DMatrix<f64>, modes: &Modes) -> DMatrix<Complex> {
    let size = modes.len();
    let mut residual = DMatrix::zeros(size, size);
    for block in &modes.blocks {
        for (b, column) in block.range().enumerate() {
            for i in 0..size {
                let (mut re, mut im) = (Accumulator::default(), Accumulator::default());
                for k in 0..size {
                    let a = matrix[(i, k)];
                    if a != 0.0 {
                        let (x, low) = (modes.basis[(k, column)], modes.basis_low[(k, column)]);
                        re.add_product(a, x.re);
                        im.add_product(a, x.im);
                        re.add_small(a * low.re);
                        im.add_small(a * low.im);
                    }
                }
                for (k, index) in block.range().enumerate() {
                    let (x, x_low) = (modes.basis[(i, index)], modes.basis_low[(i, index)]);
                    let (d, d_low) = (block.matrix[(k, b)], block.low[(k, b)]);
                    re.add_product(-x.re, d.re);
                    re.add_product(x.im, d.im);
                    im.add_product(-x.re, d.im);
                    im.add_product(-x.im, d.re);
                    let small = x * d_low + x_low * d;
                    re.add_small(-small.re);
                    im.add_small(-small.im);
                }
                residual[(i, column)] = Complex::new(re.value(), im.value());
            }
        }
    }
    residual
}

/// `|X⁻¹| · 4 N ε² (|Ā| |X| + |X| |D|)`: what rounding may hide in the residual.
fn rounding(matrix: &DMatrix<f64>, modes: &Modes) -> DMatrix<f64> {
    let basis = modes.basis.map(Complex::norm);
    let mut sizes = matrix.abs() * &basis;
    for block in &modes.blocks {
        let columns = basis.columns(block.start, block.len()) * block.matrix.map(Complex::norm);
        let mut part = sizes.columns_mut(block.start, block.len());
        part += columns;
    }
    modes.dual.map(Complex::norm) * sizes * (4.0 * modes.len() as f64 * f64::EPSILON * f64::EPSILON)
}
