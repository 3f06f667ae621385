//! `--out FILE.toml|DIR`: a scene into a file, or all that is said into a folder.

use std::{
    ffi::OsStr,
    fs, io,
    ops::Range,
    path::{Path, PathBuf},
};

use clap::Args;
use dashpot_scene::{
    BareNumbers, Diagnostics, Fault, ReadOptions, pose, read, read_models, with_paths,
};
use dashpot_units::si_unit;

use crate::{
    error::CliError,
    folder::Folder,
    input::options,
    output::list,
    part::{can_write, write_text},
    varied::messages,
    verbs::with_paths_of_sections,
};

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
    pub(crate) path: &'a Path,
    /// Whether it is overwritten if there is one.
    pub(crate) force: bool,
}

impl OutArguments {
    /// The folder, for files of these names, if it is one, and the file otherwise.
    pub(crate) fn split(
        &self,
        names: impl IntoIterator<Item = String>,
    ) -> Result<(Option<Folder>, Option<SceneFile<'_>>), CliError> {
        let Some(path) = self.out.as_deref() else { return Ok((None, None)) };
        if path.extension() == Some(OsStr::new("toml")) {
            return Ok((None, Some(SceneFile::new(path, self.force)?)));
        }
        Ok((Folder::wanted(Some(path), names)?, None))
    }
}

impl<'a> SceneFile<'a> {
    /// A file that can be written, so that no work is done in vain.
    pub(crate) fn new(path: &'a Path, force: bool) -> Result<Self, CliError> {
        can_write(path, force)?;
        Ok(Self { path, force })
    }

    /// Writes the text of a scene.
    pub(crate) fn write(&self, text: &SceneText<'_>) -> Result<(), CliError> {
        write_text(self.path, &text.at(self.path)?, self.force)
    }
}

/// The text of a scene or of models, as it is to be written.
pub(crate) struct SceneText<'t> {
    pub(crate) text: &'t str,
    /// The file beside which it is read so far.
    pub(crate) file: &'t str,
    /// Values of the table [values] that the command line sets, which do not stand in it.
    pub(crate) set: &'t [(String, String)],
}

impl SceneText<'_> {
    /// The text as a file at `path` says the same: files beside it are found from there, and numbers have the units in which
    /// they are read. It is read as from there, and compared.
    ///
    /// Paths are rewritten and files not copied: a copy would lose its origin, and grow old beside it.
    pub(crate) fn at(&self, path: &Path) -> Result<String, CliError> {
        let [from, to] = [Path::new(self.file), path].map(folder_of);
        // A text of a program that calls is in no folder, and what is not there stays as it is written.
        let led = |folder: &str| way(&to, &from.join(folder)).ok();
        let led_file = |name: &str| {
            let is_absolute = name.starts_with(['/', '\\']) || name.contains(':');
            let (folder, file) = name.split_at(name.rfind('/').map_or(0, |own| own + 1));
            let is_there = !is_absolute && from.join(name).exists();
            is_there.then(|| led(folder)).flatten().map(|own| own + file)
        };
        let text = if led("").is_none_or(|own| own.is_empty()) {
            self.text.to_owned()
        } else {
            with_paths_of_sections(&with_paths(self.text, &led_file), &led)
        };
        let otherwise = |reason| CliError::WrittenOtherwise { path: path.to_owned(), reason };
        let place = path.to_string_lossy();
        let read = |text: &str, file: &str| said(text, &options(Some(file), self.set));
        let is_same = |own: &String| read(own, &place).ok() == read(&text, &place).ok();
        let in_units = with_units(&text, &options(Some(&place), self.set)).filter(is_same);
        let text = in_units.unwrap_or(text);
        let again = read(&text, &place);
        let again = again.map_err(|faults| otherwise(messages(&faults)))?;
        if text != self.text && read(self.text, self.file).is_ok_and(|own| own != again) {
            return Err(otherwise("its numbers are others there".to_owned()));
        }
        Ok(text)
    }
}

/// The text with their units behind numbers that are read without one; `None` where there are none.
fn with_units(text: &str, options: &ReadOptions<'_>) -> Option<String> {
    let options = ReadOptions { bare: BareNumbers::Warned, ..*options };
    let warnings = match read_models(text, &options) {
        Some(models) => models.ok()?.warnings,
        None => read(text, &options).ok()?.warnings,
    };
    let mut places: Vec<(Range<usize>, String)> = list(warnings.list.iter().filter_map(|own| {
        let Fault::NoUnit { text: number, expected, .. } = &own.fault else { return None };
        let is_here = own.source.as_ref().is_some_and(|source| *source.text == *text);
        let span = own.span.clone().filter(|_| is_here && number.parse::<f64>().is_ok())?;
        Some((span, format!("\"{number} {}\"", si_unit(*expected))))
    }));
    places.sort_by_key(|own| own.0.start);
    places.dedup_by_key(|own| own.0.start);
    let mut whole = text.to_owned();
    places.iter().rev().for_each(|(span, own)| whole.replace_range(span.clone(), own));
    (!places.is_empty()).then_some(whole)
}

/// All that a text says to a solver: what is printed of numbers tells them apart to the bit.
fn said(text: &str, options: &ReadOptions<'_>) -> Result<String, Diagnostics> {
    match read_models(text, options) {
        Some(models) => {
            Ok(list(models?.value.iter().map(|own| format!("{} {:?}", own.name, own.model)))
                .concat())
        }
        None => pose(text, options).map(|own| format!("{own:?}")),
    }
}

fn folder_of(file: &Path) -> PathBuf {
    match file.parent() {
        Some(folder) if folder != Path::new("") => folder.to_owned(),
        _ => PathBuf::from("."),
    }
}

/// What leads from one folder to another, before the name of a file there: empty where it is the same one, and absolute
/// where they share no folder but the root.
fn way(from: &Path, to: &Path) -> io::Result<String> {
    let (from, to) = (fs::canonicalize(from)?, fs::canonicalize(to)?);
    let shared = from.components().zip(to.components()).take_while(|own| own.0 == own.1).count();
    let part = |path: &Path| {
        list(
            path.components()
                .skip(shared)
                .map(|own| own.as_os_str().to_string_lossy().into_owned()),
        )
    };
    let up = from.components().skip(shared).map(|_| "..".to_owned());
    let names = list(up.chain(part(&to)));
    Ok(match shared {
        0 | 1 => format!("{}/", to.display()),
        _ if names.is_empty() => String::new(),
        _ => names.join("/") + "/",
    })
}
