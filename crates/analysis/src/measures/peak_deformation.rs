//! Peak deformation.

use dashpot_network::{parameters, parameters::WindowWish};

use super::{
    Family, MeasureKind, Reading, WINDOW,
    reading::{peak, peaks_below_zero, positive_peak},
};
use crate::{Note, Solution};

parameters! {
    /// The largest magnitude of an element's deformation, `max |y(t)|` \[m\], with its time; a peak in
    /// elongation is noted. Of what never pulls it is the deepest compression, `max y(t) ≥ 0`: what it is
    /// apart by is a gap.
    #[derive(Debug, Clone, Copy, PartialEq, Default)]
    pub struct PeakDeformation: "peak-deformation",
        "largest magnitude of the deformation, positive in compression [m]"
    {
        /// The part of the run that it looks at.
        pub window: WindowWish => WINDOW;
    }
}

impl MeasureKind for PeakDeformation {
    const UNIT: &'static str = "m";
    const APPLIES_TO: Family = Family::Element;
    const BY_DEFAULT: bool = true;
    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        let span = match solution.element_impact(target).span(self.window, solution.end()) {
            Ok(span) => span,
            Err(note) => return Reading::undefined(note),
        };
        let connection = &solution.assembly().connections[target];
        let deformation = solution.signal(connection.deformation);
        if connection.never_pulls {
            return positive_peak(deformation, &span);
        }
        let mut reading = peak(deformation, &span);
        if solution.has_contact(target) {
            // At a contact it is the remainder of the way that its ends have come to meet.
            reading = reading.of_size(deformation.bound());
        }
        if peaks_below_zero(deformation, &span) {
            reading.noting(Note::InElongation)
        } else {
            reading
        }
    }
}
