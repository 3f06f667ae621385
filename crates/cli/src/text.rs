//! Tables and paragraphs as text.

use dashpot_plot::Table;
use std::fmt::Write as _;

/// Blanks between columns.
const GAP: usize = 2;

/// The table as lines: its heading and its header, if any, and its rows; numbers are set to the
/// right.
pub(crate) fn table(table: &Table) -> (String, Vec<String>) {
    let count = table.rows.iter().map(Vec::len).fold(table.header.len(), usize::max);
    let cells = |column: usize| {
        let rows = table.rows.iter().filter_map(move |row| row.get(column));
        rows.chain(table.header.get(column))
    };
    let widths: Vec<usize> = (0..count)
        .map(|column| cells(column).map(|cell| columns(cell)).max().unwrap_or(0))
        .collect();
    let right: Vec<bool> = (0..count).map(|column| is_numeric(table, column)).collect();
    let line = |row: &Vec<String>| {
        let mut text = String::new();
        for (column, cell) in row.iter().enumerate() {
            let blanks = " ".repeat(widths[column] - columns(cell));
            let gap = " ".repeat(if column == 0 { 0 } else { GAP });
            let (left, after) =
                if right[column] { (blanks.as_str(), "") } else { ("", blanks.as_str()) };
            let _ = write!(text, "{gap}{left}{cell}{after}");
        }
        text.trim_end().to_owned()
    };
    (line(&table.header), table.rows.iter().map(line).collect())
}

/// Columns that the table takes as text.
pub(crate) fn width(table: &Table) -> usize {
    let (header, rows) = self::table(table);
    rows.iter().chain([&header]).map(|line| columns(line)).max().unwrap_or(0)
}

/// `text` broken at blanks into lines of at most `width` columns.
pub(crate) fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let last = lines.len() - 1;
        if lines[last].is_empty() {
            lines[last].push_str(word);
        } else if columns(&lines[last]) + 1 + columns(word) <= width {
            lines[last] += " ";
            lines[last] += word;
        } else {
            lines.push(word.to_owned());
        }
    }
    lines
}

/// A label and a text beside it, wrapped; both indented by two columns.
pub(crate) fn labelled(label: &str, label_width: usize, text: &str, width: usize) -> String {
    let room = width.saturating_sub(label_width + 2 + GAP).max(20);
    let mut shown = String::new();
    for (at, line) in wrapped(text, room).iter().enumerate() {
        let label = if at == 0 { label } else { "" };
        let blanks = " ".repeat(label_width.saturating_sub(columns(label)) + GAP);
        shown += format!("  {label}{blanks}{line}").trim_end();
        shown.push('\n');
    }
    shown
}

/// Every line indented by two columns.
pub(crate) fn indented(text: &str) -> String {
    let line = |line: &str| if line.is_empty() { "\n".to_owned() } else { format!("  {line}\n") };
    text.lines().map(line).collect()
}

/// The columns that a text takes.
pub(crate) fn columns(text: &str) -> usize {
    text.chars().count()
}

fn is_numeric(table: &Table, column: usize) -> bool {
    let mut cells = table
        .rows
        .iter()
        .filter_map(|row| row.get(column))
        .filter(|cell| !cell.is_empty() && cell.as_str() != "–")
        .peekable();
    let is_number = |cell: &String| {
        let digits = cell.trim_start_matches(['-', '±', '<', ' ']);
        digits.starts_with(|first: char| first.is_ascii_digit())
    };
    column > 0 && cells.peek().is_some() && cells.all(is_number)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(rows: &[&[&str]]) -> Vec<Vec<String>> {
        rows.iter().map(|row| row.iter().map(|cell| (*cell).to_owned()).collect()).collect()
    }

    #[test]
    fn numbers_stand_to_the_right_and_words_to_the_left() {
        let header = ["measure", "exact", "unit"].map(str::to_owned).to_vec();
        let rows = rows(&[&["peak", "38.4", "kN"], &["contact", "–", "ms"]]);
        let (header, rows) = table(&Table { caption: String::new(), header, rows });
        assert_eq!(header, "measure  exact  unit");
        assert_eq!(rows, ["peak      38.4  kN", "contact      –  ms"]);
    }

    #[test]
    fn paragraphs_break_at_blanks() {
        assert_eq!(wrapped("one two three", 7), ["one two", "three"]);
        assert_eq!(labelled("a", 3, "b c", 80), "  a    b c\n");
        assert_eq!(indented("x\n\ny"), "  x\n\n  y\n");
    }
}
