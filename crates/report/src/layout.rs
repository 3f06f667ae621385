//! Tables and paragraphs as text.

use std::fmt::Write as _;

use crate::Table;

/// Columns of a terminal's text.
pub const WIDTH: usize = 80;
/// Blanks between columns.
const GAP: usize = 2;
/// Columns that a wrapped column has at least.
const LEAST_ROOM: usize = 20;

/// The table as lines: its header, if any, and its rows; numbers are set to the right. Headings of several
/// lines stand on the rows.
pub fn table(table: &Table) -> (String, Vec<String>) {
    let count = table.rows.iter().map(Vec::len).fold(table.header.len(), usize::max);
    let cells = |column: usize| {
        let rows = table.rows.iter().filter_map(move |row| row.get(column));
        rows.chain(table.header.get(column))
    };
    let widths: Vec<usize> = (0..count)
        .map(|column| cells(column).flat_map(|cell| cell.lines()).map(columns).max().unwrap_or(0))
        .collect();
    let right: Vec<bool> =
        (0..count).map(|column| column > 0 && table.is_numeric(column)).collect();
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
    let height = table.header.iter().map(|cell| cell.lines().count()).max().unwrap_or(0);
    let header = (0..height.max(1)).map(|at| {
        let part = |cell: &String| {
            let above = height - cell.lines().count();
            at.checked_sub(above).and_then(|at| cell.lines().nth(at)).unwrap_or("").to_owned()
        };
        line(&table.header.iter().map(part).collect())
    });
    let header: Vec<String> = header.collect();
    (header.join("\n"), table.rows.iter().map(line).collect())
}

/// Columns that the table takes as text.
pub fn width(table: &Table) -> usize {
    let (header, rows) = self::table(table);
    header.lines().chain(rows.iter().map(String::as_str)).map(columns).max().unwrap_or(0)
}

/// `text` broken at blanks into lines of at most `width` columns, but not at those that are no-break spaces.
pub fn wrapped(text: &str, width: usize) -> Vec<String> {
    wrapped_after(text, width, width)
}

