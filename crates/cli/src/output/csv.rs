//! Tables of numbers as CSV.

use std::io::{self, Write};

use dashpot_scene::text_cell;
use serde::Serialize;

/// Writes a heading and rows; a cell without a value is blank.
pub(crate) fn csv(
    out: &mut dyn Write,
    header: impl IntoIterator<Item = String>,
    rows: impl IntoIterator<Item: Serialize>,
) -> io::Result<()> {
    let header: Vec<String> = header.into_iter().map(|own| text_cell(&own).into_owned()).collect();
    writeln!(out, "{}", header.join(","))?;
    let mut writer = csv::Writer::from_writer(out);
    rows.into_iter().try_for_each(|row| writer.serialize(row))?;
    writer.flush()
}
