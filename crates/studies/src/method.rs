//! What is asked of solutions: methods, and how much work they may be.

use dashpot_analysis::{Choice, RunError};
use dashpot_dae::methods;

use serde::{Deserialize, Serialize};

use crate::{Given, Kind, Single, list};

/// The word of a method.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MethodName(pub String);

impl MethodName {
    /// The methods of these words.
    ///
    /// # Errors
    ///
    /// [`RunError::UnknownMethod`].
    pub fn choices(all: &[Self]) -> Result<Vec<Choice>, RunError> {
        all.iter().map(|method| Choice::named(&method.0)).collect()
    }
}

impl Single for MethodName {
    const KIND: Kind =
        Kind::Words(|| list(methods::all().iter().map(|method| (method.name(), ""))));

    fn of(given: &Given) -> Result<Self, String> {
        String::of(given).map(Self)
    }
}

/// Work, in units of a step of one unknown; from 1 to 10¹⁸.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Budget(pub u64);

impl Single for Budget {
    const KIND: Kind = Kind::Count;

    fn of(given: &Given) -> Result<Self, String> {
        const MOST: f64 = 1e18;
        let number = match given {
            Given::Text(text) => text.parse().ok(),
            Given::Number(number) => Some(*number),
            _ => None,
        };
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "the range is checked, and no one counts the last units"
        )]
        match number {
            Some(number) if (1.0..=MOST).contains(&number) => Ok(Self(number as u64)),
            _ => Err("it must be a number from 1 to 1e18, such as 1e10".to_owned()),
        }
    }
}

/// How often something is done: once at least.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Repeats(pub usize);

impl Single for Repeats {
    const KIND: Kind = Kind::Count;

    fn of(given: &Given) -> Result<Self, String> {
        match usize::of(given) {
            Ok(count @ 1..) => Ok(Self(count)),
            _ => Err("it must be a whole number of 1 or more".to_owned()),
        }
    }
}
