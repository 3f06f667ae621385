//! Folders that results are written to.
//!
//! A folder has one writer at a time, which holds a lock. All files are written beside their places
//! first; then the old [`RESULT`] is removed, the files are renamed, and the new [`RESULT`] comes last:
//! where it is, the results are whole.

mod list;
mod staged;
#[cfg(test)]
mod tests;

use std::{
    fs::{self, File, OpenOptions, TryLockError},
    io::{self, ErrorKind},
    path::{Path, PathBuf},
};

use self::list::List;
pub(crate) use self::staged::Staged;
use crate::{
    error::{CliError, unwritable},
    part::{Part, metadata, part_name, token},
    terminal::{note, print},
};

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
        let folder = Self { path: path.to_owned(), is_new, _lock: lock(path)? };
        let list = List::read(path)?;
        list.tidy(path).map_err(unwritable(path))?;
        refuse_foreign(path, &list, names.into_iter())?;
        Part::new(path, &part_name(&token(), 0), |_| Ok(())).map_err(unwritable(path))?;
        Ok(folder)
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
        let told = files.finish(result)?;
        if beside {
            note(&told);
            return Ok(());
        }
        print(&format!("\n{told}\n"))
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
    for name in names.chain([RESULT.to_owned()]) {
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
