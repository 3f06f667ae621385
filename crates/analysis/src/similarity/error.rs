//! What can go wrong with similar scenes.

use dashpot_network::parameters::InvalidParameter;
use thiserror::Error;

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
    #[error("`{name}` is {from} in the scene, so no scale makes it {to}")]
    NoFactor {
        /// The parameter.
        name: String,
        /// Its value in the scene.
        from: f64,
        /// The value wanted.
        to: f64,
    },
    /// Wishes that contradict each other.
    #[error("`{name}` cannot be {to} as well: the other wishes make it {follows}")]
    Contradiction {
        /// The parameter.
        name: String,
        /// The value wanted, in SI units.
        to: f64,
        /// What follows from the wishes before, in SI units.
        follows: f64,
    },
    /// A group that a scene of this form cannot have.
    #[error("no padding has these groups: q = a - b c/d - d/c is {q:.6}, and must be positive")]
    NoPadding {
        /// The value of q.
        q: f64,
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
