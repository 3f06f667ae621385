//! Bounded least squares: the only file that names the optimiser.
//!
//! The optimiser is given as many rows as there are unknowns, and one: with `[r J] = Q R` these have the same sums,
//! gradients and steps as all rows, and it decomposes no more than that. A robust sum is a plain one of residuals that
//! are drawn in.

use std::cell::RefCell;

use basin::{
    BoxBounds, ConstraintDescription, ConstraintSet, Constraints, DenseMatrix, Executor, Jacobian,
    Residual, TerminationCode, TrustRegionReflective,
};
use nalgebra::{DMatrix, DVector};

/// What is to be made small.
pub trait Residuals {
    /// Where a step lowers the sum by less than this part, the search has converged.
    fn cost_change(&self) -> f64 {
        COST_CHANGE
    }

    /// The residuals; numbers that are not finite where there are none.
    fn residual(&self, unknowns: &[f64]) -> Vec<f64>;

    /// Their derivatives, one column for each unknown.
    fn jacobian(&self, unknowns: &[f64]) -> DMatrix<f64>;

    /// Told before each step how many were made and what is left at the best of them, half the sum of squares or the
    /// robust sum; returns whether the search has to end there.
    fn is_stopped(&self, _steps: usize, _cost: f64) -> bool {
        false
    }
}

/// Where the search ended.
#[derive(Debug, Clone, PartialEq)]
pub struct Optimum {
    /// The unknowns.
    pub unknowns: Vec<f64>,
    /// Half the sum of squares, or the robust sum.
    pub cost: f64,
    /// Whether a test of convergence was met.
    pub is_converged: bool,
}

/// Steps of one search.
const MOST_STEPS: u64 = 100;
/// Convergence: part by which a step lowers the sum, and scaled gradient.
const COST_CHANGE: f64 = 1e-10;
const GRADIENT: f64 = 1e-12;
/// So many steps in a row, each a quarter of the one before, that lower no sum are a sign of a kink, or of rounding.
const MOST_REJECTED: usize = 10;

/// The least squares within bounds, from a start between them; with a robust scale residuals beyond it count by their
/// magnitude (Huber).
pub fn least_squares(
    problem: &dyn Residuals,
    [lower, upper]: [&[f64]; 2],
    start: &[f64],
    robust_scale: Option<f64>,
) -> Option<Optimum> {
    let unknowns = start.to_vec();
    let best = RefCell::new(Best { steps: 0, cost: f64::INFINITY, unknowns, rejected: 0 });
    let (low, high) = (lower.to_vec(), upper.to_vec());
    let bounded = Bounded { problem, lower: low, upper: high, robust_scale, best: &best };
    let solver = TrustRegionReflective::new()
        .with_absolute_scaled_gradient_tolerance(GRADIENT)
        .with_relative_cost_change_tolerance(problem.cost_change());
    let own = Executor::from_start(bounded, solver, start.to_vec()).max_iter(MOST_STEPS).run();
    let Ok(own) = own else {
        let Best { cost, unknowns, rejected, .. } = best.into_inner();
        // Of a refit nothing but its sum is asked for.
        let is_asked = problem.cost_change() <= COST_CHANGE;
        let is_converged = rejected > MOST_REJECTED
            && is_asked
            && is_settled(problem, [lower, upper], &unknowns, (robust_scale, cost));
        return cost.is_finite().then_some(Optimum { unknowns, cost, is_converged });
    };
    let (unknowns, cost) = (own.param().clone(), own.cost());
    let code = own.report.termination.code();
    let is_converged = match code {
        TerminationCode::MaxIter
        | TerminationCode::SolverFailed
        | TerminationCode::NumericalNoProgress => {
            is_settled(problem, [lower, upper], &unknowns, (robust_scale, cost))
        }
        _ => true,
    };
    cost.is_finite().then_some(Optimum { unknowns, cost, is_converged })
}

/// Half the sum of squares of residuals, or of what counts by its magnitude beyond a robust scale (Huber).
pub fn sum(left: &[f64], robust_scale: Option<f64>) -> f64 {
    let far = robust_scale.unwrap_or(f64::INFINITY);
    let counted = |own: f64| if own > far { far * (own - 0.5 * far) } else { 0.5 * own * own };
    left.iter().map(|own| counted(own.abs())).sum()
}

/// A minimum whose sum a step of Gauss and Newton would lower by less than this part is one, or by less than this part of
/// what a row adds to it: by a tenth of a standard deviation.
const SETTLED: f64 = 1e-7;
const OF_A_ROW: f64 = 1e-2;
/// So is one that no such step lowers by that part, nor half of it, and so on.
const HALVINGS: i32 = 8;
/// So is one whose unknowns that step would move by no more than this part of the room between their bounds: of exact
/// records what is left is rounding.
const SHORT: f64 = 1e-10;

