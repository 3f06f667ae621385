//! Complex Schur form `A = Q T Qᴴ` with upper triangular `T`.

use dashpot_numerics::decompositions;
use nalgebra::DMatrix;

use super::{Complex, components::Components};

/// A unitary basis and the triangular matrix in it.
#[derive(Debug, Clone)]
pub(super) struct ComplexSchur {
    /// `Q`, or its rows of interest.
    pub(super) basis: DMatrix<Complex>,
    /// `T`.
    pub(super) triangle: DMatrix<Complex>,
}

impl ComplexSchur {
    /// The form of a real matrix, `None` where the iteration does not converge.
    ///
    /// States that act one way only on others have eigenvalues of their own, to which the size of the others
    /// is nothing: beside a mode of 10¹⁰⁰ 1/s, what stands still does so exactly.
    pub(super) fn new(a: &DMatrix<f64>) -> Option<Self> {
        let size = a.nrows();
        let groups = Components::of(a, size).order(size);
        if groups.len() < 2 {
            return Self::of_group(a);
        }
        let mut basis = DMatrix::zeros(size, size);
        let mut inner = Vec::with_capacity(groups.len());
        let mut start = 0;
        for group in &groups {
            let part = DMatrix::from_fn(group.len(), group.len(), |i, j| a[(group[i], group[j])]);
            let form = Self::of_group(&part)?;
            for (i, &row) in group.iter().enumerate() {
                basis.view_mut((row, start), (1, group.len())).copy_from(&form.basis.row(i));
            }
            inner.push((start, form.triangle));
            start += group.len();
        }
        let mut triangle = basis.adjoint() * a.map(|x| Complex::new(x, 0.0)) * &basis;
        triangle.fill_lower_triangle(Complex::default(), 1);
        for (start, own) in inner {
            triangle.view_mut((start, start), own.shape()).copy_from(&own);
        }
        Some(Self { basis, triangle })
    }

    /// The form of a matrix all of whose states act on each other.
    fn of_group(a: &DMatrix<f64>) -> Option<Self> {
        let size = a.nrows();
        let (basis, triangle) = decompositions::schur(a)?;
        let complex = |x: f64| Complex::new(x, 0.0);
        let mut schur = Self { basis: basis.map(complex), triangle: triangle.map(complex) };
        for m in (1..size).rev() {
            schur.split(m);
        }
        Some(schur)
    }

    /// Makes the entry below the diagonal in row `m` zero, by a rotation in the plane of `m − 1`
    /// and `m` onto an eigenvector of their block.
    fn split(&mut self, m: usize) {
        let t = &self.triangle;
        let below = t[(m, m - 1)];
        if below == Complex::default() {
            return;
        }
        let (a, b, d) = (t[(m - 1, m - 1)], t[(m - 1, m)], t[(m, m)]);
        let half = (a - d) * 0.5;
        let root = (half * half + b * below).sqrt();
        // The eigenvalue nearer to `d`, as its offset from `d`, without cancellation.
        let far = if (half.conj() * root).re >= 0.0 { half + root } else { half - root };
        let offset = if far == Complex::default() { root } else { -(b * below) / far };
        let length = offset.norm().hypot(below.norm());
        self.rotate(m, offset / length, below / length);
        self.triangle[(m, m - 1)] = Complex::default();
    }

    /// `T ← G T Gᴴ`, `Q ← Q Gᴴ` with `G = [c̄ s; −s c]` on `m − 1` and `m`, `s` real up to phase.
    fn rotate(&mut self, m: usize, c: Complex, s: Complex) {
        let size = self.triangle.ncols();
        for j in m - 1..size {
            let (x, y) = (self.triangle[(m - 1, j)], self.triangle[(m, j)]);
            self.triangle[(m - 1, j)] = c.conj() * x + s.conj() * y;
            self.triangle[(m, j)] = c * y - s * x;
        }
        let turn = |matrix: &mut DMatrix<Complex>, rows: usize| {
            for i in 0..rows {
                let (x, y) = (matrix[(i, m - 1)], matrix[(i, m)]);
                matrix[(i, m - 1)] = x * c + y * s;
                matrix[(i, m)] = y * c.conj() - x * s.conj();
            }
        };
        turn(&mut self.triangle, m + 1);
        let rows = self.basis.nrows();
        turn(&mut self.basis, rows);
    }