/// The same with a first line of its own width.
fn wrapped_after(text: &str, first: usize, others: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_ascii_whitespace() {
        let last = lines.len() - 1;
        let width = if last == 0 { first } else { others };
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

/// `text` as lines of at most `width` columns, all but the first indented by two.
pub fn hanging(text: &str, width: usize) -> String {
    wrapped_after(text, width, width.saturating_sub(GAP)).join("\n  ")
}

/// A line in lines of at most the width of a terminal, the first with its own indent.
pub fn indented_line(line: &str) -> String {
    let text = line.trim_start();
    let indent = line.len() - text.len();
    line[..indent].to_owned() + &hanging(text, WIDTH - indent.min(WIDTH / 2))
}

/// The table as tables of at most `width` columns, where its first columns, `lead` of them, stand before each part of
/// the others; where they take more than half of the width, the numbers of the rows do.
pub fn side_by_side(table: &Table, lead: usize, width: usize) -> Vec<Table> {
    if self::width(table) <= width {
        return vec![table.clone()];
    }
    let first = |row: &Vec<String>| row[..row.len().min(lead)].to_vec();
    let leading = Table {
        header: first(&table.header),
        rows: table.rows.iter().map(first).collect(),
        ..Table::default()
    };
    if lead > 1 && 2 * self::width(&leading) > width {
        return side_by_side(&numbered(table), 1, width);
    }
    let part = |columns: &[usize]| {
        let pick = |row: &Vec<String>| -> Vec<String> {
            let all = (0..lead).chain(columns.iter().copied());
            all.filter_map(|column| row.get(column).cloned()).collect()
        };
        let rows = table.rows.iter().map(pick).collect();
        Table { caption: table.caption.clone(), header: pick(&table.header), rows }
    };
    let count = table.rows.iter().map(Vec::len).fold(table.header.len(), usize::max);
    let mut parts: Vec<Vec<usize>> = vec![Vec::new()];
    for column in lead..count {
        let last = parts.len() - 1;
        let mut with = parts[last].clone();
        with.push(column);
        if with.len() > 1 && self::width(&part(&with)) > width {
            parts.push(vec![column]);
        } else {
            parts[last] = with;
        }
    }
    parts.iter().map(|columns| part(columns)).collect()
}

/// The table with the numbers of its rows before them.
fn numbered(table: &Table) -> Table {
    let before = |number: String, row: &Vec<String>| {
        std::iter::once(number).chain(row.iter().cloned()).collect()
    };
    let rows = table.rows.iter().enumerate().map(|(at, row)| before((at + 1).to_string(), row));
    Table {
        caption: table.caption.clone(),
        header: before("row".to_owned(), &table.header),
        rows: rows.collect(),
    }
}

/// Header and rows of a table as lines of at most `width` columns: where they do not fit, the last column is wrapped.
pub fn fitted(table: &Table, width: usize) -> (String, Vec<String>) {
    let count = table.rows.iter().map(Vec::len).max().unwrap_or(0);
    if count < 2 || self::width(table) <= width {
        return self::table(table);
    }
    let last = count - 1;
    let firsts = |row: &Vec<String>| row[..row.len().min(last)].to_vec();
    let leading = Table {
        header: firsts(&table.header),
        rows: table.rows.iter().map(firsts).collect(),
        ..Table::default()
    };
    let lead = self::width(&leading) + GAP;
    let room = width.saturating_sub(lead).max(LEAST_ROOM);
    let mut rows = Vec::new();
    for row in &table.rows {
        let Some(text) = row.get(last).filter(|own| !own.is_empty()) else {
            rows.push(row.clone());
            continue;
        };
        for (at, line) in wrapped(text, room).into_iter().enumerate() {
            let mut own = if at == 0 { row[..last].to_vec() } else { vec![String::new(); last] };
            own.push(line);
            rows.push(own);
        }
    }
    self::table(&Table { header: table.header.clone(), rows, ..Table::default() })
}

/// A label and a text beside it, wrapped; both indented by two columns.
pub fn labelled(label: &str, label_width: usize, text: &str, width: usize) -> String {
    let room = width.saturating_sub(label_width + 2 + GAP).max(LEAST_ROOM);
    let mut shown = String::new();
    for (at, line) in wrapped(text, room).iter().enumerate() {
        let label = if at == 0 { label } else { "" };
        let blanks = " ".repeat(label_width.saturating_sub(columns(label)) + GAP);
        shown += format!("  {label}{blanks}{line}").trim_end();
        shown.push('\n');
    }
    shown
}

/// A text with a capital first letter.
pub fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// Every line indented by two columns.
pub fn indented(text: &str) -> String {
    let line = |line: &str| if line.is_empty() { "\n".to_owned() } else { format!("  {line}\n") };
    text.lines().map(line).collect()
}

/// The columns that a text takes.
pub fn columns(text: &str) -> usize {
    text.chars().count()
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
        assert_eq!(hanging("one two three four", 7), "one two\n  three\n  four");
    }

    #[test]
    fn columns_that_do_not_fit_stand_below() {
        let header = ["", "one", "two", "three"].map(str::to_owned).to_vec();
        let rows = rows(&[&["a", "1", "2", "3"], &["b", "4", "5", "6"]]);
        let whole = Table { caption: "map".to_owned(), header, rows };
        assert_eq!(side_by_side(&whole, 1, 80), std::slice::from_ref(&whole));
        let parts = side_by_side(&whole, 1, 11);
        let shown: Vec<_> = parts.iter().map(table).collect();
        assert_eq!(shown[0].0, "   one  two");
        assert_eq!(shown[1], ("   three".to_owned(), vec!["a      3".into(), "b      6".into()]));
    }

    #[test]
    fn each_part_of_a_table_begins_with_what_leads_its_rows() {
        let header = ["material", "speed", "force", "depth"].map(str::to_owned).to_vec();
        let rows = rows(&[&["eps", "5", "1.5", "2.5"], &["epp", "6", "3.5", "4.5"]]);
        let whole = Table { caption: String::new(), header, rows };
        let headers = |width: usize| -> Vec<String> {
            side_by_side(&whole, 2, width).iter().map(|own| table(own).0).collect()
        };
        assert_eq!(headers(29), ["material  speed  force  depth"]);
        // The lead takes more than half of this.
        let parts = side_by_side(&whole, 2, 28);
        let shown: Vec<_> = parts.iter().map(table).collect();
        assert_eq!(shown[0].0, "row  material  speed  force");
        assert_eq!(shown[1].1, ["1      2.5", "2      4.5"]);
        let wide = Table {
            header: [&whole.header[..], &whole.header[2..]].concat(),
            rows: whole.rows.iter().map(|row| [&row[..], &row[2..]].concat()).collect(),
            ..Table::default()
        };
        let shown: Vec<_> = side_by_side(&wide, 2, 36).iter().map(|own| table(own).0).collect();
        assert_eq!(shown, ["material  speed  force  depth  force", "material  speed  depth"]);
    }

    #[test]
    fn only_the_last_column_of_a_wide_table_is_wrapped() {
        let rows =
            rows(&[&["state", "position of a joint inside of pad"], &["algebraic", "force"]]);
        let table = Table { rows, ..Table::default() };
        let wide = ["state      position of a joint inside of pad", "algebraic  force"];
        assert_eq!(fitted(&table, 80).1, wide);
        let narrow =
            ["state      position of a joint", "           inside of pad", "algebraic  force"];
        assert_eq!(fitted(&table, 31).1, narrow);
    }
}
