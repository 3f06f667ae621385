//! Peak acceleration.

use dashpot_network::{parameters, parameters::WindowWish};

use super::{
    Family, MeasureKind, Needs, Reading, WINDOW,
    reading::{infinite, peak},
};
use crate::{Note, Solution};

parameters! {
    /// The largest magnitude of what an accelerometer on a body reads, `max |Σ F_contact|/m` \[m/s²\],
    /// with its time; free fall is 0. Where the speed jumps, it is infinite.
    #[derive(Debug, Clone, Copy, PartialEq, Default)]
    pub struct PeakAcceleration: "peak-acceleration",
        "largest magnitude of what an accelerometer reads [m/s^2]"
    {
        /// The part of the run that it looks at.
        pub window: WindowWish => WINDOW;
    }
}

impl MeasureKind for PeakAcceleration {
    const UNIT: &'static str = "m/s^2";
    const APPLIES_TO: Family = Family::Node;
    const NEEDS: Needs = Needs::Acceleration;
    const BY_DEFAULT: bool = true;
    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        let Some(acceleration) = solution.assembly().nodes[target].acceleration else {
            return Reading::undefined(Note::Massless);
        };
        let span = match solution.node_impact(target).span(self.window, solution.end()) {
            Ok(span) => span,
            Err(note) => return Reading::undefined(note),
        };
        infinite(&span, &solution.node_blows(target))
            .unwrap_or_else(|| peak(solution.signal(acceleration), &span))
    }
}
