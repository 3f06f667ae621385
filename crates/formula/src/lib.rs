//! Arithmetic with units, and formulas with their derivatives.
//!
//! A [`Formula`] is a text such as `"2 * area * 100 kPa"` or `"20 MN/m * y * (1 + (y / 5 mm)^2)"`, read into a
//! tree. With names that stand for quantities it has a [value](Formula::quantity) with a dimension; with
//! variables it is a [law](Formula::law), an [`Expression`] in SI units that can be differentiated and
//! [compiled](Program).
//!
//! # Grammar
//!
//! ```text
//! sum     = product { ("+" | "-") product }
//! product = sign { ("*" | "·" | "/") sign }
//! sign    = { "-" | "+" } power
//! power   = atom [ "^" sign ]
//! atom    = number [ unit ] | name | function "(" sum { "," sum } ")" | "(" sum ")"
//! ```
//!
//! A unit stands only behind a number and binds tighter than all else: `5 mm^2` are five square millimetres, and
//! `20 kN/m * y` are 20 kN/m times `y`. Where a `*` is followed by a name, the unit ends before it; where a `/` with
//! spaces is followed by what is both a unit and a name, the text is refused. A word elsewhere is a name, `pi` or
//! `g0`. Number without a unit are pure numbers; only a plain 0 fits every dimension, as in `max(0, y - 5 mm)`.

mod antiderivative;
mod derivative;
mod error;
mod expression;
mod function;
mod law;
mod parse;
mod program;
mod tree;
mod unit;
mod waves;

pub use error::{FormulaError, FormulaFault};
pub use expression::Expression;
pub use function::Function;
pub use law::{Meaning, Variable};
pub use parse::is_arithmetic;
pub use program::Program;
pub use tree::Formula;
pub use waves::PolynomialAndSine;

#[cfg(test)]
mod tests;
