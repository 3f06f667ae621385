//! Energy taken up.

use dashpot_network::{parameters, parameters::WindowWish};

use super::{Family, MeasureKind, Reading, WINDOW, reading::work};
use crate::{Note, Solution};

parameters! {
    /// The energy that an element takes up, `∫ F ẏ dt` \[J\]: at the end of an impact what it has not
    /// given back, be it stored or dissipated.
    ///
    /// Where a prescribed motion or a load jumps, the jump of the stored energy is counted; where masses
    /// meet in the element, the energy that the impact loses. What it holds as the run begins is not: of a load
    /// or motion that is there from the start on, and of what has no mass, that is all that they do at once.
    #[derive(Debug, Clone, Copy, PartialEq, Default)]
    pub struct Energy: "energy", "energy taken up by the element during the window [J]" {
        /// The part of the run that it looks at.
        pub window: WindowWish => WINDOW;
    }
}

impl MeasureKind for Energy {
    const UNIT: &'static str = "J";
    const APPLIES_TO: Family = Family::Element;
    const BY_DEFAULT: bool = true;
    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        let connection = &solution.assembly().connections[target];
        if connection.force.is_none() {
            return Reading::undefined(Note::NoForce);
        }
        let span = match solution.element_impact(target).span(self.window, solution.end()) {
            Ok(span) => span,
            Err(note) => return Reading::undefined(note),
        };
        work(solution, target, &span)
    }
}
