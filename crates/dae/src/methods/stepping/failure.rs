//! The integrators' errors in our words.

use diffsol::{DiffsolError, error::OdeSolverError};

use super::balance::{Imbalance, undetermined};
use crate::{SolveError, System, UnknownKind};

/// Where and by whom something failed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Site<'a> {
    /// Name of the method.
    pub(super) method: &'static str,
    /// Time reached \[s\].
    pub(super) time: f64,
    /// What is solved.
    pub(super) system: &'a System,
}

/// Values beyond this overflow when they are squared in norms.
const LARGEST: f64 = 1e150;

impl Site<'_> {
    /// The error of an integrator that stood at `state` with `slopes`.
    pub(super) fn integrator(
        self,
        error: &DiffsolError,
        state: &[f64],
        slopes: &[f64],
    ) -> SolveError {
        let Self { method, time, .. } = self;
        if let Err(lost) = self.finite(state).and_then(|()| self.finite(slopes)) {
            return lost;
        }
        match error {
            DiffsolError::OdeSolverError(
                OdeSolverError::StepSizeTooSmall { .. }
                | OdeSolverError::TooManyErrorTestFailures { .. },
            ) => self.too_small(state, slopes),
            DiffsolError::OdeSolverError(OdeSolverError::TooManyNonlinearSolverFailures {
                ..
            })
            | DiffsolError::NonLinearSolverError(_) => SolveError::NewtonFailed { method, time },
            other => SolveError::Integrator { method, time, reason: other.to_string() },
        }
    }

    /// The step became too small, at `state` with `slopes`.
    pub(super) fn too_small(self, state: &[f64], slopes: &[f64]) -> SolveError {
        let Self { method, time, .. } = self;
        SolveError::StepTooSmall { method, time, unknown: self.fastest(state, slopes) }
    }

    /// Whether the structure of the system is one that has a solution.
    pub(super) fn structure(self) -> Result<(), SolveError> {
        let Self { method, system, .. } = self;
        let moves = |row: usize| system.unknowns[row].kind == UnknownKind::Differential;
        let reason = if let Some(term) = system.terms.iter().find(|term| moves(term.row)) {
            let name = self.name(term.row);
            format!("a term that is not linear stands in the row of `{name}`, which is no balance")
        } else if let Some(unknown) = undetermined(system) {
            format!("no balance determines `{}`", self.name(unknown))
        } else {
            return Ok(());
        };
        Err(SolveError::NotApplicable { method, reason })
    }

    /// The algebraic unknowns, which came out as `state`, have no consistent values or slopes.
    pub(super) fn imbalance(self, failure: Imbalance, state: &[f64]) -> SolveError {
        match failure {
            Imbalance::Singular => self.singular(state),
            Imbalance::Unsettled { unknown } => {
                SolveError::Inconsistent { time: self.time, unknown: self.name(unknown) }
            }
        }
    }

    /// The balances do not determine the algebraic unknowns, which came out as `state`.
    pub(super) fn singular(self, state: &[f64]) -> SolveError {
        let reason = match state.iter().position(|value| !value.is_finite()) {
            Some(unknown) => format!("the balances do not determine `{}`", self.name(unknown)),
            None => "the balances do not determine all of their unknowns".to_owned(),
        };
        SolveError::NotApplicable { method: self.method, reason }
    }

    /// Whether all `values` are finite, and small enough to be squared.
    pub(super) fn finite(self, values: &[f64]) -> Result<(), SolveError> {
        let fine = |value: &f64| value.abs() < LARGEST;
        if values.iter().all(fine) {
            return Ok(());
        }
        let lost = values.iter().position(|value| !fine(value)).unwrap_or_default();
        let Self { method, time, .. } = self;
        Err(SolveError::NotFinite { method, time, unknown: self.name(lost) })
    }

    /// The unknown with the largest slope in parts of its value.
    fn fastest(self, state: &[f64], slopes: &[f64]) -> String {
        let rate = |at: usize| slopes[at].abs() / (state[at].abs() + 1.0);
        let fastest = (0..slopes.len()).max_by(|&a, &b| rate(a).total_cmp(&rate(b)));
        fastest.map(|at| self.name(at)).unwrap_or_default()
    }

    fn name(self, unknown: usize) -> String {
        self.system.unknowns.get(unknown).map(|unknown| unknown.name.clone()).unwrap_or_default()
    }
}
