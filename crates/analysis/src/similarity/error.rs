//! What can go wrong with similar scenes.

use dashpot_network::parameters::{Dimension, InvalidParameter};
use thiserror::Error;

use super::Ranges;

/// Why there is no similar scene.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SimilarityError {
    /// A parameter that the scene does not have.
    #[error("the scene has no parameter `{name}`")]
    UnknownQuantity {
        /// The name.
        name: String,
        /// The parameters that it has.
        known: Vec<String>,
    },
    /// A parameter that cannot be scaled.
    #[error(
        "`{name}` is {} in the scene, so no scale makes it {}",
        said(*.from, *.dimension),
        said(*.to, *.dimension)
    )]
    NoFactor {
        /// The parameter.
        name: String,
        /// Its value in the scene, in SI units.
        from: f64,
        /// The value wanted, in SI units.
        to: f64,
        /// What it measures.
        dimension: Dimension,
    },
    /// Wishes that contradict each other.
    #[error(
        "`{name}` cannot be {} as well: the other wishes make it {}",
        said(*.to, *.dimension),
        said(*.follows, *.dimension)
    )]
    Contradiction {
        /// The parameter.
        name: String,
        /// The value wanted, in SI units.
        to: f64,
        /// What follows from the wishes before, in SI units.
        follows: f64,
        /// What it measures.
        dimension: Dimension,
    },
    /// A group that a scene of this form cannot have.
    #[error("the group {name} is {value}, and must be {range}")]
    GroupOutOfRange {
        /// The group.
        name: &'static str,
        /// The value wanted.
        value: f64,
        /// What it may be.
        range: &'static str,
    },
    /// Groups that no padding has together.
    #[error(
        "no padding has these groups: q = a − b c/d − d/c is {q:.6}, and must be positive; with the \
         other groups as they are there is one for: {ranges}"
    )]
    NoPadding {
        /// The value of q.
        q: f64,
        /// Where there is one.
        ranges: Box<Ranges>,
    },
    /// A scene that has not the form in question.
    #[error("the scene has not the form of the thesis: {reason}")]
    OtherForm {
        /// What is different.
        reason: &'static str,
    },
    /// A value out of its range.
    #[error(transparent)]
    Invalid(#[from] InvalidParameter),
}

/// A value with its unit, where that has a name.
fn said(value: f64, dimension: Dimension) -> String {
    match dimension.named().filter(|_| dimension != Dimension::NUMBER) {
        Some((_, unit)) => format!("{value} {unit}"),
        None => value.to_string(),
    }
}
