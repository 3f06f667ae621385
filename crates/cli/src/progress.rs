//! A bar for long runs.

use std::{
    ops::ControlFlow,
    time::{Duration, Instant},
};

use dashpot_dae::{Observer, Progress};
use dashpot_network::parameters::Dimension;
use dashpot_scene::units::format_quantity;
use indicatif::{ProgressBar, ProgressFinish, ProgressStyle};

/// Shorter runs have no bar.
const PATIENCE: Duration = Duration::from_millis(500);
/// Steps of the bar.
const PARTS: u64 = 1000;

/// Shows on standard error, where that is a terminal, how far some work has come.
pub(crate) struct Bar {
    word: String,
    end: f64,
    started: Instant,
    shown: Option<ProgressBar>,
    wanted: bool,
}

impl Bar {
    /// A bar for work of this name, a run until `end` \[s\]; none if nobody sees it.
    pub(crate) fn new(word: &str, end: f64, wanted: bool) -> Self {
        Self { word: word.to_owned(), end, started: Instant::now(), shown: None, wanted }
    }

    /// Shows which share is done, with a word on it.
    pub(crate) fn show(&mut self, share: f64, message: impl FnOnce() -> String) -> ControlFlow<()> {
        if self.wanted && (self.shown.is_some() || self.started.elapsed() > PATIENCE) {
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
}

impl Observer for Bar {
    fn progress(&mut self, progress: Progress) -> ControlFlow<()> {
        self.show(progress.time / self.end, || {
            let time = format_quantity(progress.time, Dimension::TIME, 3);
            format!("{time}, {} steps", progress.steps)
        })
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
