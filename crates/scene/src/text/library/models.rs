//! The models and materials of documents, by their names.

use std::collections::VecDeque;

use super::{Library, top_entry};
use crate::{
    diagnostics::fault::Fault,
    text::{
        document::{Content, Entry, Item},
        source::Place,
        table_file::beside,
    },
};

dashpot_units::words! {
    /// Which of the two tables of models.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
    pub(crate) enum ModelSection, pub(crate) fn word(self) {
        /// `[models]`, in N/m.
        Models = "model",
        /// `[materials]`, in Pa.
        Materials = "material",
    }
}

/// Both, in the order in which a name is looked up.
pub(crate) const MODEL_SECTIONS: [ModelSection; 2] =
    [ModelSection::Models, ModelSection::Materials];

impl ModelSection {
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

    pub(super) fn entries(self, root: &Item) -> &[Entry] {
        top_entry(root, self.key()).and_then(|entry| entry.item.table()).unwrap_or(&[])
    }
}

/// A model or a material of a document.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) struct Reference {
    pub(crate) document: usize,
    /// The table in which it is.
    pub(crate) section: ModelSection,
    index: usize,
}

impl Library {
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
    /// The paths in `model = "path:name"` and `material = "path:name"` anywhere in a document, with their places.
    pub(super) fn files_wanted(&self, document: usize) -> Vec<(String, Place)> {
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
