use nalgebra::{DMatrix, DVector};

use super::*;

/// Numbers between −1 and 1 without a pattern.
pub(super) struct Numbers(pub(super) u64);

impl Numbers {
    pub(super) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695);
        (self.0 >> 11) as f64 / f64::from(1_u32 << 26) / f64::from(1_u32 << 26) - 1.0
    }

    /// A number below this one.
    pub(super) fn below(&mut self, count: usize) -> usize {
        self.next();
        (self.0 >> 33) as usize % count
    }

    /// The numbers below this one in any order.
    pub(super) fn shuffled(&mut self, count: usize) -> Vec<usize> {
        let mut all: Vec<usize> = (0..count).collect();
        all.sort_by_cached_key(|_| self.next().to_bits());
        all
    }
}

/// Entries of a band of the given reach whose unknowns are numbered at random.
fn band(size: usize, reach: usize, numbers: &mut Numbers) -> Vec<(usize, usize, f64)> {
    let names = numbers.shuffled(size);
    let mut entries = Vec::new();
    for row in 0..size {
        for column in row.saturating_sub(reach)..size.min(row + reach + 1) {
            entries.push((names[row], names[column], numbers.next()));
        }
    }
    entries
}

pub(super) fn places_of(
    entries: &[(usize, usize, f64)],
) -> impl Iterator<Item = (usize, usize)> + Clone {
    entries.iter().map(|&(row, column, _)| (row, column))
}

pub(super) fn values_of(entries: &[(usize, usize, f64)]) -> Vec<f64> {
    entries.iter().map(|entry| entry.2).collect()
}

fn factorised(size: usize, entries: &[(usize, usize, f64)]) -> Banded {
    let mut banded = Banded::whole(size, places_of(entries), size).unwrap();
    banded.factorise(&values_of(entries)).unwrap();
    banded
}

fn dense(size: usize, entries: &[(usize, usize, f64)]) -> DMatrix<f64> {
    let mut dense = DMatrix::zeros(size, size);
    entries.iter().for_each(|&(row, column, value)| dense[(row, column)] += value);
    dense
}

fn difference(size: usize, entries: &[(usize, usize, f64)], numbers: &mut Numbers) -> f64 {
    difference_of(&factorised(size, entries), size, entries, numbers)
}

/// The difference to a dense solution in parts of what the rounding of either may make of it, which
/// grows with the condition and, with small pivots, by up to one over the share that is accepted.
pub(super) fn difference_of(
    banded: &Banded,
    size: usize,
    entries: &[(usize, usize, f64)],
    numbers: &mut Numbers,
) -> f64 {
    let right: Vec<f64> = (0..size).map(|_| numbers.next()).collect();
    let matrix = dense(size, entries);
    let lu = matrix.clone().full_piv_lu();
    let truth = lu.solve(&DVector::from_vec(right.clone())).unwrap();
    let inverse = lu.try_inverse().unwrap();
    let condition = matrix.norm() * inverse.norm();
    let mut found = right;
    assert!(banded.solve(&mut found));
    let error = (DVector::from_vec(found) - &truth).norm();
    error / (f64::EPSILON * condition * truth.norm() / GOOD_PIVOT)
}

#[test]
fn solutions_are_those_of_a_dense_factorisation() {
    let numbers = &mut Numbers(7);
    for reach in 0..9 {
        for size in [1, 2, 3, 7, 40, 90] {
            // Random entries ask for exchanges of rows in nearly every column, a heavy diagonal for none.
            let mut entries = band(size, reach, numbers);
            let found = difference(size, &entries, numbers);
            assert!(found < 1.0, "{size} with reach {reach}: {found:e}");
            for entry in &mut entries {
                entry.2 += if entry.0 == entry.1 { 4.0 * (reach + 1) as f64 } else { 0.0 };
            }
            let found = difference(size, &entries, numbers);
            assert!(found < 1.0, "heavy, {size} with reach {reach}: {found:e}");
            assert!(factorised(size, &entries).general.pivots.is_empty());
        }
    }
}

