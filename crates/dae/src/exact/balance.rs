//! Diagonal scaling that makes rows and columns of a matrix equally large.

use nalgebra::DMatrix;

use super::components::Components;

/// Most sweeps; each lowers the norm, so few are ever needed.
const SWEEPS: usize = 40;

/// Replaces the leading `n × n` block `A` by `D⁻¹ A D` and returns the diagonal `D` of powers of
/// two, so that nothing is rounded (Parlett & Reinsch, Numer. Math. 13 (1969) 293).
///
/// Only states that act on each other, directly or through others, have a balance; where the action
/// goes one way, scaling would go on and on to make it vanish. States that nothing depends on, or
/// that depend on nothing, are scaled only so far that they do not raise the norm.
pub(super) fn balance(a: &mut DMatrix<f64>, n: usize) -> Vec<f64> {
    let mut units = vec![1.0; n];
    let components = Components::of(a, n);
    for _ in 0..SWEEPS {
        let mut settled = true;
        for i in 0..n {
            let (mut column, row) = sums(a, n, i, |j| components.together(i, j));
            if column == 0.0 || row == 0.0 {
                continue;
            }
            let before = column + row;
            let mut factor = 1.0;
            while column < 0.5 * row && factor < 1e150 {
                factor *= 2.0;
                column *= 4.0;
            }
            while column > 2.0 * row && factor > 1e-150 {
                factor *= 0.5;
                column *= 0.25;
            }
            if (column + row) / factor < 0.95 * before {
                settled = false;
                scale(a, n, i, factor);
                units[i] *= factor;
            }
        }
        if settled {
            break;
        }
    }
    let norm = (0..n).map(|i| sums(a, n, i, |_| true)).filter(|s| s.0 != 0.0 && s.1 != 0.0);
    let norm = norm.fold(0.0_f64, |norm, (column, _)| norm.max(column));
    if norm == 0.0 {
        return units;
    }
    for (i, unit) in units.iter_mut().enumerate() {
        let (column, row) = sums(a, n, i, |_| true);
        let factor = match (column > 0.0, row > 0.0) {
            (false, true) if row > norm => power_of_two(row / norm),
            (true, false) if column > norm => power_of_two(norm / column),
            _ => continue,
        };
        scale(a, n, i, factor);
        *unit *= factor;
    }
    units
}

/// The power of two next to a positive number.
pub(super) fn power_of_two(x: f64) -> f64 {
    x.log2().round().clamp(-900.0, 900.0).exp2()
}

/// Sums of the sizes of column and row `i` of the leading block without the diagonal, over the states that count.
fn sums(a: &DMatrix<f64>, n: usize, i: usize, counts: impl Fn(usize) -> bool) -> (f64, f64) {
    let mut column = 0.0;
    let mut row = 0.0;
    for (j, entry) in a.as_slice()[i * a.nrows()..][..n].iter().enumerate() {
        if j != i && counts(j) {
            column += entry.abs();
            row += a[(i, j)].abs();
        }
    }
    (column, row)
}

/// Multiplies column `i` of the leading block by `factor` and divides its row by it.
fn scale(a: &mut DMatrix<f64>, n: usize, i: usize, factor: f64) {
    for j in 0..n {
        a[(j, i)] *= factor;
        a[(i, j)] /= factor;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_badly_scaled_oscillator_becomes_skew_up_to_a_factor_of_two() {
        let mut a = DMatrix::from_row_slice(2, 2, &[0.0, 1.0, -1e12, 0.0]);
        let units = balance(&mut a, 2);
        assert!((a[(0, 1)] / a[(1, 0)]).abs().log2().abs() <= 2.0);
        let back = a[(1, 0)] * units[1] / units[0];
        assert!((back + 1e12).abs() < 1e-3, "scaling by powers of two is exact");
    }

    #[test]
    fn action_in_one_direction_is_left_alone() {
        // An oscillator that pulls another one along.
        let mut a = DMatrix::zeros(4, 4);
        for (i, j, value) in [(0, 1, 1.0), (1, 0, -1.0), (2, 3, 1.0), (3, 2, -1.0), (3, 0, 0.5)] {
            a[(i, j)] = value;
        }
        assert_eq!(balance(&mut a, 4), [1.0; 4]);
    }

    #[test]
    fn a_free_mass_keeps_its_jordan_block() {
        let mut a = DMatrix::from_row_slice(2, 2, &[0.0, 1.0, 0.0, 0.0]);
        balance(&mut a, 2);
        assert_eq!((a[(0, 0)], a[(1, 0)], a[(1, 1)]), (0.0, 0.0, 0.0));
        assert!(a[(0, 1)] > 0.0);
    }
}
