//! A file of numbers that points are read from, and where it is found.

use std::{cell::RefCell, collections::HashMap, ops::Range, sync::Arc};

use dashpot_signal::iso_mme::MmeChannel;

use super::source::{Place, Source};
use crate::{
    diagnostics::{Faults, fault::Fault},
    models::notes::Remark,
};

/// A file of numbers that points are read from.
#[derive(Debug)]
pub(crate) struct TableFile {
    /// Number of its text among the sources.
    pub(crate) number: u32,
    pub(crate) source: Arc<Source>,
    /// Its channels, where it is a test in ISO-MME, and the paths of their files.
    pub(crate) channels: Option<Vec<MmeChannel>>,
    pub(super) parts: Vec<String>,
    /// What became of it, each told once.
    pub(super) remarks: RefCell<Vec<Remark>>,
}

impl TableFile {
    /// Takes up what became of it.
    pub(crate) fn remark(&self, what: Remark) {
        let mut all = self.remarks.borrow_mut();
        if !all.contains(&what) {
            all.push(what);
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
    /// The path of the document.
    pub(super) document: &'d str,
    /// All files by their paths, or why one could not be read.
    pub(super) tables: &'d HashMap<String, Result<TableFile, String>>,
}

impl<'d> Files<'d> {
    /// The file of this path, which stands at `place`, as seen from the document; `None` with a fault where it
    /// could not be read.
    pub(crate) fn get(self, path: &str, place: Place, faults: &Faults) -> Option<&'d TableFile> {
        let path = beside(self.document, path);
        let reason = match self.tables.get(&path) {
            Some(Ok(file)) => return Some(file),
            Some(Err(reason)) => reason.clone(),
            None => "it was not looked for".to_owned(),
        };
        faults.error(place, Fault::Unloadable { path, reason });
        None
    }
}

/// A path as seen from the file `from`: beside it, unless it is absolute.
pub(super) fn beside(from: &str, path: &str) -> String {
    let absolute = path.starts_with(['/', '\\']) || path.contains(':');
    match from.rfind(['/', '\\']) {
        Some(end) if !absolute => format!("{}{path}", &from[..=end]),
        _ => path.to_owned(),
    }
}
