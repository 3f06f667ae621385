//! What can be wrong with a table of numbers, in words.

use std::{fmt, mem, ops::Range};

use dashpot_network::parameters::Dimension;
use dashpot_units::UnitError;
use thiserror::Error;

use crate::{diagnostics::fault_help::comma_help, quantities::words::described};

/// A table may have so many rows of numbers.
pub(crate) const MOST_ROWS: usize = 1_000_000;

/// What is wrong with a table, and where.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("line {line}{}: {fault}{}", .column.as_ref().map_or_else(String::new, |own| format!(", column `{own}`")), .likewise.as_ref().map_or_else(String::new, |own| format!("; {own}")))]
pub struct TableError {
    /// The line, from 1.
    pub line: usize,
    /// Name of the column, or its number from 1, where it is about one.
    pub column: Option<String>,
    /// What is wrong.
    pub fault: Box<TableFault>,
    /// The bytes of the text that it is about.
    pub span: Range<usize>,
    /// The further lines with the same fault in the same column.
    pub likewise: Option<Likewise>,
}

/// Further lines with a fault.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Likewise {
    /// The first ones, from 1.
    pub lines: Vec<usize>,
    /// How many there are in all, one or more.
    pub count: usize,
}

/// So many lines are named.
const NAMED: usize = 3;

impl Likewise {
    pub(crate) fn add(&mut self, line: usize) {
        if self.lines.len() < NAMED {
            self.lines.push(line);
        }
        self.count += 1;
    }
}

impl fmt::Display for Likewise {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lines = self.lines.iter().map(usize::to_string).collect::<Vec<_>>().join(", ");
        let word = if self.count == 1 { "line" } else { "lines" };
        write!(f, "likewise in {word} {lines}")?;
        match self.count - self.lines.len() {
            0 => Ok(()),
            more => write!(f, " and {more} more"),
        }
    }
}

impl TableError {
    /// A fault at the bytes `span` of `text`.
    pub(crate) fn new(text: &str, span: Range<usize>, fault: TableFault) -> Self {
        let line = 1 + text.get(..span.start).map_or(0, |before| before.matches('\n').count());
        Self { line, column: None, fault: Box::new(fault), span, likewise: None }
    }

    /// The same, about a column.
    pub(crate) fn in_column(self, name: String) -> Self {
        Self { column: Some(name), ..self }
    }

    /// Whether it is the same kind of fault in the same column.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        mem::discriminant(&*self.fault) == mem::discriminant(&*other.fault)
            && self.column == other.column
    }

    /// How to put it right, where that can be said.
    pub fn help(&self) -> Option<String> {
        self.fault.help()
    }
}

