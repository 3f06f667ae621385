//! Maxwell element.

use super::{Form, Part, Role};

/// A spring and a dashpot in a row, `F + (C/K) F' = C ẏ`.
///
/// Liquid; instantaneous stiffness `K`; relaxation time `τ = C/K`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Maxwell;

impl Form for Maxwell {
    const KIND: &'static str = "maxwell";
    const ALIASES: &'static [&'static str] = &[];
    const SUMMARY: &'static str = "spring and dashpot in series, F + (C/K) F' = C y'";
    const PARTS: &'static [Part] = &[
        Part { name: "spring", role: Role::Spring },
        Part { name: "dashpot", role: Role::Dashpot },
    ];
    const IN_SERIES: bool = true;
}
