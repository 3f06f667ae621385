//! The legend above a chart: samples of lines with their names, in rows.

use super::Stroke;
use crate::text_metrics::{clip_width, text_width};
use crate::theme;

/// What an entry of the legend shows a sample of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Sample {
    /// A curve.
    Curve(Stroke),
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

    /// The placed entries.
    pub(super) fn entries(&self) -> &[Entry] {
        &self.entries
    }

    /// Height of all rows \[px\].
    pub(super) fn height(&self) -> f64 {
        self.rows * Self::ROW
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
}
