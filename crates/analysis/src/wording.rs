//! Quantities in running text.

/// A quantity with three significant digits in the unit that suits it, for instance `7.43 ms`.
pub(crate) fn quantity(value: f64, unit: &str) -> String {
    dashpot_units::quantity(value, unit, 3)
}

/// A share in percent with two significant digits.
pub(crate) fn percent(share: f64) -> String {
    dashpot_units::percent(share, 2)
}
