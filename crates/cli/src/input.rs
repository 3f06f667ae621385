//! Scenes and models from files.

use std::{
    borrow::Cow,
    fs::{self, File},
    io::{self, Read},
    path::Path,
    sync::atomic::{AtomicBool, Ordering},
};

use dashpot_network::parameters::Dimension;
use dashpot_scene::{
    BareNumbers, Fault, ReadOptions, Scene, nearest, references, table_text, text_of_bytes,
    units::parse_quantity, with_units,
};

use crate::{
    error::{CliError, reason},
    host,
};

/// Texts are at most so long, in bytes; a reader takes one more, so that the limit is noticed.
const MAX_BYTES: u64 = 64 << 20;
/// What is said of pipes and devices.
const NO_FILE: &str = "it is no regular file";
/// Endings of tables, and what is said of one in the place of a scene.
const TABLES: [&str; 4] = ["csv", "tsv", "dat", "xlsx"];
const NO_SCENE: &str = "it is a table, and a scene or model (TOML) is wanted here; options name tables, as \
                        `--to \"drop.csv:force=pad.force\"` of `fit` or `--measured drop.csv` of `run`, and \
                        `dashpot signal` reads one alone";
/// Whether numbers without a unit are refused.
static IS_STRICT: AtomicBool = AtomicBool::new(false);
/// Name of the built-in scene.
const BUILT_IN: &str = "reference";

/// From now on numbers of scenes without a unit are refused.
pub(crate) fn refuse_bare_numbers() {
    IS_STRICT.store(true, Ordering::Relaxed);
}

/// A text and the file that it is from, as far as messages are concerned.
pub(crate) struct Input {
    pub(crate) file: String,
    bytes: Vec<u8>,
}

impl Input {
    /// The same; the built-in scene where none is named.
    pub(crate) fn of(path: Option<&Path>) -> Result<Self, CliError> {
        Self::read(path.unwrap_or(Path::new(BUILT_IN)))
    }

    /// The built-in scene of this name, a file, or standard input for `-`.
    pub(crate) fn read(path: &Path) -> Result<Self, CliError> {
        let name = path.to_string_lossy();
        if let Some(text) = host::text(&name) {
            return Ok(Self { file: name.into_owned(), bytes: text.into_bytes() });
        }
        if !path.is_file()
            && let Some(shipped) = references().iter().find(|shipped| shipped.name == name)
        {
            let file = format!("{}.toml", shipped.name);
            return Ok(Self { file, bytes: shipped.text.as_bytes().to_vec() });
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
            CliError::Unreadable { name, reason: reason(&error) + more, similar }
        })?;
        Ok(Self { file: file.to_owned(), bytes })
    }

    /// The text of a scene or model.
    pub(crate) fn text(&self) -> Result<&str, CliError> {
        let ending = Path::new(&self.file).extension().and_then(|own| own.to_str());
        if ending.is_some_and(|own| TABLES.contains(&&*own.to_lowercase())) {
            let (name, reason) = (self.file.clone(), NO_SCENE.to_owned());
            return Err(CliError::Unreadable { name, reason, similar: None });
        }
        text_of_bytes(&self.bytes, Some(&self.file)).map_err(CliError::Scene)
    }

    /// The text of a file of numbers, whichever its encoding is.
    pub(crate) fn table_text(&self) -> Cow<'_, str> {
        table_text(&self.bytes)
    }

    /// How it is read with the values `set` in place of its own.
    pub(crate) fn options<'o>(&'o self, set: &'o [(String, String)]) -> ReadOptions<'o> {
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

/// The scene's title, or the name of its file.
pub(crate) fn title(scene: &Scene) -> &str {
    scene.title.as_deref().or(scene.file.as_deref()).unwrap_or("a scene without title")
}

/// The value of a setting of this name, in SI units. A bare number may be meant in others, and is none but zero; that of
/// a program that calls is in SI units.
pub(crate) fn setting(name: &str, text: &str, expected: Dimension) -> Result<f64, CliError> {
    let wrong = |reason: String| CliError::setting(name, reason);
    let unlike = |fault: Fault| CliError::quantity(name, fault);
    let found = parse_quantity(text);
    let found =
        found.map_err(|error| unlike(Fault::Unreadable { error, expected }))?.meant(expected);
    match found.dimension {
        Some(found) if found != expected => {
            Err(unlike(Fault::WrongDimension { text: text.to_owned(), found, expected }))
        }
        None if expected != Dimension::NUMBER && found.value != 0.0 && !host::is_called() => {
            Err(wrong(format!("`{text}` has no unit: write {}", with_units(text, expected))))
        }
        _ if found.angle == 0 => Ok(found.value),
        Some(Dimension::FREQUENCY) => {
            let frequency = found.value / std::f64::consts::TAU;
            Err(unlike(Fault::AngularFrequency { text: text.to_owned(), frequency }))
        }
        _ => Err(wrong(format!("`{text}` is an angle"))),
    }
}

/// The same for a value of the command line, with what to write in one sentence.
pub(crate) fn argument(name: &str, text: &str, expected: Dimension) -> Result<f64, String> {
    setting(name, text.trim(), expected).map_err(|error| match error.help() {
        Some(help) => format!("{error}; {help}"),
        None => error.to_string(),
    })
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
