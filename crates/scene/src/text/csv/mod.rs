//! Tables of numbers in text files.
//!
//! Columns are separated by semicolons where the first line has one, else by tabs where it has one,
//! else by commas. A line that begins with `#` is a comment. The first line is a header if no field
//! of it is a number; a field such as `force [kN]` or `force (kN)` names a column and its unit. An
//! apostrophe before a name that begins like a formula is not part of it ([`text_cell`]).

mod fault;

use std::{borrow::Cow, ops::Range};

use fault::MOST_ROWS;

use crate::units::{UnitError, parse_quantity};

pub use fault::CsvFault;

/// After so many faults the rest of a file is not looked at.
const TOLD: usize = 10;

/// One field of a line and where it stands in the text.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Field<'t> {
    /// Without spaces and quotes around it.
    pub(crate) text: &'t str,
    /// Its first byte.
    pub(crate) at: usize,
}

impl Field<'_> {
    /// The bytes of the field.
    pub(crate) fn span(&self) -> Range<usize> {
        self.at..self.at + self.text.len()
    }

    /// The name and the unit of a column, `force` and `kN` in `force [kN]`.
    pub(crate) fn name_and_unit(&self) -> (&str, Option<Self>) {
        let text = unguarded(self.text);
        let at = self.at + self.text.len() - text.len();
        let open = match text.chars().last() {
            Some(']') => text.rfind('['),
            Some(')') => text.rfind('('),
            _ => None,
        };
        let Some(open) = open else { return (text, None) };
        let unit = trimmed(&text[open + 1..text.len() - 1], at + open + 1);
        (text[..open].trim_end(), Some(unit))
    }

    /// The number that the field is, without a unit.
    pub(crate) fn number(&self) -> Result<f64, CsvFault> {
        if self.text.is_empty() {
            return Err(CsvFault::EmptyCell);
        }
        match parse_quantity(self.text) {
            Ok(quantity) if quantity.dimension.is_none() => Ok(quantity.value),
            Ok(_) => Err(CsvFault::UnitInCell { text: self.text.to_owned() }),
            Err(
                error @ (UnitError::DecimalComma { .. }
                | UnitError::Separated { .. }
                | UnitError::NotFinite { .. }
                | UnitError::TooLarge { .. }
                | UnitError::TooSmall { .. }),
            ) => Err(CsvFault::Unreadable(error)),
            Err(_) => Err(CsvFault::NoNumber { text: self.text.to_owned() }),
        }
    }

    /// Whether the field is a number or begins like one.
    fn is_like_number(&self) -> bool {
        let bare = self.text.trim_start_matches(['+', '-', '.', ',']);
        let is_word = |word: &str| bare.eq_ignore_ascii_case(word);
        bare.starts_with(|first: char| first.is_ascii_digit())
            || ["nan", "inf", "infinity"].into_iter().any(is_word)
    }
}

/// A text with columns.
#[derive(Debug)]
pub(crate) struct Csv<'t> {
    text: &'t str,
    separator: char,
    /// The names and units of the columns, where the first line has them.
    pub(crate) header: Option<Vec<Field<'t>>>,
    /// Number of columns of the first line.
    pub(crate) columns: usize,
    /// Where the rows begin.
    start: usize,
}

impl<'t> Csv<'t> {
    /// The table in `text`; `None` where there is no line but comments.
    pub(crate) fn new(text: &'t str) -> Option<Self> {
        let (at, first) = lines(text, 0).next()?;
        let separates = |own: &char| first.split('"').step_by(2).any(|part| part.contains(*own));
        let separator = [';', '\t'].into_iter().find(separates).unwrap_or(',');
        let mut fields = Vec::new();
        split(first, at, separator, &mut fields);
        let columns = fields.len();
        let is_header = !fields.iter().any(Field::is_like_number);
        let start = if is_header { at + first.len() } else { at };
        let header = is_header.then_some(fields);
        Some(Self { text, separator, header, columns, start })
    }

