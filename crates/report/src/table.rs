//! Tables of texts.

/// A table of texts.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Table {
    /// Heading.
    pub caption: String,
    /// Column headings; empty for none.
    pub header: Vec<String>,
    /// Rows, which may be shorter than the header.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// A table with these column headings. A column in which nothing stands is left out, unless it is the first.
    pub fn new(
        caption: impl Into<String>,
        header: impl IntoIterator<Item: ToString>,
        rows: impl IntoIterator<Item = Vec<String>>,
    ) -> Self {
        let mut own = Self::plain(caption, rows);
        own.header = header.into_iter().map(|own| own.to_string()).collect();
        let is_filled =
            |row: &Vec<String>, at: usize| row.get(at).is_some_and(|cell| !cell.is_empty());
        for at in (1..own.header.len()).rev() {
            if own.rows.is_empty() || own.rows.iter().any(|row| is_filled(row, at)) {
                continue;
            }
            own.header.remove(at);
            own.rows.iter_mut().filter(|row| at < row.len()).for_each(|row| drop(row.remove(at)));
        }
        own
    }

    /// A table without headings.
    pub fn plain(caption: impl Into<String>, rows: impl IntoIterator<Item = Vec<String>>) -> Self {
        let rows = rows.into_iter().collect();
        Self { caption: caption.into(), header: Vec::new(), rows }
    }

    /// A table of one column without a heading.
    pub fn list(caption: impl Into<String>, lines: impl IntoIterator<Item = String>) -> Self {
        Self::plain(caption, lines.into_iter().map(|line| vec![line]))
    }

    /// Whether a column holds numbers only, which are set to the right.
    pub(crate) fn is_numeric(&self, column: usize) -> bool {
        let cells = self.rows.iter().filter_map(|row| row.get(column));
        let mut cells = cells.filter(|cell| !cell.is_empty() && cell.as_str() != "–").peekable();
        let is_number = |cell: &String| {
            let digits = cell.trim_start_matches(['-', '−', '+', '±', '<', '≤', ' ']);
            digits.starts_with(|first: char| first.is_ascii_digit())
        };
        cells.peek().is_some() && cells.all(is_number)
    }
}
