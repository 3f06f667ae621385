//! Tables of numbers in text files: measured curves, driving functions, lists of designs.
//!
//! There is one reader for all of them. [`table_text`] makes text of bytes, and a [`DataTable`] finds the table in
//! it: what separates its columns, where names, units and rows stand, what stands before the decimals, and which
//! lines a machine wrote before it. `docs/tables.md` says what is read.

mod cells;
mod encoding;
mod fault;
mod guard;
mod layout;
mod left_out;

use std::{f64::consts::TAU, ops::Range};

use dashpot_network::parameters::Dimension;
use dashpot_units::{Quantity, UnitError, parse_quantity};

use self::{
    cells::{Decimal, spelt, split},
    fault::MOST_ROWS,
    layout::{Layout, check_columns, decimal, lines},
};

pub(crate) use self::cells::{Field, is_no_unit};
pub use self::{
    encoding::table_text,
    fault::{Likewise, TableError, TableFault},
    guard::{guarded, text_cell},
    left_out::LeftOut,
};

/// A table of numbers in a text.
///
/// # Examples
///
/// ```
/// use dashpot_scene::{DataTable, units::Dimension};
///
/// let text = "Specimen: EPS 30 g/l\n\nWeg [mm];Kraft [kN]\n0,0;0,0\n2,5;1,2\n";
/// let table = DataTable::read(text)?;
/// let [force] = table.measuring(Dimension::FORCE)[..] else { panic!() };
/// assert_eq!(table.heading(force).name, "Kraft");
/// assert_eq!(table.column(force, Dimension::FORCE)?, [0.0, 1200.0]);
/// assert_eq!(table.lines(), [4, 5]);
/// assert_eq!(table.skipped().next(), Some((1, "Specimen: EPS 30 g/l")));
/// # Ok::<(), dashpot_scene::TableError>(())
/// ```
#[derive(Debug)]
pub struct DataTable<'t> {
    text: &'t str,
    layout: Layout<'t>,
    decimal: Decimal,
}

/// What a table says of a column.
#[derive(Debug, Clone, PartialEq)]
pub struct Heading<'t> {
    /// The name, without the unit; empty where there is none.
    pub name: &'t str,
    /// The unit as it is written; `None` where there is none.
    pub unit: Option<&'t str>,
    /// What the unit measures; `None` where there is none, or none that can be read.
    pub dimension: Option<Dimension>,
}

/// Two columns of a table, row by row.
#[derive(Debug, Default)]
pub(crate) struct Samples {
    /// The values in SI units.
    pub(crate) points: Vec<(f64, f64)>,
    /// The byte at which each row begins.
    pub(crate) starts: Vec<usize>,
}

/// A number of a column times `factor`, plus `offset`, is in SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Scale {
    pub(crate) factor: f64,
    pub(crate) offset: f64,
}

impl Scale {
    /// That of numbers in SI units.
    pub(crate) const SI: Self = Self { factor: 1.0, offset: 0.0 };
}

impl<'t> DataTable<'t> {
    /// The table in `text`.
    ///
    /// # Errors
    ///
    /// A text without a line, and one whose commas may stand before decimals or between thousands, or between columns. Cells
    /// are looked at when their column is read.
    pub fn read(text: &'t str) -> Result<Self, TableError> {
        let empty = || TableError::new(text, 0..0, TableFault::Empty);
        let layout = Layout::of(text).ok_or_else(empty)?;
        check_columns(text, &layout)?;
        let decimal = decimal(text, &layout)?;
        Ok(Self { text, layout, decimal })
    }

    /// Number of columns of the header, or else of the first row.
    pub fn columns(&self) -> usize {
        self.layout.columns
    }

    /// Whether the columns are named.
    pub fn has_header(&self) -> bool {
        self.layout.header.is_some()
    }

