//! Integrals over time, and means.

use super::{MeasureKind, MeasureTraits, Reading};
use crate::{Note, Solution, VelocityJump};

windowed! {
    /// The integral of an element's force over time, `∫ F dt` \[N s\], positive in compression, and the
    /// impulses with which masses meet in it.
    Impulse: "impulse", "integral of the force over time [N s]"
}

impl MeasureKind for Impulse {
    const ABOUT: MeasureTraits = MeasureTraits::of_element::<Self>("N s").by_default();

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        let force = solution.element_force(target)?;
        let span = solution.element_span(target, self.window)?;
        let connection = &solution.assembly().connections[target];
        let jumps = VelocityJump::within(solution.element_jumps(target), span.window());
        let sum: f64 = jumps.iter().map(|jump| jump.impulse).sum();
        // An impulse is the lighter side's mass times no more than twice the speed of approach.
        let mass = connection.between.map(|end| {
            let at = end.index();
            let is_free = solution.assembly().nodes[at].free;
            if is_free { solution.body_mass(at) } else { f64::INFINITY }
        });
        let of_approach = if jumps.is_empty() { None } else { solution.approach(connection).error };
        let each = of_approach.map(|error| 2.0 * mass[0].min(mass[1]) * error);
        let error = each.map(|each| each * jumps.iter().map(|_| 1.0).sum::<f64>());
        Ok(Reading::integral(force, &span).plus(sum, sum.abs(), error))
    }
}

windowed! {
    /// The magnitude of the mean of what an accelerometer on a body reads, `|∫ a dt| / T` \[m/s²\]:
    /// without gravity the change of velocity over the time `T` that it takes, jumps included.
    AverageDeceleration: "average-deceleration", "mean of what an accelerometer reads [m/s^2]"
}

impl MeasureKind for AverageDeceleration {
    const ABOUT: MeasureTraits = MeasureTraits::of_body::<Self>("m/s^2");

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        let acceleration = solution.node_acceleration(target)?;
        let span = solution.node_span(target, self.window)?;
        let jumps = solution.node_jumps(target);
        if span.length() <= 0.0 {
            return Reading::infinite(&span, &jumps).ok_or(Note::NoLength);
        }
        let jumps = VelocityJump::within(&jumps, span.window());
        let mass = solution.body_mass(target);
        let jump: f64 = jumps.iter().map(|jump| jump.impulse / mass).sum();
        let size: f64 = jumps.iter().map(|jump| jump.impulse.abs() / mass).sum();
        let error = solution.velocity_error(target).map(|error| 2.0 * error);
        let error = error.map(|each| jumps.iter().map(|_| each).sum());
        let mean = Reading::integral(acceleration, &span).plus(jump, size, error).mean(&span);
        Ok(Reading { value: mean.value.map(f64::abs), ..mean })
    }
}
