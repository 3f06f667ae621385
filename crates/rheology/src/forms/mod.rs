//! The register of named forms.
//!
//! Texts number the constants of these models in conflicting ways, so the parts are named:
//! `burgers = { maxwell = { spring, dashpot }, kelvin = { spring, dashpot } }`.

mod burgers;
mod jeffreys;
mod kelvin_voigt;
mod maxwell;
mod zener;

pub use burgers::BURGERS;
pub use jeffreys::JEFFREYS;
pub use kelvin_voigt::KELVIN_VOIGT;
pub use maxwell::MAXWELL;
pub use zener::ZENER;

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
    const fn role(&self) -> Role {
        Role::Form { parts: self.parts, in_series: self.in_series }
    }
}

/// Every form. **A new form is registered here.**
pub const FORMS: &[Form] = &[KELVIN_VOIGT, MAXWELL, ZENER, JEFFREYS, BURGERS];

/// The tree of a form; `leaf` makes the primitive for the part at a path such as
/// `["maxwell", "spring"]`.
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
