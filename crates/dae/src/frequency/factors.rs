//! Elimination of a sparse complex matrix.
//!
//! The next row is one with the fewest entries, the pivot in it the one whose column has the
//! fewest, of those that are large enough in their row (Markowitz, with a threshold). A chain is
//! eliminated in a time proportional to its length, a full matrix as any other method does it.
//! Pivots are compared within rows only, so the scale of a row does not matter.

use nalgebra::Complex;

/// Column, or row, and value.
type Entry = (usize, Complex<f64>);
/// Rows of a square matrix: their entries in rising order of columns.
pub(super) type Entries = Vec<Vec<Entry>>;

/// A pivot is at least this part of the largest entry of its row.
const THRESHOLD: f64 = 0.1;

/// One eliminated unknown.
#[derive(Debug, Clone)]
struct Step {
    row: usize,
    column: usize,
    pivot: Complex<f64>,
    /// The other entries of the pivot's row.
    rest: Vec<Entry>,
    /// Which multiples of the row were taken from other rows.
    multipliers: Vec<Entry>,
}

/// A matrix as the steps of its elimination.
#[derive(Debug, Clone)]
pub(super) struct Factors(Vec<Step>);

impl Factors {
    /// Eliminates all unknowns; `None` where a row vanishes.
    pub(super) fn of(mut rows: Entries) -> Option<Self> {
        let mut users: Vec<Vec<usize>> = vec![Vec::new(); rows.len()];
        for (at, row) in rows.iter().enumerate() {
            row.iter().for_each(|entry| users[entry.0].push(at));
        }
        let mut open: Vec<usize> = (0..rows.len()).collect();
        let mut steps = Vec::with_capacity(rows.len());
        while let Some(place) = (0..open.len()).min_by_key(|&at| (rows[open[at]].len(), open[at])) {
            let row = open.swap_remove(place);
            let mut rest = std::mem::take(&mut rows[row]);
            rest.iter().for_each(|entry| users[entry.0].retain(|&user| user != row));
            let (column, pivot) = rest.remove(pivot_of(&rest, &users)?);
            let mut multipliers = Vec::new();
            for user in std::mem::take(&mut users[column]) {
                let own = std::mem::take(&mut rows[user]);
                let found = own.binary_search_by_key(&column, |entry| entry.0).ok()?;
                let multiplier = own[found].1 / pivot;
                let filled = |at: usize| users[at].push(user);
                rows[user] = reduced(&own, column, multiplier, &rest, filled);
                multipliers.push((user, multiplier));
            }
            steps.push(Step { row, column, pivot, rest, multipliers });
        }
        Some(Self(steps))
    }

    /// Turns the right-hand side into the solution.
    pub(super) fn solve(&self, right: &mut [Complex<f64>]) {
        for step in &self.0 {
            let own = right[step.row];
            step.multipliers.iter().for_each(|&(row, factor)| right[row] -= factor * own);
        }
        let mut solution = vec![Complex::default(); right.len()];
        for step in self.0.iter().rev() {
            let own = right[step.row];
            let own = step.rest.iter().fold(own, |sum, &(at, value)| sum - value * solution[at]);
            solution[step.column] = own / step.pivot;
        }
        right.copy_from_slice(&solution);
    }

    /// The same with the transposed matrix.
    pub(super) fn solve_transposed(&self, right: &mut [Complex<f64>]) {
        let mut solution = vec![Complex::default(); right.len()];
        for step in &self.0 {
            let own = right[step.column] / step.pivot;
            step.rest.iter().for_each(|&(column, value)| right[column] -= value * own);
            solution[step.row] = own;
        }
        for step in self.0.iter().rev() {
            let own = solution[step.row];
            let multipliers = step.multipliers.iter();
            solution[step.row] =
                multipliers.fold(own, |sum, &(row, factor)| sum - factor * solution[row]);
        }
        right.copy_from_slice(&solution);
    }
}

/// The place of the pivot in a row; `None` where the row vanishes.
fn pivot_of(row: &[Entry], users: &[Vec<usize>]) -> Option<usize> {
    let largest = row.iter().map(|entry| entry.1.l1_norm()).fold(0.0, f64::max);
    if largest == 0.0 {
        return None;
    }
    (0..row.len())
        .filter(|&at| row[at].1.l1_norm() >= THRESHOLD * largest)
        .min_by_key(|&at| users[row[at].0].len())
}

