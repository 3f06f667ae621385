//! Spring that is stiffer the faster it is loaded.

use super::{
    Element, Law, Tangent,
    power::{PowerLaw, in_range},
};
use crate::{parameters, parameters::InvalidParameter};

parameters! {
    /// A spring that is stiffer the faster it is loaded: a modulus that depends on strain and on rate, `F = F_s(y)·(1 +
    /// φ(ẏ))` with `F_s = F_r (|y|/y_r)^n sgn y`, and `φ = a ln(1 + |ẏ|/v_r)` while it is loaded, `y ẏ > 0`, else 0.
    ///
    /// | symbol | field            | unit | range |
    /// |--------|------------------|------|-------|
    /// | `F_r`  | `force`          | N    | > 0   |
    /// | `y_r`  | `at`             | m    | > 0   |
    /// | `n`    | `exponent`       | 1    | ≥ 1, 1 where left out |
    /// | `a`    | `gain`           | 1    | ≥ 0   |
    /// | `v_r`  | `reference-rate` | m/s  | > 0   |
    ///
    /// Well above the rate `v_r`, ten times the rate raises the force of loading by `2.3 a F_s`.
    ///
    /// # Energy
    ///
    /// The spring stores `W(y) = ∫ F_s dy`. A product `E1(rate)·E2(strain)` that works in unloading, too, creates
    /// energy: what is loaded slowly and unloaded fast returns more than it took up. Here `F ẏ = F_s ẏ + F_s ẏ φ` while
    /// `F_s ẏ > 0`, and `F ẏ = F_s ẏ` else. So `F ẏ − dW/dt ≥ 0` at every instant, and no closed cycle creates energy.
    /// Because `φ = 0` at rest, the force is continuous where loading ends; its slope over the rate is not.
    ///
    /// # Limits
    ///
    /// In unloading the force does not depend on the rate at all, so a massless node that nothing else damps
    /// does not find its rate there. It gets a dashpot beside the spring, of 10⁻⁸ of the slope over the rate
    /// that the spring has in the motion at hand.
    ///
    /// # Examples
    ///
    /// ```
    /// use dashpot_network::{Element, elements::RateSpring};
    ///
    /// let spring =
    ///     RateSpring { force: 1000.0, at: 0.01, exponent: 1.0, gain: 0.1, reference_rate: 0.01 };
    /// assert!((spring.force(0.01, 0.99) - 1000.0 * (1.0 + 0.1 * 100_f64.ln())).abs() < 1e-10);
    /// assert!((spring.force(0.01, -0.99) - 1000.0).abs() < 1e-10);
    /// ```
    ///
    /// # References
    ///
    /// `johnson1983` in `docs/references.bib` for the logarithm of the rate.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct RateSpring: "rate-spring",
        "spring stiffer under fast loading, F = F_s(y) (1 + a ln(1 + |y'|/v_r))", checked by Self::fits
    {
        /// force F_r at the deformation `at` [N], positive
        pub force: f64 = Quantity(Dimension::FORCE), range Positive;
        /// reference deformation y_r [m], positive
        pub at: f64 = Quantity(Dimension::LENGTH), range Positive;
        /// gain a of the force with the logarithm of the rate [1], zero or positive
        pub gain: f64 = Quantity(Dimension::NUMBER), range NonNegative;
        /// rate v_r above which the rate matters [m/s], positive
        pub reference_rate as "reference-rate": f64 = Quantity(Dimension::VELOCITY), range Positive;
        /// exponent n of the deformation [1], 1 or more
        pub exponent: f64 = Quantity(Dimension::NUMBER), default "1", range AtLeastOne;
    }
    sample { force: 1000.0, at: 0.01, exponent: 1.5, gain: 0.1, reference_rate: 0.01 }
}

impl RateSpring {
    fn power(&self) -> PowerLaw {
        PowerLaw { force: self.force, at: self.at, exponent: self.exponent }
    }