/// Why a text is no table of numbers, or a column none of what is wanted.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum TableFault {
    /// There is no row of numbers.
    #[error("there is no row of numbers in it")]
    Empty,
    /// There is but one column.
    #[error("the file has one column; a table has at least two")]
    OneColumn,
    /// There are several columns, and no word on which are meant.
    #[error("the file has {count} columns, and nothing says which are {wanted}")]
    WhichColumns { count: usize, wanted: String, names: Vec<String> },
    /// There is no such column.
    #[error("there is no column {wanted}: the file has {count}")]
    NoColumn {
        /// The column, counted from 1.
        wanted: String,
        count: usize,
    },
    /// Several columns have the name.
    #[error("{count} columns are named `{name}`")]
    SharedName { name: String, count: usize },
    /// A row has more fields than the header or the first row.
    #[error("this row has {found} fields, but the first line of the table has {first}")]
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
    /// A point among decimal commas.
    #[error("`{text}` has a point, but the decimals of this file are written with a comma")]
    PointAmongCommas { text: String },
    /// Marks between thousands.
    #[error("`{text}` has marks between thousands, which are not read")]
    Thousands { text: String },
    /// A comma that may stand before decimals, or between thousands.
    #[error("the comma in `{text}` may stand before decimals or between thousands")]
    CommaOrThousands { text: String },
    /// A comma that may stand before decimals, or between columns.
    #[error("`{text}` may be one number with a decimal comma, or two columns")]
    CommaOrColumns { text: String },
    /// A unit of a column that cannot be read.
    #[error("{0}")]
    BadUnit(UnitError),
    /// A unit of another dimension.
    #[error("`{text}` is {}; {} is expected here", .found.map_or_else(|| "no unit".to_owned(), described), described(*.expected))]
    WrongDimension { text: String, found: Option<Dimension>, expected: Dimension },
    /// A time before the one of the row above.
    #[error("the time {found} stands after {before}: times never fall")]
    OutOfOrder { found: String, before: String },
    /// Forces or stresses of the other sign.
    #[error("the largest value of `{curve}` is negative; compression is positive here")]
    Negative { curve: &'static str },
    /// A curve of one branch that goes back.
    #[error(
        "the deformation of `{curve}` turns back after this row, and goes on; the law has one branch"
    )]
    TurnsBack { curve: &'static str },
    /// A record of more than one cycle.
    #[error("a second cycle begins here; a record is loaded and unloaded once")]
    SecondCycle,
    /// A record without unloading.
    #[error("the record ends here and never turns back: it has no unloading")]
    NoUnloading,
    /// Rows of which no curve can be made.
    #[error("no curve of `{curve}` can be made of these rows and those of loading")]
    NoCurve { curve: &'static str },
    /// More rows than a table may have.
    #[error("the file has more than {MOST_ROWS} rows")]
    TooManyRows,
    /// Header and scene give different units.
    #[error("the header of the file says `{header}`, but `{given}` is given here")]
    Contradiction { header: String, given: String },
}

impl TableFault {
    /// How to put it right, where that can be said.
    pub(crate) fn help(&self) -> Option<String> {
        let help = match self {
            Self::OneColumn => "columns are separated by semicolons, tabs, commas or spaces",
            Self::WhichColumns { names, .. } => {
                let names = names.join(", ");
                return Some(format!(
                    "write `columns = [1, 2]` beside `file`, or names in place of the numbers: {names}"
                ));
            }
            Self::SharedName { .. } => "count the column from 1 instead, as in `columns = [1, 4]`",
            Self::Uneven { .. } => {
                "decimals are written with a point where commas separate columns, and nothing stands \
                 between thousands; a line that begins with `#` is left out"
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
            Self::PointAmongCommas { text } => {
                let [joined, comma] = [text.replace('.', ""), text.replacen('.', ",", 1)];
                return Some(format!(
                    "write `{comma}`, or `{joined}` where the point stands between thousands"
                ));
            }
            Self::Thousands { text } => {
                let last = text.rfind([',', '.']).unwrap_or(0);
                let joined: String = (text.char_indices())
                    .filter(|&(at, own)| at == last || !matches!(own, ',' | '.'))
                    .map(|(_, own)| own)
                    .collect();
                return Some(format!("write `{joined}`, in all rows of the file"));
            }
            Self::CommaOrThousands { text } => {
                let [joined, longer] = [text.replace(',', ""), format!("{text}0")];
                return Some(format!(
                    "write `{joined}` where it stands between thousands, or `{longer}` where it stands \
                     before decimals; one number that tells is enough"
                ));
            }
            Self::CommaOrColumns { text } => {
                let point = text.replace(',', ".");
                return Some(format!(
                    "write `{point}`, or `\"{text}\"` between quotes, where it is one number; names above them, as in \
                     `time [s],force [N]`, say that these are two columns"
                ));
            }
            Self::BadUnit(_) | Self::WrongDimension { .. } => {
                "write a unit such as `[kN]` into the header, or `units = [\"mm\", \"kN\"]` beside `file`"
            }
            Self::OutOfOrder { .. } => {
                "sort the rows by time; two rows of the same time are a jump"
            }
            Self::TooManyRows => "leave out rows that lie on the line between their neighbours",
            Self::Negative { .. } => "turn the signs of both columns in the file",
            Self::TurnsBack { .. } => {
                "cut the file behind this row, or to one cycle: then this law takes the loading, and \
                 `hysteretic-table` both branches"
            }
            Self::SecondCycle => "cut the file to the cycle that is meant",
            Self::NoUnloading => "use `table-spring`, or a record that goes back",
            Self::NoCurve { .. } => "look at the loading: it needs two rows, and forces that rise",
            Self::Contradiction { .. } => "leave `units` out, or correct one of the two",
            Self::Empty | Self::NoColumn { .. } => return None,
        };
        Some(help.to_owned())
    }
}
