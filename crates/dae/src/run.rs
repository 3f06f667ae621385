//! What is asked of a method.

use std::{ops::ControlFlow, sync::Arc};

use crate::{Budget, Guard};

/// What a method is asked to do with a [`System`](crate::System).
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// End of the time span \[s\]; it begins at 0. Zero is allowed.
    pub t_end: f64,
    /// Relative tolerance of the method, which is also the absolute one in parts of each unknown's size.
    /// `exact` has no use for it. Range 1e-13 … 1e-1.
    pub rtol: f64,
    /// The size of each unknown that the absolute tolerance is a part of, in parts of its scale, positive;
    /// 1 where there is none. `exact` has no use for it.
    pub nominal: Vec<f64>,
    /// Conditions to watch.
    pub guards: Vec<Guard>,
    /// What the trajectory is to keep.
    pub keep: Keep,
    /// How much work it may be.
    pub budget: Budget,
}

/// What a trajectory keeps of a solution.
#[derive(Debug, Clone, Default, PartialEq)]
pub enum Keep {
    /// All of it, so that every output can be asked for: memory grows with unknowns times steps.
    #[default]
    Everything,
    /// A part of it, and a [`Digest`](crate::Digest) of the rest: memory grows with the unknowns of
    /// the part times steps, and with all unknowns. Runs of several intervals, and methods that
    /// take no steps, keep everything.
    Part(Arc<Part>),
}

/// The part of a solution that is kept, and what is summed up over all of it on the way. Every number
/// is an index into [`System::outputs`](crate::System::outputs).
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Part {
    /// Outputs that can be asked for as functions of time; those of guards need not be named.
    pub outputs: Vec<usize>,
    /// Pairs of outputs of which the integral of their product over time is wanted.
    pub products: Vec<[usize; 2]>,
    /// Outputs whose jumps at breakpoints of the driving functions are wanted.
    pub jumps: Vec<usize>,
}

impl Run {
    /// A run to `t_end` \[s\] at the relative tolerance 1e-6 that watches nothing, of any work.
    pub fn to(t_end: f64) -> Self {
        Self {
            t_end,
            rtol: 1e-6,
            nominal: Vec::new(),
            guards: Vec::new(),
            keep: Keep::Everything,
            budget: Budget::default(),
        }
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
