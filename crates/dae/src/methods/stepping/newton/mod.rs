//! Values of the algebraic unknowns that satisfy the balances.

use dashpot_numerics::roots::bisect;

use super::{
    algebra::Algebra,
    balance::{Balance, Imbalance},
    equations::Equations,
    terms::Slopes,
};

/// Newton steps in a row; those towards a root where a power law is flat gain only a share each.
const STEPS: usize = 200;
/// Halvings after which a Newton step is given up.
const HALVINGS: i32 = 40;
/// Decrease of the residual that is asked for, in parts of the one that the linear model promises.
const DECREASE: f64 = 1e-4;
/// Sweeps over the terms.
const SWEEPS: usize = 40;
/// Doublings in the search of a bracket, and halvings of a bracket.
const BRACKETINGS: usize = 200;
/// Residuals below this many times their rounding error are zero.
const ROUNDING: f64 = 8.0;

/// How a Newton iteration ended.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Ended {
    Settled,
    Stuck,
    Singular,
}

/// Replaces the algebraic entries of `state` by those that satisfy the balances at the start of the
/// span that `equations` have entered, and makes the balance ready for [`slopes`](Balance::slopes).
pub(super) fn consistent<M: Algebra>(
    balance: &mut Balance<M>,
    equations: &Equations<'_, M>,
    state: &mut [f64],
) -> Result<(), Imbalance> {
    if balance.is_linear() {
        return Ok(balance.solve(equations, equations.driven(0), state)?);
    }
    settle(balance, equations, state)?;
    for kind in [Slopes::Own, Slopes::Filled] {
        balance.linearise(equations, state, kind);
        if balance.direction(&vec![1.0; state.len()]).is_some() {
            return Ok(());
        }
    }
    Err(Imbalance::Singular)
}

/// The same where terms are not linear.
///
/// Newton's method with a line search on the residuals, down to their rounding. Where it gets stuck,
/// because a law is steep or flat, the terms are settled one after the other, each by a bracketed
/// search along the line on which all other balances stay as they are to first order. A single term
/// is thereby solved for certain if its balance changes sign.
fn settle<M: Algebra>(
    balance: &mut Balance<M>,
    equations: &Equations<'_, M>,
    state: &mut [f64],
) -> Result<(), Imbalance> {
    let mut search = Search {
        weights: equations.row_sums(state),
        residual: vec![0.0; state.len()],
        state: state.to_vec(),
        balance,
        equations,
    };
    search.evaluate();
    let mut ended = search.newton();
    for _ in 0..SWEEPS {
        if ended == Ended::Settled {
            state.copy_from_slice(&search.state);
            return Ok(());
        }
        if !search.sweep() && ended == Ended::Singular {
            break;
        }
        ended = search.newton();
    }
    Err(match ended {
        Ended::Settled => {
            state.copy_from_slice(&search.state);
            return Ok(());
        }
        Ended::Singular => Imbalance::Singular,
        Ended::Stuck => Imbalance::Unsettled { unknown: search.worst().0 },
    })
}

struct Search<'b, 's, M: Algebra> {
    balance: &'b mut Balance<M>,
    equations: &'b Equations<'s, M>,
    state: Vec<f64>,
    /// The right-hand sides at `state`; those of the balances are to vanish.
    residual: Vec<f64>,
    /// Sums of the coefficients of each row.
    weights: Vec<f64>,
}

impl<M: Algebra> Search<'_, '_, M> {
    fn evaluate(&mut self) {
        self.equations.evaluate(0.0, &self.state, &mut self.residual);
    }

    /// The size of all residuals together.
    fn merit(&self) -> f64 {
        let part = |&row: &usize| (self.residual[row] / self.weights[row]).powi(2);
        self.balance.algebraic().iter().map(part).sum::<f64>().sqrt()
    }

