//! Why a test cannot be made.

use dashpot_network::parameters::InvalidParameter;
use thiserror::Error;

/// Why a test has no report.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum RheometerError {
    /// There is no such protocol.
    #[error("unknown test `{name}`; known tests: {}", .known.join(", "))]
    UnknownProtocol {
        /// What was asked for.
        name: String,
        /// What there is.
        known: Vec<&'static str>,
    },
    /// The protocol has no such parameter.
    #[error("`{protocol}` has no `{name}`; it has: {}", .known.join(", "))]
    UnknownParameter {
        /// The protocol.
        protocol: &'static str,
        /// What was given.
        name: String,
        /// What it has.
        known: Vec<&'static str>,
    },
    /// A parameter of the test or of the model is out of its range.
    #[error(transparent)]
    Invalid(#[from] InvalidParameter),
    /// The model is not linear.
    #[error("`{kind}` is not linear: run it in a scene")]
    NotLinear {
        /// Word of the first element that is not.
        kind: &'static str,
    },
    /// The constants of the model or of the test are too far apart for double precision.
    #[error("the constants of the model or the test are too far apart for double precision")]
    OutOfScale,
    /// The model cannot be tested in this way.
    #[error("`{protocol}` is not possible: {reason}")]
    Impossible {
        /// The protocol.
        protocol: &'static str,
        /// Why, in mechanical words, and what is possible.
        reason: &'static str,
    },
}
