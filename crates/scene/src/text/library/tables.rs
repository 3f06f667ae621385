//! The files of numbers that documents name.

use std::{
    cell::RefCell,
    collections::{HashSet, VecDeque},
    sync::{Arc, LazyLock},
};

use dashpot_network::{
    composites::COMPOSITES, elements::ELEMENTS, parameters::registered, waveforms::WAVEFORMS,
};

use super::{Library, Loader, MAX_FILES, mme, mme::MmeTest};
use crate::{
    diagnostics::Faults,
    kinds,
    models::notes::ModelNote,
    tables::table_text,
    text::{
        document::{Content, Entry, Item, MAX_BYTES},
        source::Source,
        table_file::{TableFile, beside},
    },
};

/// The key of a file of numbers.
pub(crate) const FILE: &str = "file";
/// The key of what its forces, stresses or values are multiplied by.
pub(crate) const SCALE: &str = "scale";

impl Library {
    /// Reads the files of numbers that the documents name. One that cannot be read is a fault where it is used.
    pub(super) fn load_tables(&mut self, loader: Option<Loader<'_>>, faults: &Faults) {
        for path in self.tables_wanted() {
            if self.tables.contains_key(&path) {
                continue;
            }
            let bytes = match loader {
                None => Err("no other files can be read here".to_owned()),
                Some(_) if self.tables.len() >= MAX_FILES => {
                    Err(format!("a scene may use {MAX_FILES} files of numbers"))
                }
                Some(loader) => loader(&path),
            };
            let bytes = bytes.and_then(|bytes| match bytes.len() {
                0..=MAX_BYTES => Ok(bytes),
                count => Err(format!("it has {count} bytes; the limit is 64 MB")),
            });
            let test = match loader.filter(|_| bytes.is_ok() && mme::is_one(&path)) {
                Some(loader) => mme::read(&path, loader).map(Some),
                None => Ok(None),
            };
            let file = bytes.and_then(|own| Ok((own, test?))).map(|(bytes, test)| {
                let source = Arc::new(Source::new(&*path, &*table_text(&bytes)));
                let number = faults.add_source(Arc::clone(&source));
                let (channels, parts) = match test {
                    Some(MmeTest { channels, paths }) => (Some(channels), paths),
                    None => (None, Vec::new()),
                };
                TableFile { number, source, channels, parts, remarks: RefCell::default() }
            });
            self.tables.insert(path, file);
        }
    }

    /// What became of the files of numbers.
    pub(crate) fn table_notes(&self) -> Vec<ModelNote> {
        let mut files: Vec<&TableFile> =
            self.tables.values().filter_map(|own| own.as_ref().ok()).collect();
        files.sort_by_key(|file| file.number);
        let notes = files.into_iter().flat_map(|file| {
            let subject = format!("file `{}`", file.source.name);
            let remarks = file.remarks.borrow().clone();
            remarks.into_iter().map(move |what| ModelNote {
                subject: subject.clone(),
                what,
                until: None,
            })
        });
        notes.collect()
    }

    /// The paths in `table-spring = "path"` and `table-spring = { file = "path" }` anywhere in a document.
    fn tables_wanted(&self) -> Vec<String> {
        let mut wanted = Vec::new();
        for document in &self.documents {
            let mut queue = VecDeque::from([&document.root]);
            while let Some(item) = queue.pop_front() {
                if let Content::List(items) = &item.value {
                    queue.extend(items.iter().filter(|own| own.table().is_some()));
                }
                for entry in item.table().unwrap_or(&[]) {
                    let is_file = || entry.key == FILE || WORDS_OF_POINTS.contains(&*entry.key);
                    match entry.item.text().filter(|_| is_file()) {
                        Some(path) => wanted.push(beside(&document.path, path)),
                        None => queue.push_back(&entry.item),
                    }
                }
            }
        }
        wanted
    }
}

/// Whether `word` is that of a driving function that is a table.
pub(crate) fn is_table(word: &str) -> bool {
    registered(WAVEFORMS, word).is_some_and(|kind| kinds::is_table(kind.parameters))
}

/// The words after which a text is the name of a file of points: those of kinds that take points alone, and those
/// of their parameters.
pub(crate) static WORDS_OF_POINTS: LazyLock<HashSet<&'static str>> = LazyLock::new(|| {
    let waveforms = WAVEFORMS.iter().map(|kind| (kind.word, kind.parameters));
    let elements = ELEMENTS.iter().map(|kind| (kind.word, kind.parameters));
    let composites = COMPOSITES.iter().map(|kind| (kind.word, kind.parameters));
    let mut words = HashSet::new();
    for (word, parameters) in waveforms.chain(elements).chain(composites) {
        let points = parameters.iter().filter(|own| kinds::is_points(own));
        words.extend(points.map(|own| own.name));
        if kinds::are_file(parameters) {
            words.insert(word);
        }
    }
    words
});

/// Whether points are given by `item` as a file.
pub(crate) fn names_file(item: &Item) -> bool {
    let has_file = |entries: &[Entry]| {
        entries.iter().any(|entry| [FILE, "columns", "units", SCALE].contains(&entry.key.as_str()))
    };
    item.text().is_some() || item.table().is_some_and(has_file)
}

/// The file that points are read from, where `item` names one.
pub(crate) fn file_named(item: &Item) -> Option<&Item> {
    let named = item.table().map_or(Some(item), |entries| {
        entries.iter().find(|entry| entry.key == FILE).map(|entry| &entry.item)
    });
    named.filter(|item| item.text().is_some())
}
