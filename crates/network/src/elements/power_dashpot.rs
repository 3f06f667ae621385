//! Dashpot whose force is a power of its rate.

use super::{
    Element, ElementKind, Law, Tangent, number,
    power::{AT, EXPONENT, FORCE, in_range},
};
use crate::parameters::{Dimension, InvalidParameter, Parameter, ParameterKind, Value, positive};

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
/// The power has an infinite slope at rest for `p < 1`, and none for `p > 1`. Below 10⁻⁹ `v_r` the
/// law for `p < 1` is the straight line through zero that meets it there. The law for `p > 1` has
/// the linear part 10⁻⁹ `F_r ẏ/v_r` besides.
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
pub struct PowerDashpot {
    /// Force `F_r` at the reference rate \[N\].
    pub force: f64,
    /// Reference rate `v_r` \[m/s\].
    pub at: f64,
    /// Exponent `p`.
    pub exponent: f64,
}

/// The part of the reference rate below which a law of `p < 1` is linear, and the part of the
/// reference slope that a law of `p > 1` has at rest.
const SMALL: f64 = 1e-9;
/// Newton steps; five are the usual number.
const MOST_STEPS: usize = 100;

impl PowerDashpot {
    /// Force and slope over the rate, both in units of the reference, at the part `rate ≥ 0` of it.
    fn parts(&self, rate: f64) -> (f64, f64) {
        let p = self.exponent;
        if p > 1.0 {
            (rate.powf(p) + SMALL * rate, p * rate.powf(p - 1.0) + SMALL)
        } else if rate < SMALL {
            let slope = SMALL.powf(p - 1.0);
            (slope * rate, slope)
        } else {
            (rate.powf(p), p * rate.powf(p - 1.0))
        }
    }

    /// The rate, in units of the reference, at which it and the force together are `sum ≥ 0` of their
    /// references.
    fn rate_of(&self, sum: f64) -> f64 {
        let p = self.exponent;
        if p > 1.0 {
            root(p, 1.0 + SMALL, sum)
        } else if sum < SMALL + SMALL.powf(p) {
            sum / (1.0 + SMALL.powf(p - 1.0))
        } else {
            root(p.recip(), 1.0, sum).powf(p.recip())
        }
    }
}

/// The `z ≥ 0` at which `slope · z + z^power` is `sum ≥ 0`, for `power ≥ 1` and `slope ≥ 1`.
fn root(power: f64, slope: f64, sum: f64) -> f64 {
    // A convex function from above: each of Newton's steps goes down to the root and not beyond.
    let mut z = (sum / slope).min(sum.powf(power.recip()));
    for _ in 0..MOST_STEPS {
        let high = z.powf(power - 1.0);
        let next = z - (slope * z + high * z - sum) / (slope + power * high);
        if next >= z || next <= 0.0 {
            break;
        }
        z = next;
    }
    z
}

impl Element for PowerDashpot {
    fn kind(&self) -> &'static str {
        Self::KIND
    }

    fn force(&self, _deformation: f64, rate: f64) -> f64 {
        (self.force * self.parts(rate.abs() / self.at).0).copysign(rate)
    }

    fn tangent(&self, _deformation: f64, rate: f64) -> Tangent {
        let damping = self.force / self.at * self.parts(rate.abs() / self.at).1;
        Tangent { stiffness: 0.0, damping }
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

    fn reflected(&self, sum: f64) -> Option<[f64; 2]> {
        let whole = sum.abs() / self.force;
        let rate = self.rate_of(whole);
        let (_, slope) = self.parts(rate);
        let left = self.force * (whole - 2.0 * rate);
        Some([left * sum.signum(), (slope - 1.0) / (slope + 1.0)])
    }

    fn validate(&self) -> Result<(), InvalidParameter> {
        positive(FORCE, self.force)?;
        positive(AT, self.at)?;
        positive(EXPONENT, self.exponent)?;
        in_range(AT, self.at, self.force / self.at * self.parts(0.0).1)?;
        in_range(AT, self.at, self.force / self.at * self.exponent)
    }

    fn values(&self) -> Vec<Value> {
        [self.force, self.at, self.exponent].map(Value::Number).to_vec()
    }
}

impl ElementKind for PowerDashpot {
    const KIND: &'static str = "power-dashpot";
    const SUMMARY: &'static str = "dashpot of a power law, F = F_r (|y'|/v_r)^p sgn y'";
    const PARAMETERS: &'static [Parameter] = &[
        Parameter::required(
            FORCE,
            ParameterKind::Quantity(Dimension::FORCE),
            "force F_r at the rate `at` [N], positive",
        ),
        Parameter::required(
            AT,
            ParameterKind::Quantity(Dimension::VELOCITY),
            "reference rate v_r [m/s], positive",
        ),
        Parameter::required(
            EXPONENT,
            ParameterKind::Quantity(Dimension::NUMBER),
            "exponent p [1], positive",
        ),
    ];

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        let dashpot = Self {
            force: number(values, 0, FORCE)?,
            at: number(values, 1, AT)?,
            exponent: number(values, 2, EXPONENT)?,
        };
        dashpot.validate().map(|()| dashpot)
    }

    fn sample() -> Self {
        Self { force: 200.0, at: 1.0, exponent: 0.5 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_continuous_where_its_core_ends_and_has_a_slope_at_rest() {
        let thinning = PowerDashpot { force: 200.0, at: 2.0, exponent: 0.5 };
        let border = 2.0 * SMALL;
        let (within, beyond) = (border * (1.0 - 1e-12), border * (1.0 + 1e-12));
        let both = [within, beyond].map(|rate| thinning.force(0.0, rate));
        assert!((both[0] / both[1] - 1.0).abs() < 1e-11);
        let thickening = PowerDashpot { force: 200.0, at: 2.0, exponent: 2.0 };
        assert!((thickening.tangent(0.0, 0.0).damping / 1e-7 - 1.0).abs() < 1e-12);
        assert!((thickening.force(0.0, -4.0) + 800.0).abs() < 1e-6);
    }

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
            for part in [0.0, 1e-12, 1e-9, 1e-6, 1e-3, 0.3, 1.0, 7.0, 1e3] {
                for rate in [2.0 * part, -2.0 * part] {
                    let (force, damped) = (law.force(0.0, rate), 100.0 * rate);
                    let [left, slope] = law.reflected(force + damped).unwrap();
                    let size = force.abs() + damped.abs();
                    let what = format!("{exponent} {rate}: {left}");
                    assert!((left - (force - damped)).abs() <= 1e-13 * size, "{what}");
                    assert!(slope.abs() <= 1.0, "{what} {slope}");
                    let own = law.tangent(0.0, rate).damping / 100.0;
                    let border = (part / SMALL - 1.0).abs() < 1e-6;
                    let expected = (own - 1.0) / (own + 1.0);
                    assert!(
                        border || (slope - expected).abs() <= 1e-9,
                        "{what} {slope} {expected}"
                    );
                }
            }
        }
    }
}
