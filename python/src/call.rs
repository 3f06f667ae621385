//! The verbs of the command.

use std::{
    collections::HashMap,
    ffi::OsString,
    io,
    panic::resume_unwind,
    sync::{
        Arc,
        mpsc::{Receiver, RecvTimeoutError, channel},
    },
    thread::{self, JoinHandle},
    time::Duration,
};

use dashpot_cli::{Called, Host};
use pyo3::{prelude::*, types::PyList};

use crate::{
    failure::listed,
    watch::{Asking, PERIOD, Share},
};

/// What the command has for its stack as well \[B\].
const STACK: usize = 8 << 20;
/// So long work that is to end may take to notice.
const GRACE: Duration = Duration::from_secs(1);

/// The version of the engine.
#[pyfunction]
pub(crate) fn version() -> &'static str {
    env!("CARGO_PKG_VERSION")
}

/// An option: its name, whether it is repeated for each value, the SI unit of its numbers, and its words.
type VerbOption = (String, bool, &'static str, Vec<String>);

/// The options of a verb; `None` where there is no such verb.
#[pyfunction]
pub(crate) fn options(verb: &str) -> Option<Vec<VerbOption>> {
    let all = dashpot_cli::options(verb)?.into_iter();
    Some(all.map(|own| (own.name, own.is_repeated, own.unit, own.words)).collect())
}

/// Does what the command does with these arguments, which begin with the verb: the exit code, what it would have
/// printed, and what it said besides. A name in `texts` stands for a file with that text.
///
/// The work has a thread of its own, so that an interrupt is heard whatever it is at.
#[pyfunction]
#[pyo3(signature = (arguments, texts, progress=None))]
pub(crate) fn call(
    py: Python<'_>,
    arguments: Vec<String>,
    texts: HashMap<String, String>,
    progress: Option<Py<PyAny>>,
) -> PyResult<(u8, String, Bound<'_, PyList>)> {
    let asking = Asking::new(progress);
    let Called { status, output, said } = py.detach(|| {
        let share = Arc::new(Share::default());
        let told = Arc::clone(&share);
        let work = Work::begun(move || {
            let host = Host { texts, watch: Arc::new(move |own| told.tell(own)) };
            dashpot_cli::call(arguments.into_iter().map(OsString::from), host)
        })?;
        work.awaited(&share, &asking)
    })?;
    Ok((status, output, listed(py, &said)?))
}

/// Work that is under way.
pub(crate) struct Work<T> {
    thread: JoinHandle<()>,
    called: Receiver<T>,
}

impl<T: Default + Send + 'static> Work<T> {
    pub(crate) fn begun(work: impl FnOnce() -> T + Send + 'static) -> io::Result<Self> {
        let (sender, called) = channel();
        let thread = thread::Builder::new().name("dashpot".to_owned()).stack_size(STACK);
        let thread = thread.spawn(move || {
            // Nobody waits for what has been left alone.
            let _ = sender.send(work());
        })?;
        Ok(Self { thread, called })
    }

    /// What became of it. After an interrupt it has a while to end; what does not look up in that time is left alone,
    /// and nobody hears of it any more.
    pub(crate) fn awaited(self, share: &Share, asking: &Asking) -> PyResult<T> {
        loop {
            match self.called.recv_timeout(PERIOD) {
                Ok(called) => return Ok(called),
                Err(RecvTimeoutError::Timeout) => {
                    if let Err(error) = asking.ask(share.most()) {
                        share.end();
                        let _ = self.called.recv_timeout(GRACE);
                        return Err(error);
                    }
                }
                // It has panicked, and so does what called it.
                Err(RecvTimeoutError::Disconnected) => match self.thread.join() {
                    Err(payload) => resume_unwind(payload),
                    Ok(()) => return Ok(T::default()),
                },
            }
        }
    }
}