/// Whether no step between the bounds lowers the sum any more, where rounding ended the search.
fn is_settled(
    problem: &dyn Residuals,
    [lower, upper]: [&[f64]; 2],
    unknowns: &[f64],
    (robust_scale, cost): (Option<f64>, f64),
) -> bool {
    let counted = |own: f64| robust_scale.map_or(own, |scale| own.clamp(-scale, scale));
    let left = problem.residual(unknowns).into_iter().map(counted).collect();
    let jacobian = problem.jacobian(unknowns);
    let gradient = jacobian.tr_mul(&DVector::from_vec(left));
    let is_free = |at: &usize| {
        let near = SETTLED * (upper[*at] - lower[*at]);
        unknowns[*at] > lower[*at] + near && unknowns[*at] < upper[*at] - near
    };
    let free: Vec<usize> = (0..unknowns.len()).filter(is_free).collect();
    let columns = jacobian.select_columns(&free);
    let mut normal = columns.tr_mul(&columns);
    let largest = if free.is_empty() { 0.0 } else { normal.diagonal().max() };
    (0..free.len()).for_each(|at| normal[(at, at)] += f64::EPSILON * largest);
    let right = DVector::from_iterator(free.len(), free.iter().map(|at| gradient[*at]));
    let step = normal.cholesky().map(|own| own.solve(&right));
    let part = SETTLED.max(OF_A_ROW / jacobian.nrows() as f64);
    let Some(step) = step else { return false };
    let mut moved = step.iter().zip(&free);
    if 0.5 * step.dot(&right) <= part * cost
        || moved.all(|(own, &at)| own.abs() <= SHORT * (upper[at] - lower[at]))
    {
        return true;
    }
    // At a kink slopes tell of a side that the step does not reach.
    let is_lower = |halvings: i32| {
        let mut beside = unknowns.to_vec();
        for (own, &at) in step.iter().zip(&free) {
            beside[at] = (beside[at] - own * 0.5_f64.powi(halvings)).clamp(lower[at], upper[at]);
        }
        sum(&problem.residual(&beside), robust_scale) < (1.0 - part) * cost
    };
    !(0..HALVINGS).any(is_lower)
}

/// The best that was met so far.
struct Best {
    steps: usize,
    cost: f64,
    unknowns: Vec<f64>,
    /// How many trials were no better since.
    rejected: usize,
}

/// Why a search ended before its end.
#[derive(Debug, thiserror::Error)]
#[error("stopped")]
struct Stopped;

/// The problem as the optimiser wants it.
struct Bounded<'p> {
    problem: &'p dyn Residuals,
    lower: Vec<f64>,
    upper: Vec<f64>,
    robust_scale: Option<f64>,
    best: &'p RefCell<Best>,
}

impl Bounded<'_> {
    /// The residuals, drawn in where a robust sum counts them by their magnitude, and by what part they then change.
    ///
    /// Of `ρ` it is `√(2 ρ(r))`, so that half of its square is `ρ`.
    fn drawn_in(&self, unknowns: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let left = self.problem.residual(unknowns);
        let far = self.robust_scale.unwrap_or(f64::INFINITY);
        let one = |own: &f64| {
            if own.abs() > far {
                let drawn = (far * (2.0 * own.abs() - far)).sqrt();
                (drawn.copysign(*own), far / drawn)
            } else {
                (*own, 1.0)
            }
        };
        left.iter().map(one).unzip()
    }
}

impl Constraints for Bounded<'_> {
    type Set = ConstraintSet<BoxBounds<Vec<f64>>>;

    fn constraints(&self) -> <Self::Set as ConstraintDescription>::Borrowed<'_> {
        ConstraintSet::new().with_bounds(BoxBounds::new(Some(&self.lower), Some(&self.upper)))
    }
}

impl Residual for Bounded<'_> {
    type Param = Vec<f64>;
    type Output = Vec<f64>;
    type Error = Stopped;

    fn residual(&self, unknowns: &Vec<f64>) -> Result<Vec<f64>, Stopped> {
        let mut all = vec![0.0; unknowns.len() + 1];
        let left = self.drawn_in(unknowns).0;
        let square = left.iter().map(|own| own * own).sum::<f64>();
        all[0] = square.sqrt();
        let mut best = self.best.borrow_mut();
        if 0.5 * square < best.cost {
            (best.cost, best.unknowns, best.rejected) = (0.5 * square, unknowns.clone(), 0);
        } else {
            best.rejected += 1;
        }
        if best.rejected > MOST_REJECTED { Err(Stopped) } else { Ok(all) }
    }
}

