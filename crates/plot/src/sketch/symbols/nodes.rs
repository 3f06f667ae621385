//! Symbols of nodes, of what acts on them, and of gravity.

use super::canvas::{Canvas, Point, Weight};
use crate::sketch::order::Extent;
use crate::sketch::{SketchGravity, SketchKind, SketchNode};
use crate::text_metrics::text_width;
use crate::theme;

/// Distance of lines of text \[px\].
pub(in crate::sketch) const LINE: f64 = 1.35 * theme::TICK_SIZE;
/// Height that gravity takes above a drawing \[px\].
pub(in crate::sketch) const GRAVITY: f64 = 30.0;
/// Half the height of a wall \[px\].
const WALL: f64 = 30.0;
/// Half the height of a face \[px\].
const FACE: f64 = 16.0;
/// Half the width of a face that has mass \[px\].
const HEAVY: f64 = 4.0;
/// Radius of a joint \[px\].
const JOINT: f64 = 4.0;
/// Length of the arrow of a load or of gravity \[px\].
const ARROW: f64 = 26.0;
/// Room between such an arrow and its text \[px\].
const SPACE: f64 = 6.0;

impl Canvas {
    /// A node around its connecting line, with wires to those of its (left, right) ends that are `wired`.
    pub(in crate::sketch) fn node(
        &mut self,
        node: &SketchNode,
        at: Point,
        extent: Extent,
        wired: (bool, bool),
    ) {
        self.group(word(node.kind), |canvas| canvas.body(node, at, extent, wired));
        let mut base = at.1 - half_height(node) - 6.0;
        for load in node.loads.iter().rev() {
            let width = ARROW + SPACE + text_width(load, theme::TICK_SIZE);
            let left = at.0 + 0.5 * (extent.width - width);
            self.group("load", |canvas| canvas.labelled_arrow((left, base), load, false));
            base -= LINE;
        }
    }

    fn body(&mut self, node: &SketchNode, (x, y): Point, extent: Extent, wired: (bool, bool)) {
        let centre = x + 0.5 * extent.width;
        let half = half_height(node);
        match node.kind {
            SketchKind::Mass | SketchKind::Prescribed => {
                let is_given = node.kind == SketchKind::Prescribed;
                self.rectangle((x, y - half), (extent.width, 2.0 * half), is_given);
                let texts = text_height(node);
                self.inscription(node, (centre, y - 0.5 * texts + 0.85 * theme::LABEL_SIZE));
            }
            SketchKind::Massless => {
                self.wires((x, centre), y, extent, wired);
                self.disc((centre, y), JOINT);
                self.inscription(node, (centre, y + JOINT + 3.0 + theme::LABEL_SIZE));
            }
            SketchKind::Face => {
                self.wires((x, centre), y, extent, wired);
                self.plate((centre, y), FACE);
                self.inscription(node, (centre, y + FACE + 4.0 + theme::LABEL_SIZE));
            }
            SketchKind::HeavyFace => {
                self.wires((x, centre), y, extent, wired);
                self.rectangle((centre - HEAVY, y - FACE), (2.0 * HEAVY, 2.0 * FACE), false);
                self.inscription(node, (centre, y + FACE + 4.0 + theme::LABEL_SIZE));
            }
            SketchKind::Fixed => {
                let (end, side) = if wired.1 { (x + extent.width, -1.0) } else { (x, 1.0) };
                if wired.0 || wired.1 {
                    self.straight((end, y), (centre, y));
                }
                self.wall((centre, y), WALL, side);
                self.inscription(node, (centre, y + WALL + 4.0 + theme::LABEL_SIZE));
            }
        }
    }

    /// Wires from the ends of a node's room to its middle.
    fn wires(&mut self, (x, centre): (f64, f64), y: f64, extent: Extent, wired: (bool, bool)) {
        for (is_wired, end) in [(wired.0, x), (wired.1, x + extent.width)] {
            if is_wired {
                self.straight((end, y), (centre, y));
            }
        }
    }

