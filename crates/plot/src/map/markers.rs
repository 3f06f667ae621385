//! Points on a map that carry a text.

use std::fmt::Write as _;

use super::{Map, texts::Texts};
use crate::{Marker, axis::Frame, text_metrics::one_line, theme};

/// Radius of a point, of what surrounds it, and how far above its text stands \[px\].
const RADIUS: f64 = 5.0;
const HALO: f64 = 2.0;
const ABOVE: f64 = 17.0;

impl Map {
    /// Those within the frame, with their places on the canvas.
    fn marked<'m>(&'m self, frame: &'m Frame) -> impl Iterator<Item = (&'m Marker, (f64, f64))> {
        let Frame { left, right, top, bottom, .. } = *frame;
        let placed = self.markers.iter().map(|own| (own, frame.at(own.x, own.y)));
        placed.filter(move |(_, (x, y))| (left..=right).contains(x) && (top..=bottom).contains(y))
    }

    /// Puts the texts above, or below where there is more room, and off these lines.
    pub(super) fn put_markers(&self, frame: &Frame, texts: &mut Texts<'_>, lines: &[(f64, f64)]) {
        for (own, (x, y)) in self.marked(frame) {
            let places = [-ABOVE, ABOVE].map(|shift| vec![(x, y + shift)]);
            texts.put(&one_line(&own.label), &places, Some(lines));
        }
    }

    pub(super) fn draw_markers(&self, svg: &mut String, frame: &Frame) {
        for (_, (x, y)) in self.marked(frame) {
            let _ = writeln!(
                svg,
                "<circle class=\"marker\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{RADIUS}\" fill=\"{}\" \
                 stroke=\"{}\" stroke-width=\"{HALO}\"/>",
                theme::INK.hex(),
                theme::PAPER.hex()
            );
        }
    }
}