impl Jacobian for Bounded<'_> {
    type Jacobian = DenseMatrix;

    fn jacobian(&self, unknowns: &Vec<f64>) -> Result<DenseMatrix, Stopped> {
        let (steps, cost) = {
            let mut best = self.best.borrow_mut();
            best.steps += 1;
            (best.steps - 1, best.cost)
        };
        if self.problem.is_stopped(steps, cost) {
            return Err(Stopped);
        }
        // What was solved last is asked for first.
        let (left, slopes) = self.drawn_in(unknowns);
        let own = self.problem.jacobian(unknowns);
        let count = unknowns.len();
        let both =
            DMatrix::from_fn(left.len().max(count + 1), count + 1, |row, column| {
                match column.checked_sub(1) {
                    _ if row >= left.len() => 0.0,
                    None => left[row],
                    Some(column) => own[(row, column)] * slopes[row],
                }
            });
        let factor = both.qr().unpack_r();
        // The first column is that of the residuals, which are given as a positive number.
        let sign = if factor[(0, 0)] < 0.0 { -1.0 } else { 1.0 };
        let mut rows = Vec::with_capacity(count * (count + 1));
        for row in 0..=count {
            let sign = if row == 0 { sign } else { 1.0 };
            rows.extend((1..=count).map(|column| sign * factor[(row, column)]));
        }
        Ok(DenseMatrix::from_row_slice(count + 1, count, &rows))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `y = a e^(−b t) + c` at 40 times, with a row that is far off.
    struct Decay {
        outlier: f64,
    }

    impl Decay {
        fn times() -> impl Iterator<Item = f64> {
            (0..40).map(|at| 0.1 * f64::from(at))
        }
    }

    impl Residuals for Decay {
        fn residual(&self, unknowns: &[f64]) -> Vec<f64> {
            let [a, b, c] = [0, 1, 2].map(|at| unknowns[at]);
            let measured = |t: f64| 3.0 * (-1.3 * t).exp() + 0.5 + 0.01 * (7.0 * t).sin();
            let rows = Self::times().enumerate();
            rows.map(|(at, t)| {
                let outlier = if at == 20 { self.outlier } else { 0.0 };
                a * (-b * t).exp() + c - measured(t) - outlier
            })
            .collect()
        }

        fn jacobian(&self, unknowns: &[f64]) -> DMatrix<f64> {
            let [a, b] = [0, 1].map(|at| unknowns[at]);
            let times: Vec<f64> = Self::times().collect();
            DMatrix::from_fn(40, 3, |row, column| {
                let decayed = (-b * times[row]).exp();
                [decayed, -a * times[row] * decayed, 1.0][column]
            })
        }
    }

    /// The method of Levenberg and Marquardt with steps cut at the bounds: another way to the same minimum.
    fn levenberg(problem: &dyn Residuals, [lower, upper]: [&[f64]; 2], start: &[f64]) -> Vec<f64> {
        let square = |own: &[f64]| problem.residual(own).iter().map(|own| own * own).sum::<f64>();
        let (mut best, mut damping) = (start.to_vec(), 1e-2);
        for _ in 0..500 {
            let jacobian = problem.jacobian(&best);
            let gradient = jacobian.tr_mul(&DVector::from_vec(problem.residual(&best)));
            let is_held = |at: usize| {
                best[at] <= lower[at] && gradient[at] > 0.0
                    || best[at] >= upper[at] && gradient[at] < 0.0
            };
            let free: Vec<usize> = (0..best.len()).filter(|at| !is_held(*at)).collect();
            let normal = jacobian.tr_mul(&jacobian);
            let matrix = DMatrix::from_fn(free.len(), free.len(), |row, column| {
                let own = normal[(free[row], free[column])];
                if row == column { own * (1.0 + damping) } else { own }
            });
            let right = DVector::from_iterator(free.len(), free.iter().map(|at| -gradient[*at]));
            let Some(step) = matrix.lu().solve(&right) else { break };
            let mut next = best.clone();
            for (at, step) in free.iter().zip(step.iter()) {
                next[*at] = (next[*at] + step).clamp(lower[*at], upper[*at]);
            }
            if square(&next) < square(&best) {
                best = next;
                damping *= 0.3;
            } else {
                damping *= 4.0;
            }
        }
        best
    }

    #[test]
    fn both_ways_lead_to_the_same_minimum_within_bounds_and_on_them() {
        let problem = Decay { outlier: 0.0 };
        for upper in [[10.0, 10.0, 10.0], [10.0, 1.1, 10.0], [2.5, 10.0, 10.0]] {
            let bounds = [&[0.1, 0.01, 0.0][..], &upper[..]];
            for start in [[0.2, 0.1, 0.1], [2.4, 1.0, 4.0]] {
                let own = least_squares(&problem, bounds, &start, None).unwrap();
                let other = levenberg(&problem, bounds, &start);
                assert!(own.is_converged, "{own:?}");
                for (one, other) in own.unknowns.iter().zip(&other) {
                    assert!((one - other).abs() < 1e-4, "{own:?} {other:?}");
                }
            }
        }
    }

    #[test]
    fn a_row_that_is_far_off_does_not_pull_the_robust_minimum() {
        let bounds = [&[0.1, 0.01, 0.0][..], &[10.0; 3][..]];
        let at = |outlier: f64, scale| {
            least_squares(&Decay { outlier }, bounds, &[1.0, 1.0, 1.0], scale).unwrap().unknowns
        };
        let [clean, robust, plain] = [at(0.0, None), at(5.0, Some(0.02)), at(5.0, None)];
        let off = |own: &[f64]| {
            own.iter().zip(&clean).map(|(one, other)| (one - other).abs()).fold(0.0, f64::max)
        };
        assert!(off(&robust) < 0.01 && off(&plain) > 0.1, "{robust:?} {plain:?}");
    }
}
