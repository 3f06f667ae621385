//! Lines and texts as pieces of SVG.

use std::fmt::Write as _;

use crate::text_metrics::escape;
use crate::theme;

/// A place \[px\].
pub(super) type Point = (f64, f64);

/// Length of an arrow's head \[px\].
const HEAD: f64 = 7.0;
/// Distance of the strokes behind a wall, and how far they reach \[px\].
const HATCH: f64 = 10.0;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::sketch) enum Weight {
    Plain,
    Bold,
}

/// SVG under construction: lines and texts.
#[derive(Debug, Default)]
pub(in crate::sketch) struct Canvas {
    pub(in crate::sketch) svg: String,
}

impl Canvas {
    /// What `draw` draws as one group with a class, by which style sheets and tests find it.
    pub(super) fn group(&mut self, class: &str, draw: impl FnOnce(&mut Self)) {
        let _ = writeln!(self.svg, "<g class=\"{}\">", escape(class));
        draw(self);
        self.svg += "</g>\n";
    }

    /// An open line through points.
    pub(in crate::sketch) fn line(&mut self, points: &[Point], width: f64) {
        self.stroke(points, width, "square", "");
    }

    /// A straight wire. One along the connecting line ends where the next begins: ends that cover each other show as
    /// dots.
    pub(in crate::sketch) fn straight(&mut self, from: Point, to: Point) {
        let is_level = (from.1 - to.1).abs() < 0.05;
        let cap = if is_level { "butt" } else { "square" };
        self.stroke(&[from, to], theme::LINE_WIDTH, cap, "");
    }

    /// The same with dashes.
    pub(super) fn dashed(&mut self, points: &[Point], width: f64) {
        self.stroke(points, width, "square", " stroke-dasharray=\"2 5\"");
    }

    fn stroke(&mut self, points: &[Point], width: f64, cap: &str, dashes: &str) {
        let mut list = String::new();
        for (x, y) in points {
            let _ = write!(list, "{x:.1},{y:.1} ");
        }
        let _ = writeln!(
            self.svg,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{width}\" \
             stroke-linejoin=\"round\" stroke-linecap=\"{cap}\"{dashes}/>",
            list.trim_end(),
            theme::INK.hex()
        );
    }

    /// A straight line with a filled head at its end.
    pub(super) fn arrow(&mut self, from: Point, to: Point, width: f64) {
        let (dx, dy) = (to.0 - from.0, to.1 - from.1);
        let length = dx.hypot(dy).max(1.0);
        let (ux, uy) = (dx / length, dy / length);
        let foot = (to.0 - HEAD * ux, to.1 - HEAD * uy);
        self.line(&[from, foot], width);
        let half = 0.42 * HEAD;
        let _ = writeln!(
            self.svg,
            "<polygon points=\"{:.1},{:.1} {:.1},{:.1} {:.1},{:.1}\" fill=\"{}\"/>",
            to.0,
            to.1,
            foot.0 - half * uy,
            foot.1 + half * ux,
            foot.0 + half * uy,
            foot.1 - half * ux,
            theme::INK.hex()
        );
    }

    /// A text centred at x with its base line at y.
    pub(in crate::sketch) fn text(&mut self, (x, y): Point, text: &str, weight: Weight) {
        let (size, bold) = match weight {
            Weight::Plain => (theme::TICK_SIZE, ""),
            Weight::Bold => (theme::LABEL_SIZE, " font-weight=\"bold\""),
        };
        let _ = writeln!(
            self.svg,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"middle\" font-family=\"{}\" font-size=\"{size}\"{bold} \
             fill=\"{}\">{}</text>",
            theme::FONT,
            theme::INK.hex(),
            escape(text)
        );
    }

    pub(super) fn rectangle(
        &mut self,
        (x, y): Point,
        (width, height): (f64, f64),
        is_dashed: bool,
    ) {
        let dashes = if is_dashed { " stroke-dasharray=\"5 4\"" } else { "" };
        let _ = writeln!(
            self.svg,
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" rx=\"3\" fill=\"{}\" \
             stroke=\"{}\" stroke-width=\"{}\"{dashes}/>",
            theme::FILL.hex(),
            theme::INK.hex(),
            theme::LINE_WIDTH
        );
    }

    pub(super) fn disc(&mut self, (x, y): Point, radius: f64) {
        let ink = theme::INK.hex();
        let _ = writeln!(
            self.svg,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" fill=\"{ink}\"/>"
        );
    }

    /// An upright plate about `middle`.
    pub(super) fn plate(&mut self, middle: Point, half: f64) {
        self.line(&upright(middle, half), 2.0 * theme::LINE_WIDTH);
    }

    /// An upright wall about `middle`, hatched on its right with `side` 1 and on its left with −1.
    pub(super) fn wall(&mut self, middle: Point, half: f64, side: f64) {
        self.plate(middle, half);
        let (x, y) = middle;
        let mut hatch = -half;
        while hatch < half - 1.0 {
            let ends = [(x, y + hatch + HATCH), (x + side * HATCH, y + hatch)];
            self.line(&ends, theme::HAIR_WIDTH);
            hatch += HATCH;
        }
    }
}

/// The ends of an upright line about `middle`.
pub(super) fn upright((x, y): Point, half: f64) -> [Point; 2] {
    [(x, y - half), (x, y + half)]
}
