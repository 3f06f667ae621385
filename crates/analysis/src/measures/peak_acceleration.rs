//! Peak acceleration.

use dashpot_network::parameters::{InvalidParameter, Value, WindowWish};

use super::{
    Family, MASSLESS, MeasureKind, Needs, Reading,
    reading::{infinite, peak},
    window,
};
use crate::Solution;

/// The largest magnitude of what an accelerometer on a body reads, `max |Σ F_contact|/m` \[m/s²\],
/// with its time; free fall is 0. Where the speed jumps, it is infinite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PeakAcceleration {
    /// The part of the run that it looks at.
    pub window: WindowWish,
}

impl Default for PeakAcceleration {
    fn default() -> Self {
        Self { window: WindowWish::Impact }
    }
}

impl MeasureKind for PeakAcceleration {
    const KIND: &'static str = "peak-acceleration";
    const SUMMARY: &'static str = "largest magnitude of what an accelerometer reads [m/s^2]";
    const UNIT: &'static str = "m/s^2";
    const APPLIES_TO: Family = Family::Node;
    const NEEDS: Needs = Needs::Acceleration;
    const BY_DEFAULT: bool = true;
    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        window(values, 0).map(|window| Self { window })
    }

    fn values(&self) -> Vec<Value> {
        vec![Value::Window(self.window)]
    }

    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        let Some(acceleration) = solution.assembly().nodes[target].acceleration else {
            return Reading::undefined(MASSLESS);
        };
        let span = match solution.node_impact(target).span(self.window, solution.end()) {
            Ok(span) => span,
            Err(note) => return Reading::undefined(note),
        };
        infinite(&span, &solution.node_blows(target))
            .unwrap_or_else(|| peak(solution.signal(acceleration), &span))
    }
}
