//! The power law that several elements share.

use std::f64::consts::SQRT_2;

use crate::parameters::InvalidParameter;

/// `F_r (y/y_r)^n` for `y ≥ 0`, with `n ≥ 1`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PowerLaw {
    /// `F_r`.
    pub(super) force: f64,
    /// `y_r`.
    pub(super) at: f64,
    /// `n`.
    pub(super) exponent: f64,
}

impl PowerLaw {
    pub(super) fn value(&self, deformation: f64) -> f64 {
        times_power(self.force, deformation / self.at, self.exponent)
    }

    pub(super) fn slope(&self, deformation: f64) -> f64 {
        times_power(self.secant(), deformation / self.at, self.exponent - 1.0) * self.exponent
    }

    /// The integral of [`value`](Self::value) from 0.
    pub(super) fn integral(&self, deformation: f64) -> f64 {
        self.value(deformation) * deformation / (self.exponent + 1.0)
    }

    /// The slope of the line from 0 to the reference, `F_r/y_r`.
    pub(super) fn secant(&self) -> f64 {
        self.force / self.at
    }

    /// Whether its slope at the reference is a number.
    pub(super) fn fits(&self) -> Result<(), InvalidParameter> {
        in_range("at", self.at, self.secant() * self.exponent)
    }
}

/// Up to this exponent the power of a number between √½ and √2 is a number by far.
const LARGE: f64 = 64.0;
/// The bits of an exponent whose product with that of a power of two needs no rounding.
const COARSE: u64 = !0x1fff;

/// `factor · ratio^exponent` for `ratio ≥ 0`.
///
/// One law can be written with many references, which makes the factor larger and the ratio smaller by
/// powers of two. This product has the same digits for all of them, which that with `powf` has not.
pub(super) fn times_power(factor: f64, ratio: f64, exponent: f64) -> f64 {
    if exponent > LARGE || !ratio.is_normal() {
        return factor * ratio.powf(exponent);
    }
    let (near_one, twos) = split(ratio);
    // The exponent of the two, in a whole part and the rest, of which nothing is rounded away.
    let coarse = f64::from_bits(exponent.to_bits() & COARSE);
    let whole = (twos * coarse).floor();
    let rest = (twos * coarse - whole) + twos * (exponent - coarse);
    let product = factor * near_one.powf(exponent);
    let product = if rest.abs() > 0.0 { product * rest.exp2() } else { product };
    let half = (0.5 * whole).floor();
    product * power_of_two(half) * power_of_two(whole - half)
}

/// `x^n`, by products where `n` is a small whole number: much faster, and as good.
#[inline]
pub(super) fn power(x: f64, exponent: f64) -> f64 {
    const LARGEST: f64 = 8.0;
    if exponent.abs() <= LARGEST && exponent.fract() == 0.0 {
        #[expect(clippy::cast_possible_truncation, reason = "it is whole and small")]
        let whole = exponent as i32;
        x.powi(whole)
    } else {
        x.powf(exponent)
    }
}

/// A positive normal number as one between √½ and √2 times a power of two.
fn split(number: f64) -> (f64, f64) {
    let bits = number.to_bits();
    let mantissa = f64::from_bits((bits & ((1 << 52) - 1)) | 1.0_f64.to_bits());
    let twos = (bits >> 52) as f64 - 1023.0;
    if mantissa > SQRT_2 { (0.5 * mantissa, twos + 1.0) } else { (mantissa, twos) }
}

/// `2^exponent` of a whole exponent, or the nearest to it that is a normal number.
fn power_of_two(exponent: f64) -> f64 {
    exponent.clamp(-1022.0, 1023.0).exp2()
}

/// Accepts `value` where the `slope` that it leads to is a normal number.
pub(super) fn in_range(
    parameter: &'static str,
    value: f64,
    slope: f64,
) -> Result<(), InvalidParameter> {
    if slope.is_normal() {
        Ok(())
    } else {
        let range = "such that the slope of the law fits into double precision";
        Err(InvalidParameter::new(parameter, range, format!("{value:?}")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_law_has_the_same_digits_at_all_references_that_are_powers_of_two_apart() {
        let mut y = 1.234_567e-9;
        while y < 1e3 {
            for (exponent, step) in [(1.0, 1), (1.5, 2), (2.0, 1), (2.75, 4), (3.0, 1)] {
                let law = PowerLaw { force: 731.9, at: 0.003_7, exponent };
                let expected = 731.9 * (y / 0.003_7_f64).powf(exponent);
                assert!((law.value(y) / expected - 1.0).abs() < 1e-14, "{exponent} {y}");
                for shift in (-20..=20).map(|own| own * step) {
                    let apart = f64::from(shift).exp2();
                    let force = 731.9 * (f64::from(shift) * exponent).exp2();
                    let same = PowerLaw { force, at: 0.003_7 * apart, exponent };
                    assert_eq!(same.value(y).to_bits(), law.value(y).to_bits(), "{exponent} {y}");
                    assert_eq!(same.slope(y).to_bits(), law.slope(y).to_bits(), "{exponent} {y}");
                    assert_eq!(same.integral(y).to_bits(), law.integral(y).to_bits());
                }
            }
            y *= 1.37;
        }
    }

    #[test]
    fn powers_at_the_ends_of_the_range_are_those_of_the_library() {
        for ratio in [0.0, 5e-324, 1e-310, 1e-300, 0.3, 1.0, 1e300, f64::INFINITY] {
            for exponent in [0.0, 0.1, 0.5, 1.0, 1.37, 3.0, 70.0] {
                let (own, other) = (times_power(3.0, ratio, exponent), 3.0 * ratio.powf(exponent));
                let same = own.to_bits() == other.to_bits();
                assert!(
                    same || (own / other - 1.0).abs() < 1e-13,
                    "{ratio} {exponent} {own} {other}"
                );
            }
        }
    }
}
