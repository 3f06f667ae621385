//! A bar for long runs.

use std::{
    ops::ControlFlow,
    time::{Duration, Instant},
};

use dashpot_dae::{Observer, Progress};
use dashpot_network::parameters::Dimension;
use dashpot_scene::units::format_quantity;
use indicatif::{ProgressBar, ProgressStyle};

/// Shorter runs have no bar.
const PATIENCE: Duration = Duration::from_millis(500);
/// Steps of the bar.
const PARTS: u64 = 1000;

/// Shows on standard error, where that is a terminal, how many of many things are done.
pub(crate) struct Count {
    what: &'static str,
    started: Instant,
    shown: Option<ProgressBar>,
    wanted: bool,
}

impl Count {
    /// A bar for some work; none if nobody sees it.
    pub(crate) fn new(what: &'static str, wanted: bool) -> Self {
        Self { what, started: Instant::now(), shown: None, wanted }
    }

    /// So many of so many are done.
    pub(crate) fn tell(&mut self, done: usize, of: usize) -> ControlFlow<()> {
        if self.wanted && (self.shown.is_some() || self.started.elapsed() > PATIENCE) {
            let bar = self.shown.get_or_insert_with(|| bar(self.what, of as u64));
            bar.set_position(done as u64);
            bar.set_message(format!("{done} of {of}"));
        }
        ControlFlow::Continue(())
    }
}

impl Drop for Count {
    fn drop(&mut self) {
        if let Some(bar) = &self.shown {
            bar.finish_and_clear();
        }
    }
}

/// A bar of so many parts with a word before it.
fn bar(word: &str, parts: u64) -> ProgressBar {
    let bar = ProgressBar::new(parts);
    if let Ok(style) = ProgressStyle::with_template("{prefix} {wide_bar} {msg}") {
        bar.set_style(style);
    }
    bar.set_prefix(word.to_owned());
    bar
}

/// Shows on standard error, where that is a terminal, how far a run has come.
pub(crate) struct Bar {
    method: String,
    end: f64,
    started: Instant,
    shown: Option<ProgressBar>,
    wanted: bool,
}

impl Bar {
    /// A bar for a run by `method` until `end` \[s\]; none if nobody sees it.
    pub(crate) fn new(method: &str, end: f64, wanted: bool) -> Self {
        Self { method: method.to_owned(), end, started: Instant::now(), shown: None, wanted }
    }
}

impl Observer for Bar {
    fn progress(&mut self, progress: Progress) -> ControlFlow<()> {
        if self.wanted && (self.shown.is_some() || self.started.elapsed() > PATIENCE) {
            if self.shown.is_none() {
                self.shown = Some(bar(&self.method, PARTS));
            }
            if let Some(bar) = &self.shown {
                let share = (progress.time / self.end).clamp(0.0, 1.0);
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "a share of 0 … 1000"
                )]
                bar.set_position((share * PARTS as f64) as u64);
                let time = format_quantity(progress.time, Dimension::TIME, 3);
                bar.set_message(format!("{time}, {} steps", progress.steps));
            }
        }
        ControlFlow::Continue(())
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        if let Some(bar) = &self.shown {
            bar.finish_and_clear();
        }
    }
}
