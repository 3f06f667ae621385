//! The equivalent model of the thesis' appendix A: a Burgers element and two Maxwell elements side
//! by side, in closed form.
//!
//! [`LinearModel`](crate::LinearModel) converts any network. These are the formulas for the one pair
//! that the thesis gives, rearranged so that they lose no digits, as a second way to the same
//! numbers. They merge nothing: two Maxwell elements of nearly the same time have a Burgers element
//! for as long as their times differ at all.
//!
//! In the thesis, the Burgers element is a spring `K2`, a dashpot `C2` and a Kelvin–Voigt element
//! `K1`, `C1` in series; the Maxwell elements are `K3`, `C3` and `K4`, `C4`.

mod wide;

use thiserror::Error;

use wide::Wide;

/// A spring and a dashpot that belong together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringDashpot {
    /// Stiffness of the spring \[N/m\], positive and finite.
    pub spring: f64,
    /// Damping of the dashpot \[N s/m\], positive and finite.
    pub dashpot: f64,
}

/// A Maxwell and a Kelvin–Voigt element in series.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Burgers {
    /// Spring `K2` and dashpot `C2`, in series.
    pub maxwell: SpringDashpot,
    /// Spring `K1` and dashpot `C1`, in parallel.
    pub kelvin: SpringDashpot,
}

/// Two Maxwell elements in parallel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TwoMaxwell {
    /// Spring `K3` and dashpot `C3`, the element with the longer relaxation time `C3/K3`.
    pub slow: SpringDashpot,
    /// Spring `K4` and dashpot `C4`, the element with the shorter relaxation time `C4/K4`.
    pub fast: SpringDashpot,
}

/// What two Maxwell elements in parallel are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Equivalent {
    /// A Burgers element, where their relaxation times differ.
    Burgers(Burgers),
    /// One Maxwell element, where `C3 K4 = C4 K3`. It has no Kelvin–Voigt element.
    Maxwell(SpringDashpot),
}

/// Why there is no equivalent model.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum AppendixAError {
    /// A constant is zero, negative, infinite or not a number.
    #[error("`{constant}` must be positive and finite, but it is {value}")]
    NotPositive {
        /// Path of the constant, for instance `maxwell.spring`.
        constant: &'static str,
        /// What was given.
        value: f64,
    },
    /// A constant of the equivalent model is too large or too small for a double.
    #[error("`{constant}` of the equivalent model is out of the range of doubles")]
    OutOfRange {
        /// Path of the constant, for instance `slow.spring`.
        constant: &'static str,
    },
}

impl Burgers {
    /// The two Maxwell elements that respond like this Burgers element (A.5–A.10).
    ///
    /// With `a = K2/C2`, `b = K2/C1`, `c = K1/C1`, their rates are `α ∓ β`,
    ///
    /// ```text
    /// α = ½ (a + b + c)              β = √(α² − a c)
    /// K3 = K2 (c − α + β)/(2β)       C3 = K3/(α − β)
    /// K4 = K2 (α + β − c)/(2β)       C4 = K4/(α + β)
    /// ```
    ///
    /// As printed, A.9 has `K2/C1` twice, where one is `K1/C1`, and A.10 lacks the root. The model always exists: `4β²
    /// = (a − c)² + b² + 2b (a + c) > 0`, and `0 ≤ β < α`. These formulas subtract nearly equal numbers. Here `a − c`
    /// is taken by a fused difference of products, with `p = ½ (a − c + b)` the smaller one of `K3 = K2 (β − p)/(2β)`
    /// and `K4 = K2 (β + p)/(2β)` follows from `β² − p² = b c`, and the lower rate from the product `a c` of both. Each
    /// constant is right to a few units in its last place.
    ///
    /// # Examples
    ///
    /// ```
    /// use dashpot_rheology::appendix_a::{Burgers, SpringDashpot};
    ///
    /// let burgers = Burgers {
    ///     maxwell: SpringDashpot { spring: 2e7, dashpot: 6e3 },
    ///     kelvin: SpringDashpot { spring: 2e7, dashpot: 4e3 },
    /// };
    /// let two = burgers.to_two_maxwell()?;
    /// assert!((two.slow.spring + two.fast.spring - 2e7).abs() < 1e-8);
    /// assert!((two.slow.dashpot + two.fast.dashpot - 6e3).abs() < 1e-12);
    /// # Ok::<(), dashpot_rheology::appendix_a::AppendixAError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`AppendixAError::NotPositive`] for a constant that is not positive and finite;
    /// [`AppendixAError::OutOfRange`] where a result is beyond the normal range of doubles.
    pub fn to_two_maxwell(&self) -> Result<TwoMaxwell, AppendixAError> {
        let [k2, c2] = self.maxwell.checked(["maxwell.spring", "maxwell.dashpot"])?;
        let [k1, c1] = self.kelvin.checked(["kelvin.spring", "kelvin.dashpot"])?;
        let (a, b, c) = (k2 / c2, k2 / c1, k1 / c1);
        let a_less_c = Wide::difference_of_products(k2, c1, k1, c2) / (c1 * c2);
        // 2β and 2p.
        let span = (a_less_c.squared() + b.squared() + (b * (a + c)).twice()).root();
        let offset = a_less_c + b;
        let larger = span + offset.magnitude();
        let major = k2 * larger / span.twice();
        let minor = (k2 * b * c).twice() / (span * larger);
        let [k3, k4] = if offset.is_negative() { [major, minor] } else { [minor, major] };
        let fast = (a + b + c + span).half();
        let slow = a * c / fast;
        Ok(TwoMaxwell {
            slow: SpringDashpot::rounded([k3, k3 / slow], ["slow.spring", "slow.dashpot"])?,
            fast: SpringDashpot::rounded([k4, k4 / fast], ["fast.spring", "fast.dashpot"])?,
        })
    }
}