    /// `φ` and its slope over `|ẏ|`, as if it were loaded.
    fn gained(&self, rate: f64) -> (f64, f64) {
        let speed = rate.abs();
        (
            self.gain * (speed / self.reference_rate).ln_1p(),
            self.gain / (self.reference_rate + speed),
        )
    }

    /// The slope over the rate at the references, while it is loaded \[N s/m\].
    fn damping(&self) -> f64 {
        0.5 * self.gain * self.force / self.reference_rate
    }

    /// Whether its slopes at the references are numbers.
    fn fits(&self) -> Result<(), InvalidParameter> {
        self.power().fits()?;
        if self.gain > 0.0 {
            in_range("reference-rate", self.reference_rate, self.damping())?;
        }
        Ok(())
    }
}

impl Element for RateSpring {
    fn force(&self, deformation: f64, rate: f64) -> f64 {
        let (gain, _) = self.gained(rate);
        let steady = self.power().value(deformation.abs()).copysign(deformation);
        let loading = if deformation * rate > 0.0 { gain } else { 0.0 };
        steady * (1.0 + loading)
    }

    fn tangent(&self, deformation: f64, rate: f64) -> Tangent {
        let (gain, slope) = self.gained(rate);
        let steady = self.power().value(deformation.abs());
        let (loading, of_rate) =
            if deformation * rate > 0.0 { (gain, steady * slope) } else { (0.0, 0.0) };
        Tangent {
            stiffness: self.power().slope(deformation.abs()) * (1.0 + loading),
            damping: of_rate,
        }
    }

    fn stored(&self, deformation: f64) -> f64 {
        self.power().integral(deformation.abs())
    }

    fn law(&self) -> Law {
        let stiffness = self.power().secant();
        if self.gain > 0.0 || self.exponent > 1.0 {
            Law::Nonlinear { stiffness, damping: self.damping() }
        } else {
            Law::Spring(stiffness)
        }
    }

    fn grows_from(&self) -> Option<f64> {
        Some(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameters::Kind as _;

    #[test]
    fn no_closed_cycle_creates_energy() {
        let spring = RateSpring::sample();
        // Cycles with any speeds on the way in and out: polygons in the plane of y and ẏ, the rate
        // constant between corners. The work of a corner's stretch is F at its rate over its way.
        let mut stream = dashpot_numerics::Stream::new(7);
        for _ in 0..200 {
            let corners: Vec<f64> = (0..6).map(|_| 0.04 * (stream.share() - 0.5)).collect();
            let mut work = 0.0;
            let mut size = 0.0;
            for at in 0..corners.len() {
                let (from, to) = (corners[at], corners[(at + 1) % corners.len()]);
                let rate = (to - from).signum() * stream.between(1e-4, 1e2);
                let own = work_between(&spring, from, to, rate);
                work += own;
                size += own.abs();
            }
            assert!(work >= -1e-12 * size, "{work}");
        }
        // Slowly in, fast out: nothing is gained; fast in, slowly out: much is lost.
        let cycle = |inward: f64, outward: f64| {
            work_between(&spring, 0.0, 0.01, inward) + work_between(&spring, 0.01, 0.0, -outward)
        };
        assert!(cycle(1e-6, 10.0) < 1e-4 * spring.stored(0.01));
        let lost = 0.1 * 1001_f64.ln() * spring.stored(0.01);
        assert!((cycle(10.0, 1e-6) / lost - 1.0).abs() < 1e-3);
    }

    /// Work on a way at one rate, by the closed integral of the power law on either side of zero.
    fn work_between(spring: &RateSpring, from: f64, to: f64, rate: f64) -> f64 {
        let (low, high) = (from.min(to), from.max(to));
        let sides = [(low.min(0.0), high.min(0.0)), (low.max(0.0), high.max(0.0))];
        let work = sides.iter().map(|&(low, high)| {
            dashpot_numerics::quadrature::integral(
                // The integrand is to be positive: the sign is that of the side.
                |y| spring.force(y, rate).abs(),
                low,
                high,
            ) * if high > 0.0 { 1.0 } else { -1.0 }
        });
        work.sum::<f64>() * rate.signum()
    }
}