#[test]
fn a_diagonal_of_zeros_is_no_hindrance() {
    let numbers = &mut Numbers(3);
    for size in [2, 10, 60] {
        let mut entries = band(size, 2, numbers);
        // Pairs that determine each other.
        for entry in &mut entries {
            entry.2 = if entry.0 == entry.1 { 0.0 } else { entry.2 + entry.2.signum() };
        }
        assert!(!factorised(size, &entries).general.pivots.is_empty());
        let found = difference(size, &entries, numbers);
        assert!(found < 1.0, "{size}: {found:e}");
    }
}

#[test]
fn scales_of_rows_do_not_alter_what_is_exchanged() {
    let numbers = &mut Numbers(5);
    let size = 40;
    let mut entries = band(size, 3, numbers);
    let plain = factorised(size, &entries);
    let mut right: Vec<f64> = (0..size).map(|_| numbers.next()).collect();
    let mut other = right.clone();
    for entry in &mut entries {
        entry.2 *= f64::exp2((entry.0 % 7) as f64 * 40.0 - 120.0);
    }
    for (row, value) in other.iter_mut().enumerate() {
        *value *= f64::exp2((row % 7) as f64 * 40.0 - 120.0);
    }
    let scaled = factorised(size, &entries);
    assert_eq!(plain.general.pivots, scaled.general.pivots);
    assert!(plain.solve(&mut right) && scaled.solve(&mut other));
    // Powers of two alter exponents only, up to the rounding of one over the largest entry.
    for (one, other) in right.iter().zip(&other) {
        assert!((one - other).abs() <= 1e-9 * one.abs(), "{one} and {other}");
    }
}

#[test]
fn entries_given_twice_add_up_and_old_factors_leave_no_trace() {
    let entries = [(0, 0, 1.0), (0, 0, 1.0), (1, 1, 4.0), (0, 1, 0.0), (1, 0, 0.0)];
    let mut banded = factorised(2, &entries);
    // With the diagonal's values elsewhere, rows have to be exchanged; then again not.
    for (values, truth) in
        [([0.0, 0.0, 0.0, 2.0, 4.0], [2.0, 1.0]), ([1.0, 1.0, 4.0, 0.0, 0.0], [1.0, 2.0])]
    {
        banded.factorise(&values).unwrap();
        let mut found = [2.0, 8.0];
        assert!(banded.solve(&mut found));
        for (found, truth) in found.iter().zip(truth) {
            assert!((found - truth).abs() < 1e-15, "{found} for {truth}");
        }
    }
}

#[test]
fn singular_matrices_and_such_with_infinite_entries_have_no_solution() {
    let numbers = &mut Numbers(11);
    for reach in [1, 3, 6] {
        let healthy = band(30, reach, numbers);
        let mut right = vec![1.0; 30];
        assert!(factorised(30, &healthy).solve(&mut right));
        let spoil = |change: &dyn Fn(&(usize, usize, f64)) -> f64| {
            let mut entries = healthy.clone();
            entries.iter_mut().for_each(|entry| entry.2 = change(entry));
            factorised(30, &entries).solve(&mut vec![1.0; 30])
        };
        assert!(!spoil(&|own| if own.0 == 17 { 0.0 } else { own.2 }), "an empty row");
        assert!(!spoil(&|own| if own.1 == 17 { 0.0 } else { own.2 }), "an empty column");
        assert!(!spoil(&|_| 0.0), "nothing at all");
        assert!(!spoil(&|own| if own.0 == 4 { f64::INFINITY } else { own.2 }), "infinite");
        assert!(!spoil(&|own| if own.0 == 4 { f64::NAN } else { own.2 }), "no numbers");
    }
}

#[test]
fn nothing_is_solved_before_the_first_factorisation() {
    let entries = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2)];
    assert!(!Banded::whole(3, entries.into_iter(), 3).unwrap().solve(&mut [1.0; 3]));
}
