//! Small matrices of a fixed size, which live on the stack.
//!
//! They are what many systems of a few states are solved with, one after the other: nothing is
//! allocated, and the compiler knows every loop's length. A matrix is kept by its columns, so that
//! `[[f64; M]; N]` takes `N` numbers to `M`.

/// A square matrix by its columns.
pub type Square<const N: usize> = [[f64; N]; N];

/// `matrix · z`.
#[inline]
pub fn apply<const M: usize, const N: usize>(matrix: &[[f64; M]; N], z: &[f64; N]) -> [f64; M] {
    let mut sum = [0.0; M];
    for (column, &factor) in matrix.iter().zip(z) {
        for (own, &entry) in sum.iter_mut().zip(column) {
            *own += entry * factor;
        }
    }
    sum
}

/// `row · matrix`.
#[inline]
pub fn apply_left<const M: usize, const N: usize>(
    row: &[f64; M],
    matrix: &[[f64; M]; N],
) -> [f64; N] {
    let mut product = [0.0; N];
    for (own, column) in product.iter_mut().zip(matrix) {
        *own = dot(row, column);
    }
    product
}

/// `row · z`.
#[inline]
pub fn dot<const N: usize>(row: &[f64; N], z: &[f64; N]) -> f64 {
    row.iter().zip(z).map(|(one, other)| one * other).sum()
}

/// `first · second`.
#[inline]
pub fn product<const M: usize, const N: usize, const K: usize>(
    first: &[[f64; M]; N],
    second: &[[f64; N]; K],
) -> [[f64; M]; K] {
    let mut all = [[0.0; M]; K];
    for (own, column) in all.iter_mut().zip(second) {
        *own = apply(first, column);
    }
    all
}

/// The largest sum of magnitudes in a column: the norm that belongs to `Σ |zᵢ|`.
pub fn norm<const N: usize>(matrix: &Square<N>) -> f64 {
    let sums = matrix.iter().map(|column| column.iter().map(|own| own.abs()).sum());
    sums.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_and_columns_are_told_apart() {
        let matrix = [[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]];
        let bits = |own: &[f64]| own.iter().map(|own| own.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&apply(&matrix, &[1.0, 10.0, 100.0])), bits(&[531.0, 642.0]));
        assert_eq!(bits(&apply_left(&[1.0, 10.0], &matrix)), bits(&[21.0, 43.0, 65.0]));
        assert_eq!(product(&matrix, &[[1.0, 0.0, 0.0]]), [[1.0, 2.0]]);
    }
}
