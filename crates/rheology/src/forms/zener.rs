//! Zener element.

use super::{Form, MAXWELL, Part, Role};

/// A spring beside a Maxwell element (the standard linear solid in its Maxwell form).
///
/// Solid; equilibrium stiffness `K` of the spring, instantaneous stiffness `K` plus that of the
/// Maxwell element's spring.
pub const ZENER: Form = Form {
    word: "zener",
    aliases: &["standard-linear-solid", "sls"],
    summary: "spring in parallel with a Maxwell element (standard linear solid)",
    parts: &[
        Part { name: "spring", role: Role::Spring },
        Part { name: "maxwell", role: MAXWELL.role() },
    ],
    in_series: false,
};
