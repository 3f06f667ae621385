//! Results that are written beside their places, until all are whole.

use std::{
    fs,
    io::{self, ErrorKind, Write},
};

use super::{Folder, RESULT, list::List, refuse_foreign};
use crate::{
    error::{CliError, unwritable},
    part::{Fingerprint, Part, part_name, token},
    terminal::WIDTH,
    text::wrapped,
};

/// New results of a folder. Where they are dropped the folder is as it was.
#[derive(Debug)]
pub(crate) struct Staged<'f> {
    folder: &'f mut Folder,
    token: String,
    old: List,
    parts: Vec<(String, Fingerprint, Part)>,
    /// Whether the old results have been touched.
    is_placing: bool,
}

impl<'f> Staged<'f> {
    pub(super) fn new(folder: &'f mut Folder) -> Result<Self, CliError> {
        let (old, token) = (List::read(&folder.path)?, token());
        let files = old.files.clone();
        // First, so that the parts are known should this process come to a sudden end.
        let announced = List { files, at_work: Some(token.clone()), is_there: true };
        announced.write(&folder.path, &token)?;
        Ok(Self { folder, token, old, parts: Vec::new(), is_placing: false })
    }

    /// Adds a file of this content.
    pub(crate) fn add(
        &mut self,
        name: impl Into<String>,
        content: impl AsRef<[u8]>,
    ) -> Result<(), CliError> {
        self.add_with(name, |out| out.write_all(content.as_ref()))
    }

    /// Adds a file with what `fill` writes.
    pub(crate) fn add_with(
        &mut self,
        name: impl Into<String>,
        fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), CliError> {
        let (name, number) = (name.into(), self.parts.len() + 1);
        let part = Part::new(&self.folder.path, &part_name(&self.token, number), fill);
        let (part, print) = part.map_err(unwritable(&self.folder.path.join(&name)))?;
        self.parts.push((name, print, part));
        Ok(())
    }

    /// Puts all files and the `result` in their places instead of earlier results, and returns what is
    /// to be told of it.
    pub(super) fn finish(mut self, result: &str) -> Result<String, CliError> {
        self.add(RESULT, result)?;
        self.announce()?;
        self.take_down()?;
        let left = self.stale();
        left.iter().try_for_each(|name| remove(self.folder, name))?;
        let mut written = Vec::new();
        while let Some(own) = self.place_next()? {
            written.push(own);
        }
        // The result, which came last, is named first.
        written.rotate_right(1);
        let names: Vec<&str> = written.iter().map(|own| own.0.as_str()).collect();
        let folder = self.folder.path.display();
        let mut lines = wrapped(&format!("wrote {} to {folder}", names.join(", ")), WIDTH);
        if !left.is_empty() {
            let removed = format!("removed {} of earlier results from {folder}", left.join(", "));
            lines.extend(wrapped(&removed, WIDTH));
        }
        let list = List { files: written, at_work: None, is_there: true };
        list.write(&self.folder.path, &self.token)?;
        Ok(lines.join("\n"))
    }

    /// Lists the new files beside the old ones: whatever is found in the places from now on is known.
    pub(super) fn announce(&mut self) -> Result<(), CliError> {
        let names = self.parts.iter().map(|part| part.0.clone());
        refuse_foreign(&self.folder.path, &self.old, names)?;
        let new = self.parts.iter().map(|part| (part.0.clone(), part.1));
        let files = self.old.files.iter().cloned().chain(new).collect();
        let list = List { files, at_work: Some(self.token.clone()), is_there: true };
        list.write(&self.folder.path, &self.token)?;
        self.is_placing = true;
        self.folder.is_new = false;
        Ok(())
    }

    /// Removes the result that says of the old files that they are whole.
    pub(super) fn take_down(&self) -> Result<(), CliError> {
        remove(self.folder, RESULT)
    }

    /// Gives the next file its place, the result as the last one; returns its name and fingerprint.
    pub(super) fn place_next(&mut self) -> Result<Option<(String, Fingerprint)>, CliError> {
        if self.parts.is_empty() {
            return Ok(None);
        }
        let (name, print, part) = self.parts.remove(0);
        let file = self.folder.path.join(&name);
        part.place(&file).map_err(unwritable(&file))?;
        Ok(Some((name, print)))
    }

    /// Files of earlier results that are not among the new ones.
    fn stale(&self) -> Vec<String> {
        let is_new = |name: &str| self.parts.iter().any(|part| part.0 == name);
        let old = self.old.files.iter().map(|file| &file.0);
        let mut left: Vec<String> = old
            .filter(|name| !is_new(name) && self.old.has(&self.folder.path, name))
            .cloned()
            .collect();
        left.dedup();
        left
    }
}

impl Drop for Staged<'_> {
    fn drop(&mut self) {
        self.parts.clear();
        if self.is_placing {
            return;
        }
        // What cannot be restored is said by what remains: parts that are announced and not there.
        let _ = if self.old.is_there {
            self.old.write(&self.folder.path, &self.token).is_ok()
        } else {
            List::remove(&self.folder.path).is_ok()
        };
    }
}

/// Removes a file of the folder, if it is there.
fn remove(folder: &Folder, name: &str) -> Result<(), CliError> {
    let path = folder.path.join(name);
    match fs::remove_file(&path) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(unwritable(&path)(error)),
        _ => Ok(()),
    }
}
