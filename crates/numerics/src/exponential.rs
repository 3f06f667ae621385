//! Exponentials of real matrices.

use nalgebra::DMatrix;

use crate::small::{self, Square, apply};

/// Largest rate times time at which the series of degree 16 has a backward error below the unit roundoff
/// (Al-Mohy & Higham, SIAM J. Sci. Comput. 33 (2011) 488: 0.64 for degree 15, 1.4 for 20).
const REACH: f64 = 0.78;

/// `1/k!` for `k = 0 … 16`.
const INVERSE_FACTORIALS: [f64; 17] = inverse_factorials();

const fn inverse_factorials() -> [f64; 17] {
    let mut table = [1.0; 17];
    let (mut k, mut factorial) = (1, 1.0);
    let mut order = 1.0;
    while k < 17 {
        factorial *= order;
        table[k] = 1.0 / factorial;
        order += 1.0;
        k += 1;
    }
    table
}

/// What the exponential needs of a square matrix; implemented for matrices whose size is known to
/// the compiler and for all others.
pub trait SquareMatrix: Clone {
    /// `self · other`.
    #[must_use]
    fn product(&self, other: &Self) -> Self;

    /// `self ← self + factor · other`.
    fn add(&mut self, factor: f64, other: &Self);

    /// `self ← self + factor · 1`.
    fn add_identity(&mut self, factor: f64);

    /// `self ← factor · self`.
    fn scale(&mut self, factor: f64);

    /// `‖self‖₁`.
    fn norm(&self) -> f64;
}

impl<const N: usize> SquareMatrix for Square<N> {
    fn product(&self, other: &Self) -> Self {
        small::product(self, other)
    }

    fn add(&mut self, factor: f64, other: &Self) {
        for (a, b) in self.as_flattened_mut().iter_mut().zip(other.as_flattened()) {
            *a += factor * b;
        }
    }

    fn add_identity(&mut self, factor: f64) {
        for (j, column) in self.iter_mut().enumerate() {
            column[j] += factor;
        }
    }

    fn scale(&mut self, factor: f64) {
        self.as_flattened_mut().iter_mut().for_each(|a| *a *= factor);
    }

    fn norm(&self) -> f64 {
        small::norm(self)
    }
}

impl SquareMatrix for DMatrix<f64> {
    fn product(&self, other: &Self) -> Self {
        self * other
    }

    fn add(&mut self, factor: f64, other: &Self) {
        self.zip_apply(other, |a, b| *a += factor * b);
    }

    fn add_identity(&mut self, factor: f64) {
        for j in 0..self.nrows() {
            self[(j, j)] += factor;
        }
    }

    fn scale(&mut self, factor: f64) {
        *self *= factor;
    }

    fn norm(&self) -> f64 {
        self.column_iter().map(|column| column.lp_norm(1)).fold(0.0, f64::max)
    }
}

/// A matrix with its first powers, from which exponentials over any times are made.
#[derive(Debug, Clone)]
pub struct Powers<M> {
    /// Of the orders 1 to 4.
    all: [M; 4],
    rate: f64,
}

impl<M: SquareMatrix> Powers<M> {
    /// The powers of a matrix; that of order 4 must be within the range of numbers.
    pub fn of(matrix: M) -> Self {
        let second = matrix.product(&matrix);
        let third = second.product(&matrix);
        let fourth = second.product(&second);
        // Norms of high powers tell the rate much better than that of the matrix.
        let rate = fourth.norm().sqrt().sqrt().max(third.norm().cbrt());
        Self { all: [matrix, second, third, fourth], rate }
    }

    /// How fast anything changes: a bound of `‖Aᵏ‖^(1/k)` at the powers 3 and 4, and so of all powers
    /// beyond, give or take a factor near one.
    pub fn rate(&self) -> f64 {
        self.rate
    }

    /// `e^{A time}` by scaling and squaring.
    ///
    /// The error is of the size of rounding times the rate times the time, relative to the largest entry on the way.
    pub fn exponential(&self, time: f64) -> M {
        let halvings = halvings(self.rate * time.abs());
        let scale = time * (-halvings).exp2();
        let mut powers = self.all.clone();
        let mut factor = 1.0;
        for power in &mut powers {
            factor *= scale;
            power.scale(factor);
        }
        squared(series(&powers), halvings)
    }
}

/// `e^{matrix · time}` by scaling and squaring, for matrices of any size of entries.
///
/// The result is that of a matrix that differs by about `ε ‖matrix‖ time` from the given one.
pub fn exponential<M: SquareMatrix>(matrix: &M, time: f64) -> M {
    let halvings = halvings(matrix.norm() * time.abs());
    // Scaled first, so that no power leaves the range of numbers.
    let mut scaled = matrix.clone();
    scaled.scale(time * (-halvings).exp2());
    squared(series(&Powers::of(scaled).all), halvings)
}

