//! The narrow waist's output.

use std::{fmt::Debug, time::Duration};

use crate::{Digest, Event, Signal, System};

/// How much work a run was.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Statistics {
    /// Steps accepted.
    pub accepted: usize,
    /// Steps tried and rejected.
    pub rejected: usize,
    /// Evaluations of the right-hand side.
    pub rhs_calls: usize,
    /// Evaluations of the Jacobian.
    pub jacobian_calls: usize,
    /// Matrix factorisations.
    pub factorizations: usize,
    /// Linear systems solved.
    pub linear_solves: usize,
    /// Wall-clock time \[s\].
    pub wall: Duration,
}

impl Statistics {
    /// Adds the work of a part of the run, but for its wall-clock time.
    pub(crate) fn add(&mut self, part: &Self) {
        self.accepted += part.accepted;
        self.rejected += part.rejected;
        self.rhs_calls += part.rhs_calls;
        self.jacobian_calls += part.jacobian_calls;
        self.factorizations += part.factorizations;
        self.linear_solves += part.linear_solves;
    }
}

/// How a run that went well came to its end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Outcome {
    /// It reached the end of its time span.
    Finished,
    /// A guard stopped it.
    Stopped {
        /// Index into [`Run::guards`](crate::Run::guards).
        guard: usize,
    },
}

/// Something that switched.
#[derive(Debug, Clone, PartialEq)]
pub struct Switch {
    /// When \[s\].
    pub time: f64,
    /// Number of the switching part.
    pub part: usize,
    /// Its name.
    pub name: String,
    /// Number of the phase that begins; the one that ended, where an impact left it as it was.
    pub phase: usize,
    /// The word for that phase, or for the impact.
    pub what: &'static str,
    /// What the phase remembers.
    pub memory: f64,
    /// Impulse of an impact \[N s\]; 0 where speeds did not jump.
    pub impulse: f64,
    /// Kinetic energy lost by an impact \[J\].
    pub lost: f64,
    /// Work that a moving support does in an impact \[J\].
    pub worked: f64,
}

/// A solution between its ends.
pub trait Dense: Debug + Send + Sync {
    /// The output of this number as a function of time, in SI units, over the whole run. One that is
    /// not [kept](Self::keeps) is not a number throughout.
    fn signal(&self, system: &System, output: usize) -> Signal;

    /// Whether [`rate`](Self::rate) tells more than the slopes of the signal.
    fn has_rates(&self) -> bool {
        false
    }

    /// The derivative of an output with respect to time \[unit/s\], panel by panel: jumps leave no trace in
    /// it. It has a bound of its error where the solution tells it by itself.
    fn rate(&self, system: &System, output: usize) -> Signal {
        self.signal(system, output).derivative()
    }

    /// An output or, of order 1, its rate at these `times` \[s\] in SI units, from the left: but for rounding those of the
    /// signal, or nearer to the solution than its slopes; `None` where the signal is the way to them.
    fn values(
        &self,
        _system: &System,
        _output: usize,
        _order: usize,
        _times: &[f64],
    ) -> Option<Vec<f64>> {
        None
    }

    /// All unknowns, dimensionless, at each of the dimensionless `times` (rising, within the run):
    /// one row of `n` values after another. Empty for a run of several intervals, each of which has
    /// unknowns of its own, and where only a part is kept.
    fn sample(&self, system: &System, times: &[f64]) -> Vec<f64>;

    /// Whether the output of this number can be asked for.
    fn keeps(&self, _system: &System, _output: usize) -> bool {
        true
    }

    /// What is known of all outputs where only a part of them is kept.
    fn digest(&self) -> Option<&Digest> {
        None
    }

    /// How much longer a run of several intervals would have to be for a switching that may have
    /// come before its end, by the error of the method, to be seen \[s\].
    fn end_margin(&self) -> Option<f64> {
        None
    }

    /// Whether the intervals of a run may be others where [errors at events](crate::Run::errors_at_events) are smaller.
    fn hangs_on_threshold(&self) -> bool {
        false
    }

    /// Gives back memory that was taken so that further signals are quicker; they are as good without. Before the first
    /// signal it says that little is to be taken. What other solutions share stays.
    fn forget(&self) {}

    /// Memory that the solution takes \[B\], where it grows with the steps.
    fn bytes(&self) -> usize {
        0
    }
}

/// The result of a run.
#[derive(Debug)]
pub struct Trajectory {
    /// Name of the method that made it.
    pub method: &'static str,
    /// How it ended.
    pub outcome: Outcome,
    /// Time at its end \[s\].
    pub t_end: f64,
    /// Crossings of guards, in order of time.
    pub events: Vec<Event>,
    /// The phase of each switching part at the start: its number, and what it remembers.
    pub first_phases: Vec<(usize, f64)>,
    /// What switched, in order of time.
    pub switches: Vec<Switch>,
    /// Work done.
    pub statistics: Statistics,
    /// The solution itself.
    pub dense: Box<dyn Dense>,
}

impl Trajectory {
    /// The output number `output` of `system` as a function of time, in SI units.
    ///
    /// # Panics
    ///
    /// When `system` is not the one that was solved and has fewer outputs.
    pub fn signal(&self, system: &System, output: usize) -> Signal {
        self.dense.signal(system, output)
    }

    /// Whether the output number `output` can be asked for: the run has [kept](crate::Keep) it.
    pub fn keeps(&self, system: &System, output: usize) -> bool {
        self.dense.keeps(system, output)
    }

    /// What is known of all outputs, where the run has [kept](crate::Keep) a part of them only.
    pub fn digest(&self) -> Option<&Digest> {
        self.dense.digest()
    }
}
