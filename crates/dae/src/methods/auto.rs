//! The choice of a method.

use super::{Bdf, Exact};
use crate::{Method, MethodKind, Observer, Run, SolveError, System, Trajectory};

/// Chooses a method by structure and size, never by the clock, so that a run repeats to the bit.
///
/// The rule: [`Exact`] wherever it applies, because nothing is more accurate or faster there; else
/// [`Bdf`], which solves every system. The one-step methods are left to those who ask for them: what
/// they do better, lightly damped oscillation of linear systems, [`Exact`] does best.
#[derive(Debug, Clone, Copy, Default)]
pub struct Auto;

impl Auto {
    /// The method for `system` over `run`, and why.
    pub fn choose(system: &System, run: &Run) -> (Box<dyn Method>, String) {
        match Exact.applies(system, run) {
            Ok(why) => (Box::new(Exact), why),
            Err(SolveError::NotApplicable { method, reason }) => {
                (Box::new(Bdf), format!("`{method}` declines: {reason}"))
            }
            Err(other) => (Box::new(Bdf), other.to_string()),
        }
    }
}

impl Method for Auto {
    fn name(&self) -> &'static str {
        Self::KIND
    }

    fn summary(&self) -> &'static str {
        "chooses: `exact` wherever it applies, else `bdf`"
    }

    fn applies(&self, system: &System, run: &Run) -> Result<String, SolveError> {
        let (method, why) = Self::choose(system, run);
        Ok(format!("`{}`: {why}", method.name()))
    }

    fn integrate(
        &self,
        system: &System,
        run: &Run,
        observer: &mut dyn Observer,
    ) -> Result<Trajectory, SolveError> {
        Self::choose(system, run).0.integrate(system, run, observer)
    }
}

impl MethodKind for Auto {
    const KIND: &'static str = "auto";
}
