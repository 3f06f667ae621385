//! The lines before a table that are no part of it.

use std::fmt;

use super::DataTable;

/// Lines that are left out, with their numbers from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LeftOut {
    /// The first one.
    pub first: usize,
    /// The last one.
    pub last: usize,
}

impl LeftOut {
    /// Those of a table, where there are any.
    pub fn of(table: &DataTable<'_>) -> Option<Self> {
        let mut lines = table.skipped().map(|own| own.0);
        let first = lines.next()?;
        Some(Self { first, last: lines.last().unwrap_or(first) })
    }
}

impl fmt::Display for LeftOut {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { first, last } = self;
        if first == last {
            return write!(f, "line {first} is no part of the table and left out");
        }
        write!(f, "lines {first} to {last} are no part of the table and left out")
    }
}
