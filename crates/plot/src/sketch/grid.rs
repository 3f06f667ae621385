//! A grid of characters on which lines join by themselves.

use super::SketchTree;
use super::blocks::Pen;
use super::order::Extent;
use crate::text_metrics::columns_of;

const LEFT: usize = 1;
const RIGHT: usize = 2;
const UP: usize = 4;
const DOWN: usize = 8;

/// Line characters by the sides at which they connect (left 1, right 2, up 4, down 8).
const LINES: [char; 16] =
    [' ', '─', '─', '─', '│', '┘', '└', '┴', '│', '┐', '┌', '┬', '│', '┤', '├', '┼'];

#[derive(Debug, Clone, Default)]
struct Cell {
    sides: usize,
    /// Wins over lines; empty behind the first half of a wide character.
    text: Option<String>,
}

/// Characters in rows.
#[derive(Debug, Clone, Default)]
pub(super) struct Grid {
    rows: Vec<Vec<Cell>>,
}

impl Grid {
    fn cell(&mut self, (x, y): (f64, f64)) -> &mut Cell {
        let (column, row) = (index(x), index(y));
        if self.rows.len() <= row {
            self.rows.resize(row + 1, Vec::new());
        }
        let cells = &mut self.rows[row];
        if cells.len() <= column {
            cells.resize(column + 1, Cell::default());
        }
        &mut cells[column]
    }

    /// A straight horizontal or vertical line, both ends included.
    pub(super) fn line(&mut self, from: (f64, f64), to: (f64, f64)) {
        let (horizontal, start, end) = if (from.1 - to.1).abs() < 0.5 {
            (true, from.0.min(to.0), from.0.max(to.0))
        } else {
            (false, from.1.min(to.1), from.1.max(to.1))
        };
        let (backward, forward) = if horizontal { (LEFT, RIGHT) } else { (UP, DOWN) };
        let mut place = start;
        while place <= end {
            let at = if horizontal { (place, from.1) } else { (from.0, place) };
            let sides =
                if place > start { backward } else { 0 } | if place < end { forward } else { 0 };
            self.cell(at).sides |= sides;
            place += 1.0;
        }
    }

    /// The frame of a box.
    pub(super) fn frame(&mut self, (x, y): (f64, f64), (width, height): (f64, f64)) {
        let (right, bottom) = (x + width - 1.0, y + height - 1.0);
        self.line((x, y), (right, y));
        self.line((x, bottom), (right, bottom));
        self.line((x, y), (x, bottom));
        self.line((right, y), (right, bottom));
    }

    /// Text from a cell on to the right.
    pub(super) fn text(&mut self, (x, y): (f64, f64), text: &str) {
        let mut column = x;
        for c in text.chars() {
            match columns_of(c) {
                0 => {
                    let before = self.cell(((column - 1.0).max(0.0), y));
                    before.text.get_or_insert_default().push(c);
                }
                wide => {
                    self.cell((column, y)).text = Some(c.to_string());
                    column += 1.0;
                    if wide == 2 {
                        self.cell((column, y)).text = Some(String::new());
                        column += 1.0;
                    }
                }
            }
        }
    }

    /// The rows as lines without blanks at their ends.
    pub(super) fn print(&self) -> String {
        let mut text = String::new();
        for cells in &self.rows {
            let mut line = String::new();
            for cell in cells {
                match &cell.text {
                    Some(text) => line += text,
                    None => line.push(LINES[cell.sides]),
                }
            }
            text += line.trim_end();
            text.push('\n');
        }
        text
    }
}

impl Pen for Grid {
    fn wire(&mut self, from: (f64, f64), to: (f64, f64)) {
        self.line(from, to);
    }

    fn symbol(&mut self, leaf: &SketchTree, (x, y): (f64, f64), extent: Extent) {
        let (symbol, label) = super::text::symbol(leaf);
        if !matches!(leaf, SketchTree::Parallel(_)) {
            self.line((x, y), (x + extent.width - 1.0, y));
        }
        self.text((centred(x, extent.width, &symbol), y), &symbol);
        self.text((centred(x, extent.width, label), y - 1.0), label);
    }
}

/// First column of a text centred in `width` columns from `x` on.
pub(super) fn centred(x: f64, width: f64, text: &str) -> f64 {
    x + (0.5 * (width - super::text::columns(text))).floor().max(0.0)
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "places in a drawing are small and the maximum makes them positive"
)]
fn index(place: f64) -> usize {
    place.max(0.0).round() as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_join_where_they_meet() {
        let mut grid = Grid::default();
        grid.frame((0.0, 0.0), (4.0, 3.0));
        grid.line((3.0, 1.0), (5.0, 1.0));
        grid.line((5.0, 0.0), (5.0, 2.0));
        assert_eq!(grid.print(), "┌──┐ │\n│  ├─┤\n└──┘ │\n");
    }

    #[test]
    fn wide_and_combining_characters_keep_the_columns() {
        let mut grid = Grid::default();
        grid.text((0.0, 0.0), "頭o\u{308}");
        grid.line((3.0, 0.0), (4.0, 0.0));
        assert_eq!(grid.print(), "頭o\u{308}──\n");
    }
}
