//! Jeffreys element.

use super::{Form, KELVIN_VOIGT, Part, Role};

/// A dashpot in series with a Kelvin–Voigt element.
///
/// Liquid without instantaneous elasticity; seen from outside, a Maxwell element beside a dashpot.
pub const JEFFREYS: Form = Form {
    word: "jeffreys",
    aliases: &[],
    summary: "dashpot and Kelvin-Voigt in series: a liquid that retards",
    parts: &[
        Part { name: "dashpot", role: Role::Dashpot },
        Part { name: "kelvin", role: KELVIN_VOIGT.role() },
    ],
    in_series: true,
};
