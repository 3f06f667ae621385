//! Zener element.

use super::{Form, Maxwell, Part, Role};

/// A spring beside a Maxwell element (the standard linear solid in its Maxwell form).
///
/// Solid; equilibrium stiffness `K` of the spring, instantaneous stiffness `K` plus that of the
/// Maxwell element's spring.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Zener;

impl Form for Zener {
    const KIND: &'static str = "zener";
    const ALIASES: &'static [&'static str] = &["standard-linear-solid", "sls"];
    const SUMMARY: &'static str =
        "spring in parallel with a Maxwell element (standard linear solid)";
    const PARTS: &'static [Part] = &[
        Part { name: "spring", role: Role::Spring },
        Part {
            name: "maxwell",
            role: Role::Form { parts: Maxwell::PARTS, in_series: Maxwell::IN_SERIES },
        },
    ];
    const IN_SERIES: bool = false;
}
