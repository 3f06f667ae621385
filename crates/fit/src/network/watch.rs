//! How far a search has come, for whoever waits for it and may end it.

use std::{cell::Cell, ops::ControlFlow};

/// What is being done.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// The search from a start, by its number from 0, of so many.
    Start {
        /// Its number.
        at: usize,
        /// How many there are.
        of: usize,
    },
    /// The search from the best of them with rows counted by what is left.
    Refinement,
    /// Intervals.
    Certainty,
    /// The fit to all tests but this one, by its number from 0, of so many.
    LeftOut {
        /// Its number.
        at: usize,
        /// How many there are.
        of: usize,
    },
}

/// How far a search has come.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Search {
    /// What is being done.
    pub phase: Phase,
    /// Steps of this search so far.
    pub steps: usize,
    /// Half the sum of squares that is left at the best of them, or the robust sum; in the first phase residuals are
    /// parts of the peaks of the tests, then standard deviations of their noise.
    pub cost: f64,
}

/// What is told before each step; where it breaks, the search ends with the best so far.
pub type Watch<'w> = dyn Fn(Search) -> ControlFlow<()> + 'w;

/// Who watches, and whether it broke.
pub(super) struct Watched<'w> {
    watch: &'w Watch<'w>,
    phase: Cell<Phase>,
    is_stopped: Cell<bool>,
}

impl<'w> Watched<'w> {
    pub(super) fn new(watch: &'w Watch<'w>) -> Self {
        let phase = Cell::new(Phase::Start { at: 0, of: 1 });
        Self { watch, phase, is_stopped: Cell::new(false) }
    }

    /// Something else begins; returns whether it still may.
    pub(super) fn begin(&self, phase: Phase) -> bool {
        self.phase.set(phase);
        !self.is_stopped.get()
    }

    pub(super) fn is_stopped(&self) -> bool {
        self.is_stopped.get()
    }

    /// Tells of a step; returns whether the search has to end.
    pub(super) fn step(&self, steps: usize, cost: f64) -> bool {
        let own = Search { phase: self.phase.get(), steps, cost };
        if !self.is_stopped.get() && (self.watch)(own).is_break() {
            self.is_stopped.set(true);
        }
        self.is_stopped.get()
    }
}
