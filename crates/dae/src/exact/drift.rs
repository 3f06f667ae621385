//! Whether a system can drift away: rigid motion, for which marching is not accurate.

use nalgebra::DMatrix;

/// Pivots of the matrix below this, relative to its largest entry, are zero.
const ZERO: f64 = 1e-10;
/// Pivots of its square below this are: rates that are a decade apart are two decades apart there.
const ZERO_OF_SQUARE: f64 = 1e-14;

/// Whether the eigenvalue zero of the leading `n × n` block `A` has a Jordan chain, as that of free
/// motion has: then `A²` has a lower rank than `A`.
///
/// Rates that are slower than the fastest one by many decades may be taken for zero.
pub(super) fn drifts(matrix: &DMatrix<f64>, n: usize) -> bool {
    let mut a = vec![0.0; n * n];
    for (to, from) in a.chunks_exact_mut(n.max(1)).zip(matrix.column_iter()) {
        to.copy_from_slice(&from.as_slice()[..n]);
    }
    let mut square = vec![0.0; n * n];
    let rank = rank(&mut a.clone(), n, ZERO);
    if rank == n {
        return false;
    }
    for (to, factors) in square.chunks_exact_mut(n).zip(a.chunks_exact(n)) {
        for (from, factor) in a.chunks_exact(n).zip(factors) {
            to.iter_mut().zip(from).for_each(|(sum, x)| *sum += x * factor);
        }
    }
    self::rank(&mut square, n, ZERO_OF_SQUARE) < rank
}

/// The rank of an `n × n` matrix, which is used up, by elimination; rows of `a` are contiguous, and
/// pivots below `zero` times the largest entry do not count.
fn rank(a: &mut [f64], n: usize, zero: f64) -> usize {
    let zero = zero * a.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let mut rank = 0;
    for column in 0..n {
        let size = |row: usize| a[row * n + column].abs();
        let Some(pivot) = (rank..n).max_by(|&i, &j| size(i).total_cmp(&size(j))) else { break };
        if size(pivot) <= zero {
            continue;
        }
        let (done, rest) = a.split_at_mut((rank + 1) * n);
        let top = &mut done[rank * n..];
        if pivot > rank {
            top.swap_with_slice(&mut rest[(pivot - rank - 1) * n..][..n]);
        }
        for row in rest.chunks_exact_mut(n) {
            let factor = row[column] / top[column];
            if factor != 0.0 {
                row[column..].iter_mut().zip(&top[column..]).for_each(|(x, t)| *x -= factor * t);
            }
        }
        rank += 1;
    }
    rank
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drifting(n: usize, rows: &[f64]) -> bool {
        drifts(&DMatrix::from_row_slice(n, n, rows), n)
    }

    #[test]
    fn only_free_motion_drifts() {
        assert!(drifting(2, &[0.0, 1.0, 0.0, 0.0]), "a free mass");
        assert!(!drifting(2, &[0.0, 1.0, -1.0, 0.0]), "an oscillator");
        assert!(!drifting(2, &[0.0, 1.0, 0.0, -1.0]), "a mass that a dashpot stops");
        assert!(!drifting(2, &[0.0; 4]), "displacements at rest");
        let coupled = [
            [0.0, 0.0, 1.0, 0.0],
            [0.0, 0.0, 0.0, 1.0],
            [-1.0, 1.0, 0.0, 0.0],
            [1.0, -1.0, 0.0, 0.0],
        ];
        assert!(drifting(4, coupled.as_flattened()), "two coupled masses");
        assert!(!drifting(0, &[]));
    }
}