    fn inscription(&mut self, node: &SketchNode, (x, y): Point) {
        self.text((x, y), &node.name, Weight::Bold);
        let mut base = y;
        for line in &node.lines {
            base += LINE;
            self.text((x, base), line, Weight::Plain);
        }
    }

    /// An arrow with its text to the right, its base line at `y`.
    fn labelled_arrow(&mut self, (x, y): Point, text: &str, is_backward: bool) {
        let middle = y - 0.35 * theme::TICK_SIZE;
        let ends = [(x, middle), (x + ARROW, middle)];
        let [from, to] = if is_backward { [ends[1], ends[0]] } else { ends };
        self.arrow(from, to, 1.5 * theme::LINE_WIDTH);
        let width = text_width(text, theme::TICK_SIZE);
        self.text((x + ARROW + SPACE + 0.5 * width, y), text, Weight::Plain);
    }

    /// Gravity as an arrow, with the base line of its text at `at`.
    pub(in crate::sketch) fn gravity(&mut self, gravity: &SketchGravity, at: Point) {
        let text = gravity_text(gravity);
        self.group("gravity", |canvas| canvas.labelled_arrow(at, &text, gravity.pulls_back));
    }
}

/// Width of [`Canvas::gravity`] \[px\].
pub(in crate::sketch) fn gravity_width(gravity: &SketchGravity) -> f64 {
    ARROW + SPACE + text_width(&gravity_text(gravity), theme::TICK_SIZE)
}

fn gravity_text(gravity: &SketchGravity) -> String {
    format!("g = {}", gravity.label)
}

/// The word for a kind of node, also the class of its symbol.
pub(in crate::sketch) fn word(kind: SketchKind) -> &'static str {
    match kind {
        SketchKind::Mass => "mass",
        SketchKind::Massless => "joint",
        SketchKind::Face | SketchKind::HeavyFace => "face",
        SketchKind::Fixed => "support",
        SketchKind::Prescribed => "prescribed",
    }
}

fn text_height(node: &SketchNode) -> f64 {
    theme::LABEL_SIZE + LINE * node.lines.iter().fold(0.0, |n, _| n + 1.0)
}

/// Height of a node's symbol above its connecting line.
fn half_height(node: &SketchNode) -> f64 {
    match node.kind {
        SketchKind::Mass | SketchKind::Prescribed => {
            (0.5 * (text_height(node) + 16.0)).max(24.0).ceil()
        }
        SketchKind::Massless => 10.0,
        SketchKind::Face | SketchKind::HeavyFace => FACE + 4.0,
        SketchKind::Fixed => WALL + 4.0,
    }
}

pub(in crate::sketch) fn node_extent(node: &SketchNode) -> Extent {
    let width = |text: &String| text_width(text, theme::TICK_SIZE);
    // Bold letters are about a tenth wider.
    let name = 1.1 * text_width(&node.name, theme::LABEL_SIZE);
    let widest = node.lines.iter().map(width).fold(name, f64::max);
    let loads = node.loads.iter().map(|load| ARROW + SPACE + width(load)).fold(0.0, f64::max);
    let lines = text_height(node);
    let half = half_height(node);
    let (least, room, down) = match node.kind {
        SketchKind::Mass | SketchKind::Prescribed => (56.0, 22.0, half),
        SketchKind::Massless => (30.0, 8.0, lines + 12.0),
        SketchKind::Face | SketchKind::HeavyFace => (30.0, 8.0, FACE + lines + 10.0),
        SketchKind::Fixed => (36.0, 4.0, WALL + lines + 10.0),
    };
    let above = LINE * node.loads.iter().fold(0.0, |n, _| n + 1.0);
    let above = if above > 0.0 { above + 8.0 } else { 0.0 };
    Extent {
        width: (widest + room).max(least).max(loads + 4.0).ceil(),
        up: (half + above).ceil(),
        down: down.ceil(),
    }
}
