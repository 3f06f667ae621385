//! What the solutions of many intervals have alike.

use std::sync::Arc;

use super::{augmented::Equations, modes::Modes, tables::Tables};

/// Of how many equations, and of how many modal forms, the last are remembered.
const REMEMBERED: usize = 32;

/// The modes of a system, and what they do on panels: the same wherever a run begins.
#[derive(Debug)]
pub(super) struct Form {
    pub(super) modes: Modes,
    pub(super) tables: Tables,
}

impl Form {
    pub(super) fn of(modes: Modes) -> Self {
        Self { modes, tables: Tables::default() }
    }
}

/// What solutions that were met before are made of, so that those which follow need not keep it again:
/// a run that switches goes through the same few sets of equations.
#[derive(Debug, Default)]
pub struct Shared {
    equations: Vec<Arc<Equations>>,
    forms: Vec<Arc<Form>>,
}

impl Shared {
    pub(super) fn equations(&mut self, own: &mut Arc<Equations>) {
        share(&mut self.equations, own, |one, other| one == other);
    }

    pub(super) fn form(&mut self, own: &mut Arc<Form>) {
        share(&mut self.forms, own, |one, other| one.modes == other.modes);
    }
}

/// Takes what is alike from those that are known, or makes it known.
fn share<T>(known: &mut Vec<Arc<T>>, own: &mut Arc<T>, is_same: impl Fn(&T, &T) -> bool) {
    if let Some(same) = known.iter().rev().find(|other| is_same(other, own)) {
        *own = Arc::clone(same);
        return;
    }
    if known.len() == REMEMBERED {
        known.remove(0);
    }
    known.push(Arc::clone(own));
}