    /// The balance with the largest residual in parts of its rounding error, and this ratio.
    fn worst(&self) -> (usize, f64) {
        let sizes = self.equations.sizes(&self.state);
        let ratio = |row: usize| {
            let residual = self.residual[row].abs();
            if residual == 0.0 { 0.0 } else { residual / (f64::EPSILON * sizes[row]) }
        };
        let rows = self.balance.algebraic().iter().map(|&row| (row, ratio(row)));
        rows.fold(
            (0, 0.0),
            |worst, own| if own.1 > worst.1 || own.1.is_nan() { own } else { worst },
        )
    }

    fn newton(&mut self) -> Ended {
        for _ in 0..STEPS {
            let merit = self.merit();
            if merit == 0.0 {
                return Ended::Settled;
            }
            let settled = self.worst().1 <= ROUNDING;
            self.balance.linearise(self.equations, &self.state, Slopes::Filled);
            let right: Vec<f64> = self.residual.iter().map(|value| -value).collect();
            let step = self.balance.direction(&right);
            let moved = step.as_ref().is_some_and(|step| self.advance(step, merit));
            match (settled, moved) {
                (true, _) => return Ended::Settled,
                (false, false) if step.is_none() => return Ended::Singular,
                (false, false) => return Ended::Stuck,
                (false, true) => {}
            }
        }
        Ended::Stuck
    }

    /// Takes the largest part of `step` that lessens the residuals, if there is one.
    fn advance(&mut self, step: &[f64], merit: f64) -> bool {
        let from = self.state.clone();
        for halving in 0..HALVINGS {
            let part = 0.5_f64.powi(halving);
            self.along(&from, step, part);
            if self.merit() <= (1.0 - DECREASE * part) * merit {
                return true;
            }
        }
        self.state = from;
        self.evaluate();
        false
    }

    /// Goes to `from + part · direction`.
    fn along(&mut self, from: &[f64], direction: &[f64], part: f64) {
        for ((value, from), direction) in self.state.iter_mut().zip(from).zip(direction) {
            *value = from + part * direction;
        }
        self.evaluate();
    }

    /// Settles the balances with terms one after the other. Returns whether there was a way for any.
    fn sweep(&mut self) -> bool {
        self.balance.linearise(self.equations, &self.state, Slopes::Coarse);
        let mut rows: Vec<usize> =
            self.equations.system().terms.iter().map(|term| term.row).collect();
        rows.sort_unstable();
        rows.dedup();
        let mut found = false;
        for row in rows {
            let mut unit = vec![0.0; self.state.len()];
            unit[row] = 1.0;
            if let Some(direction) = self.balance.direction(&unit) {
                found = true;
                self.relax(row, &direction);
            }
        }
        found
    }

    /// Makes the residual of `row` zero by going along `direction`, where its sign changes there.
    fn relax(&mut self, row: usize, direction: &[f64]) {
        let from = self.state.clone();
        let first = self.residual[row];
        if first == 0.0 || !first.is_finite() {
            return;
        }
        // The coarse slope of the residual along the direction is one.
        let Some((near, far)) =
            [-first, first].into_iter().find_map(|step| self.bracket(row, &from, direction, step))
        else {
            self.along(&from, direction, 0.0);
            return;
        };
        let (near, far) = bisect(near, far, BRACKETINGS, |part| {
            self.along(&from, direction, part);
            self.residual[row] == 0.0 || self.residual[row].signum() != first.signum()
        });
        self.along(&from, direction, near);
        let left = self.residual[row].abs();
        self.along(&from, direction, far);
        if left < self.residual[row].abs() {
            self.along(&from, direction, near);
        }
    }

    /// Two places on the line, from `step` on ever farther away, between which the residual of `row` changes sign.
    fn bracket(
        &mut self,
        row: usize,
        from: &[f64],
        direction: &[f64],
        step: f64,
    ) -> Option<(f64, f64)> {
        self.along(from, direction, 0.0);
        let first = self.residual[row];
        let (mut near, mut far) = (0.0, step);
        for _ in 0..BRACKETINGS {
            self.along(from, direction, far);
            let residual = self.residual[row];
            if residual.is_nan() {
                return None;
            }
            if residual == 0.0 || residual.signum() != first.signum() {
                return Some((near, far));
            }
            (near, far) = (far, 2.0 * far);
        }
        None
    }
}

#[cfg(test)]
mod tests;
