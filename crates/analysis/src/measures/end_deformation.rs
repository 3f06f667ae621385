//! Deformation at the end.

use dashpot_network::{parameters, parameters::WindowWish};

use super::{Family, MeasureKind, Reading, WINDOW, reading::end_value};
use crate::Solution;

parameters! {
    /// An element's deformation at the end of the window, `y(t_end)` \[m\], positive in compression.
    /// At the end of an impact it is what the pad has not yet sprung back.
    #[derive(Debug, Clone, Copy, PartialEq, Default)]
    pub struct EndDeformation: "end-deformation", "deformation at the end of the window [m]" {
        /// The part of the run that it looks at.
        pub window: WindowWish => WINDOW;
    }
}

impl MeasureKind for EndDeformation {
    const UNIT: &'static str = "m";
    const APPLIES_TO: Family = Family::Element;

    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        let span = match solution.element_impact(target).span(self.window, solution.end()) {
            Ok(span) => span,
            Err(note) => return Reading::undefined(note),
        };
        end_value(solution.signal(solution.assembly().connections[target].deformation), &span)
    }
}
