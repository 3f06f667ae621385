//! Peak displacement.

use dashpot_network::parameters::{InvalidParameter, Value, WindowWish};

use super::{Family, MeasureKind, Reading, reading::peak, window};
use crate::Solution;

/// The largest magnitude of a node's displacement, `max |x(t)|` \[m\], with its time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PeakDisplacement {
    /// The part of the run that it looks at.
    pub window: WindowWish,
}

impl Default for PeakDisplacement {
    fn default() -> Self {
        Self { window: WindowWish::Impact }
    }
}

impl MeasureKind for PeakDisplacement {
    const KIND: &'static str = "peak-displacement";
    const SUMMARY: &'static str = "largest magnitude of the displacement [m]";
    const UNIT: &'static str = "m";
    const APPLIES_TO: Family = Family::Node;

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        window(values, 0).map(|window| Self { window })
    }

    fn values(&self) -> Vec<Value> {
        vec![Value::Window(self.window)]
    }

    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        let span = match solution.node_impact(target).span(self.window, solution.end()) {
            Ok(span) => span,
            Err(note) => return Reading::undefined(note),
        };
        peak(solution.signal(solution.assembly().nodes[target].position), &span)
    }
}
