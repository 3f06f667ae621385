//! Long work that an interrupt of Python ends.

use std::{
    ops::ControlFlow,
    sync::atomic::{AtomicBool, AtomicU64, Ordering},
    time::{Duration, Instant},
};

use dashpot_dae::{Observer, Progress};
use pyo3::prelude::*;

/// So often the interpreter is asked whether there was an interrupt.
pub(crate) const PERIOD: Duration = Duration::from_millis(50);

/// The share of some work that is done, which never falls, and whether the work is to end.
#[derive(Debug, Default)]
pub(crate) struct Share {
    /// The bits of a number from 0 to 1, which are in its order.
    most: AtomicU64,
    is_ended: AtomicBool,
}

impl Share {
    /// That this share is done; `Break` where the work is to end.
    pub(crate) fn tell(&self, share: f64) -> ControlFlow<()> {
        self.most.fetch_max(within(share).to_bits(), Ordering::Relaxed);
        if self.is_ended.load(Ordering::Relaxed) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }

    /// The largest share that was told, 0 … 1.
    pub(crate) fn most(&self) -> f64 {
        f64::from_bits(self.most.load(Ordering::Relaxed))
    }

    /// The work is to end.
    pub(crate) fn end(&self) {
        self.is_ended.store(true, Ordering::Relaxed);
    }
}

/// A share within its bounds, 0 … 1; what is not a number is nothing.
fn within(share: f64) -> f64 {
    if share > 0.0 { share.min(1.0) } else { 0.0 }
}

/// Asks the interpreter whether work goes on, and tells it how far that is.
pub(crate) struct Asking(Option<Py<PyAny>>);

impl Asking {
    /// One that tells `told`, where it is given.
    pub(crate) fn new(told: Option<Py<PyAny>>) -> Self {
        Self(told)
    }

    /// What an interrupt or what is told raises.
    pub(crate) fn ask(&self, share: f64) -> PyResult<()> {
        Python::attach(|py| {
            py.check_signals()?;
            if let Some(told) = &self.0 {
                told.call1(py, (share,))?;
            }
            Ok(())
        })
    }
}

/// A run that asks now and then, and keeps what that raises. Every solution of it is thought to be half of what is
/// left to do.
pub(crate) struct OfRun {
    next: Instant,
    asking: Asking,
    /// When the run ends \[s\].
    end: f64,
    /// Solutions that were before, and how far this one is.
    solutions: i32,
    part: f64,
    pub(crate) raised: Option<PyErr>,
}

impl OfRun {
    /// That of a run until `end` \[s\].
    pub(crate) fn new(asking: Asking, end: f64) -> Self {
        let next = Instant::now() + PERIOD;
        Self { next, asking, end, solutions: 0, part: 0.0, raised: None }
    }

    /// The share that is done once a solution has come to this part.
    fn share(&mut self, part: f64) -> f64 {
        let part = within(part);
        if part < self.part {
            self.solutions += 1;
        }
        self.part = part;
        1.0 - 0.5_f64.powi(self.solutions) * (1.0 - 0.5 * part)
    }
}

impl Observer for OfRun {
    fn progress(&mut self, progress: Progress) -> ControlFlow<()> {
        let share = self.share(progress.time / self.end);
        let now = Instant::now();
        if now < self.next {
            return ControlFlow::Continue(());
        }
        self.next = now + PERIOD;
        match self.asking.ask(share) {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                self.raised = Some(error);
                ControlFlow::Break(())
            }
        }
    }
}