    /// The eigenvalue number `i`.
    pub(super) fn eigenvalue(&self, i: usize) -> Complex {
        self.triangle[(i, i)]
    }

    /// Exchanges the eigenvalues `k` and `k + 1` on the diagonal by one rotation.
    fn swap(&mut self, k: usize) {
        let (first, second) = (self.eigenvalue(k), self.eigenvalue(k + 1));
        let (f, g) = (self.triangle[(k, k + 1)], second - first);
        let length = f.norm().hypot(g.norm());
        if length == 0.0 {
            return;
        }
        let (c, s) = if f == Complex::default() {
            (0.0, g.conj() / g.norm())
        } else {
            (f.norm() / length, f / f.norm() * g.conj() / length)
        };
        for j in k + 2..self.triangle.ncols() {
            let (x, y) = (self.triangle[(k, j)], self.triangle[(k + 1, j)]);
            self.triangle[(k, j)] = x * c + s * y;
            self.triangle[(k + 1, j)] = y * c - s.conj() * x;
        }
        let turn = |matrix: &mut DMatrix<Complex>, rows: usize| {
            for i in 0..rows {
                let (x, y) = (matrix[(i, k)], matrix[(i, k + 1)]);
                matrix[(i, k)] = x * c + s.conj() * y;
                matrix[(i, k + 1)] = y * c - s * x;
            }
        };
        turn(&mut self.triangle, k);
        let rows = self.basis.nrows();
        turn(&mut self.basis, rows);
        self.triangle[(k, k)] = second;
        self.triangle[(k + 1, k + 1)] = first;
    }

    /// Brings the eigenvalues into the order of their `labels`, which are sorted along.
    pub(super) fn sort(&mut self, labels: &mut [usize]) {
        for end in 1..labels.len() {
            let mut k = end;
            while k > 0 && labels[k - 1] > labels[k] {
                self.swap(k - 1);
                labels.swap(k - 1, k);
                k -= 1;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn residual(a: &DMatrix<f64>, schur: &ComplexSchur) -> f64 {
        let a = a.map(|x| Complex::new(x, 0.0));
        (&a * &schur.basis - &schur.basis * &schur.triangle).map(Complex::norm).max()
    }

    fn below(schur: &ComplexSchur) -> f64 {
        let t = &schur.triangle;
        (0..t.nrows()).flat_map(|i| (0..i).map(move |j| t[(i, j)].norm())).fold(0.0, f64::max)
    }

    #[test]
    fn the_form_is_triangular_and_similar_and_stays_so_when_sorted() {
        for size in 1..12 {
            let a = DMatrix::from_fn(size, size, |i, j| {
                ((7 * i + 3 * j * j + 1) as f64).sin() * ((i * j + 2) as f64).cos()
            });
            let mut schur = ComplexSchur::new(&a).unwrap();
            assert!(residual(&a, &schur) < 1e-14 && below(&schur) == 0.0, "size {size}");
            let mut labels: Vec<usize> = (0..size).rev().collect();
            schur.sort(&mut labels);
            assert!(residual(&a, &schur) < 1e-13 && below(&schur) == 0.0, "sorted, size {size}");
        }
    }

    #[test]
    fn defective_matrices_have_a_form() {
        for a in [
            DMatrix::from_row_slice(2, 2, &[0.0, 1.0, -1.0, -2.0]),
            DMatrix::from_row_slice(2, 2, &[0.0, 1.0, 0.0, 0.0]),
            DMatrix::from_row_slice(3, 3, &[0.0, 1.0, 0.0, 0.0, 0.0, 1.0, -1.0, -3.0, -3.0]),
        ] {
            let schur = ComplexSchur::new(&a).unwrap();
            assert!(residual(&a, &schur) < 1e-13, "{a} {:e}", residual(&a, &schur));
            assert!(below(&schur) == 0.0);
        }
    }
}
