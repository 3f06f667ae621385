//! The register of symbols of elements.

use super::canvas::{Canvas, Point, Weight, upright};
use crate::sketch::order::Extent;
use crate::sketch::{SketchLaw, SketchTree};
use crate::text_metrics::text_width;
use crate::theme;

/// Length of most symbols \[px\].
const SYMBOL: f64 = 56.0;
/// Half their height \[px\].
const HALF: f64 = 9.0;
/// How far the arrow of a law that is not linear reaches \[px\].
const ARROW: f64 = 15.0;
/// Half the height of a plate \[px\].
const PLATE: f64 = 12.0;
/// Half the height of the wall of a stop \[px\].
const WALL: f64 = 15.0;
/// Length of the wire at each end of a symbol \[px\].
const STUB: f64 = 8.0;

/// How one kind of element, or what an effect puts into a network, is drawn.
pub(in crate::sketch) struct Symbol {
    pub(in crate::sketch) kind: &'static str,
    /// One and several of them in a count.
    pub(in crate::sketch) names: [&'static str; 2],
    /// The symbol in characters.
    pub(in crate::sketch) text: &'static str,
    /// Length \[px\].
    width: f64,
    /// Height above and below the connecting line \[px\].
    reach: (f64, f64),
    /// Draws it from its left end on.
    draw: fn(&mut Canvas, Point),
}

const fn symbol(
    kind: &'static str,
    names: [&'static str; 2],
    text: &'static str,
    reach: f64,
    draw: fn(&mut Canvas, Point),
) -> Symbol {
    Symbol { kind, names, text, width: SYMBOL, reach: (reach, reach), draw }
}

/// Every symbol of a kind of its own, in the order in which kinds are counted. All others have that of
/// their [`SketchLaw`]; the drawing then carries the kind's word too.
pub(in crate::sketch) const SYMBOLS: &[Symbol] = &[
    symbol("spring", ["spring", "springs"], "/\\/\\/\\", HALF, spring),
    symbol("dashpot", ["dashpot", "dashpots"], "]=", HALF, dashpot),
    symbol("rigid", ["rigid bar", "rigid bars"], "═══", HALF, bar),
    symbol("contact", ["contact", "contacts"], "┤ ├", PLATE, contact),
    symbol("separation", ["separation", "separations"], "┊ ┊", PLATE, separation),
    symbol("stop", ["stop", "stops"], "┤↔▒", WALL, stop),
    Symbol {
        reach: (HALF, 18.0),
        ..symbol("friction", ["friction slider", "friction sliders"], "═µ═", HALF, slider)
    },
    Symbol {
        kind: "hunt-crossley",
        names: ["Hunt–Crossley contact", "Hunt–Crossley contacts"],
        ..NONLINEAR_IMPACT
    },
];

const NONLINEAR_SPRING: Symbol = symbol("", [""; 2], "/\\/↗/\\", ARROW, nonlinear_spring);
const NONLINEAR_DASHPOT: Symbol = symbol("", [""; 2], "]↗=", ARROW, nonlinear_dashpot);
const NONLINEAR_IMPACT: Symbol =
    Symbol { width: 84.0, ..symbol("", [""; 2], "┤ ├/↗\\", ARROW, gap_and_spring) };

/// The symbol of a kind, or else of its law; without both it is drawn as a box with its word.
pub(in crate::sketch) fn symbol_of(kind: &str, law: SketchLaw) -> Option<&'static Symbol> {
    SYMBOLS.iter().find(|own| own.kind == kind).or(match law {
        SketchLaw::Spring => Some(&NONLINEAR_SPRING),
        SketchLaw::Dashpot => Some(&NONLINEAR_DASHPOT),
        SketchLaw::Impact => Some(&NONLINEAR_IMPACT),
        SketchLaw::Other => None,
    })
}

impl Canvas {
    /// An element with its value above and wires to both ends.
    pub(in crate::sketch) fn element(&mut self, leaf: &SketchTree, (x, y): Point, extent: Extent) {
        let centre = x + 0.5 * extent.width;
        let (width, (up, _)) = size(leaf);
        let (left, right) = (centre - 0.5 * width, centre + 0.5 * width);
        // Without any branch the ends are not connected.
        if matches!(leaf, SketchTree::Parallel(_)) {
            return;
        }
        self.straight((x, y), (left, y));
        self.straight((right, y), (x + extent.width, y));
        let SketchTree::Element { kind, label, law } = leaf else {
            return bar(self, (left, y));
        };
        match symbol_of(kind, *law) {
            Some(symbol) => self.group(kind, |canvas| (symbol.draw)(canvas, (left, y))),
            None => self.group("other", |canvas| {
                canvas.rectangle((left, y - up), (width, 2.0 * up), false);
                canvas.text((centre, y + 0.35 * theme::TICK_SIZE), kind, Weight::Plain);
            }),
        }
        if !label.is_empty() {
            self.text((centre, y - up - 7.0), label, Weight::Plain);
        }
    }
}

/// Length of a symbol, and its height above and below the connecting line.
fn size(leaf: &SketchTree) -> (f64, (f64, f64)) {
    let SketchTree::Element { kind, law, .. } = leaf else { return (SYMBOL, (HALF, HALF)) };
    if let Some(symbol) = symbol_of(kind, *law) {
        return (symbol.width, symbol.reach);
    }
    let width = text_width(kind, theme::TICK_SIZE) + 14.0;
    (width.max(SYMBOL), (HALF + 3.0, HALF + 3.0))
}

/// Extent of a single element with its value.
pub(in crate::sketch) fn leaf_extent(leaf: &SketchTree) -> Extent {
    let (symbol, (up, down)) = size(leaf);
    let label = if let SketchTree::Element { label, .. } = leaf { label } else { "" };
    let width = (symbol + 2.0 * STUB).max(text_width(label, theme::TICK_SIZE) + 12.0).ceil();
    let text = if label.is_empty() { 0.0 } else { theme::TICK_SIZE + 8.0 };
    Extent { width, up: (up + 4.0 + text).ceil(), down: down + 5.0 }
}

fn spring(canvas: &mut Canvas, at: Point) {
    zigzag(canvas, at, SYMBOL, 5);
}

fn zigzag(canvas: &mut Canvas, (left, y): Point, length: f64, teeth: u32) {
    let pitch = length / f64::from(teeth);
    let mut points = vec![(left, y)];
    for tooth in 0..teeth {
        let start = left + f64::from(tooth) * pitch;
        points.extend([(start + 0.25 * pitch, y - HALF), (start + 0.75 * pitch, y + HALF)]);
    }
    points.push((left + length, y));
    canvas.line(&points, theme::LINE_WIDTH);
}

/// A cylinder open to the left, with the piston on the left wire.
fn dashpot(canvas: &mut Canvas, (left, y): Point) {
    let (mouth, bottom) = (left + 0.28 * SYMBOL, left + 0.78 * SYMBOL);
    let piston = left + 0.52 * SYMBOL;
    canvas.straight((left, y), (piston, y));
    canvas.plate((piston, y), HALF - 3.0);
    let cylinder = [(mouth, y - HALF), (bottom, y - HALF), (bottom, y + HALF), (mouth, y + HALF)];
    canvas.line(&cylinder, theme::LINE_WIDTH);
    canvas.straight((bottom, y), (left + SYMBOL, y));
}

fn bar(canvas: &mut Canvas, (left, y): Point) {
    canvas.line(&[(left, y), (left + SYMBOL, y)], 2.5 * theme::LINE_WIDTH);
}

/// The arrow that marks a law as not linear.
fn slanted_arrow(canvas: &mut Canvas, (middle, y): Point) {
    let from = (middle - 17.0, y + ARROW - 1.0);
    canvas.arrow(from, (middle + 18.0, y - ARROW), theme::LINE_WIDTH);
}

fn nonlinear_spring(canvas: &mut Canvas, at: Point) {
    spring(canvas, at);
    slanted_arrow(canvas, (at.0 + 0.5 * SYMBOL, at.1));
}

fn nonlinear_dashpot(canvas: &mut Canvas, at: Point) {
    dashpot(canvas, at);
    slanted_arrow(canvas, (at.0 + 0.5 * SYMBOL, at.1));
}

/// Wires that end before a gap from one place to the other.
fn opened(canvas: &mut Canvas, (left, y): Point, (from, to): (f64, f64)) {
    canvas.straight((left, y), (left + from, y));
    canvas.straight((left + to, y), (left + SYMBOL, y));
}

/// Two plates with a gap between them.
fn contact(canvas: &mut Canvas, at: Point) {
    opened(canvas, at, (22.0, 34.0));
    for plate in [22.0, 34.0] {
        canvas.plate((at.0 + plate, at.1), PLATE);
    }
}

/// Two dashed plates that lie on each other until they part.
fn separation(canvas: &mut Canvas, at: Point) {
    opened(canvas, at, (24.0, 32.0));
    for plate in [24.0, 32.0] {
        canvas.dashed(&upright((at.0 + plate, at.1), PLATE), 2.0 * theme::LINE_WIDTH);
    }
}

/// A plate, and a wall at a distance from it.
fn stop(canvas: &mut Canvas, at: Point) {
    let (plate, wall) = (10.0, 38.0);
    opened(canvas, at, (plate, wall));
    canvas.plate((at.0 + plate, at.1), 0.6 * PLATE);
    canvas.wall((at.0 + wall, at.1), WALL, 1.0);
    let middle = (at.0 + 0.5 * (plate + wall), at.1);
    for end in [plate + 2.0, wall - 2.0] {
        canvas.arrow(middle, (at.0 + end, at.1), theme::HAIR_WIDTH);
    }
}

/// Two plates that slide on each other.
fn slider(canvas: &mut Canvas, (left, y): Point) {
    let broad = 2.0 * theme::LINE_WIDTH;
    canvas.line(&[(left, y), (left + 6.0, y), (left + 6.0, y - 2.5)], theme::LINE_WIDTH);
    canvas.line(&[(left + 6.0, y - 2.5), (left + 42.0, y - 2.5)], broad);
    canvas.line(&[(left + 14.0, y + 2.5), (left + 50.0, y + 2.5)], broad);
    let end = [(left + 50.0, y + 2.5), (left + 50.0, y), (left + SYMBOL, y)];
    canvas.line(&end, theme::LINE_WIDTH);
    canvas.text((left + 0.5 * SYMBOL, y + 16.0), "µ", Weight::Plain);
}

/// A contact with a spring that is not linear behind it.
fn gap_and_spring(canvas: &mut Canvas, (left, y): Point) {
    canvas.straight((left, y), (left + 10.0, y));
    for plate in [10.0, 20.0] {
        canvas.plate((left + plate, y), PLATE);
    }
    canvas.straight((left + 20.0, y), (left + 28.0, y));
    zigzag(canvas, (left + 28.0, y), 48.0, 4);
    canvas.straight((left + 76.0, y), (left + 84.0, y));
    slanted_arrow(canvas, (left + 52.0, y));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text_metrics::columns;
    use crate::well_formed::assert_well_formed;

    #[test]
    fn every_kind_has_one_symbol_that_stays_in_its_room() {
        for (i, own) in SYMBOLS.iter().enumerate() {
            assert!(SYMBOLS[..i].iter().all(|other| other.kind != own.kind), "{}", own.kind);
        }
        let of_laws = [&NONLINEAR_SPRING, &NONLINEAR_DASHPOT, &NONLINEAR_IMPACT];
        for own in SYMBOLS.iter().chain(of_laws) {
            assert!(columns(own.text) <= 6, "{}", own.kind);
            let mut canvas = Canvas::default();
            (own.draw)(&mut canvas, (0.0, 0.0));
            let lists = canvas.svg.split("points=\"").skip(1);
            let pairs = lists.flat_map(|rest| rest.split('"').next().unwrap().split(' '));
            for pair in pairs {
                let (x, y) = pair.split_once(',').unwrap();
                let (x, y): (f64, f64) = (x.parse().unwrap(), y.parse().unwrap());
                assert!((0.0..=own.width).contains(&x), "{} at {x}", own.kind);
                let room = -own.reach.0 - 3.0..=own.reach.1 + 3.0;
                assert!(room.contains(&y), "{} at {y}", own.kind);
            }
        }
    }

    #[test]
    fn an_element_is_a_group_of_its_kind_and_an_unknown_one_a_box_with_its_word() {
        for (kind, class) in [("friction", "friction"), ("a<b>", "other")] {
            let leaf = SketchTree::element(kind, "200 N");
            let mut canvas = Canvas::default();
            canvas.element(&leaf, (0.0, 0.0), leaf_extent(&leaf));
            assert_well_formed(&format!("<svg>{}</svg>", canvas.svg));
            assert!(canvas.svg.contains(&format!("<g class=\"{class}\">")), "{}", canvas.svg);
            assert!(canvas.svg.contains(">200 N</text>"));
        }
    }
}
