//! Double-double arithmetic: numbers as sums of two doubles.

use std::{
    cmp::Ordering,
    iter::Sum,
    ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign},
};

/// `a + b = sum + rest` exactly (Knuth), as long as nothing overflows.
#[inline]
pub fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let other = sum - a;
    (sum, (a - (sum - other)) + (b - other))
}

/// `a b = product + rest` exactly, unless the rest is below the smallest double.
#[inline]
pub fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    (product, a.mul_add(b, -product))
}

/// A double-double number, known to about 32 digits: the unevaluated sum of two doubles, of which the second is at
/// most half a unit in the last place of the first.
///
/// Each operation is right to a few units of 2⁻¹⁰⁴, relatively, as long as its result and rest are normal doubles;
/// results below about 10⁻²⁹² have fewer digits. Overflow gives infinities or NaN, as with doubles.
///
/// # References
///
/// Joldes, Muller, Popescu, *Tight and rigorous error bounds for basic building blocks of
/// double-word arithmetic*, 2017.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Default)]
pub struct DoubleDouble {
    high: f64,
    low: f64,
}

impl DoubleDouble {
    /// 0.
    pub const ZERO: Self = Self { high: 0.0, low: 0.0 };
    /// 1.
    pub const ONE: Self = Self { high: 1.0, low: 0.0 };

    /// The number `high + low`.
    #[inline]
    pub fn from_parts(high: f64, low: f64) -> Self {
        let (high, low) = two_sum(high, low);
        Self { high, low }
    }

    /// The nearest double.
    #[inline]
    pub fn high(self) -> f64 {
        self.high
    }

    /// What is left of the number beside [`high`](Self::high).
    #[inline]
    pub fn low(self) -> f64 {
        self.low
    }

    /// `1/self`.
    #[inline]
    #[must_use]
    pub fn recip(self) -> Self {
        Self::ONE / self
    }

    /// The absolute value.
    #[inline]
    #[must_use]
    pub fn abs(self) -> Self {
        if self.high < 0.0 { -self } else { self }
    }

    /// An order in which every number has its place, NaN too.
    pub fn total_cmp(&self, other: &Self) -> Ordering {
        self.high.total_cmp(&other.high).then(self.low.total_cmp(&other.low))
    }

    /// The square root of a number ≥ 0.
    #[must_use]
    pub fn sqrt(self) -> Self {
        if self.high <= 0.0 {
            return Self::from(self.high.sqrt());
        }
        // One step of Newton from the root in doubles doubles its digits.
        let root = self.high.sqrt();
        let rest = self - Self::product(root, root);
        Self::from_parts(root, rest.high / (2.0 * root))
    }

    /// `a b`, exactly.
    #[inline]
    pub fn product(a: f64, b: f64) -> Self {
        let (high, low) = two_product(a, b);
        Self { high, low }
    }

    /// `a/b`, with all digits.
    #[inline]
    pub fn quotient(a: f64, b: f64) -> Self {
        Self::from(a) / Self::from(b)
    }
}

impl From<f64> for DoubleDouble {
    #[inline]
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

impl Neg for DoubleDouble {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Add for DoubleDouble {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        let (sum, rest) = two_sum(self.high, other.high);
        let (low, last) = two_sum(self.low, other.low);
        let first = Self::from_parts(sum, rest + low);
        Self::from_parts(first.high, first.low + last)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        let (product, rest) = two_product(self.high, other.high);
        let cross = self.high.mul_add(other.low, self.low * other.high);
        Self::from_parts(product, rest + cross)
    }
}

impl Div for DoubleDouble {
    type Output = Self;

    /// Long division by doubles: two digits of 53 bits.
    #[inline]
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * first;
        Self::from_parts(first, rest.high / other.high)
    }
}

impl Add<f64> for DoubleDouble {
    type Output = Self;

    #[inline]
    fn add(self, other: f64) -> Self {
        self + Self::from(other)
    }
}

impl Sub<f64> for DoubleDouble {
    type Output = Self;

    #[inline]
    fn sub(self, other: f64) -> Self {
        self + Self::from(-other)
    }
}