    /// What the table says of a column, counted from 0; nothing of one that there is not.
    pub fn heading(&self, column: usize) -> Heading<'t> {
        let unit = self.unit(column);
        let written = unit.map(|own| quantity_in(own.text));
        let dimension = written.and_then(|own| own.ok()?.dimension);
        Heading {
            name: self.name(column).map_or("", |own| own.0),
            unit: unit.map(|own| own.text),
            dimension,
        }
    }

    /// The columns, counted from 0, whose unit is one of this dimension. `g` is a gram, and standard gravity where
    /// accelerations are asked for.
    pub fn measuring(&self, dimension: Dimension) -> Vec<usize> {
        let is_one = |column: &usize| {
            let found = self.unit(*column).and_then(|unit| quantity_in(unit.text).ok());
            found.is_some_and(|own| own.meant(dimension).dimension == Some(dimension))
        };
        (0..self.columns()).filter(is_one).collect()
    }

    /// The column of this name, counted from 0.
    ///
    /// # Errors
    ///
    /// No column, or several, of the name.
    pub fn position(&self, name: &str) -> Result<usize, TableError> {
        let is_it = |column: &usize| self.name(*column).is_some_and(|own| own.0 == name.trim());
        let found: Vec<usize> = (0..self.columns()).filter(is_it).collect();
        let fault = match found[..] {
            [column] => return Ok(column),
            [] => TableFault::NoColumn { wanted: format!("`{name}`"), count: self.columns() },
            _ => TableFault::SharedName { name: name.to_owned(), count: found.len() },
        };
        Err(TableError::new(self.text, self.header_span(), fault))
    }

    /// The numbers of a column, counted from 0, in SI units, row by row. Where the table says no unit they are
    /// taken as they are.
    ///
    /// # Errors
    ///
    /// A column that there is not; a unit that cannot be read, or is of another dimension; the first cell that is
    /// no number.
    pub fn column(&self, column: usize, expected: Dimension) -> Result<Vec<f64>, TableError> {
        let scale = match self.unit(column) {
            None => Scale::SI,
            Some(unit) => {
                let fault = |fault| self.error(unit.span(), column, fault);
                let one = quantity_in(unit.text).map_err(|own| fault(TableFault::BadUnit(own)))?;
                scale_of(one, expected).ok_or_else(|| {
                    let (text, found) = (unit.text.to_owned(), one.dimension);
                    fault(TableFault::WrongDimension { text, found, expected })
                })?
            }
        };
        let mut fault = None;
        let values = self.values([column], [scale], |error| {
            fault.get_or_insert(error);
        });
        match (values, fault) {
            (Some(values), None) => Ok(values.into_iter().map(|(_, [value])| value).collect()),
            (_, fault) => {
                Err(fault.unwrap_or_else(|| TableError::new(self.text, 0..0, TableFault::Empty)))
            }
        }
    }

    /// The line of each row, from 1.
    pub fn lines(&self) -> Vec<usize> {
        let (mut line, mut counted) = (1, 0);
        let rows = self.layout.lines(self.text).map(|(at, _)| {
            line += self.text[counted..at].matches('\n').count();
            counted = at;
            line
        });
        rows.collect()
    }

    /// The lines before the table that are no part of it, with their numbers from 1.
    pub fn skipped(&self) -> impl Iterator<Item = (usize, &'t str)> + '_ {
        let before = lines(self.text, 0).take_while(|(at, _)| *at < self.layout.table);
        before.map(|(at, line)| (self.line_of(at), line))
    }

    /// The numbers, from 1, of the first and the last line of words behind the rows, which are no part of the table.
    pub fn behind(&self) -> Option<[usize; 2]> {
        let mut behind = lines(self.text, self.layout.end).map(|own| self.line_of(own.0));
        let first = behind.next()?;
        Some([first, behind.last().unwrap_or(first)])
    }

    /// The number of the line at a byte, from 1.
    fn line_of(&self, at: usize) -> usize {
        1 + self.text[..at].matches('\n').count()
    }

    /// The name of a column, and where it stands.
    pub(crate) fn name(&self, column: usize) -> Option<(&'t str, Field<'t>)> {
        let field = *self.layout.header.as_ref()?.get(column)?;
        Some((field.name_and_unit().0, field))
    }

    /// The unit of a column, in the header or in the row of units below it.
    pub(crate) fn unit(&self, column: usize) -> Option<Field<'t>> {
        let unit = match &self.layout.units {
            Some(units) => Some(units.get(column)?.bare_unit()),
            None => self.layout.header.as_ref()?.get(column)?.name_and_unit().1,
        };
        unit.filter(|unit| !unit.text.is_empty())
    }

    /// The fields of each row, with the byte at which it begins.
    pub(crate) fn rows(&self) -> impl Iterator<Item = (usize, Vec<Field<'t>>)> + '_ {
        self.layout.lines(self.text).map(move |(at, row)| {
            let mut fields = Vec::with_capacity(self.layout.columns);
            split(row, at, self.layout.separator, &mut fields);
            (at, fields)
        })
    }

    /// A field of the row that begins at byte `start`.
    pub(crate) fn cell(&self, start: usize, column: usize) -> Option<Field<'t>> {
        let (at, row) = lines(self.text, start).next()?;
        let mut fields = Vec::new();
        split(row, at, self.layout.separator, &mut fields);
        fields.get(column).copied()
    }

    /// The number that a field is, without a unit.
    pub(crate) fn number(&self, field: &Field<'_>) -> Result<f64, TableFault> {
        field.number(self.decimal)
    }

    /// A fault at the bytes `span`, in a column.
    pub(crate) fn error(&self, span: Range<usize>, column: usize, fault: TableFault) -> TableError {
        TableError::new(self.text, span, fault).in_column(self.layout.name_of(column))
    }

    /// The values in two columns, counted from 0, row by row; `None` where a fault was noted.
    pub(crate) fn samples(
        &self,
        columns: [usize; 2],
        scales: [Scale; 2],
        note: impl FnMut(TableError),
    ) -> Option<Samples> {
        let values = self.values(columns, scales, note)?;
        let (starts, points) = values.into_iter().map(|(at, [x, y])| (at, (x, y))).unzip();
        Some(Samples { points, starts })
    }

    /// The values in `columns` with the beginnings of their rows; `None` where a fault was noted.
    fn values<const N: usize>(
        &self,
        columns: [usize; N],
        scales: [Scale; N],
        mut note: impl FnMut(TableError),
    ) -> Option<Vec<(usize, [f64; N])>> {
        let (mut told, mut all, mut fields) = (Vec::<TableError>::new(), Vec::new(), Vec::new());
        for (rows, (at, line)) in self.layout.lines(self.text).enumerate() {
            let span = at..at + line.len();
            if rows == MOST_ROWS {
                note(TableError::new(self.text, span, TableFault::TooManyRows));
                return None;
            }
            split(line, at, self.layout.separator, &mut fields);
            match self.row(&fields, &span, columns, scales) {
                Ok(values) => all.push((at, values)),
                Err(error) => match told.iter_mut().find(|known| known.is_like(&error)) {
                    Some(known) => known.likewise.get_or_insert_default().add(error.line),
                    None => told.push(error),
                },
            }
        }
        if told.is_empty() {
            return Some(all);
        }
        told.into_iter().for_each(note);
        None
    }

    /// Some of the `fields` of the row at `span`, in SI units; the first fault where there is one.
    fn row<const N: usize>(
        &self,
        fields: &[Field<'t>],
        span: &Range<usize>,
        columns: [usize; N],
        scales: [Scale; N],
    ) -> Result<[f64; N], TableError> {
        if fields.len() > self.layout.columns {
            let fault = TableFault::Uneven { found: fields.len(), first: self.layout.columns };
            return Err(TableError::new(self.text, span.clone(), fault));
        }
        let mut values = [0.0; N];
        for (value, (column, scale)) in values.iter_mut().zip(columns.into_iter().zip(scales)) {
            let Some(field) = fields.get(column) else {
                return Err(self.error(span.clone(), column, TableFault::EmptyCell));
            };
            let number = self.number(field).map_err(|own| self.error(field.span(), column, own))?;
            *value = number * scale.factor + scale.offset;
            if !value.is_finite() {
                let text = field.text.to_owned();
                let fault = TableFault::Unreadable(UnitError::TooLarge { text });
                return Err(self.error(field.span(), column, fault));
            }
        }
        Ok(values)
    }

    /// The bytes of the header, or of the beginning of the rows where there is none.
    fn header_span(&self) -> Range<usize> {
        let header = self.layout.header.as_deref().unwrap_or_default();
        match (header.first(), header.last()) {
            (Some(first), Some(last)) => first.span().start..last.span().end,
            _ => self.layout.rows..self.layout.rows,
        }
    }
}

/// One of the unit `text`.
pub(crate) fn quantity_in(text: &str) -> Result<Quantity, UnitError> {
    if is_no_unit(text) {
        return Ok(Quantity::of(1.0, Dimension::NUMBER));
    }
    let one = |unit: &str| parse_quantity(&format!("1 {unit}"));
    one(&spelt(text)).or_else(|_| one(text))
}

/// What numbers in the unit of which this is `one` become in SI units; `None` where it is of another dimension.
pub(crate) fn scale_of(one: Quantity, expected: Dimension) -> Option<Scale> {
    let one = one.meant(expected);
    if one.dimension != Some(expected) {
        return None;
    }
    Some(match (one.is_celsius, one.angle) {
        (true, _) => Scale { factor: 1.0, offset: one.value - 1.0 },
        // Where a frequency is asked for, an angular one is 2π times as much.
        (false, 1) if expected == Dimension::FREQUENCY => {
            Scale { factor: one.value / TAU, offset: 0.0 }
        }
        _ => Scale { factor: one.value, offset: 0.0 },
    })
}

#[cfg(test)]
mod tests;
