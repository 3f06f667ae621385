//! Exponents of units.

use std::{
    fmt,
    ops::{Add, Neg, Sub},
};

/// The exponent of a unit: a whole number, or one of up to two decimals or with thirds, as in `N/m^1.5`.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Exponent(i32);

/// Its parts: hundredths and thirds are whole numbers of them.
const PARTS: i32 = 300;
/// No exponent is larger.
const MOST: i32 = 127;

impl Exponent {
    /// That of what a quantity does not have.
    pub const ZERO: Self = Self(0);

    /// A whole number.
    pub const fn whole(power: i8) -> Self {
        Self(power as i32 * PARTS)
    }

    /// The exponent of this value; `None` where it has other parts, or is beyond ±127.
    pub fn of(power: f64) -> Option<Self> {
        let parts = power * f64::from(PARTS);
        let whole = parts.round();
        let fits = (parts - whole).abs() <= 1e-9 * whole.abs() && power.abs() <= f64::from(MOST);
        #[expect(clippy::cast_possible_truncation, reason = "it is whole and in range")]
        fits.then_some(Self(whole as i32))
    }

    /// Its value.
    pub fn value(self) -> f64 {
        f64::from(self.0) / f64::from(PARTS)
    }

    /// Its value without what is no whole number.
    pub const fn truncated(self) -> i32 {
        self.0 / PARTS
    }

    /// The sum of this and `power` times another one; `None` as by [`of`](Self::of).
    pub fn plus(self, other: Self, power: f64) -> Option<Self> {
        Self::of(self.value() + power * other.value())
    }
}

impl PartialEq<i8> for Exponent {
    fn eq(&self, other: &i8) -> bool {
        *self == Self::whole(*other)
    }
}

impl Neg for Exponent {
    type Output = Self;

    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Add<i8> for Exponent {
    type Output = Self;

    fn add(self, other: i8) -> Self {
        Self(self.0 + Self::whole(other).0)
    }
}

impl Sub<i8> for Exponent {
    type Output = Self;

    fn sub(self, other: i8) -> Self {
        Self(self.0 - Self::whole(other).0)
    }
}

impl Sub for Exponent {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl fmt::Display for Exponent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0 % (PARTS / 3) == 0 && self.0 % PARTS != 0 {
            return write!(f, "({}/3)", self.0 / (PARTS / 3));
        }
        self.value().fmt(f)
    }
}

impl fmt::Debug for Exponent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}
