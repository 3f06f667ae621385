//! Energy taken up.

use dashpot_network::parameters::{InvalidParameter, Value, WindowWish};

use super::{Family, MeasureKind, Reading, UNDETERMINED_FORCE, reading::work, window};
use crate::Solution;

/// The energy that an element takes up, `∫ F ẏ dt` \[J\]: at the end of an impact what it has not
/// given back, be it stored or dissipated.
///
/// Where a prescribed motion or a load jumps, the jump of the stored energy is counted; where masses
/// meet in the element, the energy that the impact loses. What it holds as the run begins is not: of a load
/// or motion that is there from the start on, and of what has no mass, that is all that they do at once.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Energy {
    /// The part of the run that it looks at.
    pub window: WindowWish,
}

impl Default for Energy {
    fn default() -> Self {
        Self { window: WindowWish::Impact }
    }
}

impl MeasureKind for Energy {
    const KIND: &'static str = "energy";
    const SUMMARY: &'static str = "energy taken up by the element during the window [J]";
    const UNIT: &'static str = "J";
    const APPLIES_TO: Family = Family::Element;
    const BY_DEFAULT: bool = true;
    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        window(values, 0).map(|window| Self { window })
    }

    fn values(&self) -> Vec<Value> {
        vec![Value::Window(self.window)]
    }

    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        let connection = &solution.assembly().connections[target];
        if connection.force.is_none() {
            return Reading::undefined(UNDETERMINED_FORCE);
        }
        let span = match solution.element_impact(target).span(self.window, solution.end()) {
            Ok(span) => span,
            Err(note) => return Reading::undefined(note),
        };
        work(solution, target, &span)
    }
}
