//! Least squares with unknowns that are zero or positive.
//!
//! The active-set method of Lawson and Hanson on Gram matrices, as Bro and de Jong made it fast (J. Chemometrics 11
//! (1997) 393). Columns are scaled to the length one. What the square of a condition number costs is won back by
//! correcting each solution with its residual, which is taken from the columns themselves.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// A gradient below this part of the target's length, or of what pulls along its column, is zero.
const FLAT: f64 = 1e-11;
/// Added to the diagonal of a Gram matrix, of which one is the largest entry.
const RIDGE: f64 = 1e-14;
/// More changes of the active set than this for each column are a circle of rounding errors.
const MOST_CHANGES: usize = 6;

/// A problem `min ‖A x − b‖`, `x ≥ 0`.
#[derive(Debug, Clone)]
pub struct NonNegative {
    columns: DMatrix<f64>,
    target: DVector<f64>,
    lengths: Vec<f64>,
    gram: DMatrix<f64>,
    /// What is added to the descent along each column.
    pull: DVector<f64>,
}

/// Its solution.
#[derive(Debug, Clone, PartialEq)]
pub struct Minimum {
    /// The unknowns, none below zero.
    pub values: Vec<f64>,
    /// `A x − b`.
    pub residual: DVector<f64>,
}

impl Minimum {
    /// The unknowns that are positive.
    pub fn passive(&self) -> Vec<usize> {
        (0..self.values.len()).filter(|at| self.values[*at] > 0.0).collect()
    }
}

impl NonNegative {
    /// `‖b‖²`.
    pub fn square(&self) -> f64 {
        self.target.norm_squared()
    }

    /// The length of a column.
    pub fn length(&self, column: usize) -> f64 {
        self.lengths[column]
    }

    /// The problem with these columns.
    pub fn new(mut columns: DMatrix<f64>, target: DVector<f64>) -> Self {
        let length = |own: f64| if own > 0.0 { own } else { 1.0 };
        let lengths: Vec<f64> = columns.column_iter().map(|own| length(own.norm())).collect();
        for (mut column, length) in columns.column_iter_mut().zip(&lengths) {
            column /= *length;
        }
        let gram = columns.tr_mul(&columns);
        let pull = DVector::zeros(lengths.len());
        Self { columns, target, lengths, gram, pull }
    }

    /// Pulls the minimum: that of `½ ‖A x − b‖² − pull · x`.
    pub fn pull(&mut self, pull: &[f64]) {
        let scaled = pull.iter().zip(&self.lengths).map(|(own, length)| own / length);
        self.pull = DVector::from_iterator(self.lengths.len(), scaled);
    }

    /// The minimum, looked for from the unknowns `warm` on that are likely to be positive.
    pub fn minimum(&self, warm: &[usize]) -> Minimum {
        let count = self.lengths.len();
        let mut state = State { passive: Vec::new(), values: vec![0.0; count] };
        if !warm.is_empty() {
            state.passive = warm.to_vec();
            self.settle(&mut state);
        }
        // A column that is next to nothing is pulled much, and the others not with it.
        let length = self.target.norm();
        let flat = |at: usize| FLAT * length.max(self.pull[at].abs());
        let mut barred = vec![false; count];
        for _ in 0..MOST_CHANGES * count {
            let left = &self.target - self.model(&state.values);
            let descent = self.columns.tr_mul(&left) + &self.pull;
            let open = (0..count).filter(|at| !barred[*at] && !state.passive.contains(at));
            let steepest = open.max_by(|&one, &other| descent[one].total_cmp(&descent[other]));
            let Some(enters) = steepest.filter(|&at| descent[at] > flat(at)) else { break };
            let before = state.clone();
            state.passive.push(enters);
            if !self.settle(&mut state) || state.values[enters] <= 0.0 {
                // Rounding alone let it in.
                state = before;
                barred[enters] = true;
            } else {
                barred.fill(false);
            }
        }
        let residual = self.model(&state.values) - &self.target;
        let values = state.values.iter().zip(&self.lengths).map(|(own, length)| own / length);
        Minimum { values: values.collect(), residual }
    }

    fn model(&self, values: &[f64]) -> DVector<f64> {
        let mut sum = DVector::zeros(self.target.len());
        for (at, value) in values.iter().enumerate().filter(|own| *own.1 != 0.0) {
            sum.axpy(*value, &self.columns.column(at), 1.0);
        }
        sum
    }