impl TwoMaxwell {
    /// What these two Maxwell elements are in one row (A.1–A.4). They may be given in either order.
    ///
    /// ```text
    /// K2 = K3 + K4        K1 = K3 K4 (C3 + C4)² (K3 + K4)/D²
    /// C2 = C3 + C4        C1 = C3 C4 (K3 + K4)² (C3 + C4)/D²        D = C3 K4 − C4 K3
    /// ```
    ///
    /// `D` is taken by a fused difference of products, so each constant is right to a few units in
    /// its last place, however close the relaxation times are. Where `D = 0` exactly, both elements
    /// are one Maxwell element with the spring `K3 + K4` and the dashpot `C3 + C4`.
    ///
    /// # Examples
    ///
    /// ```
    /// use dashpot_rheology::appendix_a::{Equivalent, SpringDashpot, TwoMaxwell};
    ///
    /// let two = TwoMaxwell {
    ///     slow: SpringDashpot { spring: 1e6, dashpot: 2e3 },
    ///     fast: SpringDashpot { spring: 3e6, dashpot: 6e3 },
    /// };
    /// let one = SpringDashpot { spring: 4e6, dashpot: 8e3 };
    /// assert_eq!(two.to_burgers()?, Equivalent::Maxwell(one));
    /// # Ok::<(), dashpot_rheology::appendix_a::AppendixAError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`AppendixAError::NotPositive`] for a constant that is not positive and finite;
    /// [`AppendixAError::OutOfRange`] where a result is beyond the normal range of doubles.
    pub fn to_burgers(&self) -> Result<Equivalent, AppendixAError> {
        let [k3, c3] = self.slow.checked(["slow.spring", "slow.dashpot"])?;
        let [k4, c4] = self.fast.checked(["fast.spring", "fast.dashpot"])?;
        let (k2, c2) = (k3 + k4, c3 + c4);
        let maxwell = SpringDashpot::rounded([k2, c2], ["maxwell.spring", "maxwell.dashpot"])?;
        let difference = Wide::difference_of_products(c3, k4, c4, k3);
        if difference.is_zero() {
            return Ok(Equivalent::Maxwell(maxwell));
        }
        let common = k2 * c2 / difference.squared();
        let kelvin = [k3 * k4 * c2 * common, c3 * c4 * k2 * common];
        let kelvin = SpringDashpot::rounded(kelvin, ["kelvin.spring", "kelvin.dashpot"])?;
        Ok(Equivalent::Burgers(Burgers { maxwell, kelvin }))
    }
}

impl SpringDashpot {
    fn checked(self, names: [&'static str; 2]) -> Result<[Wide; 2], AppendixAError> {
        for (value, constant) in [self.spring, self.dashpot].into_iter().zip(names) {
            if !(value > 0.0 && value.is_finite()) {
                return Err(AppendixAError::NotPositive { constant, value });
            }
        }
        Ok([self.spring.into(), self.dashpot.into()])
    }

    fn rounded(values: [Wide; 2], names: [&'static str; 2]) -> Result<Self, AppendixAError> {
        let double = |at: usize| {
            values[at].double().ok_or(AppendixAError::OutOfRange { constant: names[at] })
        };
        Ok(Self { spring: double(0)?, dashpot: double(1)? })
    }
}

#[cfg(test)]
mod tests;
