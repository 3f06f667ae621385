//! Runs whose equations change: mode intervals of one system each, joined at switchings.
//!
//! One layer serves every method. An interval is a [`System`] with guards that end it; whoever
//! knows what the equations stand for says which interval follows ([`Switching`]). Outputs have the
//! same numbers in all intervals, so that a run of many intervals still yields each of them as one
//! [`Signal`](crate::Signal).

mod chain;
mod drive;
mod precision;
mod predicted;

use std::{fmt::Debug, sync::Arc};

use crate::{Guard, SolveError, Switch, System};

pub use drive::integrate;
pub use predicted::PredictedEvent;

/// A part of a run with one set of equations.
#[derive(Debug, Clone)]
pub struct ModeInterval {
    /// The equations, with time counted from the interval's start, and their initial values.
    pub system: Arc<System>,
    /// The phase of each switching part: its number, and what it remembers.
    pub phases: Vec<(usize, f64)>,
    /// What ends the interval.
    pub guards: Vec<Guard>,
    /// What switched as the interval began.
    pub switches: Vec<Switch>,
    /// The guard that ends the interval, where that is known already: no method need look for it.
    pub predicted: Option<PredictedEvent>,
    /// The time in the run \[s\] at which the interval ends, whatever its guards say.
    pub until: Option<f64>,
    /// How many choices of phases were tried until these held.
    pub tried: usize,
    /// Whether others would have held, had the threshold been much smaller.
    pub hangs_on_threshold: bool,
}

/// The end of an interval at guards, or at the time at which it had to end.
#[derive(Debug, Clone, Copy)]
pub struct IntervalEnd<'a> {
    /// The interval.
    pub interval: &'a ModeInterval,
    /// Time of its end in the run \[s\].
    pub time: f64,
    /// How long it lasted, in units of its system's time.
    pub length: f64,
    /// The unknowns at its end.
    pub state: &'a [f64],
    /// The guards at whose levels it ended.
    pub fired: &'a [usize],
    /// Size of the error of a quantity in parts of its terms: what is smaller cannot be told from zero.
    pub threshold: f64,
}

/// Knows the intervals of a run.
pub trait Switching: Debug + Send + Sync {
    /// The interval with which a run begins. `threshold` is as in [`IntervalEnd::threshold`].
    ///
    /// # Errors
    ///
    /// [`SolveError::Switching`] where no interval is possible.
    fn first(&self, threshold: f64) -> Result<ModeInterval, SolveError>;

    /// The interval that follows.
    ///
    /// # Errors
    ///
    /// [`SolveError::Switching`] where no interval is possible.
    fn next(&self, end: &IntervalEnd<'_>) -> Result<ModeInterval, SolveError>;
}

#[cfg(test)]
mod tests;
