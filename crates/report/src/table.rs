//! Tables of texts, and columns that are declared once.

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

/// What tells the cell of a row.
type Cell<'c, T> = Box<dyn Fn(&T) -> String + 'c>;

/// The columns of a table whose rows are values of one type, each declared once: its heading, and what of a row it shows.
///
/// # Examples
///
/// ```
/// use dashpot_report::Columns;
///
/// let columns = Columns::new().column("mass", |m: &f64| format!("{m} kg"));
/// let table = columns.column("weight", |m| format!("{} N", 10.0 * m)).table("Bodies", [1.0, 2.5]);
/// assert_eq!(table.rows[1], ["2.5 kg", "25 N"]);
/// ```
pub struct Columns<'c, T> {
    columns: Vec<(String, Cell<'c, T>)>,
}

impl<'c, T> Columns<'c, T> {
    /// None yet.
    #[expect(
        clippy::new_without_default,
        reason = "columns without a column are no value to start from"
    )]
    pub fn new() -> Self {
        Self { columns: Vec::new() }
    }

    /// One more column.
    #[must_use]
    pub fn column(mut self, heading: impl Into<String>, cell: impl Fn(&T) -> String + 'c) -> Self {
        self.columns.push((heading.into(), Box::new(cell)));
        self
    }

    /// The table of these rows.
    pub fn table(&self, caption: impl Into<String>, rows: impl IntoIterator<Item = T>) -> Table {
        let row = |row: T| self.columns.iter().map(|(_, cell)| cell(&row)).collect();
        let header = self.columns.iter().map(|column| column.0.as_str());
        Table::new(caption, header, rows.into_iter().map(row))
    }
}
