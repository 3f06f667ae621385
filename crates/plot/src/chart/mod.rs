//! Charts: curves over an axis, as SVG and as text.

mod arrows;
mod axes;
mod canvas;
mod ends;
mod heading;
mod labels;
mod legend;
mod naming;
mod panels;
mod svg;
mod text;

use thiserror::Error;

use self::canvas::Pen;
use crate::{axis::Axis, theme};

pub use crate::axis::Scale;
pub(crate) use heading::Heading;

/// A chart in the units of its labels.
///
/// Values that are not finite are gaps, and so are those of a logarithmic axis that are not positive; any other data
/// are drawn, however many, constant or far apart.
///
/// # Examples
///
/// ```
/// use dashpot_plot::{Chart, Series};
///
/// let chart = Chart {
///     title: "Pad force".into(),
///     x_label: "time (ms)".into(),
///     y_label: "force (kN)".into(),
///     series: vec![Series::new("exact", vec![(0.0, 0.0), (1.0, 38.4), (2.0, 31.0)])],
///     ..Chart::default()
/// };
/// assert!(chart.svg()?.starts_with("<svg"));
/// assert!(chart.text(80, 20).contains("force (kN)"));
/// # Ok::<(), dashpot_plot::PlotError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Chart {
    /// Heading.
    pub title: String,
    /// A remark below the heading; empty for none.
    pub note: String,
    /// Quantity and unit along the horizontal axis, as in `time (ms)`.
    pub x_label: String,
    /// Quantity and unit along the vertical axis, as in `force (kN)`.
    pub y_label: String,
    /// Scale of the horizontal axis.
    pub x_scale: Scale,
    /// Scale of the vertical axis.
    pub y_scale: Scale,
    /// Curves; later ones are drawn over earlier ones.
    pub series: Vec<Series>,
    /// Points that carry a text.
    pub markers: Vec<Marker>,
    /// Limits and other constants.
    pub lines: Vec<ReferenceLine>,
    /// How many of the curves, the first ones, belong to values of one number. Their colours run from dark to bright, in
    /// the order of the numbers of their strokes or else their own; curves of the same number have the same colour.
    pub family: usize,
    /// Whether arrowheads tell in which direction curves are run through, as where a loop is loaded and unloaded.
    pub has_arrows: bool,
    /// A lower chart under this one in the same drawing, over the same horizontal axis, such as what a fit leaves of its
    /// rows. Its own title, remark and horizontal label are not drawn, nor is it in texts.
    pub below: Option<Box<Self>>,
}

/// One curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Name in the legend.
    pub name: String,
    /// Points (x, y) along the curve, in the units of the axes.
    pub points: Vec<(f64, f64)>,
    /// How the curve is drawn; `None` for the next colour and pattern in turn.
    pub stroke: Option<Stroke>,
}

impl Series {
    /// A curve in the next colour and pattern.
    pub fn new(name: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self { name: name.into(), points, stroke: None }
    }

    /// A curve in a colour of the theme, as in [`Stroke::colour`], and a pattern.
    pub fn drawn(
        name: impl Into<String>,
        (colour, pattern): (usize, Pattern),
        points: impl IntoIterator<Item = (f64, f64)>,
    ) -> Self {
        let stroke = Some(Stroke { colour, pattern });
        Self { stroke, ..Self::new(name, points.into_iter().collect()) }
    }

    /// A band from (x, lower, upper) to the next, in a colour of the theme; what is not finite is a gap.
    pub fn band(
        name: impl Into<String>,
        colour: usize,
        rows: impl IntoIterator<Item = (f64, f64, f64)>,
    ) -> Self {
        let rows: Vec<(f64, f64, f64)> = rows.into_iter().collect();
        let is_whole = |own: &(f64, f64, f64)| own.1.is_finite() && own.2.is_finite();
        let mut points = Vec::new();
        for stretch in rows.chunk_by(|one, next| is_whole(one) && is_whole(next)) {
            points.extend(stretch.iter().map(|own| (own.0, own.1)));
            points.extend(stretch.iter().rev().map(|own| (own.0, own.2)));
            points.push((f64::NAN, f64::NAN));
        }
        Self::drawn(name, (colour, Pattern::Band), points)
    }
}

