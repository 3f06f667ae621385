//! The register of named forms.
//!
//! Texts number the constants of these models in conflicting ways, so the parts are named:
//! `burgers = { maxwell = { spring, dashpot }, kelvin = { spring, dashpot } }`.

mod burgers;
mod jeffreys;
mod kelvin_voigt;
mod maxwell;
mod zener;

pub use burgers::Burgers;
pub use jeffreys::Jeffreys;
pub use kelvin_voigt::KelvinVoigt;
pub use maxwell::Maxwell;
pub use zener::Zener;

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
pub trait Form {
    /// Word for the form, for instance `burgers`.
    const KIND: &'static str;
    /// Other words for the same form.
    const ALIASES: &'static [&'static str];
    /// One line for a list: law and use.
    const SUMMARY: &'static str;
    /// The parts in order from the impactor's side.
    const PARTS: &'static [Part];
    /// Whether the parts stand in series (else in parallel).
    const IN_SERIES: bool;
}

/// Sees every form.
pub trait FormVisitor {
    /// Called once for each form.
    fn visit<F: Form>(&mut self);
}

/// Shows every form to `visitor`. **A new form is registered here.**
pub fn visit_forms(visitor: &mut impl FormVisitor) {
    visitor.visit::<KelvinVoigt>();
    visitor.visit::<Maxwell>();
    visitor.visit::<Zener>();
    visitor.visit::<Jeffreys>();
    visitor.visit::<Burgers>();
}

/// The tree of a form; `leaf` makes the primitive for the part at a path such as
/// `["maxwell", "spring"]`.
///
/// # Examples
///
/// ```
/// use dashpot_rheology::{Form, forms::{Burgers, build}};
///
/// let tree = build(Burgers::PARTS, Burgers::IN_SERIES, &mut |path, _| Ok::<_, ()>(path.join(".")))?;
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
