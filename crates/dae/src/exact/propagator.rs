//! Marching on a uniform grid: `z_{k+1} = e^{Ā Δt} z_k`, and whether a system can drift away: rigid motion,
//! for which marching is not accurate.

use dashpot_numerics::{
    exponential::exponential,
    small::{Square, apply, product},
};
use nalgebra::{DMatrix, DVector};

/// Pivots of the matrix below this, relative to its largest entry, are zero.
const ZERO: f64 = 1e-10;
/// Pivots of its square below this are: rates that are a decade apart are two decades apart there.
const ZERO_OF_SQUARE: f64 = 1e-14;

/// Equally spaced times, counted from the state that is marched.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Grid {
    /// The first time.
    pub(super) first: f64,
    /// The distance of two times.
    pub(super) step: f64,
    /// How many there are.
    pub(super) count: usize,
}

/// Appends to `out`, for each time of the grid, the first `units.len()` entries of `D z(t)`, where
/// `ż = matrix · z` and `z(0) = state`.
pub(super) fn propagate(
    matrix: &DMatrix<f64>,
    state: &[f64],
    units: &[f64],
    grid: Grid,
    out: &mut Vec<f64>,
) {
    match matrix.nrows() {
        0 => {}
        1 | 2 => propagate_fixed::<2>(matrix, state, units, grid, out),
        3 | 4 => propagate_fixed::<4>(matrix, state, units, grid, out),
        5 | 6 => propagate_fixed::<6>(matrix, state, units, grid, out),
        7 | 8 => propagate_fixed::<8>(matrix, state, units, grid, out),
        9 | 10 => propagate_fixed::<10>(matrix, state, units, grid, out),
        11 | 12 => propagate_fixed::<12>(matrix, state, units, grid, out),
        13..=16 => propagate_fixed::<16>(matrix, state, units, grid, out),
        _ => propagate_any(matrix, state, units, grid, out),
    }
}

/// The state after `time`.
pub(super) fn advance(matrix: &DMatrix<f64>, state: &[f64], time: f64) -> Vec<f64> {
    let mut end = Vec::with_capacity(state.len());
    let ones = vec![1.0; state.len()];
    propagate(matrix, state, &ones, Grid { first: time, step: 0.0, count: 1 }, &mut end);
    end
}

/// With sizes that the compiler knows; four states at a time, which do not wait for one another.
fn propagate_fixed<const N: usize>(
    matrix: &DMatrix<f64>,
    state: &[f64],
    units: &[f64],
    grid: Grid,
    out: &mut Vec<f64>,
) {
    let size = matrix.nrows();
    let mut a = [[0.0; N]; N];
    for (padded, column) in a.iter_mut().zip(matrix.as_slice().chunks_exact(size)) {
        padded[..size].copy_from_slice(column);
    }
    let mut z = [0.0; N];
    z[..size].copy_from_slice(state);
    if grid.first != 0.0 {
        z = apply(&exponential(&a, grid.first), &z);
    }
    // From here on in the units of `y`: powers of two, so that nothing is rounded.
    let mut d = [1.0; N];
    d[..units.len()].copy_from_slice(units);
    z.iter_mut().zip(&d).for_each(|(z, unit)| *z *= unit);
    let keep = units.len();
    if grid.count == 1 {
        out.extend_from_slice(&z[..keep]);
        return;
    }
    let mut e = exponential(&a, grid.step);
    for (column, from) in e.iter_mut().zip(&d) {
        column.iter_mut().zip(&d).for_each(|(entry, to)| *entry *= to / from);
    }
    let mut lanes = [z; 4];
    for lane in 1..4 {
        lanes[lane] = apply(&e, &lanes[lane - 1]);
    }
    let e2 = product(&e, &e);
    let e4 = product(&e2, &e2);
    for _ in 0..grid.count / 4 {
        if keep == N {
            out.extend_from_slice(lanes.as_flattened());
        } else {
            lanes.iter().for_each(|z| out.extend_from_slice(&z[..keep]));
        }
        lanes = apply_four(&e4, &lanes);
    }
    lanes.iter().take(grid.count % 4).for_each(|z| out.extend_from_slice(&z[..keep]));
}

/// `matrix · vector` for four vectors.
#[inline]
fn apply_four<const N: usize>(matrix: &Square<N>, vectors: &[[f64; N]; 4]) -> [[f64; N]; 4] {
    let mut sums = [[0.0; N]; 4];
    for (k, column) in matrix.iter().enumerate() {
        for (sum, vector) in sums.iter_mut().zip(vectors) {
            let factor = vector[k];
            for (s, c) in sum.iter_mut().zip(column) {
                *s += c * factor;
            }
        }
    }
    sums
}

fn propagate_any(
    matrix: &DMatrix<f64>,
    state: &[f64],
    units: &[f64],
    grid: Grid,
    out: &mut Vec<f64>,
) {
    let mut z = DVector::from_column_slice(state);
    if grid.first != 0.0 {
        z = exponential(matrix, grid.first) * z;
    }
    let mut write = |z: &DVector<f64>| out.extend(units.iter().zip(z.iter()).map(|(d, z)| d * z));
    write(&z);
    if grid.count > 1 {
        let e = exponential(matrix, grid.step);
        for _ in 1..grid.count {
            z = &e * z;
            write(&z);
        }
    }
}

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

    #[test]
    fn every_size_marches_alike() {
        for size in 1..=20 {
            let matrix = DMatrix::from_fn(size, size, |i, j| match i.abs_diff(j) {
                0 => -1.0,
                1 => 0.5,
                _ => 0.0,
            });
            let state = vec![1.0; size];
            let grid = Grid { first: 0.25, step: 0.125, count: 11 };
            let mut out = Vec::new();
            propagate(&matrix, &state, &vec![1.0; size], grid, &mut out);
            let last = exponential(&matrix, 1.5) * DVector::from_column_slice(&state);
            for (got, expected) in out[10 * size..].iter().zip(last.iter()) {
                assert!((got - expected).abs() < 1e-14, "size {size}");
            }
        }
    }

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
