//! Which files in a folder are results, so that no other one is overwritten or removed.

use std::{
    fs, io,
    path::{Component, Path},
};

use super::RESULT;
use crate::{
    error::{CliError, unwritable},
    part::{Fingerprint, Part, is_first_part, is_part_of, is_token, metadata, part_name},
};

/// The file of the list.
const LIST: &str = ".dashpot-files";
/// Its first line.
const HEAD: &str = "dashpot results 1";
/// The beginning of a line with the token of a writer that is at work.
const AT_WORK: &str = "part ";
/// Endings of the names of results.
const ENDINGS: [&str; 8] = ["csv", "f64", "html", "json", "md", "parquet", "svg", "toml"];

/// The names of results, each with the fingerprint of what was written.
///
/// A file is a result only if it is listed and still as it was written: neither an edited file nor a
/// stranger of the same name is taken for one, whoever wrote the list.
#[derive(Debug, Default)]
pub(super) struct List {
    pub(super) files: Vec<(String, Fingerprint)>,
    /// The token of a writer that is at work, or did not come to its end.
    pub(super) at_work: Option<String>,
    /// Whether there is such a file.
    pub(super) is_there: bool,
}

impl List {
    /// That of a folder. Results without the file [`RESULT`] are not whole, and where no writer was at
    /// work they are nobody's, but for files of points, each of which is whole by itself.
    pub(super) fn read(folder: &Path) -> Result<Self, CliError> {
        let path = folder.join(LIST);
        let foreign = || CliError::Foreign {
            path: path.clone(),
            help: "it is no list of results as this version writes it, but an earlier version's or \
                   somebody else's: choose another folder, or move this file and the results \
                   beside it away",
        };
        match metadata(&path).map_err(unwritable(&path))? {
            None => return Ok(Self::default()),
            Some(own) if own.is_file() => {}
            Some(_) => return Err(foreign()),
        }
        let text = fs::read_to_string(&path).map_err(|error| match error.kind() {
            io::ErrorKind::InvalidData => foreign(),
            _ => unwritable(&path)(error),
        })?;
        let mut list = Self::parse(&text).ok_or_else(foreign)?;
        if list.at_work.is_none() && !list.has(folder, RESULT) {
            list.files.retain(|own| is_of_points(&own.0));
        }
        Ok(list)
    }

    fn parse(text: &str) -> Option<Self> {
        let mut lines = text.lines();
        if lines.next() != Some(HEAD) {
            return None;
        }
        let mut list = Self { is_there: true, ..Self::default() };
        for line in lines {
            if let Some(token) = line.strip_prefix(AT_WORK) {
                list.at_work = Some(token.to_owned()).filter(|own| is_token(own));
                list.at_work.as_ref()?;
                continue;
            }
            let (print, name) = line.split_once(' ')?;
            let print = Fingerprint::parse(print).filter(|_| is_name(name))?;
            list.files.push((name.to_owned(), print));
        }
        Some(list)
    }

    /// Writes it into a folder, by the writer with this token.
    pub(super) fn write(&self, folder: &Path, token: &str) -> Result<(), CliError> {
        let path = folder.join(LIST);
        let part = Part::new(folder, &part_name(token, 0), |out| {
            writeln!(out, "{HEAD}")?;
            if let Some(token) = &self.at_work {
                writeln!(out, "{AT_WORK}{token}")?;
            }
            self.files.iter().try_for_each(|(name, print)| writeln!(out, "{print} {name}"))
        });
        part.and_then(|(part, _)| part.place(&path)).map_err(unwritable(&path))
    }

    /// Removes it from a folder.
    pub(super) fn remove(folder: &Path) -> io::Result<()> {
        fs::remove_file(folder.join(LIST))
    }

    /// Whether the file of this name in the folder is a result.
    pub(super) fn has(&self, folder: &Path, name: &str) -> bool {
        let mut listed = self.files.iter().filter(|file| file.0 == name).peekable();
        let path = folder.join(name);
        let is_file = || matches!(metadata(&path), Ok(Some(own)) if own.is_file());
        if listed.peek().is_none() || !is_file() {
            return false;
        }
        Fingerprint::of(&path).is_ok_and(|print| listed.any(|own| own.1 == print))
    }

    /// Whether points of a sweep are there, which are written while it is solved.
    pub(super) fn has_points(&self, folder: &Path) -> bool {
        self.files.iter().any(|own| is_of_points(&own.0) && folder.join(&own.0).exists())
    }

    /// Removes the parts of writers that did not come to their end: those of the one that is listed, and
    /// what others left before they were.
    pub(super) fn tidy(&self, folder: &Path) -> io::Result<()> {
        for entry in fs::read_dir(folder)? {
            let entry = entry?;
            let name = entry.file_name();
            let is_listed = self.at_work.as_ref().is_some_and(|token| is_part_of(&name, token));
            let is_left = || is_listed || (is_first_part(&name) && is_of_list(&entry.path()));
            if entry.file_type()?.is_file() && is_left() {
                fs::remove_file(entry.path())?;
            }
        }
        Ok(())
    }
}

/// Whether a file is empty or begins as the list does: what the first part of a writer may hold.
fn is_of_list(path: &Path) -> bool {
    fs::read(path).is_ok_and(|own| {
        let length = own.len().min(HEAD.len());
        own[..length] == HEAD.as_bytes()[..length]
    })
}

/// Whether a file of this name holds points of a sweep.
pub(super) fn is_of_points(name: &str) -> bool {
    name.ends_with(".parquet")
}

/// Whether a result may have this name: that of a file in the folder itself, with a known ending.
pub(super) fn is_name(name: &str) -> bool {
    let path = Path::new(name);
    let is_one = matches!(path.components().collect::<Vec<_>>()[..], [Component::Normal(own)] if own == name);
    let ending = path.extension().and_then(|own| own.to_str());
    is_one
        && !name.starts_with('.')
        && !name.contains(['\n', '\r', '\\'])
        && ending.is_some_and(|ending| ENDINGS.contains(&ending))
}
