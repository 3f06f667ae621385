//! Quantities with units: `"20 MN/m"`, `"6 kN s/m"`, `"1 g0"`.
//!
//! A quantity is a number and a unit. A unit is a product of symbols, separated by spaces, `*` or
//! `·`; `/` divides by the one symbol, or the parenthesis, that follows it; powers are written
//! `^2`, `²` or `2`, and those that are no whole numbers `^1.5` or `^(2/3)`. A number alone is in SI units. Everything is SI once it has been read.
//!
//! Degrees Celsius (`"20 degC"`, `"20 °C"`) count from a point of their own. So they are read only
//! where they are the whole unit, and what is read is a temperature and never a difference.

mod dimension;
mod exponent;
mod format;
mod nearest;
mod parse;
mod shown;
mod symbols;
mod worded;

pub use dimension::{Dimension, si_unit};
pub use exponent::Exponent;
pub use format::{exact_quantity, format_quantity, format_short, tidy};
pub use nearest::nearest;
pub use parse::{Quantity, UnitError, parse_dimension, parse_quantity};
pub use shown::{Unit, percent, quantity, rounded, significant};
pub use symbols::{foreign, meant_as};

/// Standard acceleration of free fall \[m/s²\] (3rd CGPM, 1901).
pub const STANDARD_GRAVITY: f64 = 9.806_65;

#[cfg(test)]
mod tests;
