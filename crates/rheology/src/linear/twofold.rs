//! Numbers with twice the digits of a double, as this crate gives them to others.

use twofloat::TwoFloat;

/// A number known to about 32 digits: the unevaluated sum of two doubles.
///
/// The range is that of doubles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Twofold(pub(crate) TwoFloat);

impl Twofold {
    /// The number `high + low`.
    pub fn from_parts(high: f64, low: f64) -> Self {
        Self(TwoFloat::new_add(high, low))
    }

    /// The nearest double.
    pub fn high(self) -> f64 {
        self.0.hi()
    }

    /// What is left of the number beside [`high`](Self::high).
    pub fn low(self) -> f64 {
        self.0.lo()
    }
}

impl From<f64> for Twofold {
    fn from(number: f64) -> Self {
        Self(TwoFloat::from(number))
    }
}
