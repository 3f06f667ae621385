//! Peak displacement.

use dashpot_network::{parameters, parameters::WindowWish};

use super::{Family, MeasureKind, Reading, WINDOW, reading::peak};
use crate::Solution;

parameters! {
    /// The largest magnitude of a node's displacement, `max |x(t)|` \[m\], with its time.
    #[derive(Debug, Clone, Copy, PartialEq, Default)]
    pub struct PeakDisplacement: "peak-displacement", "largest magnitude of the displacement [m]" {
        /// The part of the run that it looks at.
        pub window: WindowWish => WINDOW;
    }
}

impl MeasureKind for PeakDisplacement {
    const UNIT: &'static str = "m";
    const APPLIES_TO: Family = Family::Node;

    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        let span = match solution.node_impact(target).span(self.window, solution.end()) {
            Ok(span) => span,
            Err(note) => return Reading::undefined(note),
        };
        peak(solution.signal(solution.assembly().nodes[target].position), &span)
    }
}
