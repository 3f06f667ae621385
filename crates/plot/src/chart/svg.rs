//! A chart as SVG, through plotters' SVG back-end.

use plotters::element::{Circle, Text};
use plotters::style::Color;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::axes::draw_heading;
use super::canvas::{
    Area, Drawn, Fault, band, canvas, dashes, draw_curve, draw_disc, draw_stem, layer, line,
    opening, path, pixels, places, shape, text_style,
};
use super::ends::{EndNames, draw_sample as draw_end};
use super::legend::{Entry, Legend, Sample, Texts, draw_texts};
use super::naming::{same_curves, same_name};
use super::{Chart, Direction, Heading, Pattern, ReferenceLine};
use crate::PlotError;
use crate::axis::{Axis, Ends, Frame};
use crate::decimation::Path;
use crate::text_metrics::{escape, one_line, text_width};
use crate::theme::{self, Sheet};

/// Where everything is in a drawing \[px\].
pub(super) struct Layout {
    pub(super) size: (f64, f64),
    pub(super) heading: Heading,
    pub(super) frame: Frame,
    pub(super) ends: Option<EndNames>,
    pub(super) legend: Legend,
    /// Upper left corner of the legend.
    pub(super) origin: (f64, f64),
    /// Whether the horizontal axis has its labels, which it has not where another chart is below.
    pub(super) is_labelled: bool,
}

impl Chart {
    /// The chart as one SVG element, 760 pixels wide, without any outer resource.
    ///
    /// # Errors
    ///
    /// [`PlotError::Backend`] when the drawing back-end refuses a shape.
    pub fn svg(&self) -> Result<String, PlotError> {
        self.on(theme::PAGE)
    }

    /// The same for a phone, 358 pixels wide, with texts of the same size.
    ///
    /// # Errors
    ///
    /// As those of [`Chart::svg`].
    pub fn narrow_svg(&self) -> Result<String, PlotError> {
        self.on(theme::PHONE)
    }

    fn on(&self, sheet: Sheet) -> Result<String, PlotError> {
        self.draw(sheet).map_err(|fault| PlotError::Backend {
            title: self.title.clone(),
            reason: fault.to_string(),
        })
    }

    fn draw(&self, sheet: Sheet) -> Result<String, Fault> {
        if let Some(below) = &self.below {
            return self.over(below, sheet);
        }
        let layout = self.layout(sheet);
        Ok(opening(layout.size, &self.title) + &self.drawn(&layout)? + "</svg>\n")
    }

    /// The drawing within its outermost element.
    pub(super) fn drawn(&self, layout: &Layout) -> Result<String, Fault> {
        let Layout { size, heading, frame, ends, legend, origin, is_labelled } = layout;
        let size = *size;
        let curves: Vec<Vec<Path>> =
            (0..self.series.len()).map(|index| self.curve(frame, index)).collect();
        let mut svg = layer(size, "class=\"axes\"", |area| {
            draw_heading(area, heading, frame.left)?;
            self.draw_axes(area, frame, size.0, *is_labelled)
        })?;
        svg += &layer(size, "class=\"limits\" stroke-dasharray=\"70 50\"", |area| {
            self.draw_lines(area, frame)
        })?;
        for (index, paths) in curves.iter().enumerate() {
            let pen = self.pen(index);
            let attributes = format!(
                "class=\"series\" data-name=\"{}\" stroke-linejoin=\"round\"{}",
                escape(&self.series[index].name),
                dashes(pen.pattern)
            );
            svg += &layer(size, &attributes, |area| draw_curve(area, paths, pen))?;
        }
        let arrowheads = self.arrowheads(frame, &curves);
        if !arrowheads.is_empty() {
            svg += &layer(size, "class=\"arrows\"", |area| {
                arrowheads.iter().try_for_each(|own| area.draw(&shape(&own.corners, own.colour)))
            })?;
        }
        for entry in legend.entries() {
            let dashes = match entry.sample {
                Sample::Curve(pen) => dashes(pen.pattern),
                Sample::Line(_) => " stroke-dasharray=\"70 50\"",
            };
            let attributes = format!("class=\"sample\"{dashes}");
            svg += &layer(size, &attributes, |area| draw_sample(area, entry, *origin))?;
        }
        if let Some(ends) = ends {
            let corner = (frame.right, frame.top);
            for sample in ends.samples() {
                let attributes = format!("class=\"end\"{}", dashes(sample.0.pattern));
                svg += &layer(size, &attributes, |area| draw_end(area, sample, corner))?;
            }
            svg += &layer(size, "class=\"names\"", |area| ends.draw(area, corner))?;
        }
        svg += &drawn_texts(size, &self.place_texts(frame, &curves, &arrowheads))?;
        Ok(svg)
    }

