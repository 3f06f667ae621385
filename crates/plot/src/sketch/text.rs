//! A network as text for a terminal, in a grid of characters on which lines join by themselves.

use std::fmt::Write as _;

use super::{
    Sketch, SketchKind, SketchLink, SketchNode, SketchTree,
    blocks::{Pen, Sizes},
    layout::{Metrics, Placed, plan},
    list::{self, gravity, lines_and_loads},
    order::Extent,
    symbols::symbol_of,
};
use crate::text_metrics::{self, columns_of, one_line};

/// Elements or nodes beyond which a list is clearer.
const MOST: usize = 30;

impl Sketch {
    /// The network as lines of at most `width` columns (80 is usual; at least 40).
    ///
    /// A chain that is too wide goes on in further rows; any other network that is too wide, and one of more than
    /// 30 elements or nodes, becomes a list with counts.
    pub fn text(&self, width: usize) -> String {
        let width = width.max(40);
        if self.nodes.is_empty() {
            return String::from("no nodes\n");
        }
        if !self.is_drawable(MOST) {
            return list::list(self, width);
        }
        match self.rows(width) {
            Some(rows) => {
                let above = self.gravity.as_ref().map(|own| gravity(own) + "\n\n");
                above.unwrap_or_default() + &rows
            }
            None => list::list(self, width),
        }
    }

    /// The drawing in one or, for a chain, several rows.
    fn rows(&self, width: usize) -> Option<String> {
        if let Some(drawing) = self.drawing(width) {
            return Some(drawing);
        }
        let chain = self.chain()?;
        let mut text = String::new();
        let mut start = 0;
        while start + 1 < chain.len() {
            let row = |end: usize| self.section(&chain[start..=end]).drawing(width);
            let (end, drawing) =
                (start + 1..chain.len()).map_while(|end| Some((end, row(end)?))).last()?;
            if start > 0 {
                let name = one_line(&self.nodes[chain[start]].name);
                let _ = writeln!(text, "\n… from {name} on:");
            }
            text += &drawing;
            start = end;
        }
        Some(text)
    }

    /// The nodes from left to right when each is linked to the next one only.
    fn chain(&self) -> Option<Vec<usize>> {
        let count = self.nodes.len();
        let next = |v: usize| {
            let mut ahead: Vec<usize> =
                self.links.iter().filter(|l| l.from == v && l.to < count).map(|l| l.to).collect();
            ahead.dedup();
            ahead
        };
        let mut at = (0..count).find(|v| self.links.iter().all(|l| l.to != *v))?;
        let mut chain = vec![at];
        while let [only] = next(at)[..] {
            if chain.contains(&only) {
                return None;
            }
            chain.push(only);
            at = only;
        }
        (chain.len() == count && next(at).is_empty()).then_some(chain)
    }

    /// The sketch of some of the nodes.
    fn section(&self, nodes: &[usize]) -> Self {
        let place = |v: usize| nodes.iter().position(|n| *n == v);
        let links = self.links.iter().filter_map(|link| {
            Some(SketchLink { from: place(link.from)?, to: place(link.to)?, ..link.clone() })
        });
        Self {
            nodes: nodes.iter().map(|v| self.nodes[*v].clone()).collect(),
            links: links.collect(),
            gravity: None,
        }
    }

    /// The drawing in one row, if it is not wider than `width`.
    fn drawing(&self, width: usize) -> Option<String> {
        let sizes = Sizes { leaf: &leaf_extent, gap: 1.0, rail: 1.0, wire: 1.0 };
        let link_extent = |index: usize| {
            let link = &self.links[index];
            let tree = sizes.extent(&link.tree);
            let is_named = if link.name.is_empty() { 0.0 } else { 1.0 };
            Extent { width: tree.width.max(columns(&link.name)), up: tree.up + is_named, ..tree }
        };
        let metrics = Metrics {
            node: &|index| node_extent(&self.nodes[index]),
            link: &link_extent,
            through: Extent { width: 1.0, up: 0.0, down: 0.0 },
            gap: 1.0,
            lead: 0.0,
            track: 1.0,
            wire: 1.0,
        };
        let plan = plan(self, &metrics);
        if (width as f64) < plan.width {
            return None;
        }
        let mut grid = Grid::default();
        for wire in &plan.wires {
            wire.windows(2).for_each(|ends| grid.line(ends[0], ends[1]));
        }
        for placed in &plan.links {
            let link = &self.links[placed.index];
            let tree = sizes.extent(&link.tree);
            let start = placed.x + (0.5 * (placed.extent.width - tree.width)).floor();
            let right = placed.x + placed.extent.width - 1.0;
            grid.line((placed.x, placed.y), (start, placed.y));
            grid.line((start + tree.width - 1.0, placed.y), (right, placed.y));
            sizes.draw(&link.tree, (start, placed.y), placed.reversed, &mut grid);
            let name = one_line(&link.name);
            let above = placed.y - placed.extent.up;
            grid.text((centred(placed.x, placed.extent.width, &name), above), &name);
        }
        for placed in &plan.nodes {
            draw_node(&mut grid, &self.nodes[placed.index], placed);
        }
        Some(grid.print())
    }
}

