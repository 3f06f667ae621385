//! Texts within the frame of a chart: at limits, beside markers, with the discs and lines that belong to them.

use plotters::element::Text;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::canvas::{Area, Fault, canvas, text_style};
use super::labels::{self, Leader};
use super::{Chart, Direction, ReferenceLine};
use crate::decimation::Path;
use crate::frame::{Ends, Frame};
use crate::text_metrics::one_line;
use crate::theme;

/// A text with its left middle at a place \[px\].
pub(super) struct PlacedText {
    text: String,
    anchor: (f64, f64),
    colour: theme::Colour,
}

/// The texts within the frame, the discs of markers and the lines from discs to texts.
pub(super) struct Texts {
    pub(super) limits: Vec<PlacedText>,
    pub(super) markers: Vec<PlacedText>,
    pub(super) discs: Path,
    pub(super) leaders: Vec<Leader>,
}

/// Draws texts at their places.
pub(super) fn draw_texts(area: &Area<'_>, texts: &[PlacedText]) -> Result<(), Fault> {
    for text in texts {
        let pos = Pos::new(HPos::Left, VPos::Center);
        let style = text_style(theme::TICK_SIZE, text.colour, pos);
        area.draw(&Text::new(text.text.clone(), canvas(text.anchor), style))?;
    }
    Ok(())
}

impl Chart {
    /// Places for the texts at limits and markers, and for what belongs to them.
    pub(super) fn place_texts(&self, frame: &Frame, curves: &[Vec<Path>]) -> Texts {
        let bounds = labels::Area {
            left: frame.left + 0.5 * theme::HALO_WIDTH,
            right: frame.right,
            top: frame.top,
            bottom: frame.bottom - 0.5 * theme::HALO_WIDTH,
        };
        let mut placer = labels::Placer::new(bounds, curves);
        let limits = self.limits(frame);
        limits.iter().for_each(|(_, ends)| placer.avoid_line(*ends));
        let (x_zero, y_zero) = frame.at(0.0, 0.0);
        if frame.x.holds(0.0) {
            placer.avoid_path(&[(x_zero, frame.top), (x_zero, frame.bottom)]);
        }
        if frame.y.holds(0.0) {
            placer.avoid_path(&[(frame.left, y_zero), (frame.right, y_zero)]);
        }
        let marked: Vec<_> =
            self.marked().map(|m| (frame.at(m.x, m.y), one_line(&m.label))).collect();
        for (point, _) in &marked {
            placer.avoid(*point, theme::MARKER_RADIUS);
        }
        let anchors = placer.beside_all(&marked, theme::TICK_SIZE);
        let discs = marked.iter().map(|(point, _)| *point).collect();
        let marker_text = |((_, text), anchor)| PlacedText { text, anchor, colour: theme::INK };
        let markers = marked.into_iter().zip(anchors).map(marker_text).collect();
        // A line has many places for its text, a point has few.
        let limit_text = |(limit, [start, _]): (&ReferenceLine, Ends)| {
            let text = one_line(&limit.label);
            let is_horizontal = limit.direction == Direction::Horizontal;
            let at = if is_horizontal { start.1 } else { start.0 };
            let anchor = placer.along(at, is_horizontal, &text, theme::TICK_SIZE);
            PlacedText { text, anchor, colour: theme::limit_colour(limit.colour) }
        };
        let limits = limits.into_iter().map(limit_text).collect();
        Texts { limits, markers, discs, leaders: placer.leaders().to_vec() }
    }
}
