//! dashpot from Python: the engine of the package, which adds what is Python's own.
//!
//! Scenes and runs are held here; the verbs are called as the command is, with texts in place of files.

mod arrow;
mod call;
mod failure;
mod report;
mod scene;
mod study;
mod watch;

use pyo3::pymodule;

/// The engine of the package `dashpot`.
#[pymodule]
mod _dashpot {
    #[pymodule_export]
    use crate::arrow::Columns;
    #[pymodule_export]
    use crate::call::{call, options, version};
    #[pymodule_export]
    use crate::report::{Measure, Report};
    #[pymodule_export]
    use crate::scene::{Scene, opened};
    #[pymodule_export]
    use crate::study::{ask, studies};
}
