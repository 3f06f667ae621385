//! Maps: a value over two quantities, as colours with lines of equal value; frame, axes and the bar of colours.

mod contours;
mod lines;

use std::fmt::Write as _;

use self::lines::{draw_path, text, upright};
use crate::{
    Scale,
    axis::{Axis, Frame},
    text_metrics::{clip_width, escape, one_line, text_width},
    theme,
};

/// A value over two quantities.
///
/// The points stand on a grid; values that are not finite are gaps.
///
/// # Examples
///
/// ```
/// use dashpot_plot::{Map, MapLimit, Scale};
///
/// let map = Map {
///     title: "Peak force".into(),
///     x_label: "stiffness (MN/m)".into(),
///     y_label: "damping (kN s/m)".into(),
///     value_label: "peak force (kN)".into(),
///     x: vec![5.0, 10.0, 20.0],
///     y: vec![2.0, 4.0],
///     values: vec![30.0, 34.0, 38.0, 31.0, 35.0, 40.0],
///     limits: vec![MapLimit {
///         values: vec![1.4, 1.1, 0.9, 1.2, 0.9, 0.8],
///         at: 1.0,
///         label: "as deep as it is thick".into(),
///     }],
///     ..Map::default()
/// };
/// assert!(map.svg().contains("as deep as it is thick"));
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Map {
    /// Heading.
    pub title: String,
    /// A remark below the heading; empty for none.
    pub note: String,
    /// Quantity and unit along the horizontal axis.
    pub x_label: String,
    /// Quantity and unit along the vertical axis.
    pub y_label: String,
    /// Scale of the horizontal axis.
    pub x_scale: Scale,
    /// Scale of the vertical axis.
    pub y_scale: Scale,
    /// Quantity and unit of the values.
    pub value_label: String,
    /// Places of the columns, ascending.
    pub x: Vec<f64>,
    /// Places of the rows, ascending.
    pub y: Vec<f64>,
    /// Values, row by row.
    pub values: Vec<f64>,
    /// Lines on which another quantity has a certain value.
    pub limits: Vec<MapLimit>,
}

/// A line on which a quantity has a certain value, such as that of a padding pressed to nothing.
#[derive(Debug, Clone, PartialEq)]
pub struct MapLimit {
    /// The quantity, row by row.
    pub values: Vec<f64>,
    /// Its value on the line.
    pub at: f64,
    /// Text at the line.
    pub label: String,
}

impl Map {
    /// Both axes, which end where the data do.
    fn axes(&self, ticks: (usize, usize)) -> (Axis, Axis) {
        let axis = |scale: &Scale, places: &[f64], ticks| {
            Axis::of(scale, places.iter().copied(), false, ticks)
        };
        (axis(&self.x_scale, &self.x, ticks.0), axis(&self.y_scale, &self.y, ticks.1))
    }

    /// The value at a column of a row; what is missing is a gap.
    fn value(&self, column: usize, row: usize) -> f64 {
        self.values.get(row * self.x.len() + column).copied().unwrap_or(f64::NAN)
    }
}

/// How far a cell reaches into its neighbours \[px\].
const OVERLAP: f64 = 0.6;

/// Width of the bar of colours \[px\].
const BAR: f64 = 16.0;
/// Room between the frame and the bar \[px\].
const GAP: f64 = 18.0;
/// Steps of the bar of colours.
const STEPS: usize = 64;

