//! Kelvin–Voigt element.

use super::{Form, Part, Role};

/// A spring and a dashpot side by side, `F = K y + C ẏ` (the thesis' Kelvin element).
///
/// Solid; no instantaneous elasticity; retardation time `λ = C/K`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct KelvinVoigt;

impl Form for KelvinVoigt {
    const KIND: &'static str = "kelvin-voigt";
    const ALIASES: &'static [&'static str] = &["kelvin", "voigt"];
    const SUMMARY: &'static str = "spring and dashpot in parallel, F = K y + C y'";
    const PARTS: &'static [Part] = &[
        Part { name: "spring", role: Role::Spring },
        Part { name: "dashpot", role: Role::Dashpot },
    ];
    const IN_SERIES: bool = false;
}