fn has_frame(node: &SketchNode) -> bool {
    matches!(node.kind, SketchKind::Mass | SketchKind::Prescribed)
}

fn draw_node(grid: &mut Grid, node: &SketchNode, placed: &Placed) {
    let Extent { width, up, down } = placed.extent;
    let top = placed.y - up;
    let mut row = placed.y;
    if has_frame(node) {
        grid.frame((placed.x, top), (width, up + down + 1.0));
        row = top + 1.0;
    }
    for line in inscription(node, placed.wired.1) {
        let start = match node.kind {
            SketchKind::Fixed if placed.wired.1 => placed.x + width - columns(&line),
            SketchKind::Fixed => placed.x,
            _ => centred(placed.x, width, &line),
        };
        grid.text((start, row), &line);
        row += 1.0;
    }
}

/// What stands in a node, line by line.
fn inscription(node: &SketchNode, is_left_end: bool) -> Vec<String> {
    let name = one_line(&node.name);
    let first = match node.kind {
        SketchKind::Mass => name,
        SketchKind::Prescribed => format!("↔ {name}"),
        SketchKind::Massless => format!("({name})"),
        SketchKind::Face => format!("▏{name}▕"),
        SketchKind::HeavyFace => format!("▌{name}▐"),
        SketchKind::Fixed if is_left_end => format!("{name} ▒"),
        SketchKind::Fixed => format!("▒ {name}"),
    };
    std::iter::once(first).chain(lines_and_loads(node)).collect()
}

fn node_extent(node: &SketchNode) -> Extent {
    let lines = inscription(node, false);
    let widest = lines.iter().map(|line| columns(line)).fold(0.0, f64::max);
    let count = lines.iter().fold(0.0, |n, _| n + 1.0);
    if !has_frame(node) {
        return Extent { width: widest, up: 0.0, down: count - 1.0 };
    }
    let up = f64::midpoint(count, 1.0).floor();
    Extent { width: widest + 2.0, up, down: count + 1.0 - up }
}

fn leaf_extent(leaf: &SketchTree) -> Extent {
    let (symbol, label) = symbol(leaf);
    let up = if label.is_empty() { 0.0 } else { 1.0 };
    Extent { width: columns(&symbol).max(columns(label)) + 2.0, up, down: 0.0 }
}

/// Symbol of an element and the value above it.
fn symbol(leaf: &SketchTree) -> (String, &str) {
    match leaf {
        SketchTree::Element { kind, label, law } => match symbol_of(kind, *law) {
            Some(symbol) => (symbol.text.to_owned(), label),
            None => (format!("[{}]", one_line(kind)), label),
        },
        SketchTree::Series(_) | SketchTree::Parallel(_) => (String::new(), ""),
    }
}

/// Terminal columns of a text.
fn columns(text: &str) -> f64 {
    text_metrics::columns(text) as f64
}

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

#[derive(Debug, Clone, Default)]
struct Grid {
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
        let horizontal = (from.1 - to.1).abs() < 0.5;
        let (one, other) = if horizontal { (from.0, to.0) } else { (from.1, to.1) };
        let (start, end) = (one.min(other), one.max(other));
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
        let (symbol, label) = symbol(leaf);
        if !matches!(leaf, SketchTree::Parallel(_)) {
            self.line((x, y), (x + extent.width - 1.0, y));
        }
        self.text((centred(x, extent.width, &symbol), y), &symbol);
        self.text((centred(x, extent.width, label), y - 1.0), label);
    }
}

/// First column of a text centred in `width` columns from `x` on.
fn centred(x: f64, width: f64, text: &str) -> f64 {
    x + (0.5 * (width - columns(text))).floor().max(0.0)
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
    use crate::sketch::tests::{chain, reference, tangled};

    fn assert_narrow(text: &str, width: usize) {
        for line in text.lines() {
            assert!(text_metrics::columns(line) <= width, "{line:?} in\n{text}");
        }
    }

    #[test]
    fn the_reference_network_fits_80_columns() {
        let text = reference().text(80);
        assert_narrow(&text, 80);
        for part in ["head", "10 m/s →", "padding", "6 kN s/m", "]=", "/\\/\\/\\", "▒ ground", "├"]
        {
            assert!(text.contains(part), "{part} in\n{text}");
        }
    }

    #[test]
    fn a_long_chain_goes_on_in_further_rows() {
        let text = chain(12).text(80);
        assert_narrow(&text, 80);
        assert!(text.contains("… from m"), "{text}");
        assert_eq!(text.matches("/\\/\\/\\").count(), 11, "{text}");
    }

    #[test]
    fn any_graph_keeps_the_width() {
        for width in [40, 60, 80, 200] {
            let text = tangled().text(width);
            assert_narrow(&text, width);
            assert!(text.contains("Körper 頭"), "{text}");
        }
    }

    #[test]
    fn big_networks_become_a_list_with_counts() {
        let text = chain(500).text(80);
        assert_narrow(&text, 80);
        assert!(text.contains("500 masses") && text.contains("499 springs"), "{text}");
        assert!(text.lines().count() < 40, "{text}");
    }

    #[test]
    fn an_empty_network_says_so() {
        assert_eq!(Sketch::default().text(80), "no nodes\n");
    }

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
