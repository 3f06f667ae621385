//! The register of named forms.
//!
//! Texts number the constants of these models in conflicting ways, so the parts are named:
//! `burgers = { maxwell = { spring, dashpot }, kelvin = { spring, dashpot } }`.

use crate::{Branch, Tree};

/// A part that a form is made of: a name and what stands there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Part {
    /// Key of the part.
    pub name: &'static str,
    /// What it is.
    pub role: Role,
}

/// What stands at a part's place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// A spring.
    Spring,
    /// A dashpot.
    Dashpot,
    /// Another form, given by its own parts.
    Form {
        /// The parts of that form.
        parts: &'static [Part],
        /// Whether they stand in series.
        in_series: bool,
    },
}

/// A named form: a fixed arrangement of named parts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Form {
    /// Word for the form, for instance `burgers`.
    pub word: &'static str,
    /// Other words for the same form.
    pub aliases: &'static [&'static str],
    /// One line for a list: law and use.
    pub summary: &'static str,
    /// The parts in order from the impactor's side.
    pub parts: &'static [Part],
    /// Whether the parts stand in series (else in parallel).
    pub in_series: bool,
}

impl Form {
    /// The form as a part of another one.
    const fn part(&self, name: &'static str) -> Part {
        Part { name, role: Role::Form { parts: self.parts, in_series: self.in_series } }
    }
}

const SPRING: Part = Part { name: "spring", role: Role::Spring };
const DASHPOT: Part = Part { name: "dashpot", role: Role::Dashpot };

/// A spring and a dashpot in parallel, `F = K y + C ẏ` (the thesis' Kelvin element).
///
/// Solid; no instantaneous elasticity; retardation time `λ = C/K`.
pub const KELVIN_VOIGT: Form = Form {
    word: "kelvin-voigt",
    aliases: &["kelvin", "voigt"],
    summary: "spring and dashpot in parallel, F = K y + C y'",
    parts: &[SPRING, DASHPOT],
    in_series: false,
};

/// A spring and a dashpot in series, `F + (C/K) F' = C ẏ`.
///
/// Liquid; instantaneous stiffness `K`; relaxation time `τ = C/K`.
pub const MAXWELL: Form = Form {
    word: "maxwell",
    aliases: &[],
    summary: "spring and dashpot in series, F + (C/K) F' = C y'",
    parts: &[SPRING, DASHPOT],
    in_series: true,
};

/// A spring beside a Maxwell element (the standard linear solid in its Maxwell form).
///
/// Solid; equilibrium stiffness `K` of the spring, instantaneous stiffness `K` plus that of the
/// Maxwell element's spring.
pub const ZENER: Form = Form {
    word: "zener",
    aliases: &["standard-linear-solid", "sls"],
    summary: "spring in parallel with a Maxwell element (standard linear solid)",
    parts: &[SPRING, MAXWELL.part("maxwell")],
    in_series: false,
};

/// A dashpot in series with a Kelvin–Voigt element.
///
/// Liquid without instantaneous elasticity; seen from outside, a Maxwell element beside a dashpot.
pub const JEFFREYS: Form = Form {
    word: "jeffreys",
    aliases: &[],
    summary: "dashpot and Kelvin-Voigt in series: a liquid that retards",
    parts: &[DASHPOT, KELVIN_VOIGT.part("kelvin")],
    in_series: true,
};

/// A Maxwell element in series with a Kelvin–Voigt element: the four-parameter model of the thesis.
///
/// Liquid; instantaneous stiffness that of the Maxwell spring (the thesis' `K2`), which stands on
/// the impactor's side, then the Maxwell dashpot (`C2`), then `K1 ∥ C1`. The thesis' equation 2.12,
/// `F'' = −(K1 K2/(C1 C2)) F − (K2/C1)(1 + K1/K2 + C1/C2) F' + (K1 K2/C1) y' + K2 y''`.
pub const BURGERS: Form = Form {
    word: "burgers",
    aliases: &["four-parameter"],
    summary: "Maxwell and Kelvin-Voigt in series: the four-parameter model",
    parts: &[MAXWELL.part("maxwell"), KELVIN_VOIGT.part("kelvin")],
    in_series: true,
};

/// Every form. **A new form is registered here.**
pub const FORMS: &[Form] = &[KELVIN_VOIGT, MAXWELL, ZENER, JEFFREYS, BURGERS];

/// The tree of a form; `leaf` makes the primitive for the part at a path such as `["maxwell", "spring"]`.
///
/// # Examples
///
/// ```
/// use dashpot_rheology::forms::{BURGERS, build};
///
/// let tree = build(BURGERS.parts, BURGERS.in_series, &mut |path, _| Ok::<_, ()>(path.join(".")))?;
/// let maxwell = &tree.branches()[0];
/// assert_eq!(maxwell.name, "maxwell");
/// assert_eq!(maxwell.tree.branches()[1].tree, dashpot_rheology::Tree::Part("maxwell.dashpot".to_owned()));
/// # Ok::<(), ()>(())
/// ```
///
/// # Errors
///
/// The first error that `leaf` returns.
pub fn build<P, E>(
    parts: &[Part],
    in_series: bool,
    leaf: &mut impl FnMut(&[&'static str], Role) -> Result<P, E>,
) -> Result<Tree<P>, E> {
    build_at(&mut Vec::new(), parts, in_series, leaf)
}

fn build_at<P, E>(
    path: &mut Vec<&'static str>,
    parts: &[Part],
    in_series: bool,
    leaf: &mut impl FnMut(&[&'static str], Role) -> Result<P, E>,
) -> Result<Tree<P>, E> {
    let mut branches = Vec::with_capacity(parts.len());
    for part in parts {
        path.push(part.name);
        let tree = match part.role {
            Role::Form { parts, in_series } => build_at(path, parts, in_series, leaf)?,
            role => Tree::Part(leaf(path, role)?),
        };
        path.pop();
        branches.push(Branch::new(part.name, tree));
    }
    Ok(if in_series { Tree::Series(branches) } else { Tree::Parallel(branches) })
}
