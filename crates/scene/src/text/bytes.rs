//! From bytes to text.

use std::sync::Arc;

use super::{document::MAX_BYTES, source::Source};
use crate::{
    diagnostics::{Diagnostics, fault::Fault},
    tables::{DataTable, table_text},
};

/// The bytes of a file as text.
///
/// # Errors
///
/// A file that is too large, or not UTF-8.
pub fn text_of_bytes<'b>(bytes: &'b [u8], file: Option<&str>) -> Result<&'b str, Diagnostics> {
    let nowhere = || file.map(|name| Arc::new(Source::new(name, "")));
    if bytes.len() > MAX_BYTES {
        return Err(Diagnostics::single(Fault::TooLarge { bytes: bytes.len() }, nowhere()));
    }
    std::str::from_utf8(bytes).map_err(|error| {
        if let Some(fault) = table_for_scene(&table_text(bytes), file.unwrap_or("scene")) {
            return Diagnostics::single(fault, nowhere());
        }
        let at = error.valid_up_to();
        let line = bytes[..at].split(|&byte| byte == b'\n').count();
        Diagnostics::single(Fault::NotUtf8 { at, line }, nowhere())
    })
}

/// What is wrong with a text that is a table of numbers, as no scene is.
pub(crate) fn table_for_scene(text: &str, name: &str) -> Option<Fault> {
    let is_comment = |line: &&str| line.is_empty() || line.starts_with('#');
    let first = text.lines().map(str::trim).find(|line| !is_comment(line))?;
    // The first line of TOML is a section or an assignment.
    if first.starts_with('[') || first.contains('=') {
        return None;
    }
    let table = DataTable::read(text).ok()?;
    let (_, row) = table.rows().next()?;
    let is_table = row.len() > 1 && row.iter().all(|field| table.number(field).is_ok());
    is_table.then(|| Fault::TableForScene { name: name.to_owned() })
}
