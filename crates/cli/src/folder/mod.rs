//! Folders that results are written to.
//!
//! A folder has one writer at a time, which holds a lock. A file is written beside its place and renamed, so that it is
//! whole or not there. [`Folder::write`] renames all files of a run together, between the removal of the old [`RESULT`]
//! and the new one, which comes last; [`Folder::keep`] gives each file its place as soon as it is written, for work that
//! goes on later. Where there is a [`RESULT`], the results are whole.

mod list;

use std::{
    fs::{self, File, OpenOptions, TryLockError},
    io::{self, ErrorKind, Write},
    path::{Path, PathBuf},
};

use self::list::List;
use crate::{
    cancel,
    error::{CliError, shards, unwritable},
    host,
    out::SceneText,
    part::{Fingerprint, Part, metadata, part_name, token},
    terminal::{WIDTH, message, print},
};
use dashpot_report::layout::wrapped;

/// The file whose presence says that results are whole.
pub(crate) const RESULT: &str = "result.json";
/// The file that the writer of a folder keeps locked. It is empty, and stays.
const LOCK: &str = ".dashpot-lock";

/// A folder of which this process is the only writer.
#[derive(Debug)]
pub(crate) struct Folder {
    path: PathBuf,
    /// Whether it was made in vain so far.
    is_new: bool,
    /// Locked as long as it is open.
    _lock: File,
}

impl Folder {
    /// The folder that is asked for, where one is.
    pub(crate) fn wanted(
        path: Option<&Path>,
        names: impl IntoIterator<Item = String>,
    ) -> Result<Option<Self>, CliError> {
        path.map(|path| Self::open(path, names)).transpose()
    }