    /// Moves to the least squares of the passive unknowns, and takes those out that would fall below zero on the
    /// way; false where they cannot be told apart.
    fn settle(&self, state: &mut State) -> bool {
        // Each round takes one out at least, but for what rounding keeps.
        for _ in 0..MOST_CHANGES * self.lengths.len() {
            if state.passive.is_empty() {
                break;
            }
            let Some(wanted) = self.least_squares(&state.passive) else { return false };
            let fraction = state.passive.iter().zip(&wanted).filter(|own| *own.1 <= 0.0).map(
                |(&at, wanted)| {
                    let from = state.values[at];
                    if from > 0.0 { from / (from - wanted) } else { 0.0 }
                },
            );
            let Some(fraction) = fraction.reduce(f64::min) else {
                state.values.fill(0.0);
                state.passive.iter().zip(wanted).for_each(|(&at, own)| state.values[at] = own);
                return true;
            };
            for (&at, wanted) in state.passive.iter().zip(&wanted) {
                let own = &mut state.values[at];
                *own += fraction * (wanted - *own);
                if *wanted <= 0.0 && *own <= f64::EPSILON * wanted.abs() {
                    *own = 0.0;
                }
            }
            let values = &state.values;
            state.passive.retain(|at| values[*at] > 0.0);
        }
        state.values.fill(0.0);
        state.passive.is_empty()
    }

    /// The least squares of some unknowns.
    fn least_squares(&self, passive: &[usize]) -> Option<Vec<f64>> {
        let size = passive.len();
        let gram = DMatrix::from_fn(size, size, |row, column| {
            self.gram[(passive[row], passive[column])] + if row == column { RIDGE } else { 0.0 }
        });
        let factor: Cholesky<f64, Dyn> = Cholesky::new(gram)?;
        let mut values = DVector::zeros(size);
        let mut left = self.target.clone();
        for _ in 0..2 {
            let descent = |&at: &usize| self.columns.column(at).dot(&left) + self.pull[at];
            let projected = passive.iter().map(descent);
            let step = factor.solve(&DVector::from_iterator(size, projected));
            for (&at, step) in passive.iter().zip(step.iter()) {
                left.axpy(-step, &self.columns.column(at), 1.0);
            }
            values += step;
        }
        Some(values.iter().copied().collect())
    }
}

/// Which unknowns may be positive, and what they are.
#[derive(Debug, Clone)]
struct State {
    passive: Vec<usize>,
    values: Vec<f64>,
}

#[cfg(test)]
mod tests {
    use dashpot_numerics::Stream;

    use super::*;

    /// Conditions of Karush, Kuhn and Tucker: no unknown below zero, no descent along one that is zero, none either
    /// way along one that is positive.
    fn assert_optimal(columns: &DMatrix<f64>, target: &DVector<f64>, minimum: &Minimum) {
        for (at, column) in columns.column_iter().enumerate() {
            let descent = -column.dot(&minimum.residual) / column.norm();
            let value = minimum.values[at];
            assert!(value >= 0.0, "{at}: {value}");
            assert!(descent < 1e-9 * target.norm(), "{at}: {descent} at {value}");
            assert!(value == 0.0 || descent > -1e-9 * target.norm(), "{at}: {descent} at {value}");
        }
    }

    #[test]
    fn random_problems_meet_the_conditions_of_optimality() {
        let mut stream = Stream::new(7);
        let mut uniform = || stream.share() - 0.5;
        for size in [1, 3, 8, 20, 40] {
            let columns = DMatrix::from_fn(2 * size, size, |_, _| uniform());
            let target = DVector::from_fn(2 * size, |_, _| uniform());
            let problem = NonNegative::new(columns.clone(), target.clone());
            let cold = problem.minimum(&[]);
            assert_optimal(&columns, &target, &cold);
            let warm = problem.minimum(&(0..size).collect::<Vec<_>>());
            let off = warm.residual.norm() - cold.residual.norm();
            assert!(off.abs() < 1e-12 * target.norm(), "{size}: {off}");
        }
    }

    #[test]
    fn exponentials_that_are_hardly_apart_meet_them_too() {
        let times: Vec<f64> =
            (0..200).map(|at| 10.0_f64.powf(f64::from(at) / 20.0 - 5.0)).collect();
        let columns = DMatrix::from_fn(200, 80, |row, column| {
            (-times[row] / 10.0_f64.powf(f64::from(u32::try_from(column).unwrap()) / 8.0 - 5.0))
                .exp()
        });
        let target = DVector::from_iterator(200, times.iter().map(|t| 1.0 / (1.0 + t).powf(0.3)));
        let minimum = NonNegative::new(columns.clone(), target.clone()).minimum(&[]);
        assert_optimal(&columns, &target, &minimum);
    }

    #[test]
    fn two_columns_by_hand() {
        // Without the bound x = (3, −1); with it the second is zero and the first is the projection.
        let columns = DMatrix::from_row_slice(2, 2, &[1.0, 1.0, 0.0, 1.0]);
        let problem = NonNegative::new(columns, DVector::from_vec(vec![2.0, -1.0]));
        let minimum = problem.minimum(&[]);
        assert!((minimum.values[0] - 2.0).abs() < 1e-14 && minimum.values[1] == 0.0);
    }
}
