//! How far long work has come: a bar, or where nobody sees one a line now and then.

use std::{
    ops::ControlFlow,
    time::{Duration, Instant},
};

use dashpot_dae::{Observer, Progress};
use dashpot_network::parameters::Dimension;
use dashpot_scene::units::format_quantity;
use dashpot_studies::Progress as Advance;
use dashpot_units::percent;
use indicatif::{ProgressBar, ProgressFinish, ProgressStyle};

use crate::{host, terminal::note};
use dashpot_report::numbers::duration;

/// Shorter runs have no bar.
const PATIENCE: Duration = Duration::from_millis(500);
/// Without a terminal a line is written after so long, and then whenever the time has doubled.
const FIRST: Duration = Duration::from_secs(10);
const PARTS: u64 = 1000;

/// Shows on standard error how far some work has come.
pub(crate) struct Bar {
    word: String,
    end: f64,
    started: Instant,
    shown: Option<ProgressBar>,
    is_seen: bool,
    next: Duration,
    /// The number of the solution, and the time that it has reached \[s\].
    solution: (usize, f64),
}

impl Bar {
    /// A bar for work of this name, a run until `end` \[s\]; lines if nobody sees it.
    pub(crate) fn new(word: &str, end: f64, is_seen: bool) -> Self {
        let (word, started) = (word.to_owned(), Instant::now());
        Self { word, end, started, shown: None, is_seen, next: FIRST, solution: (1, 0.0) }
    }

    /// Shows which share is done, with a word on it.
    pub(crate) fn show(&mut self, share: f64, message: impl FnOnce() -> String) -> ControlFlow<()> {
        if let Some(answer) = host::progress(share.clamp(0.0, 1.0)) {
            return answer;
        }
        let elapsed = self.started.elapsed();
        if !self.is_seen {
            if self.is_due(elapsed) {
                let (word, done) = (&self.word, percent(share.clamp(0.0, 1.0), 2));
                note(&format!("{word}: {done} after {}, {}", duration(elapsed), message()));
            }
        } else if self.shown.is_some() || elapsed > PATIENCE {
            let bar = self.shown.get_or_insert_with(|| bar(&self.word));
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a share of 0 … 1000"
            )]
            bar.set_position((share.clamp(0.0, 1.0) * PARTS as f64) as u64);
            bar.set_message(message());
        }
        ControlFlow::Continue(())
    }

    /// Shows that `done` of so many are done.
    pub(crate) fn count(&mut self, done: usize, of: usize) -> ControlFlow<()> {
        self.show(done as f64 / of as f64, || format!("{done} of {of}"))
    }

    /// Shows how far a study has come.
    pub(crate) fn progress_of(&mut self, progress: Advance) -> ControlFlow<()> {
        match progress {
            Advance::Count { done, of } => self.count(done, of),
            Advance::Solution { time, end, steps } => self.solution(time, end, steps),
            _ => ControlFlow::Continue(()),
        }
    }

    /// Shows how far a solution until `end` has come. Errors are estimated from further solutions, each of which begins
    /// anew, and whose measures are read at its end.
    fn solution(&mut self, time: f64, end: f64, steps: usize) -> ControlFlow<()> {
        let (number, before) = self.solution;
        let number = number + usize::from(time < before);
        self.solution = (number, time);
        self.show(time / end, || {
            let what = if time < end { "solving" } else { "reading" };
            let time = format_quantity(time, Dimension::TIME, 3);
            format!("{what} solution {number} at {time}, {steps} steps")
        })
    }

    /// Whether a line is due after so long.
    fn is_due(&mut self, elapsed: Duration) -> bool {
        let is_due = elapsed > self.next;
        if is_due {
            self.next = 2 * elapsed;
        }
        is_due
    }
}

impl Observer for Bar {
    fn progress(&mut self, Progress { time, steps }: Progress) -> ControlFlow<()> {
        self.solution(time, self.end, steps)
    }
}

/// A bar with a word before it, which is cleared at its end.
fn bar(word: &str) -> ProgressBar {
    let bar = ProgressBar::new(PARTS).with_finish(ProgressFinish::AndClear);
    if let Ok(style) = ProgressStyle::with_template("{prefix} {wide_bar} {msg}") {
        bar.set_style(style);
    }
    bar.set_prefix(word.to_owned());
    bar
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solutions_that_begin_anew_are_counted() {
        let mut bar = Bar::new("auto", 1.0, false);
        for time in [0.2, 0.9, 1.0, 1.0, 0.1, 0.1, 1.0, 0.3] {
            assert!(bar.progress(Progress { time, steps: 1 }).is_continue());
        }
        assert_eq!(bar.solution.0, 3);
    }

    #[test]
    fn lines_become_rarer_as_work_goes_on() {
        let mut bar = Bar::new("sweep", 0.0, false);
        let due = (0..400).filter(|&at| bar.is_due(Duration::from_secs(at)));
        assert_eq!(due.collect::<Vec<_>>(), [11, 23, 47, 95, 191, 383]);
    }
}
