//! Quantities that are asked for.

use dashpot_network::parameters::Dimension;
use dashpot_scene::{Fault, units::parse_quantity, with_units};

use crate::{Given, Kind, Single, StudyError};

/// A quantity whose dimension follows from what it is for: a text with its unit, or a number in SI units.
#[derive(Debug, Clone, PartialEq)]
pub enum Amount {
    /// As it is written.
    Text(String),
    /// In SI units.
    Number(f64),
}

impl Amount {
    /// Its value in SI units, of a quantity of this `name`.
    ///
    /// # Errors
    ///
    /// That it is no such quantity.
    pub fn read(&self, name: &str, expected: Dimension) -> Result<f64, StudyError> {
        match self {
            Self::Text(text) => setting(name, text, expected),
            Self::Number(number) => Ok(*number),
        }
    }

    /// A positive value in SI units, likewise.
    ///
    /// # Errors
    ///
    /// What is wrong, and what to write, in one sentence.
    pub fn positive(&self, name: &str, expected: Dimension) -> Result<f64, String> {
        let value = match self {
            Self::Text(text) => argument(name, text, expected)?,
            Self::Number(number) => *number,
        };
        if value > 0.0 { Ok(value) } else { Err("it must be positive".to_owned()) }
    }

    /// As it is written.
    pub fn text(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            Self::Number(number) => number.to_string(),
        }
    }
}

impl Single for Amount {
    const KIND: Kind = Kind::Amount;
    const IS_DIVIDED: bool = false;

    fn of(given: &Given) -> Result<Self, String> {
        match given {
            Given::Text(text) => Ok(Self::Text(text.trim().to_owned())),
            Given::Number(number) => Ok(Self::Number(*number)),
            _ => Err("a quantity is wanted".to_owned()),
        }
    }
}

/// A value with the name that it is for.
#[derive(Debug, Clone, PartialEq)]
pub struct Assignment {
    /// The name.
    pub name: String,
    /// Its values: several stand side by side.
    pub values: Vec<Amount>,
}

impl Single for Assignment {
    const KIND: Kind = Kind::Assignment;
    const IS_DIVIDED: bool = false;

    fn of(given: &Given) -> Result<Self, String> {
        let (name, given) = match given {
            Given::Named(name, values) => (name.clone(), values.clone()),
            Given::Text(text) => {
                let (name, value) = assignment(text)?;
                (name, vec![Given::Text(value)])
            }
            _ => return Err(ASSIGNMENT.to_owned()),
        };
        let mut values = Vec::new();
        for value in &given {
            match value {
                Given::Text(text) => {
                    values.extend(text.split(',').map(|part| Amount::Text(part.trim().to_owned())));
                }
                value => values.push(Amount::of(value)?),
            }
        }
        Ok(Self { name, values })
    }
}

const ASSIGNMENT: &str = "write a name, `=` and a value, such as \"K=25 MN/m\"";

/// A name and a value with `=` between them.
///
/// # Errors
///
/// What to write.
pub fn assignment(text: &str) -> Result<(String, String), String> {
    let (name, value) = text.rsplit_once('=').unwrap_or((text, ""));
    if name.trim().is_empty() || value.trim().is_empty() {
        return Err(ASSIGNMENT.to_owned());
    }
    Ok((name.trim().to_owned(), value.trim().to_owned()))
}

/// Types of quantities of one dimension.
macro_rules! quantities {
    ($($(#[doc = $about:literal])+ $quantity:ident: $dimension:ident, $name:literal, $unit:literal, $check:expr;)*) => { $(
        $(#[doc = $about])+
        #[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
        pub struct $quantity(pub f64);

        impl Single for $quantity {
            const KIND: Kind = Kind::Quantity($unit);

            fn of(given: &Given) -> Result<Self, String> {
                let value = match given {
                    Given::Number(number) => *number,
                    Given::Text(text) => argument($name, text.trim(), Dimension::$dimension)?,
                    _ => return Err(concat!("a ", $name, " is wanted").to_owned()),
                };
                let check: fn(f64) -> Option<&'static str> = $check;
                check(value).map_or(Ok(Self(value)), |wrong| Err(wrong.to_owned()))
            }
        }
    )* };
}

quantities! {
    /// A frequency \[Hz\], positive.
    Frequency: FREQUENCY, "frequency", "Hz", positive;
    /// A time or a difference of times \[s\].
    Time: TIME, "time", "s", |_| None;
    /// A speed along the impact \[m/s\], positive.
    Speed: VELOCITY, "velocity", "m/s", |value| positive(value).map(|_| {
        "it must be positive: it is that along the impact, whichever way the peak points"
    });
    /// A mass \[kg\], positive.
    Mass: MASS, "mass", "kg", positive;
}

fn positive(value: f64) -> Option<&'static str> {
    (value <= 0.0 || value.is_nan()).then_some("it must be positive")
}

/// The value of a setting of this name, in SI units. A number without a unit may be meant in others, and is refused unless
/// it is zero.
///
/// # Errors
///
/// [`StudyError::Quantity`] and [`StudyError::WrongSetting`].
pub fn setting(name: &str, text: &str, expected: Dimension) -> Result<f64, StudyError> {
    let wrong = |reason: String| StudyError::setting(name, reason);
    let unlike = |fault: Fault| StudyError::quantity(name, fault);
    let parsed = parse_quantity(text);
    let quantity =
        parsed.map_err(|error| unlike(Fault::Unreadable { error, expected }))?.meant(expected);
    match quantity.dimension {
        Some(found) if found != expected => {
            Err(unlike(Fault::WrongDimension { text: text.to_owned(), found, expected }))
        }
        None if expected != Dimension::NUMBER && quantity.value != 0.0 => {
            Err(wrong(format!("`{text}` has no unit: write {}", with_units(text, expected))))
        }
        _ if quantity.angle == 0 => Ok(quantity.value),
        Some(Dimension::FREQUENCY) => {
            let frequency = quantity.value / std::f64::consts::TAU;
            Err(unlike(Fault::AngularFrequency { text: text.to_owned(), frequency }))
        }
        _ => Err(wrong(format!("`{text}` is an angle"))),
    }
}

/// The same, with what is wrong and what to write in one sentence.
///
/// # Errors
///
/// That sentence.
pub fn argument(name: &str, text: &str, expected: Dimension) -> Result<f64, String> {
    setting(name, text.trim(), expected).map_err(|error| match error.help() {
        Some(help) => format!("{error}; {help}"),
        None => error.to_string(),
    })
}
