//! The documents of a scene: its own, and those whose models it uses.

use std::{
    cell::RefCell,
    collections::{HashMap, HashSet, VecDeque},
    ops::Range,
    sync::Arc,
};

use super::{
    document::{Content, Entry, Item, MAX_BYTES, parse_scattered, scattered::note},
    source::{Place, Source},
    table::{check_name, entries_of},
};
use crate::{
    curves::CurveChange,
    diagnostics::{Diagnostic, Faults, fault::Fault},
    kinds,
    models::notes::{ModelNote, Remark},
    quantities::{
        basis::Basis,
        quantity::{Quantities, Subject, Values},
        scatter::ScatterFault,
        values::{self, Overrides},
    },
    scene::text_of_bytes,
    tables::table_text,
};
use dashpot_network::{
    composites::COMPOSITES, elements::ELEMENTS, parameters::registered, waveforms::WAVEFORMS,
};

/// Gives the bytes of another file by its path, or says why there are none.
pub type Loader<'l> = &'l dyn Fn(&str) -> Result<Vec<u8>, String>;

/// The key of a file of numbers.
pub(crate) const FILE: &str = "file";

/// A scene may use models from so many files.
const MAX_FILES: usize = 1000;

/// Which of the two tables of models.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum ModelSection {
    /// `[models]`, in N/m.
    Models,
    /// `[materials]`, in Pa.
    Materials,
}

/// Both, in the order in which a name is looked up.
pub(crate) const MODEL_SECTIONS: [ModelSection; 2] =
    [ModelSection::Models, ModelSection::Materials];

impl ModelSection {
    /// What a model of it is called; also the key that refers to one.
    pub(crate) fn word(self) -> &'static str {
        match self {
            Self::Models => "model",
            Self::Materials => "material",
        }
    }

    /// The other one.
    pub(crate) fn other(self) -> Self {
        match self {
            Self::Models => Self::Materials,
            Self::Materials => Self::Models,
        }
    }

    pub(crate) fn key(self) -> &'static str {
        match self {
            Self::Models => "models",
            Self::Materials => "materials",
        }
    }

    fn entries(self, root: &Item) -> &[Entry] {
        top_entry(root, self.key()).and_then(|entry| entry.item.table()).unwrap_or(&[])
    }
}

/// A model or a material of a document.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) struct Reference {
    /// Index of the document.
    pub(crate) document: usize,
    /// The table in which it is.
    pub(crate) section: ModelSection,
    index: usize,
}

#[derive(Debug)]
struct Document {
    path: String,
    root: Item,
    values: Values,
    /// Index of each model in its table.
    models: HashMap<(ModelSection, String), usize>,
}

/// A file of numbers that points are read from.
#[derive(Debug)]
pub(crate) struct TableFile {
    /// Number of its text among the sources.
    pub(crate) number: u32,
    /// Its text.
    pub(crate) source: Arc<Source>,
    /// What became of curves in it, each told once.
    remarks: RefCell<Vec<CurveChange>>,
}

impl TableFile {
    /// Takes up what became of a curve.
    pub(crate) fn remark(&self, change: CurveChange) {
        let mut all = self.remarks.borrow_mut();
        if !all.contains(&change) {
            all.push(change);
        }
    }

    /// The bytes of the line at which a row begins.
    pub(crate) fn row(&self, start: usize) -> Range<usize> {
        let rest = self.source.text.get(start..).unwrap_or_default();
        start..start + rest.find(['\n', '\r']).unwrap_or(rest.len())
    }

    /// The number of the line, from 1, at which a byte is.
    pub(crate) fn line(&self, at: usize) -> usize {
        self.source.line_and_column(at).0
    }
}

/// The files of numbers that a document names.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Files<'d> {
    library: &'d Library,
    document: usize,
}

impl<'d> Files<'d> {
    /// The file of this path as seen from the document; `None` where it could not be read.
    pub(crate) fn get(self, path: &str) -> Option<&'d TableFile> {
        let document = self.library.documents.get(self.document)?;
        self.library.tables.get(&beside(&document.path, path))?.as_ref()
    }
}

