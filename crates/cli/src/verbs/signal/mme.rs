//! Tests in ISO-MME: an `.mme` file with its folder, the folder, or a zip of it.

use std::{
    fs,
    path::{Path, PathBuf},
};

use dashpot_scene::table_text;
use dashpot_signal::iso_mme::{self, MmeChannel};

use super::zip;
use crate::{
    error::{CliError, reason},
    input::bytes_of,
};

/// A test has at most so many channels.
const MOST_FILES: usize = 1000;

/// A text of a test: its name and its bytes.
type Part = (String, Vec<u8>);

/// Whether a path is a test in ISO-MME.
pub(in crate::verbs) fn is_one(path: &Path) -> bool {
    path.is_dir() || has_ending(path, "mme") || has_ending(path, "zip")
}

fn has_ending(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|own| own.eq_ignore_ascii_case(ending))
}

/// Whether a name ends in the number of a channel: `drop.001`.
fn is_channel(name: &str) -> bool {
    let ending = name.rsplit_once('.').map_or("", |own| own.1);
    ending.len() == 3 && ending.bytes().all(|own| own.is_ascii_digit())
}

/// Reads the channels of a test.
pub(in crate::verbs) fn read(path: &Path) -> Result<Vec<MmeChannel>, CliError> {
    let file = path.to_string_lossy().into_owned();
    let wrong = |reason: String| CliError::SignalFile { file: file.clone(), reason };
    let parts = if has_ending(path, "zip") { of_zip(path) } else { of_folder(path) };
    let mut parts = parts.map_err(wrong)?;
    parts.sort();
    if parts.is_empty() {
        return Err(wrong(
            "there is no channel of ISO-MME in it: no file that ends in `.001` or another number of three digits"
                .to_owned(),
        ));
    }
    let texts: Vec<_> = parts.iter().map(|own| table_text(&own.1)).collect();
    let texts: Vec<&str> = texts.iter().map(|own| &**own).collect();
    let channels = iso_mme::read(&texts).map_err(|(at, error)| {
        wrong(format!("{}, {error}", parts.get(at).map_or("", |own| &own.0)))
    })?;
    if channels.is_empty() {
        return Err(wrong("all its channels are times".to_owned()));
    }
    Ok(channels)
}

/// The channels in the folder of a test, or in `Channel` within it.
fn of_folder(path: &Path) -> Result<Vec<Part>, String> {
    let folder = if path.is_dir() { path } else { path.parent().unwrap_or(Path::new("")) };
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    if !path.is_dir() && !path.is_file() {
        return Err("there is no such file".to_owned());
    }
    let mut files: Vec<PathBuf> = Vec::new();
    let is_within = |own: &Path| {
        own.is_dir() && own.file_name().is_some_and(|name| name.eq_ignore_ascii_case("channel"))
    };
    let entries = |folder: &Path| -> Result<Vec<PathBuf>, String> {
        let unreadable =
            |error: std::io::Error| format!("`{}`: {}", folder.display(), reason(&error));
        let all = fs::read_dir(folder).map_err(unreadable)?;
        all.map(|own| own.map(|own| own.path()).map_err(unreadable)).collect()
    };
    for own in entries(folder)? {
        if is_within(&own) {
            files.extend(entries(&own)?);
        } else {
            files.push(own);
        }
    }
    let name = |own: &Path| {
        own.file_name().map_or_else(String::new, |own| own.to_string_lossy().into_owned())
    };
    let files: Vec<PathBuf> = files.into_iter().filter(|own| is_channel(&name(own))).collect();
    if files.len() > MOST_FILES {
        return Err(format!("there are more than {MOST_FILES} channels in it"));
    }
    let mut left = zip::MOST_TOGETHER;
    let read = |own: &PathBuf| {
        let bytes = bytes_of(own).map_err(|error| format!("{}: {}", name(own), reason(&error)))?;
        let shorter = left.checked_sub(bytes.len());
        left = shorter.ok_or("all its channels are together longer than 256 MB")?;
        Ok((name(own), bytes))
    };
    files.iter().map(read).collect()
}

/// The channels in a zip, wherever they stand in it.
fn of_zip(path: &Path) -> Result<Vec<Part>, String> {
    let bytes = bytes_of(path).map_err(|error| format!("it cannot be read: {}", reason(&error)))?;
    zip::files(&bytes, is_channel, MOST_FILES)
}
