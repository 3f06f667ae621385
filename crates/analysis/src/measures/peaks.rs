//! The largest values of forces, deformations and motions, and those at the end of a window.

use super::{MeasureKind, MeasureTraits, Reading, reading::peaks_below_zero};
use crate::{Note, Solution, VelocityJump};

windowed! {
    /// The largest magnitude of an element's force, `max |F(t)|` \[N\], with its time.
    ///
    /// It is the force of the element alone. Of a padding whose face has mass it is `F2`, behind the face;
    /// what strikes the face feels `F1 = F2 + m2 x1″`, the peak force of `<element>.contact`. A stop beside
    /// the element has a force of its own, `<element>.stop`;
    /// [`TransmittedForce`](super::TransmittedForce) is what comes through both.
    ///
    /// In an impact the force pushes throughout; in other windows a peak in tension is noted. Where masses
    /// meet in the element and speeds jump, it is infinite.
    PeakForce: "peak-force", "largest magnitude of the force, positive in compression [N]"
}

impl MeasureKind for PeakForce {
    const ABOUT: MeasureTraits = MeasureTraits::of_element::<Self>("N").by_default();

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        let force = solution.element_force(target)?;
        let span = solution.element_span(target, self.window)?;
        if let Some(reading) = Reading::infinite(&span, solution.element_jumps(target)) {
            return Ok(reading);
        }
        let reading = Reading::peak(force, &span);
        Ok(reading.noting_if(peaks_below_zero(force, &span), Note::InTension))
    }
}

windowed! {
    /// The largest magnitude of an element's deformation, `max |y(t)|` \[m\], with its time; a peak in elongation is
    /// noted. Of what never pulls it is the deepest compression, `max y(t) ≥ 0`: what it is apart by is a gap.
    PeakDeformation: "peak-deformation",
        "largest magnitude of the deformation, positive in compression [m]"
}

impl MeasureKind for PeakDeformation {
    const ABOUT: MeasureTraits = MeasureTraits::of_element::<Self>("m").by_default();

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        let span = solution.element_span(target, self.window)?;
        let connection = &solution.assembly().connections[target];
        let deformation = solution.signal(connection.deformation);
        if connection.never_pulls {
            return Ok(Reading::positive_peak(deformation, &span));
        }
        let mut reading = Reading::peak(deformation, &span);
        if solution.has_contact(target) {
            // At a contact it is the remainder of the way that its ends have come to meet.
            reading = reading.of_size(deformation.bound());
        }
        Ok(reading.noting_if(peaks_below_zero(deformation, &span), Note::InElongation))
    }
}

windowed! {
    /// The largest magnitude of an element's deformation rate, `max |ẏ(t)|` \[m/s\], with its time.
    PeakRate: "peak-rate", "largest magnitude of the deformation rate [m/s]"
}

impl MeasureKind for PeakRate {
    const ABOUT: MeasureTraits = MeasureTraits::of_element::<Self>("m/s");

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        let span = solution.element_span(target, self.window)?;
        let connection = &solution.assembly().connections[target];
        let reading = Reading::peak(&solution.rate_of(connection), &span);
        // At a jump the rates on both sides count, also that before the span.
        let jumps = VelocityJump::within(solution.element_jumps(target), (span.from, span.from));
        let before = |jump: &VelocityJump| solution.approach_before(connection, jump.time).abs();
        Ok(reading.with_value_before(jumps.first().map(before), &span))
    }
}

windowed! {
    /// The largest magnitude of what an accelerometer on a body reads, `max |Σ F_contact|/m` \[m/s²\],
    /// with its time; free fall is 0. Where the speed jumps, it is infinite.
    PeakAcceleration: "peak-acceleration",
        "largest magnitude of what an accelerometer reads [m/s^2]"
}

impl MeasureKind for PeakAcceleration {
    const ABOUT: MeasureTraits = MeasureTraits::of_body::<Self>("m/s^2").by_default();

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        let acceleration = solution.node_acceleration(target)?;
        let span = solution.node_span(target, self.window)?;
        let infinite = Reading::infinite(&span, &solution.node_jumps(target));
        Ok(infinite.unwrap_or_else(|| Reading::peak(acceleration, &span)))
    }
}

windowed! {
    /// The largest magnitude of a node's displacement, `max |x(t)|` \[m\], with its time.
    PeakDisplacement: "peak-displacement", "largest magnitude of the displacement [m]"
}

impl MeasureKind for PeakDisplacement {
    const ABOUT: MeasureTraits = MeasureTraits::of_node::<Self>("m");

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        let span = solution.node_span(target, self.window)?;
        let position = solution.assembly().nodes[target].position;
        Ok(Reading::peak(solution.signal(position), &span))
    }
}

windowed! {
    /// An element's deformation at the end of the window, `y(t_end)` \[m\], positive in compression.
    /// At the end of an impact it is what the pad has not yet sprung back.
    EndDeformation: "end-deformation", "deformation at the end of the window [m]"
}

impl MeasureKind for EndDeformation {
    const ABOUT: MeasureTraits = MeasureTraits::of_element::<Self>("m");

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        let span = solution.element_span(target, self.window)?;
        let deformation = solution.assembly().connections[target].deformation;
        Ok(Reading::end_value(solution.signal(deformation), &span))
    }
}

windowed! {
    /// An element's force at the end of the window, `F(t_end)` \[N\], positive in compression; at the end of an
    /// impact it is 0.
    EndForce: "end-force", "force at the end of the window [N]"
}

impl MeasureKind for EndForce {
    const ABOUT: MeasureTraits = MeasureTraits::of_element::<Self>("N");

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        let span = solution.element_span(target, self.window)?;
        Ok(Reading::end_value(solution.element_force(target)?, &span))
    }
}

windowed! {
    /// The largest magnitude of a node's velocity, `max |v|` \[m/s\], with its time. Where the speed jumps, it is the
    /// larger one of both sides, also that before the window.
    PeakVelocity: "peak-velocity", "largest magnitude of the velocity [m/s]"
}

impl MeasureKind for PeakVelocity {
    const ABOUT: MeasureTraits = MeasureTraits::of_node::<Self>("m/s");

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        let node = &solution.assembly().nodes[target];
        let velocity = solution.signal(node.velocity.ok_or(Note::NoVelocity)?);
        let span = solution.node_span(target, self.window)?;
        let reading = Reading::peak(velocity, &span);
        let jumps = solution.node_jumps(target);
        let first = VelocityJump::within(&jumps, (span.from, span.from)).first();
        let before = first.map(|_| velocity.left_value(span.from).abs());
        Ok(reading.with_value_before(before, &span))
    }
}

windowed! {
    /// A node's displacement at the end of the window, `x(t_end)` \[m\], positive towards the support.
    EndPosition: "end-position", "displacement at the end of the window [m]"
}

impl MeasureKind for EndPosition {
    const ABOUT: MeasureTraits = MeasureTraits::of_node::<Self>("m");

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        let span = solution.node_span(target, self.window)?;
        let position = solution.assembly().nodes[target].position;
        Ok(Reading::end_value(solution.signal(position), &span))
    }
}

windowed! {
    /// A node's velocity at the end of the window, `v(t_end)` \[m/s\], positive towards the support: at the end of its
    /// impact an impactor's rebound speed, negative. Where the speed jumps at the end, it is that after the jump.
    EndVelocity: "end-velocity",
        "velocity at the end of the window: the rebound speed of an impactor [m/s]"
}

impl MeasureKind for EndVelocity {
    const ABOUT: MeasureTraits = MeasureTraits::of_node::<Self>("m/s");

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
