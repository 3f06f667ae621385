//! Burgers element.

use super::{Form, KELVIN_VOIGT, MAXWELL, Part};

/// A Maxwell element in series with a Kelvin–Voigt element: the four-parameter model of the thesis.
///
/// Liquid; instantaneous stiffness that of the Maxwell spring (the thesis' `K2`), which stands on
/// the impactor's side, then the Maxwell dashpot (`C2`), then `K1 ∥ C1`. The thesis' equation 2.12,
/// `F'' = −(K1 K2/(C1 C2)) F − (K2/C1)(1 + K1/K2 + C1/C2) F' + (K1 K2/C1) y' + K2 y''`.
pub const BURGERS: Form = Form {
    word: "burgers",
    aliases: &["four-parameter"],
    summary: "Maxwell and Kelvin-Voigt in series: the four-parameter model",
    parts: &[
        Part { name: "maxwell", role: MAXWELL.role() },
        Part { name: "kelvin", role: KELVIN_VOIGT.role() },
    ],
    in_series: true,
};
