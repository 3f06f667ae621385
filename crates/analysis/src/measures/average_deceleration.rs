//! Average deceleration.

use dashpot_network::{parameters, parameters::WindowWish};

use super::{
    Family, MeasureKind, Needs, Reading, WINDOW,
    reading::{infinite, integral, with_blows},
};
use crate::{Note, Solution, impact::impulses};

parameters! {
    /// The magnitude of the mean of what an accelerometer on a body reads, `|∫ a dt| / T` \[m/s²\]:
    /// without gravity the change of velocity over the time `T` that it takes, jumps included.
    #[derive(Debug, Clone, Copy, PartialEq, Default)]
    pub struct AverageDeceleration: "average-deceleration",
        "mean of what an accelerometer reads [m/s^2]"
    {
        /// The part of the run that it looks at.
        pub window: WindowWish => WINDOW;
    }
}

impl MeasureKind for AverageDeceleration {
    const UNIT: &'static str = "m/s^2";
    const APPLIES_TO: Family = Family::Node;
    const NEEDS: Needs = Needs::Acceleration;

    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        let Some(acceleration) = solution.assembly().nodes[target].acceleration else {
            return Reading::undefined(Note::Massless);
        };
        let span = match solution.node_impact(target).span(self.window, solution.end()) {
            Ok(span) => span,
            Err(note) => return Reading::undefined(note),
        };
        let length = span.length();
        let blows = solution.node_blows(target);
        if length <= 0.0 {
            let none = || Reading::undefined(Note::NoLength);
            return infinite(&span, &blows).unwrap_or_else(none);
        }
        let blows = impulses::within(&blows, span.window());
        let mass = solution.body_mass(target);
        let jump: f64 = blows.iter().map(|own| own.impulse / mass).sum();
        let jumps: f64 = blows.iter().map(|own| own.impulse.abs() / mass).sum();
        let error = solution.velocity_error(target).map(|error| 2.0 * error);
        let error = error.map(|each| blows.iter().map(|_| each).sum());
        let impulse = integral(solution.signal(acceleration), &span);
        let impulse = with_blows(impulse, jump, jumps, error);
        let value = impulse.value.map_or(f64::NAN, |value| value.abs() / length);
        // A longer window adds to the integral, and divides it by more.
        let stretch = span.to_error.map(|shift| value * shift / length);
        let error = impulse.error.zip(stretch).map(|(error, stretch)| error / length + stretch);
        let end_rate = (impulse.end_rate + value) / length;
        Reading::over(&span, value, error)
            .of_size(impulse.size / length)
            .above(impulse.noise / length)
            .changing(end_rate)
    }
}
