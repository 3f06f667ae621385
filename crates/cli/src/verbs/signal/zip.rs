//! Files in a zip: the one place that knows how it is packed.

use std::io;

use miniz_oxide::inflate::{TINFLStatus, decompress_to_vec_with_limit};
use rawzip::{CompressionMethod, ZipArchive};

/// A file in a zip is at most so long, in bytes.
const MOST_BYTES: usize = 64 << 20;
/// All that are wanted of it are together at most so long.
pub(super) const MOST_TOGETHER: usize = 256 << 20;

/// The files of a zip whose names, without folders, are wanted: names and bytes, at most so many.
///
/// # Errors
///
/// What is wrong with it, in words.
pub(super) fn files(
    bytes: &[u8],
    is_wanted: impl Fn(&str) -> bool,
    most: usize,
) -> Result<Vec<(String, Vec<u8>)>, String> {
    let wrong = |error: rawzip::Error| format!("it is no zip that can be read: {error}");
    let archive = ZipArchive::from_slice(bytes).map_err(wrong)?;
    let (mut entries, mut files) = (archive.entries(), Vec::new());
    let (mut ranges, mut left): (Vec<(u64, u64)>, _) = (Vec::new(), MOST_TOGETHER);
    while let Some(entry) = entries.next_entry().map_err(wrong)? {
        let path = String::from_utf8_lossy(entry.file_path().as_ref()).into_owned();
        let name = path.rsplit(['/', '\\']).next().unwrap_or_default().to_owned();
        if !is_wanted(&name) {
            continue;
        }
        if files.len() == most {
            return Err(format!("there are more than {most} channels in it"));
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
