//! What a limit divides a map into: where it is exceeded, where that is undecided, and the patterns of both.

use std::fmt::Write as _;

use super::{Map, MapLimit, Side, bands::Field};
use crate::{axis::Frame, text_metrics::one_line, theme};

/// Distance of lines and dots \[px\].
const STEP: [f64; 2] = [14.0, 9.0];
/// A band of errors is seen where it is a larger part of the limit, or of the range of values.
const SEEN: f64 = 0.003;
/// Radius of a dot and of what surrounds it \[px\].
const DOT: [f64; 2] = [1.5, 2.6];

impl Map {
    /// The outlines of where values on its grid are at least this level.
    fn region(&self, frame: &Frame, values: Vec<f64>, level: f64) -> String {
        self.outlines(frame, Field::whole(values, self.x.len()).region(level))
    }

    /// Draws a hatching of where a limit is exceeded.
    pub(super) fn draw_beyond(
        &self,
        svg: &mut String,
        frame: &Frame,
        limit: &MapLimit,
        pattern: &str,
    ) {
        let Some((values, level)) = limit.rising().filter(|own| self.are_on_grid(&own.0)) else {
            return;
        };
        let data = self.region(frame, values, level);
        if !data.is_empty() {
            let _ = writeln!(
                svg,
                "<path class=\"beyond\" d=\"{data}\" fill=\"url(#beyond-{pattern})\" fill-rule=\"evenodd\"/>"
            );
        }
    }

    /// Draws dots where it is undecided whether a limit is kept: where its line lies within the errors, and on the
    /// side on which it is kept where values are doubted.
    pub(super) fn draw_undecided(
        &self,
        svg: &mut String,
        frame: &Frame,
        limit: &MapLimit,
        (pattern, place): (&str, usize),
    ) {
        let Some((values, level)) = limit.rising().filter(|own| self.are_on_grid(&own.0)) else {
            return;
        };
        let mut draw = |data: &str, clip: &str| {
            let _ = writeln!(
                svg,
                "<path class=\"undecided\" d=\"{data}\" fill=\"url(#open-{pattern})\" \
                 fill-rule=\"evenodd\"{clip}/>"
            );
        };
        if self.are_on_grid(&limit.errors) {
            let moved = |sign: f64| -> Vec<f64> {
                let both = values.iter().zip(&limit.errors);
                both.map(|(own, error)| own + sign * error).collect()
            };
            let [outer, inner] = [1.0, -1.0].map(|sign| self.region(frame, moved(sign), level));
            if outer != inner {
                draw(&(outer + &inner), "");
            }
        }
        if limit.doubted.len() == values.len() && limit.doubted.contains(&true) {
            let beyond = self.region(frame, values, level);
            let doubted = limit.doubted.iter().map(|own| if *own { 1.0 } else { 0.0 }).collect();
            let data = self.region(frame, doubted, 0.5);
            let name = format!("kept-{place}-{pattern}");
            draw(&data, &format!(" clip-path=\"url(#{name})\""));
            let Frame { left, right, top, bottom, .. } = *frame;
            let _ = writeln!(
                svg,
                "<defs><clipPath id=\"{name}\"><path d=\"M{left:.1} {top:.1}H{right:.1}V{bottom:.1}H{left:.1}Z\
                 {beyond}\" clip-rule=\"evenodd\"/></clipPath></defs>"
            );
        }
    }
}

impl MapLimit {
    /// Whether there are values that do not decide.
    pub(super) fn is_open(&self) -> bool {
        let mut within = self.values.iter().zip(&self.errors);
        self.doubted.contains(&true) || within.any(|(own, error)| (own - self.at).abs() <= *error)
    }

    /// Whether so many of them do not that it is seen.
    pub(super) fn is_dotted(&self) -> bool {
        let Some(sign) = self.sign() else { return false };
        let known = || self.values.iter().copied().filter(|own| own.is_finite());
        let span =
            known().fold(f64::NEG_INFINITY, f64::max) - known().fold(f64::INFINITY, f64::min);
        let size = if self.at == 0.0 { span } else { span.min(self.at.abs()) };
        let is_beyond = |own: f64| sign * own > sign * self.at;
        let mut doubted = self.values.iter().zip(&self.doubted);
        let mut near = self.values.iter().zip(&self.errors);
        doubted.any(|(own, is_doubted)| *is_doubted && !is_beyond(*own))
            || near.any(|(own, error)| (own - self.at).abs() <= *error && *error > SEEN * size)
    }

    /// By what values are multiplied to rise to where the limit is exceeded; `None` where it has no such side.
    fn sign(&self) -> Option<f64> {
        match self.kept {
            Side::Below => Some(1.0),
            Side::Above => Some(-1.0),
            Side::Either => None,
        }
    }

    /// Values that rise to where the limit is exceeded, and their level on its line.
    fn rising(&self) -> Option<(Vec<f64>, f64)> {
        let sign = self.sign()?;
        Some((self.values.iter().map(|own| sign * own).collect(), sign * self.at))
    }

    /// What is to be said of it without a line: that all of the map lies on one side of it.
    pub(super) fn unlined(&self) -> Option<String> {
        let mut known = self.values.iter().filter(|own| own.is_finite()).peekable();
        known.peek()?;
        let [above, below] =
            [known.clone().all(|own| *own >= self.at), known.clone().all(|own| *own <= self.at)];
        let kept = if self.is_open() { "exceeded nowhere" } else { "kept everywhere" };
        let word = match self.kept {
            Side::Below if below => kept,
            Side::Above if above => kept,
            Side::Below if above => "kept nowhere",
            Side::Above if below => "kept nowhere",
            _ => return None,
        };
        Some(format!("{}: {word}", one_line(&self.label)))
    }
}

/// The patterns of what a limit forbids, lines, and of what is undecided, dots, that are seen on dark and on bright
/// colours; their names end in this one.
pub(super) fn patterns(name: &str) -> String {
    let [lines, dots] = STEP;
    let line = |colour: theme::Colour, width: f64, opacity: f64| {
        format!(
            "<line x1=\"0\" y1=\"0\" x2=\"0\" y2=\"{lines}\" stroke=\"{}\" stroke-width=\"{width}\" \
             stroke-opacity=\"{opacity}\"/>",
            colour.hex()
        )
    };
    let middle = 0.5 * dots;
    let dot = |colour: theme::Colour, radius: f64| {
        format!(
            "<circle cx=\"{middle}\" cy=\"{middle}\" r=\"{radius}\" fill=\"{}\"/>",
            colour.hex()
        )
    };
    format!(
        "<defs><pattern id=\"beyond-{name}\" width=\"{lines}\" height=\"{lines}\" \
         patternUnits=\"userSpaceOnUse\" patternTransform=\"rotate(45)\">{}{}</pattern>\
         <pattern id=\"open-{name}\" width=\"{dots}\" height=\"{dots}\" \
         patternUnits=\"userSpaceOnUse\">{}{}</pattern></defs>\n",
        line(theme::PAPER, 3.4, 0.3),
        line(theme::LIMIT, 1.3, 0.6),
        dot(theme::PAPER, DOT[1]),
        dot(theme::LIMIT, DOT[0]),
    )
}
