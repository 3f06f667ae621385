//! Transmitted force.

use dashpot_network::parameters::{InvalidParameter, Value, WindowWish};

use super::{
    Family, MeasureKind, Reading, UNDETERMINED_FORCE,
    reading::{infinite, peak, peaks_below_zero},
    window,
};
use crate::Solution;

/// The largest magnitude of the force that an element passes on at the second of its ends,
/// `max |F(t)|` \[N\], with its time; a peak in tension is noted.
///
/// It is the peak force but in pads of layers with mass, through which the force travels: there it
/// comes later and has another size. Where masses meet in the element and speeds jump, it is infinite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TransmittedForce {
    /// The part of the run that it looks at.
    pub window: WindowWish,
}

impl Default for TransmittedForce {
    fn default() -> Self {
        Self { window: WindowWish::Impact }
    }
}

impl MeasureKind for TransmittedForce {
    const KIND: &'static str = "transmitted-force";
    const SUMMARY: &'static str =
        "largest magnitude of the force at the second end, behind all layers [N]";
    const UNIT: &'static str = "N";
    const APPLIES_TO: Family = Family::Element;
    const OF_LAYERS: bool = true;

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        window(values, 0).map(|window| Self { window })
    }

    fn values(&self) -> Vec<Value> {
        vec![Value::Window(self.window)]
    }

    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        let connection = &solution.assembly().connections[target];
        let Some(force) = connection.transmitted else {
            return Reading::undefined(UNDETERMINED_FORCE);
        };
        let span = match solution.element_impact(target).span(self.window, solution.end()) {
            Ok(span) => span,
            Err(note) => return Reading::undefined(note),
        };
        if let Some(reading) = infinite(&span, solution.element_blows(target)) {
            return reading;
        }
        let force = solution.signal(force);
        let reading = peak(force, &span);
        if peaks_below_zero(force, &span) { reading.noting("in tension") } else { reading }
    }
}
