//! Peak force.

use dashpot_network::{parameters, parameters::WindowWish};

use super::{
    Family, MeasureKind, Reading, WINDOW,
    reading::{infinite, peak, peaks_below_zero},
};
use crate::{Note, Solution};

parameters! {
    /// The largest magnitude of an element's force, `max |F(t)|` \[N\], with its time.
    ///
    /// It is the force of the element alone. Of a padding whose face has mass it is `F2`, behind the face;
    /// what strikes the face feels `F1 = F2 + m2 x1″`, the peak force of `<element>.contact`. A stop beside
    /// the element has a force of its own, `<element>.stop`;
    /// [`TransmittedForce`](super::TransmittedForce) is what comes through both.
    ///
    /// In an impact the force pushes throughout; in other windows a peak in tension is noted. Where masses
    /// meet in the element and speeds jump, it is infinite.
    #[derive(Debug, Clone, Copy, PartialEq, Default)]
    pub struct PeakForce: "peak-force",
        "largest magnitude of the force, positive in compression [N]"
    {
        /// The part of the run that it looks at.
        pub window: WindowWish => WINDOW;
    }
}

impl MeasureKind for PeakForce {
    const UNIT: &'static str = "N";
    const APPLIES_TO: Family = Family::Element;
    const BY_DEFAULT: bool = true;
    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        let connection = &solution.assembly().connections[target];
        let Some(force) = connection.force else {
            return Reading::undefined(Note::NoForce);
        };
        let force = solution.signal(force);
        let span = match solution.element_impact(target).span(self.window, solution.end()) {
            Ok(span) => span,
            Err(note) => return Reading::undefined(note),
        };
        if let Some(reading) = infinite(&span, solution.element_blows(target)) {
            return reading;
        }
        let reading = peak(force, &span);
        if peaks_below_zero(force, &span) { reading.noting(Note::InTension) } else { reading }
    }
}
