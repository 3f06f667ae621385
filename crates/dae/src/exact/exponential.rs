//! The exponential of a real matrix.

use nalgebra::DMatrix;

/// Largest norm at which the series of degree 16 has a backward error below the unit roundoff
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
pub(super) trait Square: Clone {
    /// `self · other`.
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

/// Columns of a matrix of fixed size.
pub(super) type Columns<const N: usize> = [[f64; N]; N];

impl<const N: usize> Square for Columns<N> {
    fn product(&self, other: &Self) -> Self {
        let mut product = [[0.0; N]; N];
        for (sum, column) in product.iter_mut().zip(other) {
            *sum = apply(self, column);
        }
        product
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
        self.iter().map(|c| c.iter().map(|x| x.abs()).sum()).fold(0.0, f64::max)
    }
}

impl Square for DMatrix<f64> {
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

/// `matrix · vector`.
#[inline]
pub(super) fn apply<const N: usize>(matrix: &Columns<N>, vector: &[f64; N]) -> [f64; N] {
    let mut sum = [0.0; N];
    for (column, factor) in matrix.iter().zip(vector) {
        for (s, c) in sum.iter_mut().zip(column) {
            *s += c * factor;
        }
    }
    sum
}

/// `e^{matrix · time}` by scaling and squaring of the Taylor polynomial of degree 16, evaluated in
/// powers of the fourth power (Paterson & Stockmeyer): six products and one for each halving.
///
/// The result is that of a matrix that differs by about `ε ‖matrix‖ time` from the given one.
pub(super) fn exponential<M: Square>(matrix: &M, time: f64) -> M {
    let mut a = matrix.clone();
    let size = matrix.norm() * time.abs();
    let halvings = if size > REACH { (size / REACH).log2().ceil().min(1000.0) } else { 0.0 };
    a.scale(time * (-halvings).exp2());
    let a2 = a.product(&a);
    let a3 = a2.product(&a);
    let a4 = a2.product(&a2);
    let group = |k: usize, base: Option<M>| {
        let c = &INVERSE_FACTORIALS[k..];
        let mut sum = base.unwrap_or_else(|| {
            let mut top = a4.clone();
            top.scale(c[4]);
            top
        });
        sum.add(c[3], &a3);
        sum.add(c[2], &a2);
        sum.add(c[1], &a);
        sum.add_identity(c[0]);
        sum
    };
    let mut sum = group(12, None);
    for k in [8, 4, 0] {
        sum = group(k, Some(sum.product(&a4)));
    }
    let mut left = halvings;
    while left > 0.0 {
        sum = sum.product(&sum);
        left -= 1.0;
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
}
