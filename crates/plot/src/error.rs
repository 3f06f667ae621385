//! What can go wrong while drawing.

use thiserror::Error;

/// A drawing that could not be made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PlotError {
    /// The drawing back-end refused a shape of the chart.
    #[error("chart `{title}` cannot be drawn: {reason}")]
    Backend {
        /// Title of the chart.
        title: String,
        /// The back-end's own words.
        reason: String,
    },
}
