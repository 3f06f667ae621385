//! Designs from a table: each row is one, each column a number of the scene.

use thiserror::Error;

use super::variation::Variation;
use crate::{
    tables::{DataTable, TableError, TableFault, is_no_unit},
    units::{UnitError, parse_quantity},
};

/// A table has at most so many rows.
const MOST: usize = 1_000_000;

/// Why a text is no table of designs. Lines are counted from 1.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum ListedFault {
    /// There is no row of numbers.
    #[error("the table has no row of numbers")]
    Empty,
    /// The first line does not name the columns.
    #[error("the first line of the table names no numbers of the scene")]
    NoHeader,
    /// A column has no name.
    #[error("column {column} of the table has no name")]
    Nameless { column: usize },
    /// The unit of a column is none.
    #[error("column `{column}`: {error}")]
    BadUnit { column: String, error: UnitError },
    /// A row has more or fewer fields than the first line.
    #[error("line {line} has {found} fields, but the first line has {wanted}")]
    Uneven { line: usize, found: usize, wanted: usize },
    /// The table cannot be read.
    #[error("{0}")]
    Unreadable(TableError),
    /// More rows than a table may have.
    #[error("the table has more than {MOST} rows")]
    TooMany,
}

impl ListedFault {
    /// What to write.
    pub fn help(&self) -> String {
        match self {
            Self::Unreadable(error) if error.help().is_some() => error.help().unwrap_or_default(),
            Self::Uneven { .. } | Self::Unreadable(_) => {
                "numbers are bare, with a point for decimals; their unit stands in the first line, \
                 such as `liner.thickness [mm]`"
                    .to_owned()
            }
            _ => {
                "write the numbers' paths or names into the first line, with their units, such as \
                  `head.velocity [m/s],liner.thickness [mm]`, and one design into each line below"
                    .to_owned()
            }
        }
    }
}

impl Variation {
    /// The columns of a table, `head.velocity [m/s],liner.thickness [mm]` and rows of numbers below: in place of
    /// all combinations, they take the values of one row together. Columns are separated as in other tables, by
    /// commas, semicolons or tabs.
    ///
    /// # Errors
    ///
    /// What is wrong with the table, with its line and column.
    pub fn listed(text: &str) -> Result<Vec<Self>, ListedFault> {
        let table = DataTable::read(text).map_err(|error| match *error.fault {
            TableFault::Empty => ListedFault::Empty,
            _ => ListedFault::Unreadable(error),
        })?;
        if !table.has_header() {
            return Err(ListedFault::NoHeader);
        }
        let mut columns = Vec::with_capacity(table.columns());
        for at in 0..table.columns() {
            let heading = table.heading(at);
            if heading.name.is_empty() {
                return Err(ListedFault::Nameless { column: at + 1 });
            }
            let unit = heading.unit.filter(|unit| !is_no_unit(unit)).unwrap_or_default();
            columns.push(Self {
                name: heading.name.to_owned(),
                unit: unit.to_owned(),
                numbers: Vec::new(),
                values: Vec::new(),
                dimension: None,
                is_logarithmic: false,
                is_range: false,
                words: Vec::new(),
            });
        }
        for ((at, fields), line) in table.rows().zip(table.lines()) {
            if fields.len() != columns.len() {
                let (found, wanted) = (fields.len(), columns.len());
                return Err(ListedFault::Uneven { line, found, wanted });
            }
            for (column, (own, field)) in columns.iter_mut().zip(&fields).enumerate() {
                let number = table.number(field).map_err(|fault| {
                    let span = at..field.span().end;
                    ListedFault::Unreadable(table.error(span, column, fault))
                })?;
                own.numbers.push(number);
            }
            if columns[0].numbers.len() > MOST {
                return Err(ListedFault::TooMany);
            }
        }
        if columns[0].numbers.is_empty() {
            return Err(ListedFault::Empty);
        }
        for own in &mut columns {
            let quantity = |at: usize| {
                let error = |error| ListedFault::BadUnit { column: own.name.clone(), error };
                parse_quantity(&own.text(at)).map_err(error)
            };
            let dimension = quantity(0)?.dimension;
            let values = (0..own.numbers.len()).map(|at| quantity(at).map(|own| own.value));
            let values = values.collect::<Result<_, _>>()?;
            (own.dimension, own.values) = (dimension, values);
        }
        Ok(columns)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_designs_and_columns_are_numbers_with_units() {
        for text in [
            "head.mass [kg],liner.thickness [mm]\n5,20\n4.5,1.5e1\n",
            "# from the lab\n\"head.mass (kg)\";liner.thickness [mm]\n5;20\n\n4.5;15\n",
            "\u{feff}head.mass [kg]\tliner.thickness [mm]\r\n5\t20\r\n4.5\t15\r\n",
        ] {
            let own = Variation::listed(text).unwrap();
            let told: Vec<_> =
                own.iter().map(|own| (&*own.name, &*own.unit, &own.values[..])).collect();
            let right: [(_, _, &[f64]); 2] =
                [("head.mass", "kg", &[5.0, 4.5]), ("liner.thickness", "mm", &[0.02, 0.015])];
            assert_eq!(told, right, "{text:?}");
        }
    }

    #[test]
    fn what_is_wrong_is_told_with_line_and_column() {
        for (text, told) in [
            ("", "the table has no row of numbers"),
            ("K [N/m]\n", "the table has no row of numbers"),
            ("5,20\n4,15\n", "the first line of the table names no numbers"),
            ("K [N/m],[mm]\n1,2\n", "column 2 of the table has no name"),
            ("K [N/mm2x]\n1\n", "column `K`: "),
            ("K,C\n1,2\n# no\n1\n", "line 4 has 1 fields, but the first line has 2"),
            ("K,C\n1,2\n1,2,3\n", "line 3 has 3 fields"),
            ("K,C\n1,2\n1,two\n", "line 3, column `C`: `two` is not a number"),
            ("K;C\n1;2,5\n2;1.5\n", "line 3, column `C`: `1.5` has a point, but"),
            ("K,C\n1,5 mm\n", "line 2, column `C`: `5 mm` has a unit"),
        ] {
            let fault = Variation::listed(text).unwrap_err();
            assert!(fault.to_string().contains(told), "{text:?}: {fault}");
            assert!(!fault.help().is_empty());
        }
    }
}
