//! The register of methods.

mod auto;
mod exact;
mod schemes;
mod stepping;

pub use auto::Auto;
pub use exact::Exact;
pub use schemes::{Bdf, Dop853, Esdirk34, TrBdf2, Tsit45};

pub use stepping::derivatives;

use std::fmt::Debug;

use crate::{Observer, Run, Shared, SolveError, System, Trajectory};

/// See [`Method::fall`]: orders 2 to 5 give 2/3 to 5/6.
const FALL: f64 = 0.8;

/// Integrates a [`System`] over a time span.
pub trait Method: Debug + Send + Sync {
    /// Its name on the command line, for instance `bdf`.
    fn name(&self) -> &'static str;

    /// What it is good for, in one line.
    fn summary(&self) -> &'static str;

    /// Whether it can solve `system` over `run`, and if so why it is a fit (one clause, shown in the report).
    ///
    /// # Errors
    ///
    /// [`SolveError::NotApplicable`] with the reason.
    fn applies(&self, system: &System, run: &Run) -> Result<String, SolveError>;

    /// Whether its only error is rounding, so that its signals carry a bound.
    fn is_exact(&self) -> bool {
        false
    }

    /// The power of its tolerance with which its errors fall about, for a method that has one. Error
    /// bars are calibrated with it.
    fn fall(&self) -> f64 {
        FALL
    }

    /// Runs from the initial state to `run.t_end`, or to the first guard that stops it.
    ///
    /// # Errors
    ///
    /// Any [`SolveError`]; a trajectory is returned only if every number in it is finite.
    fn integrate(
        &self,
        system: &System,
        run: &Run,
        observer: &mut dyn Observer,
    ) -> Result<Trajectory, SolveError>;

    /// The same of an interval of a run, which shares with those before it what they have alike.
    ///
    /// # Errors
    ///
    /// As [`integrate`](Self::integrate).
    fn integrate_interval(
        &self,
        system: &System,
        run: &Run,
        _shared: &mut Shared,
        observer: &mut dyn Observer,
    ) -> Result<Trajectory, SolveError> {
        self.integrate(system, run, observer)
    }
}

/// What a method says about itself.
pub trait MethodKind: Method + Default + 'static {
    /// Its name on the command line.
    const KIND: &'static str;
    /// The power of the step with which its error falls, the highest one where it varies; `None` for
    /// a method that takes no steps.
    const ORDER: Option<u8> = None;
}

/// A method in the register.
#[derive(Debug)]
pub struct MethodEntry {
    /// Its name on the command line.
    pub name: &'static str,
    /// As in [`MethodKind`].
    pub order: Option<u8>,
    /// The method.
    pub make: fn() -> Box<dyn Method>,
}

const fn method<M: MethodKind>() -> MethodEntry {
    MethodEntry { name: M::KIND, order: M::ORDER, make: || Box::new(M::default()) }
}

/// Every method. **A new method is registered here.**
pub static METHODS: &[MethodEntry] = &[
    method::<Auto>(),
    method::<Bdf>(),
    method::<TrBdf2>(),
    method::<Esdirk34>(),
    method::<Tsit45>(),
    method::<Dop853>(),
    method::<Exact>(),
];

/// Every method of the register, in its order.
pub fn all() -> Vec<Box<dyn Method>> {
    METHODS.iter().map(|own| (own.make)()).collect()
}

/// The method of this name on the command line.
pub fn by_name(name: &str) -> Option<Box<dyn Method>> {
    all().into_iter().find(|method| method.name() == name)
}

/// Checks what every method asks of a run.
/// Errors: [`SolveError::InvalidSetting`] for an end that is negative or not finite.
fn check(system: &System, run: &Run) -> Result<(), SolveError> {
    let setting = |setting, range, value| SolveError::InvalidSetting { setting, range, value };
    if !(run.t_end >= 0.0 && run.t_end.is_finite()) {
        return Err(setting("t_end", "zero or positive, and finite", run.t_end));
    }
    if !(system.time_scale > 0.0 && (run.t_end / system.time_scale).is_finite()) {
        return Err(setting("time_scale", "positive, and finite", system.time_scale));
    }
    match run.guards.iter().find(|guard| guard.output >= system.outputs.len()) {
        Some(guard) => Err(setting("guard", "about an output of the system", guard.output as f64)),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests;