/// How often a matrix of this rate times time is halved before its series is summed.
fn halvings(size: f64) -> f64 {
    if size > REACH { (size / REACH).log2().ceil().min(1000.0) } else { 0.0 }
}

/// The Taylor polynomial of degree 16 from the first four powers, evaluated in powers of the fourth one
/// (Paterson & Stockmeyer): three products.
fn series<M: SquareMatrix>(powers: &[M; 4]) -> M {
    let [a, a2, a3, a4] = powers;
    let group = |k: usize, mut sum: M| {
        let c = &INVERSE_FACTORIALS[k..];
        sum.add(c[3], a3);
        sum.add(c[2], a2);
        sum.add(c[1], a);
        sum.add_identity(c[0]);
        sum
    };
    let mut top = a4.clone();
    top.scale(INVERSE_FACTORIALS[16]);
    [8, 4, 0].into_iter().fold(group(12, top), |sum, k| group(k, sum.product(a4)))
}

/// The matrix squared so many times.
fn squared<M: SquareMatrix>(mut matrix: M, halvings: f64) -> M {
    let mut left = halvings;
    while left > 0.0 {
        matrix = matrix.product(&matrix);
        left -= 1.0;
    }
    matrix
}

/// Terms beyond this count are not summed.
const MOST_TERMS: u32 = 48;

/// `e^{matrix · time} · z` by its series, for a norm of the matrix times the time of about one at
/// most: beyond, digits cancel.
#[inline]
pub fn advanced<const N: usize>(matrix: &Square<N>, time: f64, z: &[f64; N]) -> [f64; N] {
    let size = |z: &[f64; N]| z.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
    let (mut sum, mut term) = (*z, *z);
    let least = 0.1 * f64::EPSILON * size(z);
    for at in 1..=MOST_TERMS {
        let factor = time / f64::from(at);
        term = apply(matrix, &term);
        for (own, term) in sum.iter_mut().zip(&mut term) {
            *term *= factor;
            *own += *term;
        }
        if size(&term) <= least {
            break;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rotation_turns_by_its_angle() {
        for angle in [1e-9, 0.3, 1.0, 7.0, 100.0] {
            let e = exponential(&[[0.0, -1.0], [1.0, 0.0]], angle);
            let (sin, cos) = angle.sin_cos();
            let bound = 4e-16 * (1.0 + angle);
            assert!((e[0][0] - cos).abs() < bound && (e[1][0] - sin).abs() < bound, "{angle}");
        }
    }

    #[test]
    fn a_nilpotent_matrix_gives_a_polynomial() {
        let mut a = DMatrix::zeros(3, 3);
        a[(0, 1)] = 1.0;
        a[(1, 2)] = 1.0;
        let e = exponential(&a, 1024.0);
        assert!((e[(0, 2)] / 524_288.0 - 1.0).abs() < 1e-14);
    }

    #[test]
    fn fixed_and_dynamic_sizes_agree() {
        let fixed = [[-1.0, 2.0, 0.5], [0.3, -4.0, 1.0], [0.0, 0.7, -0.2]];
        let dynamic = DMatrix::from_column_slice(3, 3, fixed.as_flattened());
        let (a, b) = (exponential(&fixed, 1.7), exponential(&dynamic, 1.7));
        for (x, y) in a.as_flattened().iter().zip(b.as_slice()) {
            assert!((x - y).abs() < 1e-14);
        }
    }

    /// A mass on a spring and a dashpot: `ẍ + 2 d ẋ + x = 0`, by columns.
    fn oscillator(d: f64) -> Square<2> {
        [[0.0, -1.0], [1.0, -2.0 * d]]
    }

    #[test]
    fn the_exponential_is_that_of_an_oscillator() {
        for time in [1e-9, 0.1, 1.0, 30.0] {
            let d: f64 = 0.3;
            let omega = (1.0 - d * d).sqrt();
            let found = Powers::of(oscillator(d)).exponential(time);
            let (sine, cosine) = (omega * time).sin_cos();
            let decay = (-d * time).exp();
            let right = [decay * (cosine + d / omega * sine), -decay * sine / omega];
            for (found, right) in found[0].iter().zip(right) {
                assert!((found - right).abs() < 64.0 * f64::EPSILON * (1.0 + time), "{time}");
            }
        }
    }

    #[test]
    fn the_series_of_a_state_is_the_exponential_applied() {
        let matrix = oscillator(0.1);
        let z = [0.7, -0.2];
        for time in [-0.4, 0.0, 1e-3, 0.5] {
            let found = advanced(&matrix, time, &z);
            let right = apply(&Powers::of(matrix).exponential(time), &z);
            assert!(found.iter().zip(right).all(|(a, b)| (a - b).abs() < 1e-15), "{time}");
        }
    }
}
