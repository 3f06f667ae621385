//! The plotting frame of a chart.

use super::canvas::Fault;
use crate::axis::Axis;

/// Both ends of a straight line \[px\].
pub(super) type Ends = [(f64, f64); 2];
/// What drawing answers.
pub(super) type Drawn = Result<(), Fault>;

/// The plotting frame and its axes \[px\].
pub(super) struct Frame {
    pub(super) left: f64,
    pub(super) right: f64,
    pub(super) top: f64,
    pub(super) bottom: f64,
    pub(super) x: Axis,
    pub(super) y: Axis,
}

impl Frame {
    pub(super) fn at(&self, x: f64, y: f64) -> (f64, f64) {
        (
            self.left + self.x.fraction(x) * (self.right - self.left),
            self.bottom - self.y.fraction(y) * (self.bottom - self.top),
        )
    }
}
