//! The verbs of the command.

use std::{collections::HashMap, ffi::OsString};

use dashpot_cli::{Called, Host};
use pyo3::{prelude::*, types::PyList};

use crate::{failure::listed, watch::Watcher};

/// The version of the engine.
#[pyfunction]
pub(crate) fn version() -> &'static str {
    env!("CARGO_PKG_VERSION")
}

/// Does what the command does with these arguments, which begin with the verb: the exit code, what it would have
/// printed, and what it said besides. A name in `texts` stands for a file with that text.
#[pyfunction]
#[pyo3(signature = (arguments, texts, progress=None))]
pub(crate) fn call(
    py: Python<'_>,
    arguments: Vec<String>,
    texts: HashMap<String, String>,
    progress: Option<Py<PyAny>>,
) -> PyResult<(u8, String, Bound<'_, PyList>)> {
    let (mut watcher, raised) = Watcher::new(progress);
    let Called { status, output, said } = py.detach(move || {
        let host = Host { texts, watch: Box::new(move |share| watcher.look(share)) };
        dashpot_cli::call(arguments.into_iter().map(OsString::from), host)
    });
    match raised.take() {
        Some(error) => Err(error),
        None => Ok((status, output, listed(py, &said)?)),
    }
}