impl Map {
    /// The map as one SVG element, 760 pixels wide, without any outer resource.
    pub fn svg(&self) -> String {
        let (x, y) = self.axes((theme::X_TICKS, theme::Y_TICKS));
        let values = Axis::over(self.finite(), false, theme::Y_TICKS);
        let widest = |axis: &Axis| {
            let widths = axis.ticks().iter();
            widths
                .map(|width| text_width(&axis.tick_label(*width), theme::TICK_SIZE))
                .fold(0.0, f64::max)
        };
        let left = theme::MARGIN + 1.5 * theme::LABEL_SIZE + widest(&y) + 12.0;
        let beside = GAP + BAR + 8.0 + widest(&values) + 1.5 * theme::LABEL_SIZE;
        let right = theme::CHART_WIDTH - theme::MARGIN - beside;
        let note = if self.note.is_empty() { 0.0 } else { 1.4 * theme::TICK_SIZE };
        let top = theme::MARGIN + 1.5 * theme::TITLE_SIZE + note + 10.0;
        let bottom = top + theme::FRAME_HEIGHT;
        let frame = Frame { left, right, top, bottom, x, y };
        let height = (bottom + 2.6 * theme::LABEL_SIZE + theme::MARGIN + 8.0).ceil();
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" role=\"img\" font-family=\"{}\">\n<title>{}</title>\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"{}\"/>\n",
            theme::FONT,
            escape(&self.title),
            theme::PAPER.hex(),
            width = theme::CHART_WIDTH,
        );
        self.draw_cells(&mut svg, &frame, &values);
        self.draw_lines(&mut svg, &frame, &values);
        for limit in &self.limits {
            self.draw_limit(&mut svg, &frame, limit);
        }
        self.draw_axes(&mut svg, &frame);
        self.draw_bar(&mut svg, &frame, &values);
        svg + "</svg>\n"
    }

    fn finite(&self) -> impl Iterator<Item = f64> + '_ {
        self.values.iter().copied().filter(|value| value.is_finite())
    }

    /// One rectangle for each point, up to half-way to its neighbours.
    fn draw_cells(&self, svg: &mut String, frame: &Frame, values: &Axis) {
        let edges = |places: Vec<f64>| -> Vec<f64> {
            let inner = places.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
            let ends = [places.first(), places.last()].map(|own| own.copied().unwrap_or(0.0));
            [ends[0]].into_iter().chain(inner).chain([ends[1]]).collect()
        };
        let (x0, y0) = (self.x.first(), self.y.first());
        let (Some(&x0), Some(&y0)) = (x0, y0) else { return };
        let columns = edges(self.x.iter().map(|own| frame.at(*own, y0).0).collect());
        let rows = edges(self.y.iter().map(|own| frame.at(x0, *own).1).collect());
        svg.push_str("<g class=\"cells\" shape-rendering=\"crispEdges\">\n");
        for row in 0..self.y.len() {
            for column in 0..self.x.len() {
                let value = self.value(column, row);
                if !value.is_finite() {
                    continue;
                }
                let (left, right) = (columns[column], columns[column + 1]);
                let (bottom, top) = (rows[row], rows[row + 1]);
                // Each reaches under the next one, so that no light shines through between.
                let _ = writeln!(
                    svg,
                    "<rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{:.1}\" height=\"{:.1}\" \
                     fill=\"{}\"/>",
                    right - left + OVERLAP,
                    bottom - top + OVERLAP,
                    theme::map_colour(values.fraction(value)).hex()
                );
            }
        }
        svg.push_str("</g>\n");
    }

    fn draw_axes(&self, svg: &mut String, frame: &Frame) {
        let Frame { left, right, top, bottom, .. } = *frame;
        let _ = writeln!(
            svg,
            "<g class=\"axes\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\">\n\
             <rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{:.1}\" height=\"{:.1}\"/>",
            theme::INK.hex(),
            theme::LINE_WIDTH,
            right - left,
            bottom - top
        );
        let mut texts = Vec::new();
        let (x0, y0) = (self.x.first().copied(), self.y.first().copied());
        for &tick in frame.x.ticks() {
            let (at, _) = frame.at(tick, y0.unwrap_or(1.0));
            draw_path(svg, &[(at, bottom), (at, bottom + theme::MINOR_LENGTH)]);
            texts.push(text(
                (at, bottom + 18.0),
                "middle",
                theme::TICK_SIZE,
                &frame.x.tick_label(tick),
            ));
        }
        for &tick in frame.y.ticks() {
            let (_, at) = frame.at(x0.unwrap_or(1.0), tick);
            draw_path(svg, &[(left - theme::MINOR_LENGTH, at), (left, at)]);
            texts.push(text(
                (left - 8.0, at + 4.5),
                "end",
                theme::TICK_SIZE,
                &frame.y.tick_label(tick),
            ));
        }
        svg.push_str("</g>\n");
        let width = theme::CHART_WIDTH - theme::MARGIN - left;
        let title = clip_width(&one_line(&self.title), theme::TITLE_SIZE, width);
        let at = theme::MARGIN + theme::TITLE_SIZE;
        texts.push(text((left, at), "start", theme::TITLE_SIZE, &title));
        let note = clip_width(&one_line(&self.note), theme::TICK_SIZE, width);
        texts.push(text((left, at + 1.4 * theme::TITLE_SIZE), "start", theme::TICK_SIZE, &note));
        let x_label = clip_width(&frame.x.title(&self.x_label), theme::LABEL_SIZE, right - left);
        let middle = (0.5 * (left + right), bottom + 18.0 + 1.6 * theme::LABEL_SIZE);
        texts.push(text(middle, "middle", theme::LABEL_SIZE, &x_label));
        let y_label = clip_width(&frame.y.title(&self.y_label), theme::LABEL_SIZE, bottom - top);
        texts.push(upright(theme::MARGIN + theme::LABEL_SIZE, 0.5 * (top + bottom), &y_label));
        let _ = writeln!(svg, "<g class=\"texts\" fill=\"{}\">", theme::INK.hex());
        texts.iter().for_each(|text| svg.push_str(text));
        svg.push_str("</g>\n");
    }

    fn draw_bar(&self, svg: &mut String, frame: &Frame, values: &Axis) {
        let (left, height) = (frame.right + GAP, frame.bottom - frame.top);
        svg.push_str("<g class=\"bar\" shape-rendering=\"crispEdges\">\n");
        for step in 0..STEPS {
            let share = (step as f64 + 0.5) / STEPS as f64;
            let top = frame.bottom - (step + 1) as f64 / STEPS as f64 * height;
            let _ = writeln!(
                svg,
                "<rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{BAR}\" height=\"{:.1}\" fill=\"{}\"/>",
                height / STEPS as f64 + 0.1,
                theme::map_colour(share).hex()
            );
        }
        svg.push_str("</g>\n");
        let _ = writeln!(svg, "<g class=\"texts\" fill=\"{}\">", theme::INK.hex());
        for &tick in values.ticks() {
            let at = frame.bottom - values.fraction(tick) * height;
            let place = (left + BAR + 6.0, at + 4.5);
            svg.push_str(&text(place, "start", theme::TICK_SIZE, &values.tick_label(tick)));
        }
        let label = clip_width(&values.title(&self.value_label), theme::LABEL_SIZE, height);
        let at = theme::CHART_WIDTH - theme::MARGIN;
        svg.push_str(&upright(at, 0.5 * (frame.top + frame.bottom), &label));
        svg.push_str("</g>\n");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Scale, well_formed::assert_well_formed};

    fn map() -> Map {
        let (x, y): (Vec<f64>, Vec<f64>) =
            ((1..9).map(f64::from).collect(), vec![1.0, 10.0, 100.0]);
        let values =
            y.iter().flat_map(|b| x.iter().map(move |a| a + b.log10())).collect::<Vec<_>>();
        Map {
            title: "Peak force <&>".into(),
            note: "a remark".into(),
            x_label: "stiffness (MN/m)".into(),
            y_label: "damping".into(),
            y_scale: Scale::logarithmic("N s/m"),
            value_label: "peak force (kN)".into(),
            limits: vec![MapLimit { values: values.clone(), at: 4.5, label: "ξmax = 1".into() }],
            x,
            y,
            values,
            ..Map::default()
        }
    }

    #[test]
    fn every_point_is_a_cell_and_the_limit_a_line_with_its_text() {
        let svg = map().svg();
        assert_well_formed(&svg);
        assert_eq!(svg.matches("<rect").count(), 1 + 24 + 1 + STEPS);
        let limits = svg.split("class=\"limits\"").nth(1).unwrap();
        assert!(limits.split("</g>").next().unwrap().contains("<polyline"));
        assert!(svg.contains("ξmax = 1") && svg.contains("stiffness (MN/m)"));
        assert!(svg.contains("peak force (kN)") && svg.contains("a remark"));
    }

    #[test]
    fn gaps_are_left_blank_and_nothing_at_all_is_drawn_too() {
        let mut own = map();
        own.values[3] = f64::NAN;
        let svg = own.svg();
        assert_well_formed(&svg);
        assert_eq!(svg.matches("<rect").count(), 1 + 23 + 1 + STEPS);
        assert_well_formed(&Map::default().svg());
        let flat = Map { values: vec![2.0; 24], ..map() };
        assert_well_formed(&flat.svg());
    }

    #[test]
    fn lines_of_large_values_carry_their_power_of_ten() {
        let mut own = map();
        own.values.iter_mut().for_each(|value| *value *= 1e3);
        let svg = own.svg();
        let labels = svg.split("class=\"labels\"").nth(1).unwrap();
        assert!(labels.split("</g>").next().unwrap().contains("·10³"), "{svg}");
    }

    #[test]
    fn texts_of_limits_stay_within_the_frame() {
        let mut own = map();
        // A line through the corner of the lowest places.
        let value = |at: usize| if at % 8 + at / 8 < 2 { 0.0 } else { 1.0 };
        own.limits[0].values = (0..24).map(value).collect();
        own.limits[0].at = 0.5;
        let svg = own.svg();
        let number = |text: &str, key: &str| -> f64 {
            let rest = text.split(&format!(" {key}=\"")).nth(1).unwrap();
            rest.split('"').next().unwrap().parse().unwrap()
        };
        let frame = svg.split("class=\"axes\"").nth(1).unwrap().split("<rect").nth(1).unwrap();
        let text =
            svg.split("class=\"limit-labels\"").nth(1).unwrap().split("<text").nth(1).unwrap();
        let half = 0.5 * 1.12 * text_width("ξmax = 1", theme::TICK_SIZE);
        let (left, bottom) = (number(frame, "x"), number(frame, "y") + number(frame, "height"));
        assert!(number(text, "x") - half > left + 2.0, "{text}");
        assert!(number(text, "y") + 4.0 < bottom, "{text}");
    }
}
