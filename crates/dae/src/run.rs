//! What is asked of a method.

use std::{ops::ControlFlow, sync::Arc};

use crate::{Budget, Guard, System};

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
    pub tolerance_scaling: Vec<f64>,
    /// Conditions to watch.
    pub guards: Vec<Guard>,
    /// What the trajectory is to keep.
    pub keep: Keep,
    /// How much work it may be.
    pub budget: Budget,
    /// Whether errors of its signals will be asked for: of several intervals they take a second solution.
    pub is_bounded: bool,
    /// Errors of a method with steps at events, in parts of its tolerance: what is smaller cannot be told from zero there.
    pub errors_at_events: f64,
}

/// What a trajectory keeps of a solution.
#[derive(Debug, Clone, Default, PartialEq)]
pub enum Keep {
    /// All of it, so that every output can be asked for: memory grows with unknowns times steps.
    #[default]
    Everything,
    /// A part of it, and a [`Digest`](crate::Digest) of the rest: memory grows with the unknowns of the part times
    /// steps, and with all unknowns. Runs of several intervals, and methods that take no steps, keep everything.
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
            tolerance_scaling: Vec::new(),
            guards: Vec::new(),
            keep: Keep::Everything,
            budget: Budget::default(),
            is_bounded: true,
            errors_at_events: 1e2,
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

/// What is known of all outputs of a run that [keeps](crate::Keep) a part of them only: their values
/// at both ends, and what was to be summed up on the way.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Digest {
    pub(crate) first: Instant,
    pub(crate) last: Instant,
    /// One entry for each pair of [`Part::products`](crate::Part::products), in its order.
    pub products: Vec<Product>,
    /// The jumps of the outputs in [`Part::jumps`](crate::Part::jumps), in order of time; what cannot
    /// be told from rounding is none.
    pub jumps: Vec<Jump>,
}

/// All unknowns and inputs at one time, dimensionless.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Instant {
    pub(crate) state: Vec<f64>,
    pub(crate) inputs: Vec<f64>,
}

/// The integral of the product of two outputs over time, in SI units.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Product {
    /// The integral over the whole run.
    pub total: f64,
    /// The largest value that it has at the end of any step; at least 0.
    pub largest: f64,
}

/// A jump of an output where a driving function may jump.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jump {
    /// When \[s\].
    pub time: f64,
    /// Index into [`System::outputs`].
    pub output: usize,
    /// The value just before, in SI units.
    pub before: f64,
    /// The value just after.
    pub after: f64,
}

impl Digest {
    /// The values of the output number `output` at the start and at the end of the run, in SI units.
    ///
    /// # Panics
    ///
    /// When `system` is not the one that was solved.
    pub fn ends(&self, system: &System, output: usize) -> [f64; 2] {
        [&self.first, &self.last].map(|instant| instant.value(system, output))
    }
}

impl Instant {
    /// The inputs on the piece that holds at `piece_time`, with all unknowns, at the dimensionless `time`.
    pub(crate) fn new(system: &System, state: Vec<f64>, (piece_time, time): (f64, f64)) -> Self {
        let mut inputs = vec![0.0; system.inputs.len()];
        system.inputs_at(piece_time, time, &mut inputs);
        Self { state, inputs }
    }

    /// An output in SI units.
    pub(crate) fn value(&self, system: &System, output: usize) -> f64 {
        let output = system.outputs.at(output);
        output.scale * (output.unknowns.at(&self.state) + output.inputs.at(&self.inputs))
    }

    /// The size of an output's terms in SI units, which its rounding follows.
    pub(crate) fn magnitude(&self, system: &System, output: usize) -> f64 {
        let output = system.outputs.at(output);
        let terms =
            output.unknowns.magnitude_at(&self.state) + output.inputs.magnitude_at(&self.inputs);
        output.scale.abs() * terms
    }
}