/// Colour and pattern of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stroke {
    /// Number of the colour in the theme; after the last one they begin again.
    pub colour: usize,
    /// Pattern.
    pub pattern: Pattern,
}

/// Pattern of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Pattern {
    /// A plain line.
    Solid,
    /// A broad pale line, on which another one of the same colour stays visible.
    Broad,
    /// A dashed line.
    Dashed,
    /// A dotted line.
    Dotted,
    /// A line of dashes and dots.
    DashDotted,
    /// A dotted line in the colour of ink, whatever its number: what was measured, beside curves in colours.
    Measured,
    /// A vertical line to each point with a disc at its end, as of a spectrum of single lines.
    Stems,
    /// A disc at each point in the colour of ink: single values that were measured.
    Points,
    /// The area within the points, pale, such as the band of an uncertainty.
    Band,
}

/// A point that carries a text, such as a peak.
#[derive(Debug, Clone, PartialEq)]
pub struct Marker {
    /// Horizontal place, in the unit of the axis.
    pub x: f64,
    /// Vertical place, in the unit of the axis.
    pub y: f64,
    /// Text beside the point.
    pub label: String,
}

/// A straight line across the chart, such as the thickness of a pad.
///
/// It widens the axes when it lies near the data; a line far away is named in the legend instead of squeezing the curves.
#[derive(Debug, Clone, PartialEq)]
pub struct ReferenceLine {
    /// Which way the line runs.
    pub direction: Direction,
    /// Where it crosses the axis, in the unit of that axis.
    pub at: f64,
    /// Text at the line.
    pub label: String,
    /// Number of the theme's curve colour in which line and text are drawn, as in [`Stroke::colour`]; `None` for a
    /// line that belongs to no single curve.
    pub colour: Option<usize>,
}

impl ReferenceLine {
    /// A line that belongs to no single curve.
    pub fn new(direction: Direction, at: f64, label: impl Into<String>) -> Self {
        Self { direction, at, label: label.into(), colour: None }
    }
}

/// Which way a [`ReferenceLine`] runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Direction {
    /// At one value of y, over all x.
    Horizontal,
    /// At one value of x, over all y.
    Vertical,
}

impl Chart {
    /// The stroke of the `index`-th curve.
    fn stroke(&self, index: usize) -> Stroke {
        let pattern = match index % 3 {
            _ if index < self.family => Pattern::Solid,
            0 => Pattern::Solid,
            1 => Pattern::Dashed,
            _ => Pattern::Dotted,
        };
        self.series[index].stroke.unwrap_or(Stroke { colour: index, pattern })
    }

    /// Colour and pattern of the `index`-th curve.
    fn pen(&self, index: usize) -> Pen {
        let Stroke { colour, pattern } = self.stroke(index);
        let colour = if matches!(pattern, Pattern::Measured | Pattern::Points) {
            theme::INK
        } else if index < self.family {
            let numbers =
                (0..self.family.min(self.series.len())).map(|own| self.stroke(own).colour);
            let last = numbers.max().unwrap_or(0).max(1);
            theme::ramp_colour(colour as f64 / last as f64)
        } else {
            theme::curve_colour(colour)
        };
        Pen { colour, pattern }
    }

    /// Horizontal and vertical axis with about so many ticks each.
    fn axes(&self, x_ticks: usize, y_ticks: usize) -> (Axis, Axis) {
        let points = || self.series.iter().flat_map(|s| s.points.iter().copied());
        let drawn = || points().filter(|(x, y)| self.takes(*x, *y));
        let xs = || drawn().map(|p| p.0).chain(self.marked().map(|m| m.x));
        let ys = || drawn().map(|p| p.1).chain(self.marked().map(|m| m.y));
        let x_lines = self.near_lines(Direction::Vertical, xs());
        let y_lines = self.near_lines(Direction::Horizontal, ys());
        let is_band = |at: usize| self.stroke(at).pattern == Pattern::Band;
        let is_sorted = |s: &Series| s.points.is_sorted_by(|a, b| a.0 <= b.0);
        let mut each = self.series.iter().enumerate();
        let runs_on = each.all(|(at, own)| is_band(at) || is_sorted(own));
        let padded = !runs_on || !x_lines.is_empty();
        (
            Axis::of(&self.x_scale, xs().chain(x_lines.iter().copied()), padded, x_ticks),
            Axis::of(&self.y_scale, ys().chain(y_lines.iter().copied()), true, y_ticks),
        )
    }

