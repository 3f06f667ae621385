//! The plotting frame of a chart or map, and its axes.

use crate::axis::Axis;

/// Both ends of a straight line \[px\].
pub(crate) type Ends = [(f64, f64); 2];

/// The plotting frame and its axes \[px\].
pub(crate) struct Frame {
    pub(crate) left: f64,
    pub(crate) right: f64,
    pub(crate) top: f64,
    pub(crate) bottom: f64,
    pub(crate) x: Axis,
    pub(crate) y: Axis,
}

impl Frame {
    /// Where the point (`x`, `y`) of the data lies.
    pub(crate) fn at(&self, x: f64, y: f64) -> (f64, f64) {
        (
            self.left + self.x.fraction(x) * (self.right - self.left),
            self.bottom - self.y.fraction(y) * (self.bottom - self.top),
        )
    }
}
