//! Symbols of elements and nodes as pieces of SVG.

use std::fmt::Write as _;

use super::order::Extent;
use super::{SketchKind, SketchNode, SketchTree};
use crate::lettering::{escape, text_width};
use crate::theme;

/// Length of a symbol \[px\].
const SYMBOL: f64 = 56.0;
/// Half its height \[px\].
const HALF: f64 = 9.0;
/// Length of the wire at each of its ends \[px\].
const STUB: f64 = 8.0;
/// Distance of lines of text \[px\].
pub(super) const LINE: f64 = 1.35 * theme::TICK_SIZE;
/// Half the height of a wall \[px\].
const WALL: f64 = 30.0;
/// Radius of a joint \[px\].
const JOINT: f64 = 4.0;

/// Weight of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Weight {
    Plain,
    Bold,
}

/// SVG under construction: lines and texts.
#[derive(Debug, Default)]
pub(super) struct Canvas {
    pub(super) svg: String,
}

impl Canvas {
    /// An open line through points.
    pub(super) fn line(&mut self, points: &[(f64, f64)], width: f64) {
        let mut list = String::new();
        for (x, y) in points {
            let _ = write!(list, "{x:.1},{y:.1} ");
        }
        let _ = writeln!(
            self.svg,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{width}\" \
             stroke-linejoin=\"round\" stroke-linecap=\"square\"/>",
            list.trim_end(),
            theme::INK.hex()
        );
    }

    /// A text centred at x with its base line at y.
    pub(super) fn text(&mut self, (x, y): (f64, f64), text: &str, weight: Weight) {
        let (size, bold, colour) = match weight {
            Weight::Plain => (theme::TICK_SIZE, "", theme::INK),
            Weight::Bold => (theme::LABEL_SIZE, " font-weight=\"bold\"", theme::INK),
        };
        let _ = writeln!(
            self.svg,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"middle\" font-family=\"{}\" font-size=\"{size}\"{bold} \
             fill=\"{}\">{}</text>",
            theme::FONT,
            colour.hex(),
            escape(text)
        );
    }

    fn rectangle(&mut self, (x, y): (f64, f64), (width, height): (f64, f64), dashed: bool) {
        let dashes = if dashed { " stroke-dasharray=\"5 4\"" } else { "" };
        let _ = writeln!(
            self.svg,
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" rx=\"3\" fill=\"{}\" \
             stroke=\"{}\" stroke-width=\"{}\"{dashes}/>",
            theme::FILL.hex(),
            theme::INK.hex(),
            theme::LINE_WIDTH
        );
    }

    /// A node around its connecting line, with wires to those of its (left, right) ends that are `wired`.
    pub(super) fn node(
        &mut self,
        node: &SketchNode,
        at: (f64, f64),
        extent: Extent,
        wired: (bool, bool),
    ) {
        let (x, y) = at;
        let centre = x + 0.5 * extent.width;
        match node.kind {
            SketchKind::Mass | SketchKind::Prescribed => {
                let is_given = node.kind == SketchKind::Prescribed;
                let height = extent.up + extent.down;
                self.rectangle((x, y - extent.up), (extent.width, height), is_given);
                let texts = lettering_height(node);
                self.lettering(node, (centre, y - 0.5 * texts + 0.85 * theme::LABEL_SIZE));
            }
            SketchKind::Massless => {
                for (is_wired, end) in [(wired.0, x), (wired.1, x + extent.width)] {
                    if is_wired {
                        self.line(&[(end, y), (centre, y)], theme::LINE_WIDTH);
                    }
                }
                let _ = writeln!(
                    self.svg,
                    "<circle cx=\"{centre:.1}\" cy=\"{y:.1}\" r=\"{JOINT}\" fill=\"{}\"/>",
                    theme::INK.hex()
                );
                self.lettering(node, (centre, y + JOINT + 3.0 + theme::LABEL_SIZE));
            }
            SketchKind::Fixed => {
                let (end, side) = if wired.1 { (x + extent.width, -1.0) } else { (x, 1.0) };
                if wired.0 || wired.1 {
                    self.line(&[(end, y), (centre, y)], theme::LINE_WIDTH);
                }
                self.line(&[(centre, y - WALL), (centre, y + WALL)], 2.0 * theme::LINE_WIDTH);
                let mut hatch = -WALL;
                while hatch < WALL - 1.0 {
                    let (low, high) = (y + hatch + 10.0, y + hatch);
                    self.line(&[(centre, low), (centre + side * 10.0, high)], theme::HAIR_WIDTH);
                    hatch += 10.0;
                }
                self.lettering(node, (centre, y + WALL + 4.0 + theme::LABEL_SIZE));
            }
        }
    }

    fn lettering(&mut self, node: &SketchNode, (x, y): (f64, f64)) {
        self.text((x, y), &node.name, Weight::Bold);
        let mut base = y;
        for line in &node.lines {
            base += LINE;
            self.text((x, base), line, Weight::Plain);
        }
    }

