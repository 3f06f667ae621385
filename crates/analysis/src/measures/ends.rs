//! What is left at the end of a window: deformations, displacements and velocities.

use dashpot_network::{parameters, parameters::WindowWish};

use super::{Family, MeasureKind, Reading, WINDOW};
use crate::{Note, Solution, VelocityJump};

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

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        let span = solution.element_span(target, self.window)?;
        let deformation = solution.assembly().connections[target].deformation;
        Ok(Reading::end_value(solution.signal(deformation), &span))
    }
}

parameters! {
    /// A node's displacement at the end of the window, `x(t_end)` \[m\], positive towards the support.
    #[derive(Debug, Clone, Copy, PartialEq, Default)]
    pub struct EndPosition: "end-position", "displacement at the end of the window [m]" {
        /// The part of the run that it looks at.
        pub window: WindowWish => WINDOW;
    }
}

impl MeasureKind for EndPosition {
    const UNIT: &'static str = "m";
    const APPLIES_TO: Family = Family::Node;

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        let span = solution.node_span(target, self.window)?;
        let position = solution.assembly().nodes[target].position;
        Ok(Reading::end_value(solution.signal(position), &span))
    }
}

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

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        let node = &solution.assembly().nodes[target];
        let velocity = solution.signal(node.velocity.ok_or(Note::NoVelocity)?);
        let span = solution.node_span(target, self.window)?;
        let reading = Reading::end_value(velocity, &span);
        // What jumps at the end has jumped.
        let reading = match VelocityJump::within(&solution.node_jumps(target), (span.to, span.to)) {
            [] => reading,
            _ => Reading { value: Some(velocity.value(span.to)), ..reading },
        };
        // The velocity is what the acceleration has added up to, though it may have cancelled.
        let summed = node.acceleration.map_or(0.0, |acceleration| {
            let window = (0.0, span.to);
            solution.signal(acceleration).area_bound(window)
        });
        let noise = reading.noise.max(4.0 * f64::EPSILON * summed);
        Ok(reading.above(noise))
    }
}
