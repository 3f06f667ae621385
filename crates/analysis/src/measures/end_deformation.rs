//! Deformation at the end.

use dashpot_network::parameters::{InvalidParameter, Value, WindowWish};

use super::{Family, MeasureKind, Reading, reading::end_value, window};
use crate::Solution;

/// An element's deformation at the end of the window, `y(t_end)` \[m\], positive in compression.
/// At the end of an impact it is what the pad has not yet sprung back.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EndDeformation {
    /// The part of the run that it looks at.
    pub window: WindowWish,
}

impl Default for EndDeformation {
    fn default() -> Self {
        Self { window: WindowWish::Impact }
    }
}

impl MeasureKind for EndDeformation {
    const KIND: &'static str = "end-deformation";
    const SUMMARY: &'static str = "deformation at the end of the window [m]";
    const UNIT: &'static str = "m";
    const APPLIES_TO: Family = Family::Element;

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        window(values, 0).map(|window| Self { window })
    }

    fn values(&self) -> Vec<Value> {
        vec![Value::Window(self.window)]
    }

    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        let span = match solution.element_impact(target).span(self.window, solution.end()) {
            Ok(span) => span,
            Err(note) => return Reading::undefined(note),
        };
        end_value(solution.signal(solution.assembly().connections[target].deformation), &span)
    }
}
