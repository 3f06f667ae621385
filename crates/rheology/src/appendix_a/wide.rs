//! Doubles whose exponent has no limit.

use std::ops::{Add, Div, Mul};

/// `fraction · 2^exponent`, with 1 ≤ |fraction| < 2 or zero.
///
/// Products of many constants leave the range of doubles long before a result does. Each operation
/// rounds like the one of doubles.
#[derive(Debug, Clone, Copy)]
pub(super) struct Wide {
    fraction: f64,
    exponent: i64,
}

/// Bits of the fraction of a double.
const FRACTION_BITS: i64 = 52;
/// Exponent in the representation of 1.
const BIAS: i64 = 1023;
const EXPONENT_MASK: u64 = 0x7FF << FRACTION_BITS;
/// Addends this many powers of two below the other one leave no trace in it.
const NEGLIGIBLE: i64 = 200;

/// `2^exponent`, for exponents of normal doubles.
#[expect(clippy::cast_sign_loss, reason = "a biased exponent is not negative")]
fn power_of_two(exponent: i64) -> f64 {
    f64::from_bits(((exponent + BIAS) as u64) << FRACTION_BITS)
}

impl Wide {
    /// `fraction · 2^exponent` for any finite `fraction`.
    #[expect(clippy::cast_possible_wrap, reason = "eleven bits fit either")]
    fn normal(fraction: f64, exponent: i64) -> Self {
        if fraction == 0.0 {
            return Self { fraction, exponent: 0 };
        }
        if !fraction.is_normal() {
            return Self::normal(fraction * power_of_two(64), exponent - 64);
        }
        let bits = fraction.to_bits();
        let own = ((bits & EXPONENT_MASK) >> FRACTION_BITS) as i64 - BIAS;
        let one = (BIAS as u64) << FRACTION_BITS;
        Self { fraction: f64::from_bits(bits & !EXPONENT_MASK | one), exponent: exponent + own }
    }

    /// The nearest double; `None` where there is no normal one.
    pub(super) fn double(self) -> Option<f64> {
        if self.fraction == 0.0 {
            return Some(0.0);
        }
        (1 - BIAS..=BIAS)
            .contains(&self.exponent)
            .then(|| self.fraction * power_of_two(self.exponent))
    }

    pub(super) fn is_zero(self) -> bool {
        self.fraction == 0.0
    }

    pub(super) fn is_negative(self) -> bool {
        self.fraction < 0.0
    }

    pub(super) fn magnitude(self) -> Self {
        Self { fraction: self.fraction.abs(), ..self }
    }

    pub(super) fn twice(self) -> Self {
        Self { exponent: self.exponent + 1, ..self }
    }

    pub(super) fn half(self) -> Self {
        Self { exponent: self.exponent - 1, ..self }
    }

    pub(super) fn squared(self) -> Self {
        self * self
    }

    /// Root of a number ≥ 0.
    pub(super) fn root(self) -> Self {
        let odd = self.exponent.rem_euclid(2);
        Self::normal((self.fraction * power_of_two(odd)).sqrt(), (self.exponent - odd) / 2)
    }

    /// `a b − c d` to two units in the last place, and zero only where it is zero, by Kahan's use of
    /// fused multiplication (Jeannerod, Louvet and Muller 2013).
    pub(super) fn difference_of_products(a: Self, b: Self, c: Self, d: Self) -> Self {
        let (first, second) = (a.exponent + b.exponent, c.exponent + d.exponent);
        let exponent = first.max(second);
        let shifted = |own: i64| power_of_two((own - exponent).max(-NEGLIGIBLE));
        let (x, y) = (a.fraction * shifted(first), c.fraction * shifted(second));
        let product = y * d.fraction;
        let lost = (-y).mul_add(d.fraction, product);
        Self::normal(x.mul_add(b.fraction, -product) + lost, exponent)
    }
}

impl From<f64> for Wide {
    fn from(number: f64) -> Self {
        Self::normal(number, 0)
    }
}

impl Mul for Wide {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self::normal(self.fraction * other.fraction, self.exponent + other.exponent)
    }
}

impl Div for Wide {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        Self::normal(self.fraction / other.fraction, self.exponent - other.exponent)
    }
}

impl Add for Wide {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return if self.is_zero() { other } else { self };
        }
        let exponent = self.exponent.max(other.exponent);
        let shifted =
            |own: Self| own.fraction * power_of_two((own.exponent - exponent).max(-NEGLIGIBLE));
        Self::normal(shifted(self) + shifted(other), exponent)
    }
}
