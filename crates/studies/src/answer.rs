//! What a study answers.

use std::io::{self, Write};

use dashpot_report::Report;
use dashpot_scene::{guarded, text_cell};
use serde::Serialize;
use serde_json::Value;

/// What a study has come to: it serialises to one object, in SI units.
pub trait Answer: erased_serde::Serialize {
    /// What it says to people.
    fn report(&self) -> Report;

    /// What the reader must know first.
    fn warnings(&self) -> Vec<String> {
        Vec::new()
    }

    /// Its tables for programs.
    fn tables(&self) -> Vec<DataTable<'_>> {
        Vec::new()
    }

    /// What is to be concluded.
    fn outcome(&self) -> Outcome {
        Outcome::Done
    }
}

erased_serde::serialize_trait_object!(Answer);

/// What is to be concluded from an answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// It is done.
    Done,
    /// Nothing could be solved.
    Failed,
    /// Two models are not the same.
    NotSame,
    /// A limit that is enforced is not kept, or not for certain.
    LimitNotKept,
}

/// A cell of a table for programs.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Cell {
    /// A number in the unit of its column; one that is not finite is none.
    Number(Option<f64>),
    /// How many.
    Count(usize),
    /// A name.
    Text(String),
}

impl From<Option<f64>> for Cell {
    fn from(value: Option<f64>) -> Self {
        Self::Number(value)
    }
}

/// A table of numbers for programs, in SI units.
pub struct DataTable<'t> {
    /// Name of its file.
    pub file: String,
    /// The columns, each with its unit in brackets.
    pub header: Vec<String>,
    /// The rows.
    pub rows: Box<dyn Iterator<Item = Vec<Cell>> + 't>,
}

impl DataTable<'_> {
    /// Writes it as CSV; a zero has no sign, and what is not finite is no number.
    ///
    /// # Errors
    ///
    /// Those of `out`.
    pub fn write(self, out: &mut dyn Write) -> io::Result<()> {
        let plain = |cell| match cell {
            Cell::Number(value) => {
                Cell::Number(value.filter(|value| value.is_finite()).map(|value| value + 0.0))
            }
            cell => cell,
        };
        csv(out, self.header, self.rows.map(|row| crate::list(row.into_iter().map(plain))))
    }
}

/// Writes a heading and rows; a cell without a value is blank. A text that a sheet would take for a formula is guarded
/// in cells as in headings; a number stays one.
///
/// # Errors
///
/// Those of `out`.
pub fn csv(
    out: &mut dyn Write,
    header: impl IntoIterator<Item = String>,
    rows: impl IntoIterator<Item: Serialize>,
) -> io::Result<()> {
    let header: Vec<String> = header.into_iter().map(|own| text_cell(&own).into_owned()).collect();
    writeln!(out, "{}", header.join(","))?;
    let mut writer = csv::Writer::from_writer(out);
    for row in rows {
        cells(&serde_json::to_value(row)?, &mut writer)?;
        writer.write_record(None::<&[u8]>)?;
    }
    writer.flush()
}

/// The cells of a row or of a part of it.
fn cells(part: &Value, writer: &mut csv::Writer<impl Write>) -> csv::Result<()> {
    match part {
        Value::Array(all) => all.iter().try_for_each(|own| cells(own, writer)),
        Value::Object(all) => all.values().try_for_each(|own| cells(own, writer)),
        Value::Null => writer.write_field(""),
        Value::Bool(own) => writer.write_field(own.to_string()),
        Value::Number(own) => writer.write_field(own.to_string()),
        Value::String(own) if own.parse::<f64>().is_ok() => writer.write_field(own),
        Value::String(own) => writer.write_field(guarded(own).as_ref()),
    }
}
