//! Long work that an interrupt of Python ends.

use std::{
    ops::ControlFlow,
    sync::{Arc, Mutex, PoisonError},
    time::{Duration, Instant},
};

use dashpot_dae::{Observer, Progress};
use pyo3::prelude::*;

/// So often the interpreter is asked whether there was an interrupt.
const PERIOD: Duration = Duration::from_millis(50);

/// Asks the interpreter now and then, and keeps what it raises.
pub(crate) struct Watcher {
    next: Instant,
    told: Option<Py<PyAny>>,
    raised: Raised,
}

/// What was raised while work was under way.
#[derive(Debug, Clone, Default)]
pub(crate) struct Raised(Arc<Mutex<Option<PyErr>>>);

impl Raised {
    /// What it is.
    pub(crate) fn take(&self) -> Option<PyErr> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}

impl Watcher {
    /// One that tells `told`, where it is given, which share is done.
    pub(crate) fn new(told: Option<Py<PyAny>>) -> (Self, Raised) {
        let raised = Raised::default();
        (Self { next: Instant::now() + PERIOD, told, raised: raised.clone() }, raised)
    }

    /// Whether to go on; `share` is done.
    pub(crate) fn look(&mut self, share: f64) -> ControlFlow<()> {
        let now = Instant::now();
        if now < self.next {
            return ControlFlow::Continue(());
        }
        self.next = now + PERIOD;
        let asked = Python::attach(|py| {
            py.check_signals()?;
            self.told.as_ref().map(|own| own.call1(py, (share,))).transpose()
        });
        match asked {
            Ok(_) => ControlFlow::Continue(()),
            Err(error) => {
                *self.raised.0.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
                ControlFlow::Break(())
            }
        }
    }
}

/// A run until `end` \[s\].
pub(crate) struct OfRun(pub(crate) Watcher, pub(crate) f64);

impl Observer for OfRun {
    fn progress(&mut self, progress: Progress) -> ControlFlow<()> {
        self.0.look(progress.time / self.1)
    }
}
