//! Velocity at the end.

use dashpot_network::{parameters, parameters::WindowWish};

use super::{Family, MeasureKind, Reading, WINDOW, reading::end_value};
use crate::{Note, Solution, impact::impulses};

parameters! {
    /// A node's velocity at the end of the window, `v(t_end)` \[m/s\], positive towards the support:
    /// at the end of its impact an impactor's rebound speed, negative. Where the speed jumps at the end,
    /// it is that after the jump.
    #[derive(Debug, Clone, Copy, PartialEq, Default)]
    pub struct EndVelocity: "end-velocity",
        "velocity at the end of the window: the rebound speed of an impactor [m/s]"
    {
        /// The part of the run that it looks at.
        pub window: WindowWish => WINDOW;
    }
}

impl MeasureKind for EndVelocity {
    const UNIT: &'static str = "m/s";
    const APPLIES_TO: Family = Family::Node;

    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        let Some(velocity) = solution.assembly().nodes[target].velocity else {
            return Reading::undefined(Note::NoVelocity);
        };
        let span = match solution.node_impact(target).span(self.window, solution.end()) {
            Ok(span) => span,
            Err(note) => return Reading::undefined(note),
        };
        let velocity = solution.signal(velocity);
        let reading = end_value(velocity, &span);
        // What jumps at the end has jumped.
        let reading = match impulses::within(&solution.node_blows(target), (span.to, span.to)) {
            [] => reading,
            _ => Reading { value: Some(velocity.value(span.to)), ..reading },
        };
        // The velocity is what the acceleration has added up to, though it may have cancelled.
        let summed = solution.assembly().nodes[target].acceleration.map_or(0.0, |acceleration| {
            let window = (0.0, span.to);
            solution.signal(acceleration).area_bound(window)
        });
        let noise = reading.noise.max(4.0 * f64::EPSILON * summed);
        reading.above(noise)
    }
}
