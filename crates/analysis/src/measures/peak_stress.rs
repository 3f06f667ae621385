//! Peak stress.

use dashpot_network::{parameters, parameters::WindowWish};

use super::{Family, MeasureKind, Needs, Reading, WINDOW, of_segments::largest, reading::infinite};
use crate::{Note, Solution};

parameters! {
    /// The largest magnitude of the stress in any segment of a pad, `max |F(t)|/A` \[Pa\], with its time
    /// and its layer; a peak in tension is noted.
    ///
    /// `F` is the force in the segment and `A` the area of its layer: the stress is that on the undeformed
    /// area. Pads of layers have segments; another element with a `thickness` and an `area` is a single
    /// one, and so is each branch of its model with a size of its own. Without an area there is no stress, and where masses meet in the element and speeds jump, it
    /// is infinite.
    #[derive(Debug, Clone, Copy, PartialEq, Default)]
    pub struct PeakStress: "peak-stress",
        "largest stress in any segment of a pad, force over area [Pa]"
    {
        /// The part of the run that it looks at.
        pub window: WindowWish => WINDOW;
    }
}

impl MeasureKind for PeakStress {
    const UNIT: &'static str = "Pa";
    const APPLIES_TO: Family = Family::Element;
    const NEEDS: Needs = Needs::Area;
    const OF_LAYERS: bool = true;

    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        let connection = &solution.assembly().connections[target];
        let segments = connection.segments.iter();
        let with_area = segments.filter_map(|own| Some((own, own.area?)));
        if with_area.clone().next().is_none() {
            return Reading::undefined(Note::NoArea);
        }
        let span = match solution.element_impact(target).span(self.window, solution.end()) {
            Ok(span) => span,
            Err(note) => return Reading::undefined(note),
        };
        if let Some(reading) = infinite(&span, solution.element_blows(target)) {
            return reading;
        }
        let forces = with_area.filter_map(|(own, area)| Some((own, own.force?, area)));
        largest(solution, &span, forces, Note::InTension)
            .unwrap_or_else(|| Reading::undefined(Note::NoForce))
    }
}
