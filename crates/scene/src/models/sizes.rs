//! How large models are, before they are expanded.

use std::{
    cell::RefCell,
    collections::{HashMap, HashSet},
};

use crate::text::{
    document::{Content, Item},
    library::{Library, Reference, SHELVES},
};

/// Counts what models by name expand to: a text of a few lines may stand for any number of parts.
pub(super) struct Sizes<'d> {
    library: &'d Library,
    known: RefCell<HashMap<Reference, u64>>,
}

/// What stands in a table of a model: parts and compositions of its own, and models by name.
struct Own {
    parts: u64,
    models: Vec<Reference>,
}

impl<'d> Sizes<'d> {
    pub(super) fn new(library: &'d Library) -> Self {
        Self { library, known: RefCell::default() }
    }

    /// Parts and compositions of a model, at least. What describes a whole spectrum counts as one; a
    /// model within itself counts as nothing.
    pub(super) fn of(&self, model: Reference) -> u64 {
        let mut known = self.known.borrow_mut();
        let (mut open, mut begun) = (vec![(model, None)], HashSet::new());
        // Models nest deeply, so they are worked off with a stack.
        while let Some((model, own)) = open.pop() {
            match own {
                None if known.contains_key(&model) || !begun.insert(model) => {}
                None => {
                    let own = self.own(model);
                    let inner: Vec<_> = own.models.iter().map(|inner| (*inner, None)).collect();
                    open.push((model, Some(own)));
                    open.extend(inner);
                }
                Some(Own { parts, models }) => {
                    let inner = models.iter().map(|own| known.get(own).copied().unwrap_or(0));
                    let parts = inner.fold(parts, u64::saturating_add);
                    known.insert(model, parts);
                }
            }
        }
        known.get(&model).copied().unwrap_or(0)
    }

    fn own(&self, model: Reference) -> Own {
        let mut own = Own { parts: 0, models: Vec::new() };
        let mut open: Vec<&Item> = vec![&self.library.entry(model).item];
        while let Some(item) = open.pop() {
            let before = own.models.len();
            for entry in item.table().unwrap_or(&[]) {
                let shelf = SHELVES.into_iter().find(|shelf| shelf.word() == entry.key);
                match (&entry.item.value, shelf) {
                    (Content::Text(name), Some(shelf)) => {
                        // What is not there is told where it is read.
                        let found = self.library.find(model.document, shelf, name);
                        own.models.extend(found.ok().flatten());
                    }
                    (Content::List(branches), _) if is_composition(&entry.key) => {
                        open.extend(branches);
                    }
                    _ => {}
                }
            }
            own.parts += u64::from(own.models.len() == before);
        }
        own
    }
}

fn is_composition(word: &str) -> bool {
    ["series", "parallel"].contains(&word)
}
