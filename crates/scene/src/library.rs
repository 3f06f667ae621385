//! The documents of a scene: its own, and those whose models it uses.

use std::{
    collections::{HashMap, VecDeque},
    sync::Arc,
};

use crate::{
    diagnostics::Faults,
    document::{Content, Entry, Item, parse},
    fault::Fault,
    quantity::{Quantities, Values},
    source::{Place, Source},
    table::{check_name, entries_of},
    values::{self, Overrides},
};

/// Gives the text of another file by its path.
pub type Loader<'l> = &'l dyn Fn(&str) -> Result<String, String>;

/// A scene may use models from so many files.
const MAX_FILES: usize = 1000;

/// A model of a document.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) struct Reference {
    /// Index of the document.
    pub(crate) document: usize,
    index: usize,
}

#[derive(Debug)]
struct Document {
    path: String,
    root: Item,
    values: Values,
    /// Index of each model in the table of models.
    models: HashMap<String, usize>,
}

/// All documents of one reading, the scene's own first.
#[derive(Debug)]
pub(crate) struct Library {
    documents: Vec<Document>,
    /// Index of the document of each path that was asked for, `None` where it could not be read.
    files: HashMap<String, Option<usize>>,
}

impl Library {
    /// The document `root` of the file `path`, and all files that its models refer to.
    pub(crate) fn load(
        path: &str,
        root: Item,
        loader: Option<Loader<'_>>,
        overrides: &Overrides,
        faults: &Faults,
    ) -> Self {
        let mut library = Self { documents: Vec::new(), files: HashMap::new() };
        library.add(path, root, overrides, faults);
        let mut next = 0;
        while next < library.documents.len() {
            for (path, place) in library.files_wanted(next) {
                library.open(&path, place, loader, overrides, faults);
            }
            next += 1;
        }
        let known: Vec<&Values> = library.documents.iter().map(|own| &own.values).collect();
        overrides.check(&known, faults);
        library
    }

    /// The entry of a key of the scene's own document.
    pub(crate) fn section(&self, key: &str) -> Option<&Entry> {
        section(&self.documents.first()?.root, key)
    }

    /// All entries at the top of the scene's own document.
    pub(crate) fn sections(&self) -> &[Entry] {
        self.documents.first().and_then(|own| own.root.table()).unwrap_or(&[])
    }

    /// Reads quantities of a document.
    pub(crate) fn quantities<'d>(&'d self, document: usize, faults: &'d Faults) -> Quantities<'d> {
        Quantities { values: &self.documents[document].values, faults, is_motion: false }
    }

    /// The values of the scene's own document.
    pub(crate) fn values(&self) -> &Values {
        &self.documents[0].values
    }

    /// The models of a document.
    pub(crate) fn models(&self, document: usize) -> impl Iterator<Item = Reference> {
        let count = models_table(&self.documents[document].root).len();
        (0..count).map(move |index| Reference { document, index })
    }

    /// The entry of a model.
    pub(crate) fn entry(&self, reference: Reference) -> &Entry {
        &models_table(&self.documents[reference.document].root)[reference.index]
    }

    /// The model that a document means by `text`, a name or `file:name`; `None` where that has
    /// been noted already.
    pub(crate) fn find(&self, document: usize, text: &str) -> Result<Option<Reference>, Fault> {
        let (document, name) = match text.rsplit_once(':') {
            None => (document, text),
            Some((path, name)) => {
                let path = beside(&self.documents[document].path, path);
                match self.files.get(&path).copied().flatten() {
                    Some(document) => (document, name),
                    None => return Ok(None),
                }
            }
        };
        let models = &self.documents[document].models;
        if let Some(&index) = models.get(name) {
            return Ok(Some(Reference { document, index }));
        }
        let mut known: Vec<String> = models.keys().cloned().collect();
        known.sort();
        Err(Fault::UnknownName { family: "model", name: name.to_owned(), known })
    }

    fn add(&mut self, path: &str, root: Item, overrides: &Overrides, faults: &Faults) {
        let own = section(&root, "values").map(|entry| &entry.item);
        let values = values::read(own, overrides, faults);
        if let Some(entry) = section(&root, "models") {
            entries_of(&entry.item, "[models]", faults);
        }
        let entries = models_table(&root).iter().enumerate();
        let models = entries.map(|(index, entry)| {
            check_name(&entry.key, entry.key_place, faults);
            (entry.key.clone(), index)
        });
        let models = models.collect();
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
            Some(loader) => loader(path),
        };
        match text {
            Err(reason) => {
                faults.error(place, Fault::Unloadable { path: path.to_owned(), reason });
            }
            Ok(text) => {
                if let Some(root) = parse(&Arc::new(Source::new(path, text)), faults) {
                    self.files.insert(path.to_owned(), Some(self.documents.len()));
                    self.add(path, root, overrides, faults);
                }
            }
        }
    }

    /// The paths in `model = "path:name"` anywhere in a document, with their places.
    fn files_wanted(&self, document: usize) -> Vec<(String, Place)> {
        let own = &self.documents[document];
        let mut wanted = Vec::new();
        let mut queue = VecDeque::from([&own.root]);
        while let Some(item) = queue.pop_front() {
            match &item.value {
                Content::List(items) => queue.extend(items),
                Content::Table(entries) => {
                    for entry in entries {
                        let text = entry.item.text().filter(|_| entry.key == "model");
                        match text.and_then(|text| text.rsplit_once(':')) {
                            Some((path, _)) => {
                                wanted.push((beside(&own.path, path), entry.item.place));
                            }
                            None => queue.push_back(&entry.item),
                        }
                    }
                }
                _ => {}
            }
        }
        wanted
    }
}

fn section<'r>(root: &'r Item, key: &str) -> Option<&'r Entry> {
    root.table()?.iter().find(|entry| entry.key == key)
}

fn models_table(root: &Item) -> &[Entry] {
    section(root, "models").and_then(|entry| entry.item.table()).unwrap_or(&[])
}

/// A path as seen from the file `from`: beside it, unless it is absolute.
fn beside(from: &str, path: &str) -> String {
    let absolute = path.starts_with(['/', '\\']) || path.contains(':');
    match from.rfind(['/', '\\']) {
        Some(end) if !absolute => format!("{}{path}", &from[..=end]),
        _ => path.to_owned(),
    }
}
