//! What can be wrong with a file of numbers, in words.

use thiserror::Error;

use crate::{diagnostics::fault_help::comma_help, units::UnitError};

/// A file may have so many rows of numbers.
pub(crate) const MOST_ROWS: usize = 1_000_000;

/// Why a file is no table of values over time.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum CsvFault {
    /// There is no row of numbers.
    #[error("`{path}` has no row of numbers")]
    Empty { path: String },
    /// There is but one column.
    #[error("the file has one column; a table has at least two, time and value")]
    OneColumn,
    /// There are several columns, and no word on which are meant.
    #[error("the file has {count} columns, and nothing says which are time and value")]
    WhichColumns { count: usize },
    /// There is no such column.
    #[error("there is no column {wanted}: the file has {count}")]
    NoColumn {
        /// The column, counted from 1.
        wanted: String,
        count: usize,
    },
    /// A row has more fields than the first line.
    #[error("this row has {found} fields, but the first line has {first}")]
    Uneven { found: usize, first: usize },
    /// A cell is empty.
    #[error("a number is missing here")]
    EmptyCell,
    /// A cell is no number.
    #[error("`{text}` is not a number")]
    NoNumber { text: String },
    /// A cell is a number that cannot be read.
    #[error("{0}")]
    Unreadable(UnitError),
    /// A cell is a number with a unit.
    #[error("`{text}` has a unit; the numbers of a file have none of their own")]
    UnitInCell { text: String },
    /// A time before the one of the row above.
    #[error("the time {found} stands after {before}: times never fall")]
    OutOfOrder { found: String, before: String },
    /// More rows than a table may have.
    #[error("the file has more than {MOST_ROWS} rows")]
    TooManyRows,
    /// Header and scene give different units.
    #[error("the header of the file says `{header}`, but `{given}` is given here")]
    Contradiction { header: String, given: String },
}

impl CsvFault {
    /// How to put it right, where that can be said.
    pub(crate) fn help(&self) -> Option<String> {
        let help = match self {
            Self::OneColumn => "columns are separated by commas, semicolons or tabs",
            Self::WhichColumns { .. } => {
                "write `table = { file = \"…\", columns = [1, 2] }`, or names of the header in place \
                 of the numbers"
            }
            Self::Uneven { .. } => {
                "decimals are written with a point, and nothing stands between thousands"
            }
            Self::Unreadable(UnitError::DecimalComma { text }) => {
                return Some(comma_help(text, "`"));
            }
            Self::Unreadable(UnitError::Separated { joined, .. }) => {
                return Some(format!("write `{joined}`"));
            }
            Self::NoNumber { .. } | Self::EmptyCell | Self::Unreadable(_) => {
                "a cell holds one number; a line that begins with `#` is left out"
            }
            Self::UnitInCell { .. } => {
                "write the units into a header line, for example `time [ms], force [kN]`"
            }
            Self::OutOfOrder { .. } => {
                "sort the rows by time; two rows of the same time are a jump"
            }
            Self::TooManyRows => "leave out rows that lie on the line between their neighbours",
            Self::Contradiction { .. } => "leave `units` out, or correct one of the two",
            Self::Empty { .. } | Self::NoColumn { .. } => return None,
        };
        Some(help.to_owned())
    }
}
