//! Peak strain.

use dashpot_network::{parameters, parameters::WindowWish};

use super::{Family, MeasureKind, Needs, Reading, WINDOW, of_segments::largest};
use crate::{Note, Solution};

parameters! {
    /// The largest magnitude of the strain in any segment of a pad, `max |y(t)|/h` \[1\], with its time and
    /// its layer; a peak in elongation is noted.
    ///
    /// `y` is the deformation of the segment and `h` its thickness at rest. Pads of layers have segments;
    /// another element with a `thickness` is a single one, and so is each branch of its model with a
    /// thickness of its own.
    #[derive(Debug, Clone, Copy, PartialEq, Default)]
    pub struct PeakStrain: "peak-strain",
        "largest strain in any segment of a pad, deformation over thickness [1]"
    {
        /// The part of the run that it looks at.
        pub window: WindowWish => WINDOW;
    }
}

impl MeasureKind for PeakStrain {
    const UNIT: &'static str = "1";
    const APPLIES_TO: Family = Family::Element;
    const NEEDS: Needs = Needs::Thickness;
    const OF_LAYERS: bool = true;

    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        let connection = &solution.assembly().connections[target];
        if connection.segments.is_empty() {
            return Reading::undefined(Note::NoThickness);
        }
        let span = match solution.element_impact(target).span(self.window, solution.end()) {
            Ok(span) => span,
            Err(note) => return Reading::undefined(note),
        };
        let segments = connection.segments.iter();
        let deformations = segments.map(|own| (own, own.deformation, own.thickness));
        let Some(reading) = largest(solution, &span, deformations, Note::InElongation) else {
            return Reading::undefined(Note::NoThickness);
        };
        // The note is on the largest strain, unless that is one in elongation.
        let is_crushed = reading.value.is_some_and(|value| value > 1.0);
        if is_crushed && !reading.notes.contains(&Note::InElongation) {
            return reading.noting(Note::Crushed);
        }
        reading
    }
}