    /// Makes the folder `path` if need be, and finds out whether files of these names and the result
    /// can be written there, so that no run is done in vain.
    fn open(path: &Path, names: impl IntoIterator<Item = String>) -> Result<Self, CliError> {
        if path.is_file() {
            return Err(CliError::NotAFolder { path: path.to_owned() });
        }
        let is_new = !path.is_dir();
        fs::create_dir_all(path).map_err(unwritable(path))?;
        if is_new {
            [path.to_owned(), path.join(LOCK)].iter().for_each(|own| cancel::begin(own));
        }
        let folder = Self { path: path.to_owned(), is_new, _lock: lock(path)? };
        let list = List::read(path)?;
        list.tidy(path).map_err(unwritable(path))?;
        let names: Vec<String> = names.into_iter().collect();
        // Hours of work are no earlier result that another one replaces.
        if list.has_points(path) && !names.iter().any(|own| list::is_of_points(own)) {
            return Err(CliError::Shard {
                path: path.to_owned(),
                fault: shards::ShardFault::Taken(Vec::new()),
            });
        }
        refuse_foreign(path, &list, names.into_iter())?;
        Part::new(path, &part_name(&token(), 0), |_| Ok(())).map_err(unwritable(path))?;
        Ok(folder)
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// The names of the results that are there as they were written.
    pub(crate) fn whole(&self) -> Result<Vec<String>, CliError> {
        let list = List::read(&self.path)?;
        let mut names: Vec<String> = list.files.iter().map(|own| own.0.clone()).collect();
        names.dedup();
        names.retain(|name| list.has(&self.path, name));
        Ok(names)
    }

    /// Adds one file to those that are there, at once, in place of its namesake: after a sudden end it is found whole
    /// or not at all. The [`RESULT`], which says that all are there, comes last.
    pub(crate) fn keep(&mut self, name: &str, content: &[u8]) -> Result<(), CliError> {
        let (mut list, token) = (List::read(&self.path)?, token());
        refuse_foreign(&self.path, &list, [name.to_owned()].into_iter())?;
        remove(self, RESULT)?;
        let unwritable = unwritable(&self.path.join(name));
        let part = Part::new(&self.path, &part_name(&token, 1), |out| out.write_all(content));
        let (part, print) = part.map_err(&unwritable)?;
        list.files.retain(|own| own.0 != name);
        list.files.push((name.to_owned(), print));
        list.at_work = Some(token.clone());
        list.is_there = true;
        // First, so that the part is known should this process come to a sudden end.
        list.write(&self.path, &token)?;
        self.is_new = false;
        part.place(&self.path.join(name)).map_err(&unwritable)?;
        if name == RESULT {
            list.at_work = None;
            list.write(&self.path, &token)?;
        }
        Ok(())
    }

    /// Writes the files that `add` adds, and the `result` last, instead of earlier results, and tells of
    /// it: where results are printed, or on standard error `beside` a document.
    pub(crate) fn write(
        mut self,
        add: impl FnOnce(&mut Staged<'_>) -> Result<(), CliError>,
        result: &str,
        beside: bool,
    ) -> Result<(), CliError> {
        let mut files = Staged::new(&mut self)?;
        add(&mut files)?;
        let report = files.finish(result)?;
        if beside {
            if !host::said(host::Tone::Note, &report, None) {
                message(&report);
            }
            return Ok(());
        }
        print(&format!("\n{report}\n"))
    }
}

impl Drop for Folder {
    /// Removes the folder again where it was made in vain.
    fn drop(&mut self) {
        if self.is_new {
            let _ = fs::remove_file(self.path.join(LOCK));
            // It is empty, and if not, it stays.
            let _ = fs::remove_dir(&self.path);
        }
    }
}

/// The lock of a folder; a run that holds it already is named in the error.
fn lock(folder: &Path) -> Result<File, CliError> {
    let path = folder.join(LOCK);
    if metadata(&path).map_err(unwritable(&path))?.is_some_and(|own| !own.is_file()) {
        return Err(CliError::Foreign { path, help: "it is no regular file: move it away" });
    }
    let mut options = OpenOptions::new();
    let file = match options.write(true).create_new(true).open(&path) {
        // Nothing is written to it, whatever it is.
        Err(error) if error.kind() == ErrorKind::AlreadyExists => {
            OpenOptions::new().write(true).open(&path)
        }
        made => made,
    };
    let file = file.map_err(unwritable(&path))?;
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => Err(CliError::Busy { path: folder.to_owned() }),
        // Some file systems have no locks.
        Err(TryLockError::Error(error)) if error.kind() != ErrorKind::Unsupported => {
            Err(unwritable(&path)(error))
        }
        _ => Ok(file),
    }
}

/// Refuses to write over files of these names that are no results.
fn refuse_foreign(
    folder: &Path,
    list: &List,
    names: impl Iterator<Item = String>,
) -> Result<(), CliError> {
    // The result first: where it is not as it was written, the others are nobody's.
    for name in [RESULT.to_owned()].into_iter().chain(names) {
        let path = folder.join(&name);
        if !list::is_name(&name) {
            return Err(unwritable(&path)(io::Error::from(ErrorKind::InvalidFilename)));
        }
        if metadata(&path).map_err(unwritable(&path))?.is_some() && !list.has(folder, &name) {
            return Err(CliError::Foreign {
                path,
                help: "`--out` overwrites its own results only, as long as they are as it wrote them: \
                       choose another folder, or move the file away",
            });
        }
    }
    Ok(())
}

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
    fn new(folder: &'f mut Folder) -> Result<Self, CliError> {
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

    /// Adds the text of a scene, which says the same there.
    pub(crate) fn add_scene(
        &mut self,
        name: impl Into<String>,
        text: &SceneText<'_>,
    ) -> Result<(), CliError> {
        let name = name.into();
        let text = text.at(&self.folder.path.join(&name))?;
        self.add(name, text)
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
    fn finish(mut self, result: &str) -> Result<String, CliError> {
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
    fn announce(&mut self) -> Result<(), CliError> {
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
    fn take_down(&self) -> Result<(), CliError> {
        remove(self.folder, RESULT)
    }

    /// Gives the next file its place, the result as the last one; returns its name and fingerprint.
    fn place_next(&mut self) -> Result<Option<(String, Fingerprint)>, CliError> {
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

#[cfg(test)]
mod tests;
