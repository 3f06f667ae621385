//! Designs from a table: each row is one, each column a number or a word of the scene.

use std::mem;

use dashpot_units::{UnitError, parse_quantity};
use thiserror::Error;

use super::variation::Variation;
use crate::tables::{DataTable, TableError, TableFault, is_no_unit};

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
    /// A row has a field without anything in it.
    #[error("line {line} has an empty field: each row has a value in every column")]
    EmptyField { line: usize },
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
    /// A word is missing in a column of words.
    #[error("line {line}, column `{column}`: a word is missing here")]
    EmptyWord { line: usize, column: String },
    /// More rows than a table may have.
    #[error("the table has more than {MOST} rows")]
    TooMany,
}

impl ListedFault {
    /// What to write.
    pub fn help(&self) -> String {
        match self {
            Self::Unreadable(error) if error.help().is_some() => error.help().unwrap_or_default(),
            Self::Uneven { .. }
            | Self::Unreadable(_)
            | Self::EmptyWord { .. }
            | Self::EmptyField { .. } => {
                "numbers are bare, their unit stands in the first line, such as `liner.thickness [mm]`; a column of \
                 words, such as `liner.material`, has one in each row"
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

/// The designs of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Listed {
    /// Its columns.
    pub columns: Vec<Variation>,
    /// The line of each design in the table, from 1.
    pub lines: Vec<usize>,
}

impl Variation {
    /// The columns of a table, `head.velocity [m/s],liner.material` and rows of numbers and words below: in place of
    /// all combinations, they take the values of one row together. A column without any number is one of words. All
    /// else is as in other tables.
    ///
    /// # Errors
    ///
    /// What is wrong with the table, with its line and column.
    pub fn listed(text: &str) -> Result<Listed, ListedFault> {
        let table = DataTable::read(text).map_err(|error| match *error.fault {
            TableFault::Empty => ListedFault::Empty,
            _ => ListedFault::Unreadable(error),
        })?;
        if !table.has_header() {
            return Err(empty_field(text).unwrap_or(ListedFault::NoHeader));
        }
        let mut columns = Vec::with_capacity(table.columns());
        for at in 0..table.columns() {
            let heading = table.heading(at);
            if heading.name.is_empty() {
                return Err(ListedFault::Nameless { column: at + 1 });
            }
            let unit = heading.unit.filter(|unit| !is_no_unit(unit)).unwrap_or_default();
            let unit = unit.to_owned();
            columns.push(Self { unit, ..Self::of_words(heading.name, Vec::new()) });
        }
        let of_words = columns_of_words(&table, &columns);
        let lines = table.lines();
        for ((at, fields), &line) in table.rows().zip(&lines) {
            if fields.len() != columns.len() {
                let (found, wanted) = (fields.len(), columns.len());
                return Err(ListedFault::Uneven { line, found, wanted });
            }
            for (column, (own, field)) in columns.iter_mut().zip(&fields).enumerate() {
                if of_words[column] {
                    if field.text.is_empty() {
                        return Err(ListedFault::EmptyWord { line, column: own.name.clone() });
                    }
                    own.words.push(field.text.to_owned());
                    continue;
                }
                let number = table.number(field).map_err(|fault| {
                    let span = at..field.span().end;
                    ListedFault::Unreadable(table.error(span, column, fault))
                })?;
                own.numbers.push(number);
            }
        }
        match lines.len() {
            0 => return Err(ListedFault::Empty),
            1..=MOST => {}
            _ => return Err(ListedFault::TooMany),
        }
        for own in &mut columns {
            if own.is_of_words() {
                *own = Self::of_words(&own.name, mem::take(&mut own.words));
                continue;
            }
            let quantity = |at: usize| {
                let error = |error| ListedFault::BadUnit { column: own.name.clone(), error };
                parse_quantity(&own.text(at)).map_err(error)
            };
            let dimension = quantity(0)?.dimension;
            let values = (0..own.numbers.len()).map(|at| quantity(at).map(|own| own.value));
            let values = values.collect::<Result<_, _>>()?;
            (own.dimension, own.values) = (dimension, values);
        }
        Ok(Listed { columns, lines })
    }
}

/// The first row with an empty field, which hides the header, where the first line is no row of numbers.
fn empty_field(text: &str) -> Option<ListedFault> {
    let mut lines = text.lines().zip(1..).filter(|own| !own.0.trim().is_empty());
    lines.next().filter(|own| own.0.contains(char::is_alphabetic))?;
    let has_gap = |own: &str| own.split([',', ';', '\t']).any(|own| own.trim().is_empty());
    lines.find(|own| has_gap(own.0)).map(|(_, line)| ListedFault::EmptyField { line })
}

/// Which columns are of words: those without a unit in which no field is a number or was meant as one.
fn columns_of_words(table: &DataTable<'_>, columns: &[Variation]) -> Vec<bool> {
    let mut of_words: Vec<bool> = columns.iter().map(|own| own.unit.is_empty()).collect();
    for (_, fields) in table.rows() {
        for (own, field) in of_words.iter_mut().zip(&fields) {
            *own &= !field.is_like_number();
        }
    }
    of_words
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
            let own = Variation::listed(text).unwrap().columns;
            let told: Vec<_> =
                own.iter().map(|own| (&*own.name, &*own.unit, &own.values[..])).collect();
            let right: [(_, _, &[f64]); 2] =
                [("head.mass", "kg", &[5.0, 4.5]), ("liner.thickness", "mm", &[0.02, 0.015])];
            assert_eq!(told, right, "{text:?}");
        }
    }

    #[test]
    fn columns_without_a_number_are_words() {
        let text = "Designs of spring\n\ndesign;liner.material;K [kN/m]\nA1;eps;1,5\n\nB 2;epp-30;2\nEnd\n";
        let Listed { columns, lines } = Variation::listed(text).unwrap();
        let told: Vec<_> = columns.iter().map(|own| (&*own.name, &own.words[..])).collect();
        let words = |own: &[&str]| own.iter().map(|own| (*own).to_owned()).collect::<Vec<_>>();
        let right = [
            ("design", words(&["A1", "B 2"])),
            ("liner.material", words(&["eps", "epp-30"])),
            ("K", Vec::new()),
        ];
        assert_eq!(told, right.each_ref().map(|own| (own.0, &own.1[..])));
        assert_eq!((&columns[2].values[..], &lines[..]), (&[1500.0, 2000.0][..], &[4, 6][..]));
        let words = Variation::listed("liner.material\neps\nepp\n").unwrap().columns;
        assert_eq!((words[0].words.len(), words[0].len()), (2, 2));
    }

    #[test]
    fn what_is_wrong_is_told_with_line_and_column() {
        for (text, told) in [
            ("", "the table has no row of numbers"),
            ("K [N/m]\n", "the table has no row of numbers"),
            ("5.5,20\n4,15\n", "the first line of the table names no numbers"),
            ("m [kg],K [kN/m]\n4,\n6,7\n", "line 2 has an empty field"),
            ("K [N/m],[mm]\n1,2\n", "column 2 of the table has no name"),
            ("K [N/mm2x]\n1\n", "column `K`: "),
            ("K,C\n1,2\n# no\n1\n", "line 4 has 1 fields, but the first line has 2"),
            ("K,C\n1,2\n1,2,3\n", "line 3 has 3 fields"),
            ("K,C\n1,2\n1,two\n", "line 3, column `C`: `two` is not a number"),
            ("K;C\n1;2,5\n2;1.5\n", "line 3, column `C`: `1.5` has a point, but"),
            ("K,C\n1,5 mm\n", "line 2, column `C`: `5 mm` has a unit"),
            ("m,C\neps,1\n,2\n", "line 3, column `m`: a word is missing here"),
        ] {
            let fault = Variation::listed(text).unwrap_err();
            assert!(fault.to_string().contains(told), "{text:?}: {fault}");
            assert!(!fault.help().is_empty());
        }
    }
}