    /// Where everything is on a sheet.
    fn layout(&self, sheet: Sheet) -> Layout {
        let (x, y) = self.axes(sheet.x_ticks, sheet.y_ticks);
        let left = Self::left(&y);
        self.laid_out(sheet, (x, y), left)
    }

    /// Where the frame begins beside the labels of a vertical axis \[px\].
    pub(super) fn left(y: &Axis) -> f64 {
        let widths = y.ticks().iter().map(|own| text_width(&y.tick_label(*own), theme::TICK_SIZE));
        theme::MARGIN + 1.5 * theme::LABEL_SIZE + widths.fold(0.0_f64, f64::max) + 12.0
    }

    /// Where everything is on a sheet with these axes, whose frame begins there.
    pub(super) fn laid_out(&self, sheet: Sheet, (x, y): (Axis, Axis), left: f64) -> Layout {
        let right = sheet.width - theme::MARGIN - 8.0;
        let heading = Heading::new(&self.title, &self.note, right - left);
        let mut frame = Frame { left, right, top: 0.0, bottom: sheet.height, x, y };
        let ends = self.end_names(&frame, sheet.width);
        frame.right -= ends.as_ref().map_or(0.0, |ends| ends.width() - 8.0);
        let legend = Legend::new(self.entries(&frame, ends.is_none()), right - left);
        frame.top = heading.bottom + legend.height() + 10.0;
        frame.bottom = frame.top + sheet.height;
        let height = frame.bottom + 2.6 * theme::LABEL_SIZE + theme::MARGIN + 8.0;
        let origin = (left, heading.bottom);
        let size = (sheet.width, height);
        Layout { size, heading, frame, ends, legend, origin, is_labelled: true }
    }

    /// What stands in the legend: the curves, where they are `named` there, and the lines that are not drawn.
    fn entries(&self, frame: &Frame, named: bool) -> Vec<(Sample, String)> {
        let (x, y) = (&frame.x, &frame.y);
        let places: Vec<_> =
            (0..self.series.len()).map(|index| places(&self.curve(frame, index))).collect();
        let same = same_curves(&places, |a, b| self.stroke(a).pattern == self.stroke(b).pattern);
        let name = |index: usize| one_line(&self.series[index].name);
        let text = |index: usize| match same[index] {
            Some(host) => same_name(&name(index), &name(host), self.is_linear()),
            None => name(index),
        };
        let curves = self.series.iter().enumerate().filter(|(_, s)| named && !s.name.is_empty());
        let curves = curves.map(|(i, _)| (Sample::Curve(self.pen(i)), text(i)));
        let far = self.lines.iter().filter(|line| match line.direction {
            Direction::Horizontal => !y.holds(line.at),
            Direction::Vertical => !x.holds(line.at),
        });
        curves
            .chain(far.map(|l| {
                (Sample::Line(l.colour), format!("{} (off the axis)", one_line(&l.label)))
            }))
            .collect()
    }

    fn draw_lines(&self, area: &Area<'_>, frame: &Frame) -> Drawn {
        for (limit, ends) in self.limits(frame) {
            let colour = theme::limit_colour(limit.colour);
            area.draw(&path(&ends, line(colour, theme::LINE_WIDTH)))?;
        }
        Ok(())
    }

    /// The reference lines on the axes, with their ends.
    pub(super) fn limits(&self, frame: &Frame) -> Vec<(&ReferenceLine, Ends)> {
        let placed = self.lines.iter().filter_map(|limit| {
            let (x, y) = frame.at(limit.at, limit.at);
            let ends = match limit.direction {
                Direction::Horizontal if frame.y.holds(limit.at) => {
                    [(frame.left, y), (frame.right, y)]
                }
                Direction::Vertical if frame.x.holds(limit.at) => {
                    [(x, frame.top), (x, frame.bottom)]
                }
                _ => return None,
            };
            Some((limit, ends))
        });
        placed.collect()
    }
}

