//! What can go wrong with a sweep as a whole.

use thiserror::Error;

use crate::RunError;

/// Why there is no sweep.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SweepError {
    /// A fault of the scene at the first point, or of what is asked of it.
    #[error(transparent)]
    Run(#[from] RunError),
    /// The scene at the first point cannot be posed.
    #[error("{0}")]
    NotPosed(String),
    /// A measure that the scene does not have.
    #[error("there is no measure `{key}`")]
    NoMeasure {
        /// What was asked for.
        key: String,
        /// What the scene reports.
        known: Vec<String>,
    },
    /// The scene reports nothing by itself, and nothing is asked for.
    #[error("the scene reports no measure by itself: name one")]
    NoneReported,
    /// The watcher broke it off.
    #[error("the sweep was broken off")]
    BrokenOff,
}
