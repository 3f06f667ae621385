//! Complex numbers with twice the digits of a double.

use std::ops::{Add, Mul, Neg, Sub};

use dashpot_numerics::DoubleDouble;

#[derive(Debug, Clone, Copy)]
pub(super) struct Complex {
    pub(super) re: DoubleDouble,
    pub(super) im: DoubleDouble,
}

impl Complex {
    pub(super) fn new(re: impl Into<DoubleDouble>, im: impl Into<DoubleDouble>) -> Self {
        Self { re: re.into(), im: im.into() }
    }

    pub(super) fn zero() -> Self {
        Self::new(0.0, 0.0)
    }

    pub(super) fn one() -> Self {
        Self::new(1.0, 0.0)
    }

    /// The absolute value as a double.
    pub(super) fn size(self) -> f64 {
        self.re.high().hypot(self.im.high())
    }

    pub(super) fn conjugate(self) -> Self {
        Self { re: self.re, im: -self.im }
    }

    pub(super) fn times(self, factor: DoubleDouble) -> Self {
        Self { re: self.re * factor, im: self.im * factor }
    }

    pub(super) fn over(self, divisor: Self) -> Self {
        // The larger part scales the smaller, so that squares stay in range.
        if divisor.re.high().abs() >= divisor.im.high().abs() {
            let ratio = divisor.im / divisor.re;
            let sum = divisor.re + divisor.im * ratio;
            Self { re: (self.re + self.im * ratio) / sum, im: (self.im - self.re * ratio) / sum }
        } else {
            let ratio = divisor.re / divisor.im;
            let sum = divisor.re * ratio + divisor.im;
            Self { re: (self.re * ratio + self.im) / sum, im: (self.im * ratio - self.re) / sum }
        }
    }

    /// The nearest doubles.
    pub(super) fn rounded(self) -> [f64; 2] {
        [self.re.high(), self.im.high()]
    }
}

impl Add for Complex {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { re: self.re + other.re, im: self.im + other.im }
    }
}

impl Sub for Complex {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self { re: self.re - other.re, im: self.im - other.im }
    }
}

impl Mul for Complex {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self {
            re: self.re * other.re - self.im * other.im,
            im: self.re * other.im + self.im * other.re,
        }
    }
}

impl Neg for Complex {
    type Output = Self;

    fn neg(self) -> Self {
        Self { re: -self.re, im: -self.im }
    }
}