    /// The fields of each row, with the number of its line from 1.
    pub(crate) fn rows(&self) -> impl Iterator<Item = (usize, Vec<Field<'t>>)> + '_ {
        let (mut line, mut counted) = (1, 0);
        lines(self.text, self.start).map(move |(at, row)| {
            line += self.text[counted..at].matches('\n').count();
            counted = at;
            let mut fields = Vec::with_capacity(self.columns);
            split(row, at, self.separator, &mut fields);
            (line, fields)
        })
    }

    /// The rows as pairs of the values in two `columns`, counted from 0, times `factors`, the first
    /// one never falling; `None` where a fault was noted.
    pub(crate) fn points(
        &self,
        columns: [usize; 2],
        factors: [f64; 2],
        mut note: impl FnMut(Range<usize>, CsvFault),
    ) -> Option<Vec<(f64, f64)>> {
        let mut told = 0;
        let mut points: Vec<(f64, f64)> = Vec::new();
        let mut fields = Vec::new();
        // As it is written, for the message.
        let mut before = "";
        for (rows, (at, line)) in lines(self.text, self.start).enumerate() {
            let span = at..at + line.len();
            if rows == MOST_ROWS {
                note(span, CsvFault::TooManyRows);
                return None;
            }
            split(line, at, self.separator, &mut fields);
            let earliest = points.last().map_or(f64::NEG_INFINITY, |last| last.0);
            let fault = match self.row(&fields, &span, columns, factors) {
                Ok(point) if point.0 >= earliest => {
                    before = fields[columns[0]].text;
                    points.push(point);
                    continue;
                }
                Ok(_) => {
                    let time = &fields[columns[0]];
                    let (found, before) = (time.text.to_owned(), before.to_owned());
                    (time.span(), CsvFault::OutOfOrder { found, before })
                }
                Err(fault) => fault,
            };
            note(fault.0, fault.1);
            told += 1;
            if told >= TOLD {
                break;
            }
        }
        (told == 0).then_some(points)
    }

    /// Two of the `fields` of the row at `span`, times `factors`; the first fault where there is one.
    fn row(
        &self,
        fields: &[Field<'t>],
        span: &Range<usize>,
        columns: [usize; 2],
        factors: [f64; 2],
    ) -> Result<(f64, f64), (Range<usize>, CsvFault)> {
        if fields.len() > self.columns {
            let (found, first) = (fields.len(), self.columns);
            return Err((span.clone(), CsvFault::Uneven { found, first }));
        }
        let number = |column: usize, factor: f64| {
            let Some(field) = fields.get(column) else {
                return Err((span.clone(), CsvFault::EmptyCell));
            };
            let number = field.number().map_err(|fault| (field.span(), fault))? * factor;
            if number.is_finite() {
                return Ok(number);
            }
            let text = field.text.to_owned();
            Err((field.span(), CsvFault::Unreadable(UnitError::TooLarge { text })))
        };
        Ok((number(columns[0], factors[0])?, number(columns[1], factors[1])?))
    }
}

/// The lines from byte `start` on that hold something, with where they begin.
fn lines(text: &str, start: usize) -> impl Iterator<Item = (usize, &str)> {
    let mut next = start;
    let all = text.get(start..).unwrap_or_default().split_inclusive('\n');
    all.map(move |line| {
        let at = next;
        next += line.len();
        let mark = if at == 0 && line.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
        (at + mark, line[mark..].trim_end_matches(['\n', '\r']))
    })
    .filter(|(_, line)| !line.trim().is_empty() && !line.trim_start().starts_with('#'))
}

/// The fields of a line that begins at `at`. A separator between quotes separates nothing, and one
/// at the end of the line opens no field.
fn split<'t>(line: &'t str, at: usize, separator: char, fields: &mut Vec<Field<'t>>) {
    fields.clear();
    let (mut start, mut quoted) = (0, false);
    for (place, found) in line.char_indices() {
        if found == '"' {
            quoted = !quoted;
        } else if found == separator && !quoted {
            fields.push(trimmed(&line[start..place], at + start));
            start = place + separator.len_utf8();
        }
    }
    let last = trimmed(&line[start..], at + start);
    if !last.text.is_empty() || fields.is_empty() {
        fields.push(last);
    }
}

/// A field without what stands around it.
fn trimmed(text: &str, at: usize) -> Field<'_> {
    let outer = text.trim();
    let inner = outer.strip_prefix('"').and_then(|own| own.strip_suffix('"'));
    let own = inner.unwrap_or(outer).trim();
    // The trimmed text is a part of the text.
    let before = text.find(own).unwrap_or(0);
    Field { text: own, at: at + before }
}

/// Stands before a text that a sheet would take for a formula.
const GUARD: char = '\'';

/// A name as a field of a CSV text.
///
/// A sheet evaluates what begins with `=`, `+`, `-` or `@`. Such a name gets an apostrophe before it,
/// which says to a sheet that a text follows; where this crate reads a header it belongs to no name.
/// Where a separator of any kind stands in a name, the field is quoted.
///
/// # Examples
///
/// ```
/// use dashpot_scene::text_cell;
///
/// assert_eq!(text_cell("pad.force [N]"), "pad.force [N]");
/// assert_eq!(text_cell("=1+1"), "'=1+1");
/// assert_eq!(text_cell("-x;y"), "\"'-x;y\"");
/// ```
pub fn text_cell(name: &str) -> Cow<'_, str> {
    let guarded = if is_live(name) { format!("{GUARD}{name}").into() } else { Cow::Borrowed(name) };
    if guarded.contains([',', ';', '\t', '"', '\n', '\r']) {
        return format!("\"{}\"", guarded.replace('"', "\"\"")).into();
    }
    guarded
}

/// A name without the apostrophe of [`text_cell`].
fn unguarded(text: &str) -> &str {
    text.strip_prefix(GUARD).filter(|own| is_live(own)).unwrap_or(text)
}

/// Whether a sheet would evaluate the text; an apostrophe before such a text is data like any other.
fn is_live(text: &str) -> bool {
    text.trim_start_matches(GUARD).starts_with(['=', '+', '-', '@', '\t', '\r'])
}

#[cfg(test)]
mod tests;