    /// An element with its value above and wires to both ends.
    pub(super) fn element(&mut self, leaf: &SketchTree, (x, y): (f64, f64), extent: Extent) {
        let centre = x + 0.5 * extent.width;
        let half = match leaf {
            SketchTree::Other { word, .. } => 0.5 * word_width(word),
            _ => 0.5 * SYMBOL,
        };
        let (left, right) = (centre - half, centre + half);
        if !matches!(leaf, SketchTree::Parallel(_)) {
            self.line(&[(x, y), (left, y)], theme::LINE_WIDTH);
            self.line(&[(right, y), (x + extent.width, y)], theme::LINE_WIDTH);
        }
        match leaf {
            SketchTree::Spring { .. } => self.spring(left, y),
            SketchTree::Dashpot { .. } => self.dashpot(left, y),
            SketchTree::Other { word, .. } => {
                self.rectangle((left, y - HALF - 3.0), (2.0 * half, 2.0 * HALF + 6.0), false);
                self.text((centre, y + 0.35 * theme::TICK_SIZE), word, Weight::Plain);
            }
            SketchTree::Rigid | SketchTree::Series(_) => {
                self.line(&[(left, y), (right, y)], 2.5 * theme::LINE_WIDTH);
            }
            // Without any branch the ends are not connected.
            SketchTree::Parallel(_) => {}
        }
        if let Some(label) = value(leaf) {
            self.text((centre, y - HALF - 7.0), label, Weight::Plain);
        }
    }

    fn spring(&mut self, left: f64, y: f64) {
        const TEETH: u32 = 5;
        let pitch = SYMBOL / f64::from(TEETH);
        let mut points = vec![(left, y)];
        for tooth in 0..TEETH {
            let start = left + f64::from(tooth) * pitch;
            points.extend([(start + 0.25 * pitch, y - HALF), (start + 0.75 * pitch, y + HALF)]);
        }
        points.push((left + SYMBOL, y));
        self.line(&points, theme::LINE_WIDTH);
    }

    /// A cylinder open to the left, with the piston on the left wire.
    fn dashpot(&mut self, left: f64, y: f64) {
        let (mouth, bottom) = (left + 0.28 * SYMBOL, left + 0.78 * SYMBOL);
        let piston = left + 0.52 * SYMBOL;
        self.line(&[(left, y), (piston, y)], theme::LINE_WIDTH);
        self.line(&[(piston, y - HALF + 3.0), (piston, y + HALF - 3.0)], 2.0 * theme::LINE_WIDTH);
        let cylinder =
            [(mouth, y - HALF), (bottom, y - HALF), (bottom, y + HALF), (mouth, y + HALF)];
        self.line(&cylinder, theme::LINE_WIDTH);
        self.line(&[(bottom, y), (left + SYMBOL, y)], theme::LINE_WIDTH);
    }
}

fn word_width(word: &str) -> f64 {
    (text_width(word, theme::TICK_SIZE) + 14.0).max(SYMBOL)
}

fn value(leaf: &SketchTree) -> Option<&str> {
    match leaf {
        SketchTree::Spring { label }
        | SketchTree::Dashpot { label }
        | SketchTree::Other { label, .. } => Some(label),
        _ => None,
    }
}

fn lettering_height(node: &SketchNode) -> f64 {
    theme::LABEL_SIZE + LINE * node.lines.iter().fold(0.0, |n, _| n + 1.0)
}

/// Extent of a node.
pub(super) fn node_extent(node: &SketchNode) -> Extent {
    let texts = node.lines.iter().map(|line| text_width(line, theme::TICK_SIZE));
    // Bold letters are about a tenth wider.
    let widest = texts.fold(1.1 * text_width(&node.name, theme::LABEL_SIZE), f64::max);
    let lines = lettering_height(node);
    match node.kind {
        SketchKind::Mass | SketchKind::Prescribed => {
            let half = (0.5 * (lines + 16.0)).max(24.0).ceil();
            Extent { width: (widest + 22.0).max(56.0).ceil(), up: half, down: half }
        }
        SketchKind::Massless => {
            Extent { width: (widest + 8.0).max(30.0).ceil(), up: 10.0, down: (lines + 12.0).ceil() }
        }
        SketchKind::Fixed => Extent {
            width: (widest + 4.0).max(36.0).ceil(),
            up: WALL + 4.0,
            down: (WALL + lines + 10.0).ceil(),
        },
    }
}

/// Extent of a single element with its value.
pub(super) fn leaf_extent(leaf: &SketchTree) -> Extent {
    let symbol = match leaf {
        SketchTree::Other { word, .. } => word_width(word),
        _ => SYMBOL,
    };
    let label = value(leaf).unwrap_or("");
    let width = (symbol + 2.0 * STUB).max(text_width(label, theme::TICK_SIZE) + 12.0).ceil();
    let text = if label.is_empty() { 0.0 } else { theme::TICK_SIZE + 8.0 };
    Extent { width, up: (HALF + 4.0 + text).ceil(), down: HALF + 5.0 }
}