/// `own − multiplier · rest` without its entry in `column`; `filled` is told of new entries.
fn reduced(
    own: &[Entry],
    column: usize,
    multiplier: Complex<f64>,
    rest: &[Entry],
    mut filled: impl FnMut(usize),
) -> Vec<Entry> {
    let mut sum = Vec::with_capacity(own.len() + rest.len());
    let mut left = own.iter().filter(|entry| entry.0 != column).peekable();
    for &(at, value) in rest {
        while let Some(&&before) = left.peek().filter(|entry| entry.0 < at) {
            sum.push(before);
            left.next();
        }
        let taken = multiplier * value;
        match left.peek() {
            Some(&&(same, value)) if same == at => {
                sum.push((at, value - taken));
                left.next();
            }
            _ => {
                sum.push((at, -taken));
                filled(at);
            }
        }
    }
    sum.extend(left);
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A reproducible number in (−1, 1) for two numbers.
    fn toss(i: usize, j: usize) -> f64 {
        let x = (i as f64 * 12.9898 + j as f64 * 78.233 + 1.0).sin() * 43_758.545_3;
        2.0 * (x - x.floor()) - 1.0
    }

    fn matrix(count: usize, share: f64) -> Entries {
        let entry = |i: usize, j: usize| {
            let is_there = i == (j + 1) % count || 0.5 * (toss(i, j + count) + 1.0) < share;
            is_there.then(|| (j, Complex::new(toss(i, j), toss(j, i + 7))))
        };
        (0..count).map(|i| (0..count).filter_map(|j| entry(i, j)).collect()).collect()
    }

    #[test]
    fn solutions_meet_the_equations_and_the_transposed_ones() {
        for (count, share) in [(1, 1.0), (5, 0.3), (30, 0.1), (30, 1.0), (200, 0.01)] {
            let rows = matrix(count, share);
            let factors = Factors::of(rows.clone()).unwrap();
            let right: Vec<Complex<f64>> =
                (0..count).map(|i| Complex::new(toss(i, 3), toss(i, 4))).collect();
            let (mut plain, mut transposed) = (right.clone(), right.clone());
            factors.solve(&mut plain);
            factors.solve_transposed(&mut transposed);
            let mut missing = [right.clone(), right.clone()];
            let mut size = [0.0_f64; 2];
            for (i, row) in rows.iter().enumerate() {
                for &(j, value) in row {
                    missing[0][i] -= value * plain[j];
                    missing[1][j] -= value * transposed[i];
                    size[0] = size[0].max((value * plain[j]).norm());
                    size[1] = size[1].max((value * transposed[i]).norm());
                }
            }
            for (missing, size) in missing.iter().zip(size) {
                let worst = missing.iter().map(|own| own.norm()).fold(0.0, f64::max);
                // Growth of the elimination is at most tenfold here, terms are summed over a row.
                assert!(worst <= 10.0 * count as f64 * f64::EPSILON * size, "{count}: {worst:e}");
            }
        }
    }

    #[test]
    fn a_chain_gets_few_new_entries() {
        let count = 300;
        let row = |i: usize| {
            let ends = [i.checked_sub(1), Some(i), Some(i + 1).filter(|&j| j < count)];
            ends.into_iter().flatten().map(|j| (j, Complex::new(toss(i, j), 1.0))).collect()
        };
        let rows: Entries = (0..count).map(row).collect();
        let entries: usize = rows.iter().map(Vec::len).sum();
        let Factors(steps) = Factors::of(rows).unwrap();
        let kept: usize =
            steps.iter().map(|step| 1 + step.rest.len() + step.multipliers.len()).sum();
        assert!(kept <= entries + count, "{kept} of {entries}");
    }

    #[test]
    fn a_singular_matrix_has_no_factors() {
        let one = Complex::new(1.0, 0.0);
        assert!(Factors::of(vec![vec![(0, one), (1, one)], vec![(0, one), (1, one)]]).is_none());
        assert!(Factors::of(vec![vec![(0, one)], Vec::new()]).is_none());
        assert!(Factors::of(Vec::new()).is_some());
    }
}
