//! What goes wrong, as the exceptions of the package.

use dashpot_cli::{Said, Tone};
use pyo3::{
    IntoPyObjectExt,
    prelude::*,
    types::{PyDict, PyList},
};

/// Where the exceptions are defined.
const MODULE: &str = "dashpot._errors";

/// A class of exceptions.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Kind {
    /// Wrong input.
    Input,
    /// A run that failed.
    Run,
}

/// What is said, as dictionaries.
pub(crate) fn listed<'py>(py: Python<'py>, said: &[Said]) -> PyResult<Bound<'py, PyList>> {
    let list = PyList::empty(py);
    for own in said {
        let entry = PyDict::new(py);
        let tone = match own.tone {
            Tone::Error => "error",
            Tone::Warning => "warning",
            Tone::Note => "note",
        };
        entry.set_item("tone", tone)?;
        entry.set_item("code", own.code)?;
        entry.set_item("message", &own.message)?;
        entry.set_item("help", &own.help)?;
        entry.set_item("file", &own.file)?;
        entry.set_item("line", own.place.map(|own| own.0))?;
        entry.set_item("column", own.place.map(|own| own.1))?;
        list.append(entry)?;
    }
    Ok(list)
}

/// The exception that tells it.
pub(crate) fn failure(py: Python<'_>, kind: Kind, said: &[Said]) -> PyErr {
    let class = match kind {
        Kind::Input => "SceneError",
        Kind::Run => "RunError",
    };
    let made = listed(py, said).and_then(|all| py.import(MODULE)?.getattr(class)?.call1((all,)));
    made.map_or_else(|error| error, PyErr::from_value)
}

/// The same for one sentence.
pub(crate) fn sentence(py: Python<'_>, kind: Kind, message: &str) -> PyErr {
    failure(py, kind, &[Said::plain(Tone::Error, message.to_owned())])
}

/// An array of `NumPy` with these values.
pub(crate) fn array<'py>(py: Python<'py>, values: &[f64]) -> PyResult<Bound<'py, PyAny>> {
    let bytes: Vec<u8> = values.iter().flat_map(|own| own.to_ne_bytes()).collect();
    let numpy = py.import("numpy")?;
    let bytes = pyo3::types::PyByteArray::new(py, &bytes).into_bound_py_any(py)?;
    numpy.call_method1("frombuffer", (bytes, "f8"))
}