fn draw_sample(area: &Area<'_>, entry: &Entry, origin: (f64, f64)) -> Drawn {
    let (x, y) = (origin.0 + entry.x, origin.1 + entry.y);
    let ends = [(x, y), (x + Legend::SAMPLE, y)];
    match entry.sample {
        Sample::Curve(pen) if pen.pattern == Pattern::Stems => {
            let middle = x + 0.5 * Legend::SAMPLE;
            let reach = 0.4 * theme::TICK_SIZE;
            draw_stem(area, &[(middle, y + reach), (middle, y - reach)], pen)?;
        }
        Sample::Curve(pen) if pen.pattern == Pattern::Points => {
            for part in [0.15, 0.5, 0.85] {
                draw_disc(area, (x + part * Legend::SAMPLE, y), pen)?;
            }
        }
        Sample::Curve(pen) if pen.pattern == Pattern::Band => {
            let (right, reach) = (ends[1].0, 0.4 * theme::TICK_SIZE);
            let corners = [(x, y - reach), (right, y - reach), (right, y + reach), (x, y + reach)];
            area.draw(&band(&corners, pen.colour))?;
        }
        Sample::Curve(pen) => area.draw(&path(&ends, pen.style()))?,
        Sample::Line(colour) => {
            area.draw(&path(&ends, line(theme::limit_colour(colour), theme::LINE_WIDTH)))?;
        }
    }
    let style = text_style(theme::TICK_SIZE, theme::INK, Pos::new(HPos::Left, VPos::Center));
    area.draw(&Text::new(entry.text.clone(), canvas((x + Legend::SAMPLE + 6.0, y)), style))
}

/// What stands within the frame beside curves.
fn drawn_texts(size: (f64, f64), texts: &Texts) -> Result<String, Fault> {
    let mut svg = layer(size, "class=\"leaders\"", |area| {
        let style = line(theme::FAINT, theme::HAIR_WIDTH);
        texts.leaders.iter().try_for_each(|ends| area.draw(&path(ends, style)))
    })?;
    svg += &on_halo(size, "limit-labels", |area| draw_texts(area, &texts.limits))?;
    svg += &on_halo(size, "labels", |area| {
        let disc = |at| Circle::new(at, pixels(theme::MARKER_RADIUS), theme::INK.rgb().filled());
        texts.discs.iter().try_for_each(|at| area.draw(&disc(canvas(*at))))?;
        draw_texts(area, &texts.markers)
    })?;
    Ok(svg)
}

