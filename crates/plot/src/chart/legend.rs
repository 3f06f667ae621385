//! Texts of a chart: the legend above it, and what stands within its frame at limits and beside markers.

use plotters::{
    element::Text,
    style::{
        FontTransform,
        text_anchor::{HPos, Pos, VPos},
    },
};

use super::{
    Chart, Direction, ReferenceLine,
    arrows::Arrowhead,
    canvas::{Area, Fault, Pen, canvas, text_style},
    labels::{self, Leader},
};
use crate::{
    axis::{Ends, Frame},
    decimation::Path,
    text_metrics::{clip_width, one_line, text_width},
    theme,
};

/// What an entry of the legend shows a sample of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Sample {
    /// A curve.
    Curve(Pen),
    /// A reference line of a curve's colour, if of any.
    Line(Option<usize>),
}

/// One placed entry; places are from the legend's upper left corner \[px\].
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Entry {
    pub(super) sample: Sample,
    pub(super) text: String,
    pub(super) x: f64,
    pub(super) y: f64,
}

/// All entries, in rows that keep within a width.
#[derive(Debug)]
pub(super) struct Legend {
    entries: Vec<Entry>,
    rows: f64,
}

impl Legend {
    /// Length of a line sample \[px\].
    pub(super) const SAMPLE: f64 = 34.0;
    const ROW: f64 = 1.55 * theme::TICK_SIZE;
    const GAP: f64 = 22.0;

    /// Places `entries` in rows of `width` \[px\]; names wider than a row are cut.
    pub(super) fn new(entries: Vec<(Sample, String)>, width: f64) -> Self {
        let (mut x, mut rows) = (0.0, 0.0);
        let mut placed = Vec::with_capacity(entries.len());
        for (sample, text) in entries {
            let text = clip_width(&text, theme::TICK_SIZE, width - Self::SAMPLE - 6.0);
            let taken = Self::SAMPLE + 6.0 + text_width(&text, theme::TICK_SIZE);
            if placed.is_empty() || x + taken > width {
                x = 0.0;
                rows += 1.0;
            }
            placed.push(Entry { sample, text, x, y: (rows - 0.5) * Self::ROW });
            x += taken + Self::GAP;
        }
        Self { entries: placed, rows }
    }

    pub(super) fn entries(&self) -> &[Entry] {
        &self.entries
    }

    /// Height of all rows \[px\].
    pub(super) fn height(&self) -> f64 {
        self.rows * Self::ROW
    }
}

/// A text with its left middle at a place \[px\], or where it is upright its middle.
pub(super) struct PlacedText {
    text: String,
    is_upright: bool,
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
        let across = if text.is_upright { HPos::Center } else { HPos::Left };
        let turn = if text.is_upright { FontTransform::Rotate270 } else { FontTransform::None };
        let pos = Pos::new(across, VPos::Center);
        let style = text_style(theme::TICK_SIZE, text.colour, pos).transform(turn);
        area.draw(&Text::new(text.text.clone(), canvas(text.anchor), style))?;
    }
    Ok(())
}

impl Chart {
    /// Places for the texts at limits and markers, and for what belongs to them.
    pub(super) fn place_texts(
        &self,
        frame: &Frame,
        curves: &[Vec<Path>],
        arrowheads: &[Arrowhead],
    ) -> Texts {
        let bounds = labels::Area {
            left: frame.left + 0.5 * theme::HALO_WIDTH,
            right: frame.right,
            top: frame.top,
            bottom: frame.bottom - 0.5 * theme::HALO_WIDTH,
        };
        let mut placer = labels::Placer::new(bounds, curves);
        arrowheads.iter().for_each(|own| placer.avoid_path(&own.corners));
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
        let marker_text = |((_, text), anchor)| PlacedText {
            text,
            is_upright: false,
            anchor,
            colour: theme::INK,
        };
        let markers = marked.into_iter().zip(anchors).map(marker_text).collect();
        let room = frame.right - frame.left - 2.0 * theme::HALO_WIDTH;
        // A line has many places for its text, a point has few.
        let limit_text = |(limit, [start, _]): (&ReferenceLine, Ends)| {
            let text = one_line(&limit.label);
            let text = match limit.direction {
                Direction::Horizontal => clip_width(&text, theme::TICK_SIZE, room),
                Direction::Vertical => text,
            };
            let (anchor, is_upright) = match limit.direction {
                Direction::Horizontal => (placer.along(start.1, &text, theme::TICK_SIZE), false),
                Direction::Vertical => {
                    let own = placer.beside_line(start.0, &text, theme::TICK_SIZE);
                    (own.place, own.is_upright)
                }
            };
            PlacedText { text, is_upright, anchor, colour: theme::limit_colour(limit.colour) }
        };
        let limits = limits.into_iter().map(limit_text).collect();
        Texts { limits, markers, discs, leaders: placer.leaders().to_vec() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_stay_within_the_width_and_apart() {
        let names = (0..20).map(|i| (Sample::Line(None), format!("element number {i}"))).collect();
        let legend = Legend::new(names, 500.0);
        for pair in legend.entries().windows(2) {
            let end =
                pair[0].x + Legend::SAMPLE + 6.0 + text_width(&pair[0].text, theme::TICK_SIZE);
            assert!(end <= 500.0);
            assert!(pair[1].x >= end || pair[1].y > pair[0].y);
        }
        assert!(legend.height() > 5.0 * Legend::ROW);
    }

    #[test]
    fn the_text_of_a_limit_stays_within_the_frame_of_a_phone() {
        let label = "max 20 kN, of the mean (EN 1621-1:2012, level 2)".to_owned();
        let line = ReferenceLine { direction: Direction::Horizontal, at: 3.0, label, colour: None };
        let series = vec![crate::Series::new("pad", vec![(0.0, 0.0), (1.0, 5.0)])];
        let chart = Chart { series, lines: vec![line], ..Chart::default() };
        let svg = chart.narrow_svg().unwrap();
        let text = svg.split("class=\"limit-labels\"").nth(1).unwrap();
        let text = text.split("<text ").nth(1).unwrap();
        let left: f64 =
            text.split("x=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap();
        let words = text.split('>').nth(1).unwrap().split('<').next().unwrap().trim();
        assert!(words.starts_with("max 20 kN") && words.ends_with('…'), "{words}");
        let right = left / theme::OVERSAMPLING + text_width(words, theme::TICK_SIZE);
        assert!(left > 0.0 && right <= theme::PHONE.width, "{text}");
    }
}
