//! The documents of a scene: its own, and those whose models it uses.

mod mme;
pub(crate) mod models;
pub(crate) mod tables;

use std::{collections::HashMap, sync::Arc};

use super::{
    bytes::text_of_bytes,
    document::{Entry, Item, parse_scattered, scattered::note},
    source::{Place, Source},
    table::{check_name, entries_of},
    table_file::{Files, TableFile},
};
use crate::{
    diagnostics::{Diagnostic, Faults, fault::Fault},
    quantities::{
        basis::Basis,
        named::Values,
        quantity::{Quantities, Subject},
        scatter::ScatterFault,
        values::{self, Overrides},
    },
};
use models::{MODEL_SECTIONS, ModelSection};

/// Gives the bytes of another file by its path, or says why there are none.
pub type Loader<'l> = &'l dyn Fn(&str) -> Result<Vec<u8>, String>;

/// A scene may use models from so many files.
const MAX_FILES: usize = 1000;

#[derive(Debug)]
struct Document {
    path: String,
    root: Item,
    values: Values,
    /// Index of each model in its table.
    models: HashMap<(ModelSection, String), usize>,
}

/// All documents of one reading, the scene's own first.
#[derive(Debug)]
pub(crate) struct Library {
    documents: Vec<Document>,
    /// The files of numbers by their paths, or why one could not be read.
    tables: HashMap<String, Result<TableFile, String>>,
    /// Index of the document of each path that was asked for, `None` where it could not be read.
    files: HashMap<String, Option<usize>>,
}

impl Library {
    /// The document `root` of the file `path`, and all files that its models and curves refer to.
    pub(crate) fn load(
        path: &str,
        root: Item,
        loader: Option<Loader<'_>>,
        overrides: &Overrides,
        faults: &Faults,
    ) -> Self {
        let mut library =
            Self { documents: Vec::new(), tables: HashMap::new(), files: HashMap::new() };
        library.add(path, root, overrides, faults);
        let mut next = 0;
        while next < library.documents.len() {
            for (path, place) in library.files_wanted(next) {
                library.open(&path, place, loader, overrides, faults);
            }
            next += 1;
        }
        let known: Vec<&Values> =
            library.documents.iter().map(|document| &document.values).collect();
        overrides.check(&known, faults);
        library.load_tables(loader, faults);
        library
    }

    /// The paths of all other files that were read, in order of their names.
    pub(crate) fn paths(&self) -> Vec<String> {
        let models = self.files.iter().filter(|own| own.1.is_some()).map(|own| own.0);
        let tables = self.tables.iter().filter(|own| own.1.is_ok()).map(|own| own.0);
        let channels = self.tables.values().filter_map(|own| own.as_ref().ok());
        let channels = channels.flat_map(|own| &own.parts);
        let mut all: Vec<String> = models.chain(tables).chain(channels).cloned().collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// The entry of a key of the scene's own document.
    pub(crate) fn section(&self, key: &str) -> Option<&Entry> {
        top_entry(&self.documents.first()?.root, key)
    }

    /// All entries at the top of the scene's own document.
    pub(crate) fn sections(&self) -> &[Entry] {
        self.documents.first().and_then(|document| document.root.table()).unwrap_or(&[])
    }

    /// Reads quantities of a document.
    pub(crate) fn quantities<'d>(&'d self, document: usize, faults: &'d Faults) -> Quantities<'d> {
        let values = &self.documents[document].values;
        Quantities {
            values,
            faults,
            is_motion: false,
            basis: Basis::Model,
            element: None,
            subject: Subject::Value,
            files: Files { document: &self.documents[document].path, tables: &self.tables },
        }
    }

    /// The values of the scene's own document.
    pub(crate) fn values(&self) -> &Values {
        &self.documents[0].values
    }

    fn add(&mut self, path: &str, root: Item, overrides: &Overrides, faults: &Faults) {
        let own = top_entry(&root, "values").map(|entry| &entry.item);
        let values = values::read(own, overrides, faults);
        let mut models = HashMap::new();
        for section in MODEL_SECTIONS {
            if let Some(entry) = top_entry(&root, section.key()) {
                entries_of(&entry.item, &format!("[{}]", section.key()), faults);
            }
            for (index, entry) in section.entries(&root).iter().enumerate() {
                check_name(&entry.key, entry.key_place, faults);
                models.insert((section, entry.key.to_string()), index);
            }
        }
        self.documents.push(Document { path: path.to_owned(), root, values, models });
    }

    fn open(
        &mut self,
        path: &str,
        place: Place,
        loader: Option<Loader<'_>>,
        overrides: &Overrides,
        faults: &Faults,
    ) {
        if self.files.contains_key(path) {
            return;
        }
        self.files.insert(path.to_owned(), None);
        let text = match loader {
            None => Err("no other files can be read here".to_owned()),
            Some(_) if self.documents.len() >= MAX_FILES => {
                Err(format!("a scene may use models from {MAX_FILES} files"))
            }
            Some(loader) => loader(path).and_then(|bytes| utf8(&bytes)),
        };
        match text {
            Err(reason) => {
                faults.error(place, Fault::Unloadable { path: path.to_owned(), reason });
            }
            Ok(text) => {
                let source = Arc::new(Source::new(path, text));
                if let Some((root, scattered)) = parse_scattered(&source, faults) {
                    for (place, _) in scattered {
                        note(faults, place, ScatterFault::OtherFile);
                    }
                    self.files.insert(path.to_owned(), Some(self.documents.len()));
                    self.add(path, root, overrides, faults);
                }
            }
        }
    }
}

/// The text of a file of models.
fn utf8(bytes: &[u8]) -> Result<String, String> {
    let text = text_of_bytes(bytes, None).map_err(|faults| {
        let messages = faults.list.iter().map(Diagnostic::message);
        messages.collect::<Vec<_>>().join("; ")
    })?;
    Ok(text.to_owned())
}

fn top_entry<'r>(root: &'r Item, key: &str) -> Option<&'r Entry> {
    root.table()?.iter().find(|entry| entry.key == key)
}