impl Mul<f64> for DoubleDouble {
    type Output = Self;

    #[inline]
    fn mul(self, other: f64) -> Self {
        let (product, rest) = two_product(self.high, other);
        Self::from_parts(product, self.low.mul_add(other, rest))
    }
}

impl AddAssign for DoubleDouble {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for DoubleDouble {
    #[inline]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl MulAssign for DoubleDouble {
    #[inline]
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl Div<f64> for DoubleDouble {
    type Output = Self;

    #[inline]
    fn div(self, other: f64) -> Self {
        self / Self::from(other)
    }
}

impl MulAssign<f64> for DoubleDouble {
    #[inline]
    fn mul_assign(&mut self, other: f64) {
        *self = *self * other;
    }
}

impl SubAssign<f64> for DoubleDouble {
    #[inline]
    fn sub_assign(&mut self, other: f64) {
        *self = *self - other;
    }
}

impl PartialEq<f64> for DoubleDouble {
    #[inline]
    fn eq(&self, other: &f64) -> bool {
        *self == Self::from(*other)
    }
}

impl PartialOrd<f64> for DoubleDouble {
    #[inline]
    fn partial_cmp(&self, other: &f64) -> Option<Ordering> {
        self.partial_cmp(&Self::from(*other))
    }
}

impl Sum for DoubleDouble {
    fn sum<I: Iterator<Item = Self>>(numbers: I) -> Self {
        numbers.fold(Self::ZERO, Add::add)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A few units of 2⁻¹⁰⁴.
    const TOLERANCE: f64 = 2e-31;

    fn samples() -> Vec<DoubleDouble> {
        (1..200)
            .map(|at| {
                let x = f64::from(at).sqrt() * 10_f64.powi(at % 41 - 20);
                DoubleDouble::from_parts(x, x * f64::EPSILON * (f64::from(at).sin() * 0.4))
            })
            .collect()
    }

    #[track_caller]
    fn assert_near(found: DoubleDouble, expected: DoubleDouble) {
        let error = ((found - expected).high() / expected.high()).abs();
        assert!(error < TOLERANCE, "{found:?} for {expected:?}, off by {error:.1e}");
    }

    #[test]
    fn division_undoes_multiplication() {
        let all = samples();
        for (&a, &b) in all.iter().zip(all.iter().rev()) {
            assert_near(a * b / b, a);
            assert_near(b.recip() * b, DoubleDouble::ONE);
            assert_near((a + b) * (a + b), a * a + a * b * 2.0 + b * b);
        }
    }

    #[test]
    fn a_third_has_all_its_digits() {
        // 1/3 = 0x1.5555555555555p-2 + 0x1.5555555555555p-56.
        let third = DoubleDouble::quotient(1.0, 3.0);
        assert_eq!(third.high().to_bits(), (1.0_f64 / 3.0).to_bits());
        assert_eq!(third.low().to_bits(), (1.0_f64 / 3.0 * 2_f64.powi(-54)).to_bits());
    }

    #[test]
    fn squares_of_roots_are_what_they_were() {
        for a in samples() {
            assert_near(a.sqrt() * a.sqrt(), a);
        }
        assert_eq!(DoubleDouble::ZERO.sqrt(), DoubleDouble::ZERO);
    }

    #[test]
    fn the_difference_of_products_keeps_its_digits() {
        // (1 + ε)(1 − ε) − 1 = −ε².
        let (a, b) = (1.0 + f64::EPSILON, 1.0 - f64::EPSILON);
        let rest = DoubleDouble::product(a, b) - DoubleDouble::ONE;
        assert_eq!(rest.high().to_bits(), (-f64::EPSILON * f64::EPSILON).to_bits());
    }

    #[test]
    fn order_is_that_of_the_numbers() {
        let one = DoubleDouble::ONE;
        assert!(
            one < DoubleDouble::from_parts(1.0, 1e-20)
                && one > DoubleDouble::from_parts(1.0, -1e-20)
        );
        assert_eq!((-one).abs(), one);
    }
}
