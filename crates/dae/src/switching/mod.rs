//! Runs whose equations change: legs of one system each, joined at switchings.
//!
//! One layer serves every method. A leg is a [`System`] with guards that end it; whoever knows what
//! the equations stand for says which leg follows ([`Switching`]). Outputs have the same numbers in
//! all legs, so that a run of many legs still yields each of them as one [`Signal`](crate::Signal).

mod chain;
mod drive;
mod flight;
mod precision;
mod shaken;

use std::{fmt::Debug, sync::Arc};

use crate::{Guard, SolveError, Switch, System};

pub use drive::integrate;
pub use flight::Flight;

/// A part of a run with one set of equations.
#[derive(Debug, Clone)]
pub struct Leg {
    /// The equations, with time counted from the leg's start, and their initial values.
    pub system: Arc<System>,
    /// The phase of each switching part: its number, and what it remembers.
    pub phases: Vec<(usize, f64)>,
    /// What ends the leg.
    pub guards: Vec<Guard>,
    /// What switched as the leg began.
    pub switches: Vec<Switch>,
    /// The guard that ends the leg, where that is known already: no method need look for it.
    pub flight: Option<Flight>,
    /// The time in the run \[s\] at which the leg ends, whatever its guards say.
    pub until: Option<f64>,
}

/// The end of a leg at guards, or at the time at which it had to end.
#[derive(Debug, Clone, Copy)]
pub struct LegEnd<'a> {
    /// The leg.
    pub leg: &'a Leg,
    /// Time of its end in the run \[s\].
    pub time: f64,
    /// How long it lasted, in units of its system's time.
    pub length: f64,
    /// The unknowns at its end.
    pub state: &'a [f64],
    /// The guards at whose levels it ended.
    pub fired: &'a [usize],
    /// Size of the error of a quantity in parts of its terms: what is smaller cannot be told from
    /// zero.
    pub doubt: f64,
}

/// Knows the legs of a run.
pub trait Switching: Debug + Send + Sync {
    /// The leg with which a run begins. `doubt` is as in [`LegEnd::doubt`].
    ///
    /// # Errors
    ///
    /// [`SolveError::Switching`] where no leg is possible.
    fn first(&self, doubt: f64) -> Result<Leg, SolveError>;

    /// The leg that follows.
    ///
    /// # Errors
    ///
    /// [`SolveError::Switching`] where no leg is possible.
    fn next(&self, end: &LegEnd<'_>) -> Result<Leg, SolveError>;
}

#[cfg(test)]
mod tests;
