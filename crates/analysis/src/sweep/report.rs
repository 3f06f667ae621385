//! What a sweep yields, and what can go wrong with it as a whole.

use std::time::Duration;

use thiserror::Error;

use super::SweepWarning;
use crate::{
    RunError,
    partial::{Cost, Neglected, PutBack},
};

/// What a sweep reports of each point.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    /// Key of the measure, for instance `padding.peak-force`.
    pub key: String,
    /// SI unit of the values.
    pub unit: &'static str,
    /// Whether the values are parts of the thickness of the element: of a peak deformation that is the
    /// `ξmax` of the thesis, which is 1 where the padding is pressed to nothing.
    pub is_share: bool,
}

/// A value that does not exist, or a point that could not be solved.
#[derive(Debug, Clone, PartialEq)]
pub struct Gap {
    /// The point.
    pub point: usize,
    /// The column; `None` where the whole point could not be solved.
    pub column: Option<usize>,
    /// Why.
    pub reason: String,
}

/// What a sweep yields.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepReport {
    /// What is reported of each point.
    pub columns: Vec<Column>,
    /// One value for each column of each point, in the order of the grid; NaN where there is none.
    pub values: Vec<f64>,
    /// The errors of those; NaN where there is no value, or its error is not known.
    pub errors: Vec<f64>,
    /// Why values are missing, in the order of the points.
    pub gaps: Vec<Gap>,
    /// What runs are warned of, one for each kind.
    pub warnings: Vec<SweepWarning>,
    /// How many points were instantiated; all others were solved in full.
    pub instantiated: usize,
    /// The instantiated points that were solved in full as well.
    pub checked: Vec<usize>,
    /// The largest difference there, in parts of the value.
    pub largest_difference: f64,
    /// What was left out, where the scene allows that.
    pub partial: Option<PartialOfSweep>,
    /// Wall-clock time.
    pub wall: Duration,
}

/// What was left out of a sweep.
#[derive(Debug, Clone, PartialEq)]
pub struct PartialOfSweep {
    /// The bound: the part of its size by which a measure may move.
    pub bound: f64,
    /// What was left out of all points, the largest influence at the first point first.
    pub left_out: Vec<Neglected>,
    /// What stayed although its estimate was below the bound.
    pub put_back: Vec<PutBack>,
    /// The points that were solved with and without it, rising.
    pub checked: Vec<usize>,
    /// The measure that moves the most at any of those.
    pub worst: Option<Cost>,
    /// Solutions that finding this out took.
    pub solves: usize,
    /// Wall-clock time that the whole sweep would take in full by as many threads, from the mean of the
    /// points that were solved in full.
    pub wall_in_full: Duration,
}

impl SweepReport {
    /// The values of a column, in the order of the grid.
    pub fn column(&self, column: usize) -> impl Iterator<Item = f64> + '_ {
        self.values.iter().skip(column).step_by(self.columns.len().max(1)).copied()
    }

    /// Widens the errors by the largest move that what was left out makes, and says what that was.
    pub(super) fn charge(&mut self, partial: PartialOfSweep) {
        if let Some(moved) = partial.worst.as_ref().map(Cost::most) {
            for (error, value) in self.errors.iter_mut().zip(&self.values) {
                *error += moved * value.abs();
            }
        }
        self.partial = Some(partial);
    }
}

/// Why there is no sweep.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SweepError {
    /// A fault of the scene at the first point, or of what is asked of it.
    #[error(transparent)]
    Run(#[from] RunError),
    /// The scene at the first point cannot be made.
    #[error("{0}")]
    NotPosed(String),
    /// An axis has no values, or there are too many points to count.
    #[error("an axis has no values, or all together have too many points")]
    NoPoints,
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