    /// Whether both axes are linear.
    fn is_linear(&self) -> bool {
        [&self.x_scale, &self.y_scale].iter().all(|scale| **scale == Scale::Linear)
    }

    /// Whether a point has a place on or beyond the axes.
    fn takes(&self, x: f64, y: f64) -> bool {
        self.x_scale.takes(x) && self.y_scale.takes(y)
    }

    /// The markers that have a place.
    fn marked(&self) -> impl Iterator<Item = &Marker> {
        self.markers.iter().filter(|m| self.takes(m.x, m.y))
    }

    /// Places of the reference lines that do not blow the range of `values` up to more than twice its size.
    fn near_lines(&self, direction: Direction, values: impl Iterator<Item = f64>) -> Vec<f64> {
        let scale = match direction {
            Direction::Horizontal => &self.y_scale,
            Direction::Vertical => &self.x_scale,
        };
        let (low, high) = values
            .map(|v| scale.coordinate(v))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        let room = scale.room(low, high);
        let lines = self.lines.iter().filter(|l| l.direction == direction && scale.takes(l.at));
        lines
            .map(|l| l.at)
            .filter(|at| low > high || (low - room..=high + room).contains(&scale.coordinate(*at)))
            .collect()
    }
}

/// A drawing that could not be made.
#[derive(Debug, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum PlotError {
    /// The drawing back-end refused a shape of the chart.
    #[error("chart `{title}` cannot be drawn: {reason}")]
    Backend { title: String, reason: String },
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(at: f64) -> ReferenceLine {
        ReferenceLine {
            direction: Direction::Horizontal,
            at,
            label: "thickness".into(),
            colour: None,
        }
    }

    #[test]
    fn a_near_limit_widens_the_axis_and_a_far_one_does_not() {
        let series = vec![Series::new("pad", vec![(0.0, 0.0), (1.0, 17.5)])];
        let near = Chart { series: series.clone(), lines: vec![line(20.0)], ..Chart::default() };
        assert!(near.axes(5, 5).1.holds(20.0));
        let far = Chart { series, lines: vec![line(2000.0)], ..Chart::default() };
        assert!(!far.axes(5, 5).1.holds(2000.0));
    }

    #[test]
    fn a_line_is_near_on_a_logarithmic_axis_by_its_ratio_to_the_data() {
        let chart = |at| Chart {
            series: vec![Series::new("pad", vec![(1.0, 1e3), (2.0, 1e6), (3.0, -1.0)])],
            lines: vec![line(at)],
            y_scale: Scale::logarithmic("N/m"),
            ..Chart::default()
        };
        for (at, is_near) in [(2.0, true), (1e8, true), (1e-3, false), (0.0, false), (-1e4, false)]
        {
            assert_eq!(chart(at).axes(5, 5).1.holds(at), is_near, "{at}");
        }
    }

    #[test]
    fn a_family_has_the_colours_of_its_order_and_others_their_own() {
        let series = |colour| Series {
            stroke: Some(Stroke { colour, pattern: Pattern::Solid }),
            ..Series::new("", vec![])
        };
        let chart =
            Chart { series: [2, 0, 1, 3].map(series).to_vec(), family: 3, ..Chart::default() };
        let colours = [0, 1, 2, 3].map(|index| chart.pen(index).colour);
        let ramp = [1.0, 0.0, 0.5].map(theme::ramp_colour);
        assert_eq!(colours, [ramp[0], ramp[1], ramp[2], theme::curve_colour(3)]);
    }

    #[test]
    fn curves_without_a_stroke_differ_in_colour_and_pattern() {
        let chart = Chart {
            series: vec![Series::new("exact", vec![]), Series::new("bdf", vec![])],
            ..Chart::default()
        };
        assert_eq!(chart.stroke(0).pattern, Pattern::Solid);
        assert_eq!(chart.stroke(1), Stroke { colour: 1, pattern: Pattern::Dashed });
    }
}
