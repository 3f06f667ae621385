//! Files in a zip: the one place that knows how it is packed.

use std::io::Read;

use miniz_oxide::inflate::decompress_to_vec_with_limit;
use rawzip::{CompressionMethod, ZipArchive};

/// A file in a zip is at most so long, in bytes.
const MOST_BYTES: usize = 64 << 20;

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
        let packed = local.data();
        let method = entry.compression_method();
        let plain = if method == CompressionMethod::DEFLATE {
            decompress_to_vec_with_limit(packed, MOST_BYTES)
                .map_err(|_| format!("{name} is damaged, or longer than 64 MB"))?
        } else if method == CompressionMethod::STORE {
            packed.to_vec()
        } else {
            return Err(format!(
                "{name} is packed in a way that is not read: pack it anew, or unpack it"
            ));
        };
        let mut checked = Vec::new();
        let read = local.verifying_reader(&plain[..]).read_to_end(&mut checked);
        read.map_err(|_| format!("{name} is damaged: its checksum is another"))?;
        files.push((name, checked));
    }
    Ok(files)
}
