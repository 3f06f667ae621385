//! How large models are, before they are expanded.

use std::{cell::RefCell, collections::HashMap};

use dashpot_rheology::MOST_LEVELS;

use crate::text::{
    document::{Content, Item},
    library::{
        Library,
        models::{MODEL_SECTIONS, Reference},
    },
};

/// Counts what models by name expand to: a text of a few lines may stand for any number of parts.
pub(super) struct Sizes<'d> {
    library: &'d Library,
    known: RefCell<HashMap<Reference, u64>>,
}

impl<'d> Sizes<'d> {
    pub(super) fn new(library: &'d Library) -> Self {
        Self { library, known: RefCell::default() }
    }

    /// Parts and compositions of a model, at least. What describes a whole spectrum counts as one; a
    /// model within itself, and what is nested too deeply to be read, count as nothing.
    pub(super) fn of(&self, model: Reference) -> u64 {
        self.within(model, MOST_LEVELS)
    }

    fn within(&self, model: Reference, levels: usize) -> u64 {
        let known = self.known.borrow().get(&model).copied();
        if known.is_some() || levels == 0 {
            return known.unwrap_or(0);
        }
        self.known.borrow_mut().insert(model, 0);
        let parts = self.of_table(&self.library.entry(model).item, model.document, levels - 1);
        self.known.borrow_mut().insert(model, parts);
        parts
    }

    /// Those of what stands in a table, where models by name may nest so many levels.
    fn of_table(&self, item: &Item, document: usize, levels: usize) -> u64 {
        let (mut parts, mut is_named) = (0_u64, false);
        for entry in item.table().unwrap_or(&[]) {
            let section = MODEL_SECTIONS.into_iter().find(|section| section.word() == entry.key);
            match (&entry.item.value, section) {
                (Content::Text(name), Some(section)) => {
                    // What is not there is told where it is read.
                    if let Ok(Some(found)) = self.library.find(document, section, name) {
                        is_named = true;
                        parts = parts.saturating_add(self.within(found, levels));
                    }
                }
                (Content::List(branches), _) if is_composition(&entry.key) => {
                    for branch in branches {
                        parts = parts.saturating_add(self.of_table(branch, document, levels));
                    }
                }
                _ => {}
            }
        }
        parts.saturating_add(u64::from(!is_named))
    }
}

fn is_composition(word: &str) -> bool {
    ["series", "parallel"].contains(&word)
}
