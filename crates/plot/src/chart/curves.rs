//! Curves on the display: their stretches, the pixels through which they run, and how they are drawn.

use plotters::element::Circle;
use plotters::style::Color;

use super::canvas::Drawn;
use super::canvas::{Area, canvas, path, pen, pixels};
use super::naming::Place;
use super::{Chart, Pattern, Stroke};
use crate::decimation::{Path, stretches, thin};
use crate::frame::Frame;
use crate::theme;

/// Part of a marker's radius that a single point and the disc of a stem have.
const DISC: f64 = 0.6;

impl Chart {
    /// The stretches of a curve on the display, thinned to what can be seen; of stems one for each.
    pub(super) fn curve(&self, frame: &Frame, index: usize) -> Vec<Path> {
        let gap_or = |v: f64, place: f64| if v.is_finite() { place } else { f64::NAN };
        let placed = self.series[index].points.iter().map(|&(x, y)| {
            let at = frame.at(x, y);
            (gap_or(x, at.0), gap_or(y, at.1))
        });
        if self.stroke(index).pattern == Pattern::Stems {
            let foot = frame.bottom - frame.y.foot() * (frame.bottom - frame.top);
            let drawn = placed.filter(|(x, y)| x.is_finite() && y.is_finite());
            return drawn.map(|(x, y)| vec![(x, foot), (x, y)]).collect();
        }
        stretches(placed).iter().map(|stretch| thin(stretch, 0.5)).collect()
    }
}

/// The pixels through which a curve runs.
pub(super) fn places(stretches: &[Path]) -> Vec<Place> {
    let mut places = Vec::new();
    for stretch in stretches {
        for pair in stretch.windows(2) {
            let (dx, dy) = (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1);
            let steps = pixel(dx.abs().max(dy.abs())) + 1;
            for step in 0..steps {
                let part = step as f64 / steps as f64;
                places.push((pixel(pair[0].1 + part * dy), pixel(pair[0].0 + part * dx)));
            }
        }
    }
    places.dedup();
    places
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the value is kept within a few times the canvas"
)]
fn pixel(length: f64) -> usize {
    length.clamp(0.0, 1e5).round() as usize
}

/// Draws the stretches of one curve.
pub(super) fn draw_curve(area: &Area<'_>, paths: &[Path], stroke: Stroke) -> Drawn {
    for points in paths {
        match points[..] {
            [foot, end] if stroke.pattern == Pattern::Stems => {
                draw_stem(area, &[foot, end], stroke)?;
            }
            [point] => draw_disc(area, point, stroke)?,
            _ => area.draw(&path(points, pen(stroke)))?,
        }
    }
    Ok(())
}

/// Draws a line from its foot to its end, with a disc there.
pub(super) fn draw_stem(area: &Area<'_>, stem: &[(f64, f64); 2], stroke: Stroke) -> Drawn {
    area.draw(&path(stem, pen(stroke)))?;
    draw_disc(area, stem[1], stroke)
}

fn draw_disc(area: &Area<'_>, point: (f64, f64), stroke: Stroke) -> Drawn {
    let colour = theme::curve_colour(stroke.colour).rgb().filled();
    area.draw(&Circle::new(canvas(point), pixels(DISC * theme::MARKER_RADIUS), colour))
}
