//! Kelvin–Voigt element.

use super::{Form, Part, Role};

/// A spring and a dashpot in parallel, `F = K y + C ẏ` (the thesis' Kelvin element).
///
/// Solid; no instantaneous elasticity; retardation time `λ = C/K`.
pub const KELVIN_VOIGT: Form = Form {
    word: "kelvin-voigt",
    aliases: &["kelvin", "voigt"],
    summary: "spring and dashpot in parallel, F = K y + C y'",
    parts: &[
        Part { name: "spring", role: Role::Spring },
        Part { name: "dashpot", role: Role::Dashpot },
    ],
    in_series: false,
};
