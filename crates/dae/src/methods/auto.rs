//! The choice of a method.

use super::{Bdf, Dop853, Exact, stepping::is_stiff};
use crate::{Method, MethodKind, Observer, Run, Shared, SolveError, System, Trajectory};

/// Most unknowns of a system that is solved by an explicit method: of many it costs more to watch the stiffness
/// than steps are saved.
const MOST_EXPLICIT: usize = 30;
/// Linear systems of more unknowns than this are watched by a bound, which costs next to nothing.
const LEAST_BOUNDED: usize = 200;

/// Chooses a method by structure and size, never by the clock, so that a run repeats to the bit.
///
/// The rule: [`Exact`] wherever it applies, because nothing is more accurate or faster there; else
/// [`Dop853`], with few steps, where the system is small or a long chain without damping, and not stiff at the start; else
/// [`Bdf`], which solves every system. What becomes stiff later [`Dop853`] leaves to [`Bdf`] by itself. The other one-step methods are
/// left to those who ask for them.
#[derive(Debug, Clone, Copy, Default)]
pub struct Auto;

impl Auto {
    /// The method for `system` over `run`, and why.
    pub fn choose(system: &System, run: &Run) -> (Box<dyn Method>, String) {
        let declined = match Exact.applies(system, run) {
            Ok(why) => return (Box::new(Exact), why),
            Err(SolveError::NotApplicable { method, reason }) => {
                format!("`{method}` declines: {reason}")
            }
            Err(other) => return (Box::new(Bdf), other.to_string()),
        };
        let length = run.t_end / system.time_scale;
        let is_explicit =
            Self::allows_explicit(system, run) && !is_stiff(system, &system.initial, (0.0, length));
        (if is_explicit { Box::new(Dop853) } else { Box::new(Bdf) }, declined)
    }

    /// Whether a system is of a size of which it leaves to [`Dop853`] what is not stiff.
    pub fn allows_explicit(system: &System, run: &Run) -> bool {
        let is_few = system.len() <= MOST_EXPLICIT || system.len() > LEAST_BOUNDED;
        is_few && Dop853.applies(system, run).is_ok()
    }
}

impl Method for Auto {
    fn name(&self) -> &'static str {
        Self::KIND
    }

    fn summary(&self) -> &'static str {
        "chooses: `exact` wherever it applies, else `dop853` or, for what is large or stiff, `bdf`"
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

    fn integrate_interval(
        &self,
        system: &System,
        run: &Run,
        shared: &mut Shared,
        observer: &mut dyn Observer,
    ) -> Result<Trajectory, SolveError> {
        Self::choose(system, run).0.integrate_interval(system, run, shared, observer)
    }
}

impl MethodKind for Auto {
    const KIND: &'static str = "auto";
}
