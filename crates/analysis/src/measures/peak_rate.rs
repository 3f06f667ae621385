//! Peak deformation rate.

use dashpot_network::parameters::{InvalidParameter, Value, WindowWish};

use super::{Family, MeasureKind, Reading, reading::peak, window};
use crate::{Solution, blows};

/// The largest magnitude of an element's deformation rate, `max |ẏ(t)|` \[m/s\], with its time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PeakRate {
    /// The part of the run that it looks at.
    pub window: WindowWish,
}

impl Default for PeakRate {
    fn default() -> Self {
        Self { window: WindowWish::Impact }
    }
}

impl MeasureKind for PeakRate {
    const KIND: &'static str = "peak-rate";
    const SUMMARY: &'static str = "largest magnitude of the deformation rate [m/s]";
    const UNIT: &'static str = "m/s";
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
        let connection = &solution.assembly().connections[target];
        let reading = peak(&solution.rate_of(connection), &span);
        // At a jump the rates on both sides count, also that before the span.
        let blows = blows::within(solution.element_blows(target), (span.from, span.from));
        let before =
            blows.first().map_or(0.0, |own| solution.approach_before(connection, own.time).abs());
        if reading.value.is_none_or(|value| value >= before) {
            return reading;
        }
        Reading { value: Some(before), ..reading }.of_size(before).at(span.from)
    }
}