/// All documents of one reading, the scene's own first.
#[derive(Debug)]
pub(crate) struct Library {
    documents: Vec<Document>,
    /// The files of numbers by their paths, `None` where one could not be read.
    tables: HashMap<String, Option<TableFile>>,
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
        library
    }

    /// Reads the files of numbers that the documents name.
    pub(crate) fn load_tables(&mut self, loader: Option<Loader<'_>>, faults: &Faults) {
        for (path, place) in self.tables_wanted() {
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
            let file = match bytes {
                Ok(bytes) => {
                    let source = Arc::new(Source::new(&*path, &*table_text(&bytes)));
                    let number = faults.add_source(Arc::clone(&source));
                    Some(TableFile { number, source, remarks: RefCell::default() })
                }
                Err(reason) => {
                    faults.error(place, Fault::Unloadable { path: path.clone(), reason });
                    None
                }
            };
            self.tables.insert(path, file);
        }
    }

    /// The paths of all other files that were read, in order of their names.
    pub(crate) fn paths(&self) -> Vec<String> {
        let models = self.files.iter().filter(|own| own.1.is_some()).map(|own| own.0);
        let tables = self.tables.iter().filter(|own| own.1.is_some()).map(|own| own.0);
        let mut all: Vec<String> = models.chain(tables).cloned().collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// What became of the curves in files of numbers.
    pub(crate) fn curve_notes(&self) -> Vec<ModelNote> {
        let mut files: Vec<&TableFile> = self.tables.values().flatten().collect();
        files.sort_by_key(|file| file.number);
        let notes = files.into_iter().flat_map(|file| {
            let subject = format!("file `{}`", file.source.name);
            let remarks = file.remarks.borrow().clone();
            remarks.into_iter().map(move |change| ModelNote {
                subject: subject.clone(),
                what: Remark::Curve(change),
                until: None,
            })
        });
        notes.collect()
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
            files: Files { library: self, document },
        }
    }

    /// The values of the scene's own document.
    pub(crate) fn values(&self) -> &Values {
        &self.documents[0].values
    }

    /// The models of a table of a document.
    pub(crate) fn models(
        &self,
        document: usize,
        section: ModelSection,
    ) -> impl Iterator<Item = Reference> {
        let count = section.entries(&self.documents[document].root).len();
        (0..count).map(move |index| Reference { document, section, index })
    }

    /// The entry of a model.
    pub(crate) fn entry(&self, reference: Reference) -> &Entry {
        &reference.section.entries(&self.documents[reference.document].root)[reference.index]
    }

    /// The model of this name in a document, with no file before it.
    pub(crate) fn own(
        &self,
        document: usize,
        section: ModelSection,
        name: &str,
    ) -> Option<Reference> {
        let index = *self.documents[document].models.get(&(section, name.to_owned()))?;
        Some(Reference { document, section, index })
    }

    /// The names of a table of a document, sorted.
    pub(crate) fn names(&self, document: usize, section: ModelSection) -> Vec<String> {
        let models = self.documents[document].models.keys().filter(|(own, _)| *own == section);
        let mut names: Vec<String> = models.map(|(_, name)| name.clone()).collect();
        names.sort();
        names
    }

    /// The model of `section` that a document means by `text`, a name or `file:name`; `None` where a
    /// fault has been noted already.
    pub(crate) fn find(
        &self,
        document: usize,
        section: ModelSection,
        text: &str,
    ) -> Result<Option<Reference>, Fault> {
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
        if let Some(found) = self.own(document, section, name) {
            return Ok(Some(found));
        }
        let (family, known) = (section.word(), self.names(document, section));
        let fault = Fault::UnknownName { family, name: name.to_owned(), known };
        Err(match (self.own(document, section.other(), name), section) {
            (None, _) => fault,
            (Some(_), ModelSection::Materials) => {
                fault.with_help(format!("`{name}` is a model: write `model = \"{text}\"`"))
            }
            (Some(_), ModelSection::Models) => fault.with_help(format!(
                "`{name}` is a material: write `material = \"{text}\"` with the `thickness` and \
                 the `area` of the pad"
            )),
        })
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

    /// The paths in `table-spring = "path"` and `table-spring = { file = "path" }` anywhere in a document, with
    /// their places.
    fn tables_wanted(&self) -> Vec<(String, Place)> {
        let words = words_of_points();
        let mut wanted = Vec::new();
        for document in &self.documents {
            let mut queue = VecDeque::from([&document.root]);
            while let Some(item) = queue.pop_front() {
                if let Content::List(items) = &item.value {
                    queue.extend(items.iter().filter(|own| own.table().is_some()));
                }
                for entry in item.table().unwrap_or(&[]) {
                    let is_file = entry.key == FILE || words.contains(&entry.key.as_str());
                    match entry.item.text().filter(|_| is_file) {
                        Some(path) => wanted.push((beside(&document.path, path), entry.item.place)),
                        None => queue.push_back(&entry.item),
                    }
                }
            }
        }
        wanted
    }

    /// The paths in `model = "path:name"` and `material = "path:name"` anywhere in a document, with
    /// their places.
    fn files_wanted(&self, document: usize) -> Vec<(String, Place)> {
        let own = &self.documents[document];
        let mut wanted = Vec::new();
        let mut queue = VecDeque::from([&own.root]);
        while let Some(item) = queue.pop_front() {
            match &item.value {
                Content::List(items) => queue.extend(items),
                Content::Table(entries) => {
                    for entry in entries {
                        let refers =
                            MODEL_SECTIONS.iter().any(|section| section.word() == entry.key);
                        let text = entry.item.text().filter(|_| refers);
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

/// Whether `word` is that of a driving function that is a table.
pub(crate) fn is_table(word: &str) -> bool {
    registered(WAVEFORMS, word).is_some_and(|kind| kinds::is_table(kind.parameters))
}

/// The words after which a text is the name of a file of points: those of kinds that take points alone, and those
/// of their parameters.
fn words_of_points() -> HashSet<&'static str> {
    let waveforms = WAVEFORMS.iter().map(|kind| (kind.word, kind.parameters));
    let elements = ELEMENTS.iter().map(|kind| (kind.word, kind.parameters));
    let composites = COMPOSITES.iter().map(|kind| (kind.word, kind.parameters));
    let mut words = HashSet::new();
    for (word, parameters) in waveforms.chain(elements).chain(composites) {
        let points = parameters.iter().filter(|own| kinds::is_points(own));
        words.extend(points.map(|own| own.name));
        let mut required = parameters.iter().filter(|own| own.default.is_none());
        if parameters.iter().any(kinds::is_points) && required.all(kinds::is_points) {
            words.insert(word);
        }
    }
    words
}

/// Whether points are given by `item` as a file.
pub(crate) fn names_file(item: &Item) -> bool {
    let has_file = |entries: &[Entry]| {
        entries.iter().any(|entry| [FILE, "columns", "units"].contains(&entry.key.as_str()))
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

/// A path as seen from the file `from`: beside it, unless it is absolute.
fn beside(from: &str, path: &str) -> String {
    let absolute = path.starts_with(['/', '\\']) || path.contains(':');
    match from.rfind(['/', '\\']) {
        Some(end) if !absolute => format!("{}{path}", &from[..=end]),
        _ => path.to_owned(),
    }
}
