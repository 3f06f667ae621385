//! Layers, strokes, letters and curves on the oversampled canvas of a chart: what plotters' SVG back-end is asked for.
//!
//! Each part of a chart is drawn into a layer of its own and wrapped in a group, which carries what the back-end
//! cannot say: dash patterns, round joints, halos behind text, names of curves.

use plotters::{
    backend::SVGBackend,
    coord::Shift,
    drawing::{DrawingArea, DrawingAreaErrorKind, IntoDrawingArea},
    element::{Circle, PathElement, Polygon},
    style::{Color, FontFamily, IntoFont, ShapeStyle, TextStyle, text_anchor::Pos},
};

use super::{Chart, Pattern, naming::Place};
use crate::{
    axis::Frame,
    decimation::{Path, decimate, stretches},
    text_metrics::escape,
    theme::{self, Colour},
};

/// Where a layer is drawn.
pub(super) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
/// What the back-end answers where it refuses a shape.
pub(super) type Fault = DrawingAreaErrorKind<std::io::Error>;
/// What drawing answers.
pub(super) type Drawn = Result<(), Fault>;

pub(super) fn opening(size: (f64, f64), title: &str) -> String {
    let (width, height) = (size.0.ceil(), size.1.ceil());
    let (wide, high) = (pixels(width), pixels(height));
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {wide} {high}\" role=\"img\">\n<title>{}</title>\n\
         <rect width=\"{wide}\" height=\"{high}\" fill=\"{}\"/>\n",
        escape(title),
        theme::PAPER.hex()
    )
}

/// One layer as a group: the back-end's document without its outermost element.
pub(super) fn layer(
    size: (f64, f64),
    attributes: &str,
    draw: impl FnOnce(&Area<'_>) -> Result<(), Fault>,
) -> Result<String, Fault> {
    let mut document = String::new();
    {
        let area = SVGBackend::with_string(&mut document, (pixels(size.0), pixels(size.1)))
            .into_drawing_area();
        draw(&area)?;
        area.present()?;
    }
    let inner = document.split_once('>').map_or("", |(_, rest)| rest.trim_end());
    let inner = inner.strip_suffix("</svg>").unwrap_or(inner).trim_start();
    Ok(format!("<g {attributes}>\n{inner}</g>\n"))
}

pub(super) fn dashes(pattern: Pattern) -> &'static str {
    match pattern {
        Pattern::Solid | Pattern::Broad | Pattern::Stems | Pattern::Points | Pattern::Band => "",
        Pattern::Dashed => " stroke-dasharray=\"80 50\"",
        Pattern::Dotted | Pattern::Measured => " stroke-dasharray=\"20 40\"",
        Pattern::DashDotted => " stroke-dasharray=\"110 40 20 40\"",
    }
}

/// What a curve is drawn with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pen {
    pub(super) colour: Colour,
    pub(super) pattern: Pattern,
}

impl Pen {
    pub(super) fn style(self) -> ShapeStyle {
        let width = match self.pattern {
            Pattern::Broad => theme::BROAD_WIDTH,
            Pattern::Stems => theme::LINE_WIDTH,
            _ => theme::CURVE_WIDTH,
        };
        let alpha = if self.pattern == Pattern::Broad { 0.4 } else { 1.0 };
        let color = self.colour.rgb().mix(alpha);
        ShapeStyle { color, filled: false, stroke_width: pixels(width) }
    }
}

/// The area within corners, pale.
pub(super) fn band(corners: &[(f64, f64)], colour: Colour) -> Polygon<(i32, i32)> {
    let corners = corners.iter().map(|own| canvas(*own)).collect::<Vec<_>>();
    Polygon::new(corners, colour.rgb().mix(BAND_ALPHA).filled())
}

/// A filled shape.
pub(super) fn shape(corners: &[(f64, f64)], colour: Colour) -> Polygon<(i32, i32)> {
    Polygon::new(corners.iter().map(|p| canvas(*p)).collect::<Vec<_>>(), colour.rgb().filled())
}

pub(super) fn line(colour: Colour, width: f64) -> ShapeStyle {
    ShapeStyle { color: colour.rgb().to_rgba(), filled: false, stroke_width: pixels(width) }
}

pub(super) fn path(points: &[(f64, f64)], style: ShapeStyle) -> PathElement<(i32, i32)> {
    PathElement::new(points.iter().map(|p| canvas(*p)).collect::<Vec<_>>(), style)
}

pub(super) fn text_style(size: f64, colour: Colour, pos: Pos) -> TextStyle<'static> {
    // The back-end divides font sizes by 1.24.
    let scaled = 1.24 * size * theme::OVERSAMPLING;
    (FontFamily::Name(theme::FONT), scaled).into_font().color(&colour.rgb()).pos(pos)
}

/// A place on the oversampled canvas.
#[expect(clippy::cast_possible_truncation, reason = "places lie on the canvas, far within i32")]
pub(super) fn canvas((x, y): (f64, f64)) -> (i32, i32) {
    ((x * theme::OVERSAMPLING).round() as i32, (y * theme::OVERSAMPLING).round() as i32)
}

/// A length on the oversampled canvas.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "lengths are positive and far within u32"
)]
pub(super) fn pixels(length: f64) -> u32 {
    (length * theme::OVERSAMPLING).round() as u32
}

/// Part of a marker's radius that a single point and the disc of a stem have.
const DISC: f64 = 0.6;
/// How much of its colour a band has.
const BAND_ALPHA: f64 = 0.25;
/// Discs nearer to each other than this are one \[px\].
const NEAR: f64 = 1.5;

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
        if self.stroke(index).pattern == Pattern::Points {
            let mut all: Vec<Path> = Vec::new();
            for own in placed.filter(|own| own.0.is_finite() && own.1.is_finite()) {
                let far = |last: (f64, f64)| (own.0 - last.0).hypot(own.1 - last.1) > NEAR;
                if all.last().is_none_or(|last| far(last[0])) {
                    all.push(vec![own]);
                }
            }
            return all;
        }
        stretches(placed).iter().map(|stretch| decimate(stretch, 0.5)).collect()
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
pub(super) fn draw_curve(area: &Area<'_>, paths: &[Path], pen: Pen) -> Drawn {
    for points in paths {
        match points[..] {
            [foot, end] if pen.pattern == Pattern::Stems => {
                draw_stem(area, &[foot, end], pen)?;
            }
            [point] => draw_disc(area, point, pen)?,
            _ if pen.pattern == Pattern::Band => area.draw(&band(points, pen.colour))?,
            _ => area.draw(&path(points, pen.style()))?,
        }
    }
    Ok(())
}

/// Draws a line from its foot to its end, with a disc there.
pub(super) fn draw_stem(area: &Area<'_>, stem: &[(f64, f64); 2], pen: Pen) -> Drawn {
    area.draw(&path(stem, pen.style()))?;
    draw_disc(area, stem[1], pen)
}

pub(super) fn draw_disc(area: &Area<'_>, point: (f64, f64), pen: Pen) -> Drawn {
    let colour = pen.colour.rgb().filled();
    area.draw(&Circle::new(canvas(point), pixels(DISC * theme::MARKER_RADIUS), colour))
}
