//! The tables of a scene, one file each.

mod accuracy;
mod duration;
mod effects;
mod elements;
mod limits;
mod measures;
mod nodes;
mod of_measures;
mod run;
mod wishes;

pub(crate) use accuracy::read_accuracy;
pub(crate) use duration::find_duration;
pub(crate) use effects::read_effects;
pub(crate) use elements::{ELEMENT_KEYS, read_elements};
pub use limits::parse_limits;
pub(crate) use limits::{read_limits, unit_wanted};
pub(crate) use measures::{Targets, read_measures};
pub(crate) use nodes::{read_loads, read_nodes};
pub use run::RunSettings;
pub(crate) use run::{check_stops, read_run};
pub use wishes::{WISHING, Wish, wishes};

use std::collections::HashMap;

use dashpot_network::{
    NodeId,
    parameters::{Dimension, Registered},
    waveforms::WAVEFORMS,
};

use crate::{
    diagnostics::{Faults, fault::Fault},
    kinds::{Example, parameters::KindReader},
    quantities::quantity::Quantities,
    text::{
        document::{Entry, Item},
        library::Library,
        source::Place,
        table::{Table, entries_of, text_of, unknown_key, wrong_type},
    },
};

/// What the readers of sections share.
pub(crate) struct Reading<'d> {
    pub(crate) library: &'d Library,
    pub(crate) faults: &'d Faults,
    /// Nodes by name, faulty ones included.
    pub(crate) nodes: HashMap<&'d str, NodeId>,
    /// Elements by name, faulty ones included.
    pub(crate) elements: HashMap<&'d str, &'d Entry>,
}

impl<'d> Reading<'d> {
    pub(crate) fn new(library: &'d Library, faults: &'d Faults) -> Self {
        Self { library, faults, nodes: HashMap::new(), elements: HashMap::new() }
    }

    /// The entries of a section, none where the scene does not have it.
    pub(crate) fn section(&self, key: &'static str) -> &'d [Entry] {
        let owner = format!("[{key}]");
        let entry = self.library.section(key);
        entry.and_then(|entry| entries_of(&entry.item, &owner, self.faults)).unwrap_or(&[])
    }

    /// A table within a section.
    pub(crate) fn table(&self, entry: &'d Entry, family: &str) -> Option<Table<'d>> {
        let owner = format!("{family} `{}`", entry.key);
        Table::new(&entry.item, owner, entry.key_place, self.faults)
    }

    /// Reads quantities of the scene.
    pub(crate) fn quantities(&self) -> Quantities<'d> {
        self.library.quantities(0, self.faults)
    }

    /// The node that a text names.
    pub(crate) fn node(&self, item: &Item) -> Option<NodeId> {
        let name = text_of(item, "a node", self.faults)?;
        let found = self.nodes.get(name).copied();
        if found.is_none() {
            self.unknown("node", name, item.place, self.nodes.keys().copied());
        }
        found
    }

    /// Notes a name that is not among `known`.
    pub(crate) fn unknown<'k>(
        &self,
        family: &'static str,
        name: &str,
        place: Place,
        known: impl Iterator<Item = &'k str>,
    ) {
        let mut known: Vec<String> = known.map(str::to_owned).collect();
        known.sort();
        self.faults.missing(place, Fault::UnknownName { family, name: name.to_owned(), known });
    }

    /// A driving function, `{ half-sine = { … } }` or `{ table = "pulse.csv" }`, of what is measured in `driven`.
    pub(crate) fn waveform(
        &self,
        entry: &'d Entry,
        driven: Dimension,
    ) -> Option<dashpot_dae::Waveform> {
        let kinds = WAVEFORMS;
        let what = format!("`{}`", entry.key);
        let Some(entries) = entry.item.table() else {
            let example = kinds.first().map_or_else(String::new, example_kind);
            let expected = format!("a table, for example `{{ {example} }}`");
            wrong_type(&entry.item, &what, &expected, self.faults);
            return None;
        };
        let known = || kinds.iter().map(|kind| kind.word).collect::<Vec<_>>();
        let owner_of = |key: &str| {
            let mut words =
                entries.iter().filter_map(|entry| kinds.iter().find(|kind| kind.word == entry.key));
            words.find(|kind| kind.parameters.iter().any(|parameter| parameter.name == key))
        };
        let mut found = None;
        for own in entries {
            match kinds.iter().find(|kind| kind.word == own.key) {
                None => {
                    let help = owner_of(&own.key).map(|kind| {
                        let (word, first) = (kind.word, kind.parameters[0].name);
                        format!(
                            "it belongs to `{word}`: write `{word} = {{ {first} = …, {} = … }}`",
                            own.key
                        )
                    });
                    let fault = unknown_key(own, &what, known()).with_any_help(help);
                    self.faults.error(own.key_place, fault);
                }
                Some(_) if found.is_some() => {
                    let words = entries.iter().map(|entry| entry.key.to_string()).collect();
                    self.faults.error(own.key_place, Fault::SeveralFunctions { words });
                }
                Some(kind) => found = Some((kind, own)),
            }
        }
        if entries.is_empty() {
            let fault = Fault::NoFunction { owner: what, known: known() };
            self.faults.error(entry.item.place, fault);
        }
        let (kind, own) = found?;
        KindReader { driven, ..KindReader::new(self.quantities()) }.read(
            kind,
            &own.item,
            own.key_place,
        )
    }
}

/// A kind with its word: `constant = "…"`.
fn example_kind<T>(kind: &Registered<T>) -> String {
    format!("{} = {}", kind.word, Example::PLAIN.value(kind.parameters))
}