/// What is drawn on an edge of paper. The edge is drawn for itself, below all else: not every program that shows SVG
/// knows another order of strokes.
fn on_halo(
    size: (f64, f64),
    class: &str,
    draw: impl Fn(&Area<'_>) -> Drawn,
) -> Result<String, Fault> {
    let halo = format!("{} stroke-width=\"{}\"", theme::halo(), pixels(theme::HALO_WIDTH));
    Ok(layer(size, &halo, &draw)? + &layer(size, &format!("class=\"{class}\""), &draw)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::well_formed::assert_well_formed;
    use crate::{Marker, Scale, Series, Stroke};

    fn chart(points: Vec<(f64, f64)>) -> Chart {
        Chart {
            title: "Köpfe <&>".into(),
            x_label: "time (ms)".into(),
            y_label: "force (kN)".into(),
            series: vec![Series::new("exact", points.clone()), Series::new("bdf", points)],
            ..Chart::default()
        }
    }

    /// The coordinates of every polyline in a curve's group.
    fn drawn(svg: &str, name: &str) -> Vec<Vec<(f64, f64)>> {
        let group =
            svg.split("<g ").find(|g| g.contains(&format!("data-name=\"{name}\""))).unwrap();
        let lists = group.split("points=\"").skip(1).map(|rest| rest.split('"').next().unwrap());
        let point = |pair: &str| {
            let (x, y) = pair.split_once(',').unwrap();
            (x.parse().unwrap(), y.parse().unwrap())
        };
        lists.map(|list| list.split_whitespace().map(point).collect()).collect()
    }

    #[test]
    fn both_of_two_equal_curves_are_drawn_and_the_second_is_dashed() {
        let svg = chart(vec![(0.0, 0.0), (1.0, 38.4), (2.0, -9.7)]).svg().unwrap();
        assert_well_formed(&svg);
        assert_eq!(drawn(&svg, "exact"), drawn(&svg, "bdf"));
        let groups: Vec<&str> = svg.split("<g ").filter(|g| g.contains("data-name")).collect();
        assert!(!groups[0].contains("stroke-dasharray") && groups[1].contains("stroke-dasharray"));
        for text in ["time (ms)", "force (kN)", "Köpfe &lt;&amp;&gt;", "exact", "bdf", "−10"] {
            assert!(svg.contains(text), "{text}");
        }
    }

    #[test]
    fn drawn_points_are_the_data_on_a_linear_scale() {
        let data = [(0.0, 0.0), (1.0, 38.4), (2.0, 10.0)];
        let svg = chart(data.to_vec()).svg().unwrap();
        let points = drawn(&svg, "exact").remove(0);
        let slope = (points[1].1 - points[0].1) / 38.4;
        assert!((points[2].1 - points[0].1 - slope * 10.0).abs() <= 1.0, "{points:?}");
        assert!((points[1].0 - 0.5 * (points[0].0 + points[2].0)).abs() <= 1.0, "{points:?}");
    }

    #[test]
    fn a_long_signal_keeps_its_extremes_in_a_small_file() {
        let mut points: Vec<(f64, f64)> = (0..200_000).map(|i| (f64::from(i), 0.0)).collect();
        points[123_456].1 = 7.0;
        points[123_457].1 = -3.0;
        let svg = chart(points).svg().unwrap();
        assert!(svg.len() < 300_000, "{}", svg.len());
        let curve = drawn(&svg, "exact").remove(0);
        let heights: Vec<f64> = curve.iter().map(|p| p.1).collect();
        let (top, bottom) =
            heights.iter().fold((f64::MAX, 0.0_f64), |(l, h), y| (l.min(*y), h.max(*y)));
        let zero = heights[0];
        assert!(((zero - top) * 3.0 - (bottom - zero) * 7.0).abs() < 12.0, "{top} {zero} {bottom}");
    }

    #[test]
    fn values_that_are_not_finite_leave_gaps() {
        let points = vec![(0.0, 0.0), (1.0, 1.0), (2.0, f64::NAN), (3.0, 1.0), (4.0, 0.0)];
        let svg = chart(points).svg().unwrap();
        assert_eq!(drawn(&svg, "exact").len(), 2);
        assert!(!svg.contains("NaN"));
    }

    #[test]
    fn any_data_give_a_well_formed_drawing() {
        let hard = [
            vec![],
            vec![(0.0, 0.0)],
            vec![(f64::NAN, f64::NAN)],
            vec![(1.0, 5.0), (2.0, 5.0)],
            vec![(-f64::MAX, f64::MAX), (f64::MAX, -f64::MAX)],
            vec![(0.0, 1e-320), (1e-320, 0.0)],
        ];
        for points in hard {
            let mut chart = chart(points);
            chart.markers.push(Marker { x: f64::NAN, y: 1.0, label: "nowhere".into() });
            chart.lines.push(ReferenceLine {
                direction: Direction::Vertical,
                at: f64::INFINITY,
                label: "never".into(),
                colour: None,
            });
            assert_well_formed(&chart.svg().unwrap());
        }
    }

    #[test]
    fn powers_are_straight_on_logarithmic_axes_and_values_without_logarithm_break_them() {
        let powers = (-4..=4).map(|e| 10_f64.powi(e)).map(|x| (x, x * x));
        let mut points: Vec<_> = powers.chain([(1e5, 0.0), (-1.0, 1.0), (0.0, 1e8)]).collect();
        points.extend([(1e6, 1e12), (1e7, 1e14)]);
        let mut chart = chart(points);
        chart.x_scale = Scale::logarithmic("s");
        chart.y_scale = Scale::logarithmic("");
        let svg = chart.svg().unwrap();
        assert_well_formed(&svg);
        let curves = drawn(&svg, "exact");
        assert_eq!(curves.iter().map(Vec::len).collect::<Vec<_>>(), [9, 2]);
        let steps = curves[0].windows(2).map(|p| (p[1].0 - p[0].0, p[1].1 - p[0].1));
        let (dx, dy) = (curves[1][1].0 - curves[1][0].0, curves[1][1].1 - curves[1][0].1);
        // Places are rounded to whole numbers on the oversampled canvas.
        assert!(steps.into_iter().all(|s| (s.0 - dx).abs() <= 1.0 && (s.1 - dy).abs() <= 1.0));
        assert!(!svg.contains("NaN"));
    }

    #[test]
    fn stems_are_lines_with_discs() {
        let mut chart = chart(vec![(1e-3, 1e6), (1.0, 1e3), (10.0, 0.0)]);
        chart.series.truncate(1);
        chart.series[0].stroke = Some(Stroke { colour: 1, pattern: Pattern::Stems });
        (chart.x_scale, chart.y_scale) = (Scale::logarithmic("s"), Scale::logarithmic("N/m"));
        let svg = chart.svg().unwrap();
        let stems = drawn(&svg, "exact");
        assert_eq!(stems.len(), 2);
        let near = |a: f64, b: f64| (a - b).abs() < 0.5;
        let is_upright = |s: &Vec<(f64, f64)>| near(s[0].0, s[1].0) && near(s[0].1, stems[0][0].1);
        assert!(stems.iter().all(is_upright), "{stems:?}");
        assert_eq!(svg.matches("<circle").count(), 3, "one in the legend");
    }

    #[test]
    fn the_legend_names_curves_hidden_under_an_equal_one() {
        let mut chart = chart(vec![(0.0, 0.0), (1.0, 17.5), (2.0, 3.0)]);
        let stroke = |colour, pattern| Some(Stroke { colour, pattern });
        for (index, series) in chart.series.iter_mut().enumerate() {
            series.stroke = stroke(index, Pattern::Solid);
        }
        assert!(chart.svg().unwrap().contains("bdf = exact"));
        assert!(chart.text(80, 12).contains("bdf = exact"));
        chart.series[0].stroke = stroke(0, Pattern::Broad);
        assert!(!chart.svg().unwrap().contains("bdf = exact"), "both are seen");
    }

    #[test]
    fn a_limit_and_its_text_have_the_colour_of_their_curve() {
        let mut chart = chart(vec![(0.0, 0.0), (1.0, 17.5)]);
        let direction = Direction::Horizontal;
        let label = "thickness of hard: 10 mm".into();
        chart.lines.push(ReferenceLine { direction, at: 10.0, label, colour: Some(1) });
        let svg = chart.svg().unwrap();
        let colour = theme::curve_colour(1).hex();
        for class in ["limits", "limit-labels"] {
            let group = svg.split("<g ").find(|g| g.contains(&format!("class=\"{class}\"")));
            assert!(group.unwrap().contains(&colour), "{class}");
        }
    }

    #[test]
    fn limits_and_markers_carry_their_labels() {
        let mut chart = chart(vec![(0.0, 0.0), (1.0, 17.5)]);
        chart.markers.push(Marker { x: 1.0, y: 17.5, label: "deepest 17.5 mm".into() });
        let limit = |at, label: &str| ReferenceLine {
            direction: Direction::Horizontal,
            at,
            label: label.into(),
            colour: None,
        };
        chart.lines.extend([limit(20.0, "thickness 20 mm"), limit(500.0, "ceiling")]);
        let svg = chart.svg().unwrap();
        for text in ["deepest 17.5 mm", "thickness 20 mm", "ceiling (off the axis)"] {
            assert!(svg.contains(text), "{text}");
        }
        // The edge of paper is drawn first, of the same disc and text.
        let (below, own) = svg.split_once("<g class=\"labels\"").unwrap();
        let halo = below.rsplit("<g class=\"halo\"").next().unwrap();
        for part in [halo, own] {
            assert_eq!(part.matches("<circle").count(), 1);
            assert_eq!(part.matches("deepest 17.5 mm").count(), 1);
        }
        assert!(!svg.contains("paint-order"));
    }
}
