//! Dashpot whose force is a power of its rate.

use super::{
    Element, Law, Tangent,
    power::{in_range, times_power},
};
use crate::{parameters, parameters::InvalidParameter};

parameters! {
    /// A dashpot whose force is a power of its rate, `F = F_r (|ẏ|/v_r)^p sgn ẏ`.
    ///
    /// | symbol | field      | unit | range |
    /// |--------|------------|------|-------|
    /// | `F_r`  | `force`    | N    | > 0   |
    /// | `v_r`  | `at`       | m/s  | > 0   |
    /// | `p`    | `exponent` | 1    | > 0   |
    ///
    /// The force is `F_r` at the rate `v_r`. `p = 1` is the linear dashpot, `p = 2` an orifice in
    /// turbulent flow, `p < 1` a fluid that thins by shear. The dashpot stores nothing and dissipates
    /// the power `F ẏ ≥ 0`. True dry friction is [`Friction`](super::Friction), not a small `p`.
    ///
    /// # Limits
    ///
    /// Any reference `v_r` with the force that the law has there is the same law, and gives the same results.
    ///
    /// The power has an infinite slope at rest for `p < 1`, and none for `p > 1`. In a network it is a straight
    /// line through zero below 10⁻⁸ of the speeds of the run for `p < 1`, and at a massless node that nothing else
    /// damps also where its slope would be less than 10⁻⁸ times that at these speeds; beyond, the law is the power
    /// to the last digit.
    ///
    /// # Examples
    ///
    /// ```
    /// use dashpot_network::{Element, elements::PowerDashpot};
    ///
    /// let thinning = PowerDashpot { force: 200.0, at: 1.0, exponent: 0.5 };
    /// assert_eq!(thinning.force(0.0, 1.0), 200.0);
    /// assert_eq!(thinning.force(0.0, -4.0), -400.0);
    /// ```
    ///
    /// # References
    ///
    /// `ostwald1925` in `docs/references.bib` for `p < 1`; `merritt1967` for the orifice.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct PowerDashpot: "power-dashpot",
        "dashpot of a power law, F = F_r (|y'|/v_r)^p sgn y'", checked by Self::fits
    {
        /// force F_r at the rate `at` [N], positive
        pub force: f64 = Quantity(Dimension::FORCE), range Positive;
        /// reference rate v_r [m/s], positive
        pub at: f64 = Quantity(Dimension::VELOCITY), range Positive;
        /// exponent p [1], positive
        pub exponent: f64 = Quantity(Dimension::NUMBER), range Positive;
    }
    sample { force: 200.0, at: 1.0, exponent: 0.5 }
}

impl PowerDashpot {
    /// Whether its slope at the references is a number.
    fn fits(&self) -> Result<(), InvalidParameter> {
        in_range("at", self.at, self.force / self.at * self.exponent)
    }
}

/// Newton steps; five are the usual number.
const MOST_STEPS: usize = 100;

/// The part `z` from 0 to 1 at which `z + factor · z^power` is 1, for `power ≥ 1` and `factor ≥ 0`.
fn root(power: f64, factor: f64) -> f64 {
    if factor.is_infinite() {
        return 0.0;
    }
    // A convex function from above: each of Newton's steps goes down to the root and not beyond.
    let mut z = factor.powf(-power.recip()).min(1.0);
    for _ in 0..MOST_STEPS {
        let high = factor * z.powf(power - 1.0);
        let next = z - (z + high * z - 1.0) / (1.0 + power * high);
        if next >= z || next <= 0.0 {
            break;
        }
        z = next;
    }
    z
}

impl Element for PowerDashpot {
    fn force(&self, _deformation: f64, rate: f64) -> f64 {
        times_power(self.force, rate.abs() / self.at, self.exponent).copysign(rate)
    }

    fn tangent(&self, _deformation: f64, rate: f64) -> Tangent {
        let (force, speed) = (self.force(0.0, rate).abs(), rate.abs());
        let of_rest = if self.exponent < 1.0 { f64::MAX } else { 0.0 };
        let damping = if speed > 0.0 { self.exponent * (force / speed) } else { of_rest };
        Tangent { stiffness: 0.0, damping: damping.min(f64::MAX) }
    }

    fn stored(&self, _deformation: f64) -> f64 {
        0.0
    }

    fn law(&self) -> Law {
        let damping = self.force / self.at;
        if (self.exponent - 1.0).abs() > 0.0 {
            Law::Nonlinear { stiffness: 0.0, damping }
        } else {
            Law::Dashpot(damping)
        }
    }

    fn grows_from(&self) -> Option<f64> {
        Some(0.0)
    }

    fn reflected(&self, sum: f64, damping: f64) -> Option<[f64; 2]> {
        let p = self.exponent;
        let whole = sum.abs();
        if whole == 0.0 {
            return Some([0.0, if p < 1.0 { 1.0 } else { -1.0 }]);
        }
        // The parts of the sum that the dashpot `damping` and the law itself have, solved for the one of
        // them in which the equation is convex: `part + own = 1` with `own = whole_own · part^p`.
        let whole_own = self.force(0.0, whole / damping) / whole;
        let part = if p < 1.0 {
            1.0 - root(p.recip(), whole_own.powf(-p.recip()))
        } else {
            root(p, whole_own)
        };
        let slope = p * (1.0 - part);
        Some([sum * (1.0 - 2.0 * part), (slope - part) / (slope + part)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_exponent_one_is_the_linear_dashpot() {
        let linear = PowerDashpot { force: 200.0, at: 2.0, exponent: 1.0 };
        assert_eq!(linear.law(), Law::Dashpot(100.0));
        assert!((linear.force(0.0, 1e-12) / 1e-10 - 1.0).abs() < 1e-12);
    }

    #[test]
    fn its_reflected_law_says_the_same_and_is_nowhere_steep() {
        for exponent in [0.2, 0.5, 0.8, 1.5, 2.0, 3.0] {
            let law = PowerDashpot { force: 200.0, at: 2.0, exponent };
            for part in [0.0, 1e-30, 1e-12, 1e-9, 1e-6, 1e-3, 0.3, 1.0, 7.0, 1e3, 1e30] {
                for (rate, damping) in [(2.0 * part, 100.0), (-2.0 * part, 0.01)] {
                    let (force, damped) = (law.force(0.0, rate), damping * rate);
                    let [left, slope] = law.reflected(force + damped, damping).unwrap();
                    let size = force.abs() + damped.abs();
                    let what = format!("{exponent} {rate}: {left}");
                    assert!((left - (force - damped)).abs() <= 1e-13 * size, "{what}");
                    assert!(slope.abs() <= 1.0, "{what} {slope}");
                    let own = law.tangent(0.0, rate).damping / damping;
                    let expected = 1.0 - 2.0 / (own + 1.0);
                    assert!((slope - expected).abs() <= 1e-9, "{what} {slope} {expected}");
                }
            }
        }
    }
}
