//! One observer for many solutions, which bounds their work.

use std::ops::ControlFlow;

use dashpot_dae::{Observer, Progress, SolveError};

use crate::RunError;

/// Steps that are as much work as a part of a run of `exact` between two looks at it.
const EXACT: usize = 150;
/// Part of a run from which on its work is told from what has been done so far.
const EARLY: f64 = 0.05;
/// How many times as much as it may be that work must then promise to be: the beginning of a run may be the most of it.
const MORE: f64 = 4.0;

/// Tells an observer of many solutions as if they were one run, and gives up those of too many steps, or of
/// more work than is left for all of them together.
///
/// Work is counted in steps, so that what is given up is so on every machine.
pub(super) struct Watch<'o> {
    inner: &'o mut dyn Observer,
    /// Length of each run, and of that which the observer is told of \[s\].
    duration: f64,
    /// How many solutions there are in all.
    total: usize,
    /// How many lie behind.
    done: usize,
    most_steps: usize,
    /// The work of all solutions, and that before the present one.
    work: usize,
    before: usize,
    /// The most that it may come to in the end, and with the present solution.
    whole: usize,
    most_work: usize,
    /// What a step of the present solution is.
    weight: usize,
    given_up: Option<(Progress, Limit)>,
}

/// What a solution was too much for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Limit {
    Steps,
    Work,
}

impl<'o> Watch<'o> {
    /// Watches `total` solutions of `duration` \[s\], whose work may come to `whole` steps.
    pub(super) fn new(
        inner: &'o mut dyn Observer,
        duration: f64,
        total: usize,
        whole: usize,
    ) -> Self {
        Self {
            inner,
            duration,
            total: total.max(1),
            done: 0,
            most_steps: usize::MAX,
            work: 0,
            before: 0,
            whole,
            most_work: whole,
            weight: 1,
            given_up: None,
        }
    }

    /// Goes on to the solution of this number.
    pub(super) fn begin(&mut self, number: usize) {
        self.done = number;
    }

    /// Goes on to the next solution.
    pub(super) fn next(&mut self) {
        self.done += 1;
    }

    /// What all of the work may come to where one part of what is left, of so many, may be taken now.
    pub(super) fn share(&self, parts: usize) -> usize {
        self.work + self.whole.saturating_sub(self.work) / parts.max(1)
    }

    /// Looks at one solution by a method that is exact or not, of which more than so many steps are too many,
    /// and with which all of the work may come to this.
    pub(super) fn limited(
        &mut self,
        exact: bool,
        most_steps: usize,
        most_work: usize,
    ) -> &mut Self {
        (self.most_steps, self.most_work, self.given_up) = (most_steps, most_work, None);
        (self.weight, self.before) = (if exact { EXACT } else { 1 }, self.work);
        self
    }

    /// The work of all solutions so far.
    pub(super) fn work(&self) -> usize {
        self.work
    }

    /// The work of the solution that was looked at last.
    pub(super) fn last(&self) -> usize {
        self.work - self.before
    }

    /// Counts work that was done without being looked at.
    pub(super) fn charge(&mut self, work: usize) {
        self.work = self.work.saturating_add(work);
    }

    /// What a solution is too much for.
    fn exceeded(&self, within: f64, steps: usize) -> Option<Limit> {
        let (done, most) = (self.last() as f64, self.most_work.saturating_sub(self.before) as f64);
        let promised = if within >= EARLY { done / within } else { 0.0 };
        let is_too_much = self.work > self.most_work || promised > MORE * most;
        if is_too_much {
            Some(Limit::Work)
        } else {
            (steps > self.most_steps).then_some(Limit::Steps)
        }
    }

    /// The error of a solution in the words that suit: too many steps, or too much work, where it was given up here.
    pub(super) fn told(&mut self, method: &'static str, error: RunError) -> RunError {
        match (self.given_up.take(), &error) {
            (Some((own, limit)), RunError::Solve(SolveError::Cancelled { .. })) => {
                let Progress { time, steps } = own;
                match limit {
                    Limit::Steps => SolveError::TooManySteps { method, time, steps }.into(),
                    Limit::Work => RunError::TooMuchWork { method, time, most: self.whole },
                }
            }
            _ => error,
        }
    }
}

impl Observer for Watch<'_> {
    fn progress(&mut self, progress: Progress) -> ControlFlow<()> {
        self.charge(self.weight);
        let within = if self.duration > 0.0 { progress.time / self.duration } else { 1.0 };
        if let Some(limit) = self.exceeded(within, progress.steps) {
            self.given_up = Some((progress, limit));
            return ControlFlow::Break(());
        }
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
        let mut watch = Watch::new(&mut last, 2.0, 4, 1000);
        watch.begin(3);
        assert!(watch.progress(Progress { time: 1.0, steps: 7 }).is_continue());
        assert_eq!(last.0, Some(Progress { time: 1.75, steps: 7 }));
    }

    #[test]
    fn too_many_steps_are_told_from_being_cancelled() {
        let mut last = Last(None);
        let mut watch = Watch::new(&mut last, 2.0, 1, 1000);
        let cancelled = || RunError::from(SolveError::Cancelled { time: 1.0 });
        let limited = watch.limited(false, 10, usize::MAX);
        assert!(limited.progress(Progress { time: 1.0, steps: 11 }).is_break());
        let told = watch.told("bdf", cancelled());
        let expected = SolveError::TooManySteps { method: "bdf", time: 1.0, steps: 11 };
        assert_eq!(told, expected.into());
        assert_eq!(watch.told("bdf", cancelled()), cancelled());
    }

    #[test]
    fn work_that_promises_to_be_too_much_is_given_up_early() {
        let mut last = Last(None);
        let mut watch = Watch::new(&mut last, 2.0, 1, 20 * EXACT);
        let cancelled = || RunError::from(SolveError::Cancelled { time: 0.0 });
        let share = watch.share(2);
        assert_eq!(share, 10 * EXACT);
        let limited = watch.limited(true, usize::MAX, share);
        let mut at = |time: f64| limited.progress(Progress { time, steps: 0 });
        assert!(at(0.01).is_continue() && at(0.02).is_continue(), "nothing is known yet");
        assert!(at(0.2).is_continue(), "30 may be 40");
        assert!(at(0.11).is_break(), "4 of 10 in an eighteenth of the run");
        assert_eq!(watch.last(), 4 * EXACT);
        let error = watch.told("exact", cancelled());
        assert_eq!(error, RunError::TooMuchWork { method: "exact", time: 0.11, most: 20 * EXACT });
        watch.charge(100);
        let limited = watch.limited(false, usize::MAX, 4 * EXACT + 100);
        assert!(limited.progress(Progress { time: 2.0, steps: 1 }).is_break(), "nothing is left");
    }
}
