//! What can be wrong with a formula.

use std::{fmt, ops::Range};

use dashpot_units::{Dimension, UnitError, parse_dimension, si_unit};
use thiserror::Error;

/// What is wrong, and where.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{fault}")]
pub struct FormulaError {
    /// What is wrong.
    pub fault: FormulaFault,
    /// The bytes of the text that it is about.
    pub span: Range<usize>,
}

/// What is wrong with a formula.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum FormulaFault {
    /// A number or its unit.
    #[error(transparent)]
    Quantity(UnitError),
    /// Something else was expected.
    #[error("{expected} is expected here{}", instead(.found))]
    Unexpected { expected: &'static str, found: String },
    /// A name that stands for nothing.
    #[error("there is no value named `{name}`")]
    UnknownName { name: String },
    /// A word with a parenthesis behind it that is no function.
    #[error("`{name}` is not a function")]
    UnknownFunction { name: String },
    /// A wrong number of arguments.
    #[error("`{}` takes {expected} number{}, but here are {found}", .function, if *.expected == 1 { "" } else { "s" })]
    Arguments { function: &'static str, expected: usize, found: usize },
    /// A word behind `/` that is both a unit and a name.
    #[error("`{word}` is both a unit and a name here")]
    Ambiguous { word: String },
    /// Two dimensions that cannot be added or compared.
    #[error("`{left}` is {} and `{right}` is {}: they cannot be {verb}", in_words(*.left_is), in_words(*.right_is))]
    Unlike {
        left: String,
        left_is: Dimension,
        right: String,
        right_is: Dimension,
        verb: &'static str,
    },
    /// A dimension where a pure number has to stand.
    #[error("`{text}` is {}, where a pure number has to stand", in_words(*.found))]
    NotPure { text: String, found: Dimension },
    /// A power whose dimension has no whole exponents.
    #[error("`{text}` has no dimension: {} cannot be raised to such a power", in_words(*.base))]
    Power { text: String, base: Dimension },
    /// The result has another dimension than what is expected.
    #[error("this is {}; {} is expected", in_words(*.found), in_words(*.expected))]
    Dimension { found: Dimension, expected: Dimension },
    /// A part without a finite value.
    #[error("`{text}` has no finite value")]
    NotFinite { text: String },
    /// Too long, or too deep in parentheses.
    #[error("the formula is too long: at most 1000 characters and 50 parentheses in each other")]
    TooLong,
}

fn instead(text: &str) -> String {
    if text.is_empty() { ", where the text ends".to_owned() } else { format!(", not `{text}`") }
}

/// A dimension with its unit.
fn in_words(dimension: Dimension) -> impl fmt::Display {
    match dimension.named() {
        _ if dimension == Dimension::NUMBER => "a pure number".to_owned(),
        Some((name, unit)) => {
            let article = if name.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" };
            format!("{article} {name} ({unit})")
        }
        None => format!("in {}", si_unit(dimension)),
    }
}

impl FormulaFault {
    /// How to put it right, where that can be said.
    pub fn help(&self) -> Option<String> {
        Some(match self {
            Self::Ambiguous { word } => format!(
                "write `/{word}` without spaces where the unit is meant, or the number with its unit in \
                 parentheses where the name is"
            ),
            Self::NotPure { found, .. } => format!(
                "divide by a reference of the same dimension, as in sinh(y / 5 mm), here one in {}",
                si_unit(*found)
            ),
            Self::Power { .. } => "divide by a reference first, as in (y / 1 mm)^1.5".to_owned(),
            Self::Unlike { left_is, right_is, .. }
                if [*left_is, *right_is].contains(&Dimension::NUMBER) =>
            {
                "give the number its unit".to_owned()
            }
            Self::Unexpected { found, .. } if found == "*" => "a power is written ^".to_owned(),
            Self::Unexpected { found, .. } if found == "±" => {
                "scatter belongs to a number: give it to one under [values], and compute with its name".to_owned()
            }
            Self::Unexpected { found, .. } if parse_dimension(found).is_ok() => format!(
                "a unit stands behind a number alone: write `* 1 {found}` in place of `{found}`; between names stands `*`"
            ),
            Self::UnknownFunction { .. } => {
                let words = super::Function::ALL.map(super::Function::word);
                format!("the functions are {}; a product needs its `*`", words.join(", "))
            }
            _ => return None,
        })
    }
}
