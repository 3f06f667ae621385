//! Impulse.

use dashpot_network::{parameters, parameters::WindowWish};

use super::{
    Family, MeasureKind, Reading, WINDOW,
    reading::{integral, with_blows},
};
use crate::{Note, Solution, impact::impulses};

parameters! {
    /// The integral of an element's force over time, `∫ F dt` \[N s\], positive in compression, and the
    /// impulses with which masses meet in it.
    #[derive(Debug, Clone, Copy, PartialEq, Default)]
    pub struct Impulse: "impulse", "integral of the force over time [N s]" {
        /// The part of the run that it looks at.
        pub window: WindowWish => WINDOW;
    }
}

impl MeasureKind for Impulse {
    const UNIT: &'static str = "N s";
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
        let blows = impulses::within(solution.element_blows(target), span.window());
        let sum: f64 = blows.iter().map(|own| own.impulse).sum();
        // An impulse is the lighter side's mass times no more than twice the speed of approach.
        let mass = connection.between.map(|end| {
            let at = end.index();
            let is_free = solution.assembly().nodes[at].free;
            if is_free { solution.body_mass(at) } else { f64::INFINITY }
        });
        let of_approach = if blows.is_empty() { None } else { solution.approach(connection).error };
        let each = of_approach.map(|error| 2.0 * mass[0].min(mass[1]) * error);
        let error = each.map(|each| each * blows.iter().map(|_| 1.0).sum::<f64>());
        with_blows(integral(force, &span), sum, sum.abs(), error)
    }
}
