//! What is asked of a method.

use std::ops::ControlFlow;

use crate::Guard;

/// What a method is asked to do with a [`System`](crate::System).
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// End of the time span \[s\]; it begins at 0. Zero is allowed.
    pub t_end: f64,
    /// Relative tolerance of the method, which is also the absolute one in units of each unknown's
    /// scale. `exact` has no use for it. Range 1e-13 … 1e-1.
    pub rtol: f64,
    /// Conditions to watch.
    pub guards: Vec<Guard>,
}

impl Run {
    /// A run to `t_end` \[s\] at the relative tolerance 1e-6 that watches nothing.
    pub fn to(t_end: f64) -> Self {
        Self { t_end, rtol: 1e-6, guards: Vec::new() }
    }

    /// The same run at another tolerance.
    #[must_use]
    pub fn with_rtol(self, rtol: f64) -> Self {
        Self { rtol, ..self }
    }
}

/// How far a run has come.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Time reached \[s\].
    pub time: f64,
    /// Steps accepted so far.
    pub steps: usize,
}

/// Looks at a run while it is under way, and may end it.
pub trait Observer {
    /// Called after each accepted step; `Break` ends the run with
    /// [`SolveError::Cancelled`](crate::SolveError::Cancelled).
    fn progress(&mut self, progress: Progress) -> ControlFlow<()>;
}

/// The observer that looks away.
#[derive(Debug, Clone, Copy, Default)]
pub struct Silent;

impl Observer for Silent {
    fn progress(&mut self, _progress: Progress) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}
