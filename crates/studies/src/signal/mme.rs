//! Tests in ISO-MME: an `.mme` file with its folder, the folder, or a zip of it.

use std::{io, path::Path};

use dashpot_scene::table_text;
use dashpot_signal::iso_mme::{self, MmeChannel};
use miniz_oxide::inflate::{TINFLStatus, decompress_to_vec_with_limit};
use rawzip::{CompressionMethod, ZipArchive};

use super::SignalError;
use crate::{Context, StudyError};

/// A test has at most so many channels.
const MOST_FILES: usize = 1000;

/// A file in a zip is at most so long, in bytes.
const MOST_BYTES: usize = 64 << 20;
/// All that are wanted of it are together at most so long.
const MOST_TOGETHER: usize = 256 << 20;

/// A text of a test: its name and its bytes.
type Part = (String, Vec<u8>);

/// Whether a path is a test in ISO-MME.
pub fn is_one(path: &str, context: &dyn Context) -> bool {
    has_ending(path, "mme") || has_ending(path, "zip") || context.folder(path).is_some()
}

fn has_ending(path: &str, ending: &str) -> bool {
    Path::new(path).extension().is_some_and(|own| own.eq_ignore_ascii_case(ending))
}

fn file_name(path: &str) -> String {
    Path::new(path).file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}

/// Whether a name ends in the number of a channel: `drop.001`.
fn is_channel(name: &str) -> bool {
    let ending = name.rsplit_once('.').map_or("", |own| own.1);
    ending.len() == 3 && ending.bytes().all(|own| own.is_ascii_digit())
}

/// Reads the channels of a test.
///
/// # Errors
///
/// [`SignalError::File`].
pub fn read(path: &str, context: &dyn Context) -> Result<Vec<MmeChannel>, StudyError> {
    let file = path.to_owned();
    let wrong = |reason: String| StudyError::from(SignalError::File { file: file.clone(), reason });
    let parts =
        if has_ending(path, "zip") { of_zip(path, context) } else { of_folder(path, context) };
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
fn of_folder(path: &str, context: &dyn Context) -> Result<Vec<Part>, String> {
    let entries = match context.folder(path) {
        Some(entries) => entries?,
        None if context.has(path) => {
            let folder =
                Path::new(path).parent().map_or("", |parent| parent.to_str().unwrap_or(""));
            let folder = if folder.is_empty() { "." } else { folder };
            context.folder(folder).unwrap_or(Ok(Vec::new()))?
        }
        None => return Err("there is no such file".to_owned()),
    };
    let mut files: Vec<String> = Vec::new();
    for entry in entries {
        match context.folder(&entry) {
            Some(within) if file_name(&entry).eq_ignore_ascii_case("channel") => {
                files.extend(within?);
            }
            _ => files.push(entry),
        }
    }
    files.retain(|file| is_channel(&file_name(file)));
    if files.len() > MOST_FILES {
        return Err(too_many());
    }
    let mut left = MOST_TOGETHER;
    let read = |file: &String| {
        let name = file_name(file);
        let bytes = context.load(file).map_err(|reason| format!("{name}: {reason}"))?;
        let shorter = left.checked_sub(bytes.len());
        left = shorter.ok_or("all its channels are together longer than 256 MB")?;
        Ok((name, bytes))
    };
    files.iter().map(read).collect()
}

/// The channels in a zip, wherever they stand in it.
fn of_zip(path: &str, context: &dyn Context) -> Result<Vec<Part>, String> {
    let bytes = context.load(path).map_err(|reason| format!("it cannot be read: {reason}"))?;
    let wrong = |error: rawzip::Error| format!("it is no zip that can be read: {error}");
    let archive = ZipArchive::from_slice(&bytes).map_err(wrong)?;
    let (mut entries, mut files) = (archive.entries(), Vec::new());
    let (mut ranges, mut left): (Vec<(u64, u64)>, _) = (Vec::new(), MOST_TOGETHER);
    while let Some(entry) = entries.next_entry().map_err(wrong)? {
        let path = String::from_utf8_lossy(entry.file_path().as_ref()).into_owned();
        let name = path.rsplit(['/', '\\']).next().unwrap_or_default().to_owned();
        if !is_channel(&name) {
            continue;
        }
        if files.len() == MOST_FILES {
            return Err(too_many());
        }
        let local = archive.get_entry(entry.wayfinder()).map_err(wrong)?;
        let (packed, range) = (local.data(), local.compressed_data_range());
        if ranges.iter().any(|own| own.0 < range.1 && range.0 < own.1) {
            return Err(format!("{name} lies over another file: it is no zip of a test"));
        }
        ranges.push(range);
        let method = entry.compression_method();
        let most = MOST_BYTES.min(left);
        let plain = if method == CompressionMethod::DEFLATE {
            decompress_to_vec_with_limit(packed, most).map_err(|fault| match fault.status {
                TINFLStatus::HasMoreOutput => too_long(&name),
                _ => format!("{name} is damaged"),
            })?
        } else if method == CompressionMethod::STORE {
            packed.to_vec()
        } else {
            return Err(format!(
                "{name} is packed in a way that is not read: pack it anew, or unpack it"
            ));
        };
        left = left.checked_sub(plain.len()).ok_or_else(|| too_long(&name))?;
        // Only the checksum is looked at: nothing of it is kept.
        let read = io::copy(&mut local.verifying_reader(&plain[..]), &mut io::sink());
        read.map_err(|_| format!("{name} is damaged: its checksum is another"))?;
        files.push((name, plain));
    }
    Ok(files)
}

fn too_long(name: &str) -> String {
    format!("{name} is longer than 64 MB, or up to there all channels are longer than 256 MB")
}

fn too_many() -> String {
    format!("there are more than {MOST_FILES} channels in it")
}
