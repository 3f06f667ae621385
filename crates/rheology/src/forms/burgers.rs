//! Burgers element.

use super::{Form, KelvinVoigt, Maxwell, Part, Role};

/// A Maxwell element in a row with a Kelvin–Voigt element: the four-parameter model of the thesis.
///
/// Liquid; instantaneous stiffness that of the Maxwell spring (the thesis' `K2`), which stands on
/// the impactor's side, then the Maxwell dashpot (`C2`), then `K1 ∥ C1`. The thesis' equation 2.12,
/// `F'' = −(K1 K2/(C1 C2)) F − (K2/C1)(1 + K1/K2 + C1/C2) F' + (K1 K2/C1) y' + K2 y''`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Burgers;

impl Form for Burgers {
    const KIND: &'static str = "burgers";
    const ALIASES: &'static [&'static str] = &["four-parameter"];
    const SUMMARY: &'static str = "Maxwell and Kelvin-Voigt in series: the four-parameter model";
    const PARTS: &'static [Part] = &[
        Part {
            name: "maxwell",
            role: Role::Form { parts: Maxwell::PARTS, in_series: Maxwell::IN_SERIES },
        },
        Part {
            name: "kelvin",
            role: Role::Form { parts: KelvinVoigt::PARTS, in_series: KelvinVoigt::IN_SERIES },
        },
    ];
    const IN_SERIES: bool = true;
}
