//! A chart as SVG, through plotters' SVG back-end.

use plotters::element::{Circle, Text};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontTransform};

use super::canvas::{
    Area, Drawn, Fault, canvas, dashes, draw_curve, draw_stem, layer, line, opening, path, pen,
    pixels, places, text_style,
};
use super::legend::{Entry, Legend, Sample, draw_texts};
use super::naming::{same_curves, same_name};
use super::{Chart, Direction, Pattern, ReferenceLine};
use crate::PlotError;
use crate::axis::{Ends, Frame};
use crate::decimation::Path;
use crate::text_metrics::{clip_width, escape, one_line, text_width};
use crate::theme;

impl Chart {
    /// The chart as one SVG element, 760 pixels wide, without any outer resource.
    ///
    /// # Errors
    ///
    /// [`PlotError::Backend`] when the drawing back-end refuses a shape.
    pub fn svg(&self) -> Result<String, PlotError> {
        self.draw().map_err(|fault| PlotError::Backend {
            title: self.title.clone(),
            reason: fault.to_string(),
        })
    }

    fn draw(&self) -> Result<String, Fault> {
        let (x, y) = self.axes(theme::X_TICKS, theme::Y_TICKS);
        let widest_tick = y
            .ticks()
            .iter()
            .map(|t| text_width(&y.tick_label(*t), theme::TICK_SIZE))
            .fold(0.0_f64, f64::max);
        let left = theme::MARGIN + 1.5 * theme::LABEL_SIZE + widest_tick + 12.0;
        let right = theme::CHART_WIDTH - theme::MARGIN - 8.0;
        let note_height = if self.note.is_empty() { 0.0 } else { 1.4 * theme::TICK_SIZE };
        let heading = theme::MARGIN + 1.5 * theme::TITLE_SIZE + note_height;
        let mut frame = Frame { left, right, top: 0.0, bottom: theme::FRAME_HEIGHT, x, y };
        let legend = Legend::new(self.entries(&frame), right - left);
        frame.top = heading + legend.height() + 10.0;
        frame.bottom = frame.top + theme::FRAME_HEIGHT;
        let size =
            (theme::CHART_WIDTH, frame.bottom + 2.6 * theme::LABEL_SIZE + theme::MARGIN + 8.0);

        let curves: Vec<Vec<Path>> =
            (0..self.series.len()).map(|index| self.curve(&frame, index)).collect();
        let mut svg = opening(size, &self.title);
        svg += &layer(size, "class=\"axes\"", |area| self.draw_axes(area, &frame))?;
        svg += &layer(size, "class=\"limits\" stroke-dasharray=\"70 50\"", |area| {
            self.draw_lines(area, &frame)
        })?;
        for (index, paths) in curves.iter().enumerate() {
            let stroke = self.stroke(index);
            let attributes = format!(
                "class=\"series\" data-name=\"{}\" stroke-linejoin=\"round\"{}",
                escape(&self.series[index].name),
                dashes(stroke.pattern)
            );
            svg += &layer(size, &attributes, |area| draw_curve(area, paths, stroke))?;
        }
        for entry in legend.entries() {
            let dashes = match entry.sample {
                Sample::Curve(stroke) => dashes(stroke.pattern),
                Sample::Line(_) => " stroke-dasharray=\"70 50\"",
            };
            let attributes = format!("class=\"sample\"{dashes}");
            svg += &layer(size, &attributes, |area| draw_sample(area, entry, (left, heading)))?;
        }
        let halo = |class: &str| {
            format!(
                "class=\"{class}\" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\" \
                 paint-order=\"stroke\"",
                theme::PAPER.hex(),
                pixels(theme::HALO_WIDTH)
            )
        };
        let texts = self.place_texts(&frame, &curves);
        svg += &layer(size, "class=\"leaders\"", |area| {
            let style = line(theme::FAINT, theme::HAIR_WIDTH);
            texts.leaders.iter().try_for_each(|ends| area.draw(&path(ends, style)))
        })?;
        svg += &layer(size, &halo("limit-labels"), |area| draw_texts(area, &texts.limits))?;
        svg += &layer(size, &halo("labels"), |area| {
            let disc =
                |at| Circle::new(at, pixels(theme::MARKER_RADIUS), theme::INK.rgb().filled());
            texts.discs.iter().try_for_each(|at| area.draw(&disc(canvas(*at))))?;
            draw_texts(area, &texts.markers)
        })?;
        svg += "</svg>\n";
        Ok(svg)
    }

