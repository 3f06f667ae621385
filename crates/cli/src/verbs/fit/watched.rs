//! How far a search has come, on standard error, and its end by an interrupt.

use std::{cell::RefCell, ops::ControlFlow};

use dashpot_fit::network::{Phase, Search};

use crate::{
    cancel::{is_interrupted, notice_interrupts},
    progress::Bar,
    terminal::Terminal,
};
use dashpot_report::numbers::significant;

/// Steps after which half of a search is thought to be done.
const HALF: f64 = 10.0;

/// Shows a search of so many tests.
pub(super) struct Progress {
    bar: RefCell<Bar>,
    tests: usize,
}

impl Progress {
    /// From now on interrupts end the search.
    pub(super) fn new(tests: usize, terminal: Terminal) -> Self {
        notice_interrupts();
        Self { bar: RefCell::new(Bar::new("fit", 0.0, terminal.error.attended)), tests }
    }

    /// Shows a search after so many runs.
    pub(super) fn show(&self, own: Search, runs: usize) -> ControlFlow<()> {
        if is_interrupted() {
            return ControlFlow::Break(());
        }
        let share = self.share(own);
        self.bar.borrow_mut().show(share, || words(own, (runs, share)))
    }

    /// The share that is done, if all starts, the refinement, the intervals and each test that is left out take the
    /// same time.
    fn share(&self, own: Search) -> f64 {
        let left_out = if self.tests > 1 { self.tests } else { 0 };
        let (done, starts) = match own.phase {
            Phase::Start { at, of } => (at, of),
            Phase::Refinement => (0, 0),
            Phase::Certainty => (1, 0),
            Phase::LeftOut { at, .. } => (2 + at, 0),
        };
        // Starts take the first half.
        let half = |done: f64, of: f64| 0.5 * (done + part(own.steps)) / of;
        match own.phase {
            Phase::Start { .. } => half(done as f64, starts as f64),
            _ => 0.5 + half(done as f64, (2 + left_out) as f64),
        }
    }
}

fn part(steps: usize) -> f64 {
    let steps = steps as f64;
    steps / (steps + HALF)
}

fn words(own: Search, (runs, share): (usize, f64)) -> String {
    let (steps, cost) = (own.steps, significant(own.cost, 3));
    let what = match own.phase {
        Phase::Start { at, of } => format!("start {} of {of}", at + 1),
        Phase::Refinement => "the best of them".to_owned(),
        Phase::Certainty => "intervals".to_owned(),
        Phase::LeftOut { at, of } => format!("without test {} of {of}", at + 1),
    };
    let of = if share > 0.0 { significant(runs as f64 / share, 2) } else { "?".to_owned() };
    format!("{what}, step {steps}, cost {cost}, run {runs} of about {of}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::When;

    #[test]
    fn shares_rise_from_the_first_start_to_the_last_test_that_is_left_out() {
        let progress = Progress {
            bar: RefCell::new(Bar::new("fit", 0.0, Terminal::new(When::Never).error.attended)),
            tests: 2,
        };
        let starts = (0..3).map(|at| Phase::Start { at, of: 3 });
        let left_out = (0..2).map(|at| Phase::LeftOut { at, of: 2 });
        let phases = starts.chain([Phase::Refinement, Phase::Certainty]).chain(left_out);
        let all = phases.flat_map(|phase| {
            [0, 5, 50].map(|steps| progress.share(Search { phase, steps, cost: 1.0 }))
        });
        let all: Vec<f64> = all.collect();
        assert!(all.is_sorted_by(|one, next| one < next), "{all:?}");
        assert!(all[0] == 0.0 && all[all.len() - 1] < 1.0, "{all:?}");
    }

    #[test]
    fn a_line_says_which_run_of_about_how_many_is_in_progress() {
        let search = Search { phase: Phase::Start { at: 1, of: 4 }, steps: 3, cost: 0.5 };
        assert_eq!(
            words(search, (30, 0.25)),
            "start 2 of 4, step 3, cost 0.500, run 30 of about 120"
        );
        assert!(words(search, (0, 0.0)).ends_with("run 0 of about ?"));
    }
}
