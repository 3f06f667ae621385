//! Texts on a map: at lines, within the frame and apart from each other.

use std::fmt::Write as _;

use crate::{
    axis::Frame,
    text_metrics::{clip_width, escape, text_width},
    theme,
};

/// Room between a text and the frame, and between two texts \[px\].
const ROOM: f64 = 7.0;
/// How much wider bold letters are.
const BOLD: f64 = 1.12;
/// So many places of other lines are as bad under a text as another text.
const WORSE: usize = 1000;
/// So many places along a line are looked at.
const PLACES: usize = 24;

/// A text in the middle of a place \[px\].
#[derive(Debug, Clone, PartialEq)]
struct Placed {
    at: (f64, f64),
    half: f64,
    text: String,
    is_bold: bool,
}

impl Placed {
    fn holds(&self, (x, y): &(f64, f64)) -> bool {
        (self.at.0 - x).abs() < self.half + 3.0
            && (self.at.1 - y).abs() < 0.5 * theme::TICK_SIZE + 3.0
    }

    fn covers(&self, other: &Self) -> bool {
        (self.at.0 - other.at.0).abs() < self.half + other.half + ROOM
            && (self.at.1 - other.at.1).abs() < theme::TICK_SIZE + 0.5 * ROOM
    }
}

/// The texts that stand on a map.
#[derive(Debug)]
pub(super) struct Texts<'f> {
    frame: &'f Frame,
    placed: Vec<Placed>,
}

impl<'f> Texts<'f> {
    pub(super) fn new(frame: &'f Frame) -> Self {
        Self { frame, placed: Vec::new() }
    }

    /// Puts a text on one of the lines or beside it, as near to its middle as it is free; longer lines come first. One
    /// that keeps off `others` is bold, and where no place is free stands where it covers the least.
    pub(super) fn put(
        &mut self,
        text: &str,
        lines: &[Vec<(f64, f64)>],
        others: Option<&[(f64, f64)]>,
    ) {
        let is_bold = others.is_some();
        let room = self.frame.right - self.frame.left - 2.0 * ROOM;
        let text = clip_width(text, theme::TICK_SIZE, room / BOLD);
        let bold = if is_bold { BOLD } else { 1.0 };
        let half = 0.5 * text_width(&text, theme::TICK_SIZE) * bold;
        let mut longest: Vec<&Vec<(f64, f64)>> = lines.iter().collect();
        longest.sort_by(|one, other| length(other).total_cmp(&length(one)));
        let mut best: Option<(usize, Placed)> = None;
        let on_lines: Vec<_> = longest.into_iter().flat_map(|line| places(line)).collect();
        let aside = |shift: f64| on_lines.iter().map(move |at| (at.0 + shift, at.1));
        let beside = [half + ROOM, -half - ROOM].map(aside).into_iter().flatten();
        for at in aside(0.0).chain(beside.filter(|_| is_bold)) {
            let placed = Placed { at: self.within(at, half), half, text: text.clone(), is_bold };
            let texts = self.placed.iter().filter(|own| own.covers(&placed)).count();
            let struck = others.unwrap_or_default().iter().filter(|own| placed.holds(own)).count();
            let covered = WORSE * texts + struck;
            if best.as_ref().is_none_or(|own| covered < own.0) {
                best = Some((covered, placed));
            }
            if covered == 0 {
                break;
            }
        }
        self.placed.extend(best.filter(|own| is_bold || own.0 == 0).map(|own| own.1));
    }

    /// The place of a text of this half width near a point, wholly in the frame.
    fn within(&self, (x, y): (f64, f64), half: f64) -> (f64, f64) {
        let Frame { left, right, top, bottom, .. } = *self.frame;
        let (half, high) = (half + ROOM, 0.5 * theme::TICK_SIZE + ROOM);
        (
            x.clamp(left + half, (right - half).max(left + half)),
            y.clamp(top + high, (bottom - high).max(top + high)),
        )
    }

    /// Draws all texts, with a border in the colour of the paper.
    pub(super) fn draw(&self, svg: &mut String) {
        for (class, weight, is_bold) in
            [("labels", "", false), ("limit-labels", " font-weight=\"bold\"", true)]
        {
            let own = self.placed.iter().filter(|own| own.is_bold == is_bold);
            let texts = own
                .map(|own| text((own.at.0, own.at.1 + 4.5), "middle", theme::TICK_SIZE, &own.text));
            let texts: String = texts.collect();
            if texts.is_empty() {
                continue;
            }
            let halo = format!("{} stroke-width=\"3\"", theme::halo());
            let ink = format!("class=\"{class}\" fill=\"{}\"", theme::INK.hex());
            for own in [halo, ink] {
                let _ = writeln!(svg, "<g {own}{weight}>\n{texts}</g>");
            }
        }
    }
}

/// Places on a line, from its middle outwards.
fn places(line: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let last = line.len().saturating_sub(1);
    let count = PLACES.min(line.len());
    let mut all: Vec<usize> =
        (0..count).map(|at| at * last / count.max(2).saturating_sub(1)).collect();
    all.sort_by_key(|at| at.abs_diff(last / 2));
    all.into_iter().filter_map(|at| line.get(at).copied()).collect()
}

pub(super) fn length(line: &[(f64, f64)]) -> f64 {
    line.windows(2).map(|pair| (pair[1].0 - pair[0].0).hypot(pair[1].1 - pair[0].1)).sum()
}

/// A text at a place on the canvas.
pub(super) fn text((x, y): (f64, f64), anchor: &str, size: f64, content: &str) -> String {
    if content.is_empty() {
        return String::new();
    }
    format!(
        "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\" font-size=\"{size}\">{}</text>\n",
        escape(content)
    )
}

/// A text along the vertical, which reads upwards.
pub(super) fn upright(x: f64, y: f64, content: &str) -> String {
    format!(
        "<text transform=\"translate({x:.1} {y:.1}) rotate(-90)\" text-anchor=\"middle\" \
         font-size=\"{}\">{}</text>\n",
        theme::LABEL_SIZE,
        escape(content)
    )
}
