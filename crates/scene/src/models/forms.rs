//! Named forms in tables.

use dashpot_network::{
    Model,
    elements::{Dashpot, ELEMENTS, Spring},
    parameters::{Kind as _, registered},
};
use dashpot_rheology::{Branch, Part, Role, Tree};

use crate::{
    kinds::{Example, parameters::KindReader},
    quantities::quantity::Quantities,
    text::{
        document::Entry,
        table::{Table, wrong_type},
    },
};

/// Reads named forms; their depth is that of the register.
pub(super) struct FormReader<'d> {
    /// Reads their quantities.
    pub(super) quantities: Quantities<'d>,
}

impl FormReader<'_> {
    /// The form with these parts.
    pub(super) fn read(
        &self,
        parts: &'static [Part],
        in_series: bool,
        entry: &Entry,
    ) -> Option<Model> {
        let faults = self.quantities.faults;
        let example = Example { basis: self.quantities.basis, driven: None };
        let owner = format!("`{}`", entry.key);
        if entry.item.table().is_none() {
            let expected = format!("a table, for example `{}`", example.parts(parts));
            wrong_type(&entry.item, &owner, &expected, faults);
            return None;
        }
        let table = Table::new(&entry.item, owner, entry.key_place, faults)?;
        let read = parts.iter().map(|part| {
            let example = example.parts(std::slice::from_ref(part));
            let inner = example.strip_prefix("{ ").and_then(|rest| rest.strip_suffix(" }"));
            let tree = table
                .require(part.name, inner.unwrap_or_default())
                .and_then(|entry| self.part(part, entry));
            tree.map(|tree| Branch::new(part.name, tree))
        });
        // Every part is read, so that all faults are found.
        let read = read.collect::<Vec<_>>();
        table.finish();
        let branches = read.into_iter().collect::<Option<Vec<_>>>()?;
        Some(if in_series { Tree::Series(branches) } else { Tree::Parallel(branches) })
    }

    fn part(&self, part: &Part, entry: &Entry) -> Option<Model> {
        let word = match part.role {
            Role::Spring => Spring::KIND,
            Role::Dashpot => Dashpot::KIND,
            Role::Form { parts, in_series } => return self.read(parts, in_series, entry),
        };
        let kind = registered(ELEMENTS, word)?;
        let reader = KindReader::new(self.quantities);
        reader.read(kind, &entry.item, entry.key_place).map(Tree::Part)
    }
}
