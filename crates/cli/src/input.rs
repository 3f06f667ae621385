//! Scenes and models from files.

use std::{
    fs::{self, File},
    io::{self, Read},
    path::Path,
    sync::atomic::{AtomicBool, Ordering},
};

use dashpot_network::parameters::Dimension;
use dashpot_scene::{BareNumbers, ReadOptions, nearest, references, units::parse_quantity};
pub(crate) use dashpot_studies::{Input, title};

use crate::{
    error::{CliError, StudyError, reason},
    host,
};

/// Texts are at most so long, in bytes; a reader takes one more, so that the limit is noticed.
const MAX_BYTES: u64 = 64 << 20;
/// What is said of pipes and devices.
const NO_FILE: &str = "it is no regular file";
/// Whether numbers without a unit are refused.
static IS_STRICT: AtomicBool = AtomicBool::new(false);

/// From now on numbers of scenes without a unit are refused.
pub(crate) fn refuse_bare_numbers() {
    IS_STRICT.store(true, Ordering::Relaxed);
}

/// The text of a file; of the built-in scene where none is named.
pub(crate) fn of(path: Option<&Path>) -> Result<Input, StudyError> {
    read_input(path.unwrap_or(Path::new(dashpot_studies::BUILT_IN)))
}

/// The built-in scene of this name, a file, or standard input for `-`.
///
/// # Errors
///
/// That it cannot be read, and why.
pub fn read_input(path: &Path) -> Result<Input, StudyError> {
    let name = path.to_string_lossy();
    if let Some(text) = host::text(&name) {
        return Ok(Input::new(name, text.into_bytes()));
    }
    if !path.is_file()
        && let Some(shipped) = references().iter().find(|shipped| shipped.name == name)
    {
        return Ok(Input::new(format!("{name}.toml"), shipped.text.as_bytes().to_vec()));
    }
    let (file, bytes) = if name == "-" {
        ("standard input", limited(io::stdin().lock()))
    } else {
        (&*name, bytes_of(path))
    };
    let bytes = bytes.map_err(|error| {
        let is_pipe = error.kind() == io::ErrorKind::InvalidInput;
        let more = if is_pipe { "; standard input is `-`" } else { "" };
        let (name, similar) = (file.to_owned(), similar(path));
        StudyError::Unreadable { name, reason: reason(&error) + more, similar }
    })?;
    Ok(Input::new(file, bytes))
}

/// How a text is read by the command.
pub(crate) trait AsCommanded {
    /// With the values `set` in place of its own.
    fn options<'o>(&'o self, set: &'o [(String, String)]) -> ReadOptions<'o>;
}

impl AsCommanded for Input {
    fn options<'o>(&'o self, set: &'o [(String, String)]) -> ReadOptions<'o> {
        ReadOptions { bare: bare_numbers(), ..options(Some(&self.file), set) }
    }
}

/// What becomes of numbers without a unit.
pub(crate) fn bare_numbers() -> BareNumbers {
    match IS_STRICT.load(Ordering::Relaxed) {
        _ if host::is_called() => BareNumbers::Silent,
        true => BareNumbers::Refused,
        false => BareNumbers::Warned,
    }
}

/// How a text of this file is read once more.
pub(crate) fn options<'o>(file: Option<&'o str>, set: &'o [(String, String)]) -> ReadOptions<'o> {
    ReadOptions { file, set, loader: Some(&load), ..ReadOptions::default() }
}

/// The value of a setting of this name, in SI units. A bare number may be meant in others, and is none but zero; that of
/// a program that calls is in SI units.
pub(crate) fn setting(name: &str, text: &str, expected: Dimension) -> Result<f64, CliError> {
    match parse_quantity(text) {
        Ok(bare) if bare.dimension.is_none() && host::is_called() => Ok(bare.value),
        _ => Ok(dashpot_studies::setting(name, text, expected)?),
    }
}

/// What may be meant by a name that no file has: the same with or without the ending of a scene, or a built-in scene.
fn similar(path: &Path) -> Option<String> {
    let with_ending = path.with_extension("toml");
    if path.extension().is_none() && with_ending.is_file() {
        return Some(with_ending.display().to_string());
    }
    let stem = path.file_stem()?.to_string_lossy();
    nearest(&stem, references().iter().map(|shipped| shipped.name)).map(str::to_owned)
}

/// The bytes of a file that a scene names.
///
/// # Errors
///
/// Why it cannot be read: it is not there, no regular file, or too large.
pub fn load(path: &str) -> Result<Vec<u8>, String> {
    bytes_of(Path::new(path)).map_err(|error| reason(&error))
}

/// The paths of what is in a folder; `None` where there is none.
pub fn folder(path: &Path) -> Option<Result<Vec<String>, String>> {
    let named = |error: io::Error| format!("`{}`: {}", path.display(), reason(&error));
    let path_of = |entry: fs::DirEntry| entry.path().to_string_lossy().into_owned();
    path.is_dir().then(|| {
        let entries = fs::read_dir(path).map_err(named)?;
        entries.map(|entry| entry.map(path_of).map_err(named)).collect()
    })
}

pub(crate) fn bytes_of(path: &Path) -> io::Result<Vec<u8>> {
    let found = fs::metadata(path)?;
    if found.is_dir() {
        return Err(io::Error::from(io::ErrorKind::IsADirectory));
    }
    // Before it is opened: a pipe would wait for its other end, a device has no end.
    if !found.is_file() {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, NO_FILE));
    }
    // What has no length holds nothing, or is made while it is read, and may be without end.
    if found.len() == 0 { Ok(Vec::new()) } else { limited(File::open(path)?) }
}

fn limited(reader: impl Read) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    reader.take(MAX_BYTES + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}
