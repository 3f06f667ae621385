//! Maxwell element.

use super::{Form, Part, Role};

/// A spring and a dashpot in series, `F + (C/K) F' = C ẏ`.
///
/// Liquid; instantaneous stiffness `K`; relaxation time `τ = C/K`.
pub const MAXWELL: Form = Form {
    word: "maxwell",
    aliases: &[],
    summary: "spring and dashpot in series, F + (C/K) F' = C y'",
    parts: &[
        Part { name: "spring", role: Role::Spring },
        Part { name: "dashpot", role: Role::Dashpot },
    ],
    in_series: true,
};
