//! Why a number of a scene is not found, or cannot take the values that it is given.

use thiserror::Error;

use crate::text::nearest::list;

/// Why there is no such number.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum TunableFault {
    /// No number goes by this name.
    #[error("the scene has no number `{name}`")]
    Unknown {
        /// What was given.
        name: String,
        /// What was probably meant.
        near: Option<String>,
        /// The names that there are.
        known: Vec<String>,
    },
    /// Several numbers do.
    #[error("`{name}` may be {}", .names.join(" or "))]
    Ambiguous {
        /// What was given.
        name: String,
        /// What tells them apart.
        names: Vec<String>,
    },
    /// Its values would measure something else.
    #[error("`{name}`: {reason}")]
    OtherDimension {
        /// What was given.
        name: String,
        /// What they measure.
        reason: String,
    },
    /// Bare values where the scene has a unit other than that of SI.
    #[error("`{bare}` has no unit: a bare number is in {si}, and the scene says {scene}")]
    NoUnit {
        /// What was given.
        bare: String,
        /// The SI unit of a bare number.
        si: String,
        /// The value in the scene.
        scene: String,
        /// The same in the unit of the scene.
        meant: String,
    },
    /// One number is varied twice.
    #[error("`{first}` and `{second}` are the same number of the scene")]
    Twice {
        /// What was given first.
        first: String,
        /// What was given then.
        second: String,
    },
}

impl TunableFault {
    /// What to do.
    pub fn help(&self) -> Option<String> {
        match self {
            Self::Unknown { near, known, .. } => {
                let listed = format!("its numbers are {}", list(known));
                Some(match near {
                    Some(near) => format!("did you mean `{near}`? {listed}"),
                    None => listed,
                })
            }
            Self::Ambiguous { .. } => {
                Some("write so much of the path that it is the only one".to_owned())
            }
            Self::OtherDimension { .. } => None,
            Self::NoUnit { si, meant, .. } => {
                Some(format!("write \"{meant}\", or with `{si}` if that is meant"))
            }
            Self::Twice { .. } => Some("vary it once".to_owned()),
        }
    }
}
