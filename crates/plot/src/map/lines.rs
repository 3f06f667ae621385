//! The lines of a map: those of equal value, and those of limits with what lies beyond them.

use std::fmt::Write as _;

use super::{
    Map, MapLimit,
    bands::Field,
    colours::Colours,
    contours::contours,
    texts::{Texts, length},
};
use crate::{axis::Frame, theme};

/// Width of the lines of equal value, of limits, and of what surrounds these \[px\].
const LINES: [f64; 3] = [0.9, 2.6, 5.0];
/// A line of equal value carries its number if it is longer than this \[px\].
const LEAST_LABELLED: f64 = 70.0;
/// Levels within this part of each other are the same.
const SAME: f64 = 1e-9;

impl Map {
    /// A place in units of the grid's steps on the canvas.
    pub(super) fn place(&self, frame: &Frame, (column, row): (f64, f64)) -> (f64, f64) {
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

    /// Whether these are values at the points of the map.
    pub(super) fn are_on_grid(&self, values: &[f64]) -> bool {
        !self.x.is_empty() && values.len() == self.x.len() * self.y.len()
    }

    fn on_canvas(
        &self,
        frame: &Frame,
        (values, level): (&[f64], f64),
        wanted: impl Fn((usize, usize)) -> bool,
    ) -> Vec<Vec<(f64, f64)>> {
        if !self.are_on_grid(values) {
            return Vec::new();
        }
        let lines = contours(values, self.x.len(), level, wanted);
        let on_canvas = |line: Vec<(f64, f64)>| {
            line.into_iter().map(|own| self.place(frame, own)).collect::<Vec<_>>()
        };
        lines.into_iter().map(on_canvas).collect()
    }

    /// Outlines of a region as the data of one path.
    pub(super) fn outlines(&self, frame: &Frame, region: Vec<Vec<(f64, f64)>>) -> String {
        let mut data = String::new();
        for outline in region {
            let places: Vec<(f64, f64)> =
                outline.into_iter().map(|own| self.place(frame, own)).collect();
            for (at, (x, y)) in straightened(&places).into_iter().enumerate() {
                let _ = write!(data, "{}{x:.1} {y:.1}", if at == 0 { "M" } else { "L" });
            }
            data.push('Z');
        }
        data
    }

    /// Draws the lines of equal value at the ticks of the bar, and puts their numbers.
    pub(super) fn draw_lines(
        &self,
        svg: &mut String,
        frame: &Frame,
        (field, shares, colours): (&Field, &[f64], &Colours),
        texts: &mut Texts<'_>,
    ) {
        let _ = writeln!(
            svg,
            "<g class=\"contours\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" \
             stroke-linejoin=\"round\">",
            theme::PAPER.hex(),
            LINES[0]
        );
        // A limit has a line of its own.
        let is_limit =
            |level: f64| self.shown.iter().any(|own| (own - level).abs() <= SAME * level.abs());
        for &level in colours.axis.ticks().iter().filter(|own| !is_limit(**own)) {
            let lines = {
                let level = (shares, colours.axis.fraction(level));
                self.on_canvas(frame, level, |own| field.is_smooth(own))
            };
            lines.iter().for_each(|line| draw_path(svg, line));
            if lines.iter().any(|line| length(line) >= LEAST_LABELLED) {
                texts.put(&colours.axis.label_apart(level), &lines, None);
            }
        }
        svg.push_str("</g>\n");
    }

    /// The lines of a limit on the canvas.
    pub(super) fn limit_lines(&self, frame: &Frame, limit: &MapLimit) -> Vec<Vec<(f64, f64)>> {
        self.on_canvas(frame, (&limit.values, limit.at), |_| true)
    }
}

/// Draws the lines of a limit.
pub(super) fn draw_limit(svg: &mut String, lines: &[Vec<(f64, f64)>]) {
    for (class, colour, width) in
        [("halo", theme::PAPER, LINES[2]), ("limits", theme::LIMIT, LINES[1])]
    {
        let _ = writeln!(
            svg,
            "<g class=\"{class}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{width}\" \
             stroke-linejoin=\"round\">",
            colour.hex(),
        );
        lines.iter().for_each(|line| draw_path(svg, line));
        svg.push_str("</g>\n");
    }
}

/// A closed outline without the places that lie straight between their neighbours.
fn straightened(places: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut kept: Vec<(f64, f64)> = Vec::with_capacity(places.len());
    for (at, &place) in places.iter().enumerate() {
        let next = places.get(at + 1);
        let is_between = kept.last().zip(next).is_some_and(|(last, next)| {
            let (dx, dy) = (next.0 - last.0, next.1 - last.1);
            let aside = dx * (place.1 - last.1) - dy * (place.0 - last.0);
            let ahead = dx * (place.0 - last.0) + dy * (place.1 - last.1);
            aside.abs() <= 0.02 * dx.hypot(dy) && ahead >= 0.0 && ahead <= dx * dx + dy * dy
        });
        if !is_between {
            kept.push(place);
        }
    }
    kept
}

/// A line through places on the canvas.
pub(super) fn draw_path(svg: &mut String, line: &[(f64, f64)]) {
    let places: Vec<String> = line.iter().map(|own| format!("{:.1},{:.1}", own.0, own.1)).collect();
    let _ = writeln!(svg, "<polyline points=\"{}\"/>", places.join(" "));
}