    fn entries(&self, frame: &Frame) -> Vec<(Sample, String)> {
        let (x, y) = (&frame.x, &frame.y);
        let places: Vec<_> =
            (0..self.series.len()).map(|index| places(&self.curve(frame, index))).collect();
        let same = same_curves(&places, |a, b| self.stroke(a).pattern == self.stroke(b).pattern);
        let name = |index: usize| one_line(&self.series[index].name);
        let text = |index: usize| match same[index] {
            Some(host) => same_name(&name(index), &name(host), self.is_linear()),
            None => name(index),
        };
        let curves = self.series.iter().enumerate().filter(|(_, s)| !s.name.is_empty());
        let curves = curves.map(|(i, _)| (Sample::Curve(self.stroke(i)), text(i)));
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

    fn draw_axes(&self, area: &Area<'_>, frame: &Frame) -> Drawn {
        let Frame { left, right, top, bottom, .. } = *frame;
        let grid = line(theme::GRID, theme::HAIR_WIDTH);
        let tick = |pos| text_style(theme::TICK_SIZE, theme::INK, pos);
        for value in frame.x.ticks() {
            let (at, _) = frame.at(*value, 0.0);
            area.draw(&path(&[(at, top), (at, bottom)], grid))?;
            let style = tick(Pos::new(HPos::Center, VPos::Top));
            let label = frame.x.tick_label(*value);
            let room = 0.5 * text_width(&label, theme::TICK_SIZE);
            let at = at.min(theme::CHART_WIDTH - room - 1.0);
            area.draw(&Text::new(label, canvas((at, bottom + 7.0)), style))?;
        }
        for value in frame.y.ticks() {
            let at = bottom - frame.y.fraction(*value) * (bottom - top);
            area.draw(&path(&[(left, at), (right, at)], grid))?;
            let style = tick(Pos::new(HPos::Right, VPos::Center));
            area.draw(&Text::new(frame.y.tick_label(*value), canvas((left - 7.0, at)), style))?;
        }
        draw_minor_ticks(area, frame)?;
        let (x_zero, y_zero) = frame.at(0.0, 0.0);
        if frame.x.holds(0.0) {
            let ends = [(x_zero, top), (x_zero, bottom)];
            area.draw(&path(&ends, line(theme::FAINT, theme::HAIR_WIDTH)))?;
        }
        if frame.y.holds(0.0) {
            let ends = [(left, y_zero), (right, y_zero)];
            area.draw(&path(&ends, line(theme::FAINT, theme::HAIR_WIDTH)))?;
        }
        let border = [(left, top), (left, bottom), (right, bottom)];
        area.draw(&path(&border, line(theme::INK, theme::LINE_WIDTH)))?;
        self.draw_headings(area, frame)
    }

    fn draw_headings(&self, area: &Area<'_>, frame: &Frame) -> Drawn {
        let Frame { left, right, top, bottom, .. } = *frame;
        let width = theme::CHART_WIDTH - 2.0 * theme::MARGIN;
        let text = |text: &str, size: f64, room: f64| clip_width(&one_line(text), size, room);

        let corner = Pos::new(HPos::Left, VPos::Top);
        let title = text_style(theme::TITLE_SIZE, theme::INK, corner);
        let at = canvas((left, theme::MARGIN));
        area.draw(&Text::new(text(&self.title, theme::TITLE_SIZE, width - left), at, title))?;
        let note = text_style(theme::TICK_SIZE, theme::FAINT, corner);
        let at = canvas((left, theme::MARGIN + 1.5 * theme::TITLE_SIZE));
        area.draw(&Text::new(text(&self.note, theme::TICK_SIZE, width - left), at, note))?;

        let x_label = text(&frame.x.title(&self.x_label), theme::LABEL_SIZE, right - left);
        let below = text_style(theme::LABEL_SIZE, theme::INK, Pos::new(HPos::Center, VPos::Top));
        let at = canvas((0.5 * (left + right), bottom + 13.0 + theme::TICK_SIZE));
        area.draw(&Text::new(x_label, at, below))?;
        let y_label = text(&frame.y.title(&self.y_label), theme::LABEL_SIZE, bottom - top);
        let beside = text_style(theme::LABEL_SIZE, theme::INK, Pos::new(HPos::Center, VPos::Top))
            .transform(FontTransform::Rotate270);
        area.draw(&Text::new(y_label, canvas((theme::MARGIN, 0.5 * (top + bottom))), beside))
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

/// Short marks at the values between the labelled ones.
fn draw_minor_ticks(area: &Area<'_>, frame: &Frame) -> Drawn {
    let style = line(theme::FAINT, theme::HAIR_WIDTH);
    for value in frame.x.minor() {
        let at = frame.left + frame.x.fraction(*value) * (frame.right - frame.left);
        area.draw(&path(&[(at, frame.bottom - theme::MINOR_LENGTH), (at, frame.bottom)], style))?;
    }
    for value in frame.y.minor() {
        let at = frame.bottom - frame.y.fraction(*value) * (frame.bottom - frame.top);
        area.draw(&path(&[(frame.left, at), (frame.left + theme::MINOR_LENGTH, at)], style))?;
    }
    Ok(())
}

fn draw_sample(area: &Area<'_>, entry: &Entry, origin: (f64, f64)) -> Drawn {
    let (x, y) = (origin.0 + entry.x, origin.1 + entry.y);
    let ends = [(x, y), (x + Legend::SAMPLE, y)];
    match entry.sample {
        Sample::Curve(stroke) if stroke.pattern == Pattern::Stems => {
            let middle = x + 0.5 * Legend::SAMPLE;
            let reach = 0.4 * theme::TICK_SIZE;
            draw_stem(area, &[(middle, y + reach), (middle, y - reach)], stroke)?;
        }
        Sample::Curve(stroke) => area.draw(&path(&ends, pen(stroke)))?,
        Sample::Line(colour) => {
            area.draw(&path(&ends, line(theme::limit_colour(colour), theme::LINE_WIDTH)))?;
        }
    }
    let style = text_style(theme::TICK_SIZE, theme::INK, Pos::new(HPos::Left, VPos::Center));
    area.draw(&Text::new(entry.text.clone(), canvas((x + Legend::SAMPLE + 6.0, y)), style))
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
        assert_eq!(svg.matches("<circle").count(), 1);
    }
}
