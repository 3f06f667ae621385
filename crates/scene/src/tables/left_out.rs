//! The lines before and behind a table that are no part of it.

use std::fmt;

use super::DataTable;

/// Lines that are left out, with their numbers from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LeftOut {
    /// The first and the last one before the table.
    pub before: Option<[usize; 2]>,
    /// Those behind it.
    pub behind: Option<[usize; 2]>,
}

impl LeftOut {
    /// Those of a table, where there are any.
    pub fn of(table: &DataTable<'_>) -> Option<Self> {
        let mut lines = table.skipped().map(|own| own.0);
        let before = lines.next().map(|first| [first, lines.last().unwrap_or(first)]);
        let behind = table.behind();
        before.or(behind).map(|_| Self { before, behind })
    }
}

impl fmt::Display for LeftOut {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let span = |[first, last]: [usize; 2]| {
            if first == last { format!("line {first}") } else { format!("lines {first} to {last}") }
        };
        let parts: Vec<String> =
            [self.before, self.behind].into_iter().flatten().map(span).collect();
        let is_one = |own: [usize; 2]| own[0] == own[1];
        let is_single = parts.len() == 1 && self.before.or(self.behind).is_some_and(is_one);
        let verb = if is_single { "is" } else { "are" };
        write!(f, "{} {verb} no part of the table and left out", parts.join(" and "))
    }
}
