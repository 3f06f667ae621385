//! `--out FILE.toml|DIR`: a scene into a file, or all that is said into a folder.

use std::{
    ffi::OsStr,
    path::{Path, PathBuf},
};

use clap::Args;

use crate::{error::CliError, folder::Folder, part::write_text, terminal::note};

/// Where what was found goes.
#[derive(Debug, Args)]
pub(crate) struct OutArguments {
    /// File for the scene with what was found, if it ends in `.toml`; else a folder for that, figures, tables as CSV,
    /// result.json, and report.html with everything on one page.
    #[arg(long, value_name = "FILE.toml|DIR")]
    out: Option<PathBuf>,
    /// Overwrites the file if there is one.
    #[arg(long, requires = "out")]
    force: bool,
}

/// A file for a scene.
pub(crate) struct SceneFile<'a> {
    path: &'a Path,
    /// Whether it is overwritten if there is one.
    force: bool,
}

impl OutArguments {
    /// The folder, for files of these names, if it is one, and the file otherwise.
    pub(crate) fn split(
        &self,
        names: impl IntoIterator<Item = String>,
    ) -> Result<(Option<Folder>, Option<SceneFile<'_>>), CliError> {
        let Some(path) = self.out.as_deref() else { return Ok((None, None)) };
        if path.extension() == Some(OsStr::new("toml")) {
            return Ok((None, Some(SceneFile { path, force: self.force })));
        }
        Ok((Folder::wanted(Some(path), names)?, None))
    }
}

impl SceneFile<'_> {
    /// Writes the scene, and tells of it.
    pub(crate) fn write(
        &self,
        text: &str,
        told: impl FnOnce(&Path) -> String,
    ) -> Result<(), CliError> {
        write_text(self.path, text, self.force)?;
        note(&told(self.path));
        Ok(())
    }
}
