//! Displacement at the end.

use dashpot_network::{parameters, parameters::WindowWish};

use super::{Family, MeasureKind, Reading, WINDOW, reading::end_value};
use crate::Solution;

parameters! {
    /// A node's displacement at the end of the window, `x(t_end)` \[m\], positive towards the support.
    #[derive(Debug, Clone, Copy, PartialEq, Default)]
    pub struct EndPosition: "end-position", "displacement at the end of the window [m]" {
        /// The part of the run that it looks at.
        pub window: WindowWish => WINDOW;
    }
}

impl MeasureKind for EndPosition {
    const UNIT: &'static str = "m";
    const APPLIES_TO: Family = Family::Node;

    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        let span = match solution.node_impact(target).span(self.window, solution.end()) {
            Ok(span) => span,
            Err(note) => return Reading::undefined(note),
        };
        end_value(solution.signal(solution.assembly().nodes[target].position), &span)
    }
}
