//! Peak deformation rate.

use dashpot_network::{parameters, parameters::WindowWish};

use super::{Family, MeasureKind, Reading, WINDOW, reading::peak};
use crate::{Solution, impact::impulses};

parameters! {
    /// The largest magnitude of an element's deformation rate, `max |ẏ(t)|` \[m/s\], with its time.
    #[derive(Debug, Clone, Copy, PartialEq, Default)]
    pub struct PeakRate: "peak-rate", "largest magnitude of the deformation rate [m/s]" {
        /// The part of the run that it looks at.
        pub window: WindowWish => WINDOW;
    }
}

impl MeasureKind for PeakRate {
    const UNIT: &'static str = "m/s";
    const APPLIES_TO: Family = Family::Element;

    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        let span = match solution.element_impact(target).span(self.window, solution.end()) {
            Ok(span) => span,
            Err(note) => return Reading::undefined(note),
        };
        let connection = &solution.assembly().connections[target];
        let reading = peak(&solution.rate_of(connection), &span);
        // At a jump the rates on both sides count, also that before the span.
        let blows = impulses::within(solution.element_blows(target), (span.from, span.from));
        let before =
            blows.first().map_or(0.0, |own| solution.approach_before(connection, own.time).abs());
        if reading.value.is_none_or(|value| value >= before) {
            return reading;
        }
        Reading { value: Some(before), ..reading }.of_size(before).at(span.from)
    }
}
