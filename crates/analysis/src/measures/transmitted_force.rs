//! Transmitted force.

use dashpot_dae::Signal;
use dashpot_network::{parameters, parameters::WindowWish};

use super::{
    Family, MeasureKind, Reading, WINDOW,
    reading::{infinite, peak, peaks_below_zero},
};
use crate::{Note, Solution, impact::support::on_support};

parameters! {
    /// The largest magnitude of the force of a padding on what lies behind it, `max |F(t)|` \[N\], with
    /// its time; a peak in tension is noted.
    ///
    /// It is the force on the second of the nodes in `between`, through everything of the padding: the
    /// element, its stop, and a face at that end with its mass. A stop adds to it and not to
    /// [`PeakForce`](super::PeakForce), which is that of the element alone. In pads of layers with mass,
    /// through which the force travels, it comes later and has another size. Where masses meet in any of
    /// these and speeds jump, it is infinite.
    #[derive(Debug, Clone, Copy, PartialEq, Default)]
    pub struct TransmittedForce: "transmitted-force",
        "largest magnitude of the force on what lies behind it, its stop included [N]"
    {
        /// The part of the run that it looks at.
        pub window: WindowWish => WINDOW;
    }
}

impl MeasureKind for TransmittedForce {
    const UNIT: &'static str = "N";
    const APPLIES_TO: Family = Family::Element;
    const OF_LAYERS: bool = true;

    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        let connections = &solution.assembly().connections;
        let parts = on_support(solution.assembly(), target);
        let mut sum: Option<Signal> = None;
        for &(part, sign) in &parts {
            let connection = &connections[part];
            let force = if part == target { connection.transmitted } else { connection.force };
            let Some(force) = force.map(|own| solution.signal(own)) else {
                return Reading::undefined(Note::NoForce);
            };
            sum = Some(sum.map_or_else(|| force.scaled(sign), |sum| sum.plus(force, sign)));
        }
        let Some(force) = sum else { return Reading::undefined(Note::NoForce) };
        let span = match solution.element_impact(target).span(self.window, solution.end()) {
            Ok(span) => span,
            Err(note) => return Reading::undefined(note),
        };
        let mut blows = parts.iter().map(|&(part, _)| solution.element_blows(part));
        if let Some(reading) = blows.find_map(|blows| infinite(&span, blows)) {
            return reading;
        }
        let reading = peak(&force, &span);
        if peaks_below_zero(&force, &span) { reading.noting(Note::InTension) } else { reading }
    }
}
