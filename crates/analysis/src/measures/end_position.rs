//! Displacement at the end.

use dashpot_network::parameters::{InvalidParameter, Value, WindowWish};

use super::{Family, MeasureKind, Reading, reading::end_value, window};
use crate::Solution;

/// A node's displacement at the end of the window, `x(t_end)` \[m\], positive towards the support.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EndPosition {
    /// The part of the run that it looks at.
    pub window: WindowWish,
}

impl Default for EndPosition {
    fn default() -> Self {
        Self { window: WindowWish::Impact }
    }
}

impl MeasureKind for EndPosition {
    const KIND: &'static str = "end-position";
    const SUMMARY: &'static str = "displacement at the end of the window [m]";
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
        end_value(solution.signal(solution.assembly().nodes[target].position), &span)
    }
}
