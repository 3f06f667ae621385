//! Ranges of numbers.

use dashpot_units::{Dimension, exact_quantity};

use super::InvalidParameter;

dashpot_units::words! {
    /// The numbers that a parameter may have; all of them are finite. Those that are never negative are 0 or at
    /// least 2.2·10⁻³⁰⁸: the reciprocal of less is beyond double precision.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Range, pub fn words(self) {
        /// Any.
        Finite = "finite",
        /// Any, of an angle \[rad\]; other numbers are no angles.
        Angle = "finite",
        /// All but 0.
        NotZero = "finite and not zero",
        /// ≥ 0.
        NonNegative = "zero or positive, and finite",
        /// > 0.
        Positive = "positive and finite",
        /// ≥ 1.
        AtLeastOne = "1 or more, and finite",
        /// From 0 to 1.
        Part = "from 0 to 1",
        /// Above 0 and ≤ 1.
        PositivePart = "above 0, and 1 at most",
        /// ≥ 0 and below 1.
        PartBelowOne = "zero or positive, and below 1",
        /// A whole number from 2 to 100 000.
        Count = "a whole number from 2 to 100000",
        /// A temperature > 0 \[K\].
        AboveAbsoluteZero = "above absolute zero, and finite",
    }
}

impl Range {
    /// Whether a number is in it.
    pub fn contains(self, number: f64) -> bool {
        number.is_finite()
            && (!number.is_subnormal() || matches!(self, Self::Finite | Self::Angle))
            && match self {
                Self::Finite | Self::Angle => true,
                Self::NotZero => number != 0.0,
                Self::NonNegative => number >= 0.0,
                Self::Positive | Self::AboveAbsoluteZero => number > 0.0,
                Self::AtLeastOne => number >= 1.0,
                Self::Part => (0.0..=1.0).contains(&number),
                Self::PositivePart => number > 0.0 && number <= 1.0,
                Self::Count => number.fract() == 0.0 && (2.0..=1e5).contains(&number),
                Self::PartBelowOne => (0.0..1.0).contains(&number),
            }
    }

    /// Accepts the numbers in it.
    ///
    /// # Errors
    ///
    /// [`InvalidParameter`] for all others, NaN included.
    pub fn check(self, parameter: &'static str, number: f64) -> Result<(), InvalidParameter> {
        if self.contains(number) {
            return Ok(());
        }
        let found = match self {
            _ if number.is_subnormal() => {
                let least = exact_quantity(f64::MIN_POSITIVE, Dimension::NUMBER);
                format!("{number:e}, which is below {least}")
            }
            Self::AboveAbsoluteZero => kelvins(number),
            _ => exact_quantity(number, Dimension::NUMBER),
        };
        Err(InvalidParameter::new(parameter, self.words(), found))
    }
}

/// A temperature \[K\] as text for a message, without the digits that come from rounding.
pub(crate) fn kelvins(value: f64) -> String {
    let rounded = (value * 1e6).round() / 1e6;
    format!("{} K", if rounded == 0.0 || !rounded.is_finite() { value } else { rounded })
}
