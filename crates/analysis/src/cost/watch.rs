//! One observer for many solutions.

use std::ops::ControlFlow;

use dashpot_dae::{Observer, Progress, SolveError};

use crate::RunError;

/// Tells an observer of many solutions as if they were one run, and gives up those of too many steps.
pub(super) struct Watch<'o> {
    inner: &'o mut dyn Observer,
    /// Length of each run, and of that which the observer is told of \[s\].
    duration: f64,
    /// How many solutions there are in all.
    total: usize,
    /// How many lie behind.
    done: usize,
    most_steps: usize,
    given_up: Option<Progress>,
}

impl<'o> Watch<'o> {
    /// Watches `total` solutions of `duration` \[s\].
    pub(super) fn new(inner: &'o mut dyn Observer, duration: f64, total: usize) -> Self {
        let most_steps = usize::MAX;
        Self { inner, duration, total: total.max(1), done: 0, most_steps, given_up: None }
    }

    /// Goes on to the solution of this number.
    pub(super) fn begin(&mut self, number: usize) {
        self.done = number;
    }

    /// Goes on to the next solution.
    pub(super) fn next(&mut self) {
        self.done += 1;
    }

    /// Looks at one solution, of which more than so many steps are too many.
    pub(super) fn limited(&mut self, most_steps: usize) -> &mut Self {
        (self.most_steps, self.given_up) = (most_steps, None);
        self
    }

    /// The error of a solution in the words that suit: too many steps where it was given up here.
    pub(super) fn told(&mut self, method: &'static str, error: RunError) -> RunError {
        match (self.given_up.take(), &error) {
            (Some(Progress { time, steps }), RunError::Solve(SolveError::Cancelled { .. })) => {
                SolveError::TooManySteps { method, time, steps }.into()
            }
            _ => error,
        }
    }
}

impl Observer for Watch<'_> {
    fn progress(&mut self, progress: Progress) -> ControlFlow<()> {
        if progress.steps > self.most_steps {
            self.given_up = Some(progress);
            return ControlFlow::Break(());
        }
        let within = if self.duration > 0.0 { progress.time / self.duration } else { 1.0 };
        let share = (self.done as f64 + within.clamp(0.0, 1.0)) / self.total as f64;
        let time = self.duration * share.min(1.0);
        self.inner.progress(Progress { time, ..progress })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Last(Option<Progress>);
    impl Observer for Last {
        fn progress(&mut self, progress: Progress) -> ControlFlow<()> {
            self.0 = Some(progress);
            ControlFlow::Continue(())
        }
    }

    #[test]
    fn many_solutions_are_told_as_one() {
        let mut last = Last(None);
        let mut watch = Watch::new(&mut last, 2.0, 4);
        watch.begin(3);
        assert!(watch.progress(Progress { time: 1.0, steps: 7 }).is_continue());
        assert_eq!(last.0, Some(Progress { time: 1.75, steps: 7 }));
    }

    #[test]
    fn too_many_steps_are_told_from_being_cancelled() {
        let mut last = Last(None);
        let mut watch = Watch::new(&mut last, 2.0, 1);
        let cancelled = || RunError::from(SolveError::Cancelled { time: 1.0 });
        assert!(watch.limited(10).progress(Progress { time: 1.0, steps: 11 }).is_break());
        let told = watch.told("bdf", cancelled());
        let expected = SolveError::TooManySteps { method: "bdf", time: 1.0, steps: 11 };
        assert_eq!(told, expected.into());
        assert_eq!(watch.told("bdf", cancelled()), cancelled());
    }
}
