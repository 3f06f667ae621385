//! The lines of a map: those of equal value, and those of limits.

use std::fmt::Write as _;

use super::{Map, MapLimit, contours::contours};
use crate::{
    axis::{Axis, Frame},
    text_metrics::{escape, one_line, text_width},
    theme,
};

/// Width of the lines of equal value and of limits \[px\].
const LINES: [f64; 2] = [0.9, 2.6];
/// A line of equal value carries its number if it is longer than this \[px\].
const LEAST_LABELLED: f64 = 90.0;
/// Room between a text and the frame \[px\].
const ROOM: f64 = 7.0;
/// How much wider bold letters are.
const BOLD: f64 = 1.12;

impl Map {
    /// A place in units of the grid's steps on the canvas.
    fn place(&self, frame: &Frame, (column, row): (f64, f64)) -> (f64, f64) {
        let between = |places: &[f64], at: f64, canvas: &dyn Fn(f64) -> f64| {
            let first = at.floor();
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "places lie on the grid"
            )]
            let index = (first as usize).min(places.len().saturating_sub(1));
            let next = (index + 1).min(places.len().saturating_sub(1));
            let share = at - first;
            (1.0 - share) * canvas(places[index]) + share * canvas(places[next])
        };
        let (x0, y0) = (self.x[0], self.y[0]);
        (
            between(&self.x, column, &|own| frame.at(own, y0).0),
            between(&self.y, row, &|own| frame.at(x0, own).1),
        )
    }

    fn on_canvas(&self, frame: &Frame, values: &[f64], level: f64) -> Vec<Vec<(f64, f64)>> {
        if self.x.is_empty() || self.y.is_empty() || values.len() != self.x.len() * self.y.len() {
            return Vec::new();
        }
        let lines = contours(values, self.x.len(), level);
        let on_canvas = |line: Vec<(f64, f64)>| {
            line.into_iter().map(|own| self.place(frame, own)).collect::<Vec<_>>()
        };
        lines.into_iter().map(on_canvas).collect()
    }

    pub(super) fn draw_lines(&self, svg: &mut String, frame: &Frame, values: &Axis) {
        let _ = writeln!(
            svg,
            "<g class=\"contours\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" \
             stroke-linejoin=\"round\">",
            theme::PAPER.hex(),
            LINES[0]
        );
        let mut texts = Vec::new();
        for &level in values.ticks() {
            let lines = self.on_canvas(frame, &self.values, level);
            lines.iter().for_each(|line| draw_path(svg, line));
            let longest = lines.iter().max_by(|a, b| length(a).total_cmp(&length(b)));
            if let Some(line) = longest.filter(|line| length(line) >= LEAST_LABELLED) {
                texts.push((line[line.len() / 2], values.label_apart(level)));
            }
        }
        svg.push_str("</g>\n");
        draw_texts(svg, frame, "labels", &texts, false);
    }

    pub(super) fn draw_limit(&self, svg: &mut String, frame: &Frame, limit: &MapLimit) {
        let lines = self.on_canvas(frame, &limit.values, limit.at);
        let _ = writeln!(
            svg,
            "<g class=\"limits\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" \
             stroke-linejoin=\"round\">",
            theme::LIMIT.hex(),
            LINES[1]
        );
        lines.iter().for_each(|line| draw_path(svg, line));
        svg.push_str("</g>\n");
        if let Some(line) = lines.iter().max_by(|a, b| length(a).total_cmp(&length(b))) {
            let text = (line[line.len() / 3], one_line(&limit.label));
            draw_texts(svg, frame, "limit-labels", &[text], true);
        }
    }
}

fn length(line: &[(f64, f64)]) -> f64 {
    line.windows(2).map(|pair| (pair[1].0 - pair[0].0).hypot(pair[1].1 - pair[0].1)).sum()
}

/// Texts on the map, with a border in the colour of the paper.
fn draw_texts(
    svg: &mut String,
    frame: &Frame,
    class: &str,
    texts: &[((f64, f64), String)],
    is_bold: bool,
) {
    let weight = if is_bold { " font-weight=\"bold\"" } else { "" };
    let _ = writeln!(
        svg,
        "<g class=\"{class}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"3\" \
         stroke-linejoin=\"round\" paint-order=\"stroke\"{weight}>",
        theme::INK.hex(),
        theme::PAPER.hex()
    );
    for (at, label) in texts {
        let width = text_width(label, theme::TICK_SIZE) * if is_bold { BOLD } else { 1.0 };
        let half = 0.5 * width + ROOM;
        let x = at.0.clamp(frame.left + half, (frame.right - half).max(frame.left + half));
        let y = (at.1 + 4.5).clamp(frame.top + theme::TICK_SIZE + 0.5 * ROOM, frame.bottom - ROOM);
        svg.push_str(&text((x, y), "middle", theme::TICK_SIZE, label));
    }
    svg.push_str("</g>\n");
}

/// A line through places on the canvas.
pub(super) fn draw_path(svg: &mut String, line: &[(f64, f64)]) {
    let places: Vec<String> = line.iter().map(|own| format!("{:.1},{:.1}", own.0, own.1)).collect();
    let _ = writeln!(svg, "<polyline points=\"{}\"/>", places.join(" "));
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
