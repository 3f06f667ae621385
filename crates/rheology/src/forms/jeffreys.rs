//! Jeffreys element.

use super::{Form, KelvinVoigt, Part, Role};

/// A dashpot in a row with a Kelvin–Voigt element.
///
/// Liquid without instantaneous elasticity; seen from outside, a Maxwell element beside a dashpot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Jeffreys;

impl Form for Jeffreys {
    const KIND: &'static str = "jeffreys";
    const ALIASES: &'static [&'static str] = &[];
    const SUMMARY: &'static str = "dashpot and Kelvin-Voigt in series: a liquid that retards";
    const PARTS: &'static [Part] = &[
        Part { name: "dashpot", role: Role::Dashpot },
        Part {
            name: "kelvin",
            role: Role::Form { parts: KelvinVoigt::PARTS, in_series: KelvinVoigt::IN_SERIES },
        },
    ];
    const IN_SERIES: bool = true;
}
