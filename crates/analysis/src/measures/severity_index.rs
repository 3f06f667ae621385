//! Severity index.

use dashpot_network::{parameters, parameters::WindowWish};

use super::{Family, MeasureKind, Needs, Reading, STANDARD_GRAVITY, WINDOW};
use crate::{Note, Solution, impact::impulses};

parameters! {
    /// Gadd's severity index, `SI = ∫ (|a|/g0)^n dt` \[s\], of what an accelerometer on a body reads.
    ///
    /// | symbol | field      | unit | range            |
    /// |--------|------------|------|------------------|
    /// | `n`    | `exponent` | 1    | positive         |
    /// | `g0`   | [`STANDARD_GRAVITY`] | m/s² |        |
    ///
    /// Where the speed jumps by `Δv`, it is infinite for `n > 1`, and `Δv/g0` is added for `n = 1`.
    /// A half-sine of height `A g0` and length `T` has `SI = 0.45765586 A^2.5 T` at `n = 2.5`.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct SeverityIndex: "severity-index", "integral of (|a|/g0)^exponent over time [s]" {
        /// exponent n, positive
        pub exponent: f64 = Quantity(Dimension::NUMBER), default "2.5", range Positive;
        /// The part of the run that it looks at.
        pub window: WindowWish => WINDOW;
    }
    default { exponent: 2.5, window: WindowWish::Impact }
}

impl MeasureKind for SeverityIndex {
    const UNIT: &'static str = "s";
    const APPLIES_TO: Family = Family::Node;
    const NEEDS: Needs = Needs::Acceleration;
    const BY_DEFAULT: bool = true;
    const WITHOUT_IMPACTOR: bool = false;

    fn gravities(&self) -> f64 {
        self.exponent
    }

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        let acceleration = solution.node_acceleration(target)?;
        let span = solution.node_span(target, self.window)?;
        let jumps = solution.node_jumps(target);
        if self.exponent > 1.0
            && let Some(reading) = Reading::infinite(&span, &jumps)
        {
            return Ok(reading);
        }
        let severity = |a: f64| (a.abs() / STANDARD_GRAVITY).powf(self.exponent);
        let value = acceleration.integral_of(span.window(), &[0.0], severity);
        let last = severity(acceleration.left_value(span.to));
        let error = acceleration.error.zip(span.to_error).map(|(error, shift)| {
            // How much the integrand grows at most when the acceleration does by its error.
            let n = self.exponent;
            let growth = |a: f64| {
                let most = (a.abs() + error) / STANDARD_GRAVITY;
                if n >= 1.0 {
                    n * most.powf(n - 1.0) * error / STANDARD_GRAVITY
                } else {
                    severity(error)
                }
            };
            acceleration.integral_of(span.window(), &[0.0], growth) + last * shift + 1e-13 * value
        });
        let reading = Reading::over(&span, value, error).changing(last);
        if self.exponent < 1.0 {
            return Ok(reading);
        }
        let unit = solution.body_mass(target) * STANDARD_GRAVITY;
        let jumps = impulses::within(&jumps, span.window());
        let sum = jumps.iter().map(|own| own.impulse.abs() / unit).sum();
        let error = solution.velocity_error(target).map(|error| 2.0 * error / STANDARD_GRAVITY);
        let error = error.map(|each| jumps.iter().map(|_| each).sum());
        Ok(reading.plus(sum, sum, error))
    }
}
