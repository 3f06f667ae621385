//! A map as SVG.

use std::fmt::Write as _;

use super::{Map, MapLimit, contours::contours};
use crate::{
    axis::Axis,
    lettering::{clip_width, escape, one_line, text_width},
    theme,
};

/// Width of the bar of colours \[px\].
const BAR: f64 = 16.0;
/// Room between the frame and the bar \[px\].
const GAP: f64 = 18.0;
/// Width of the lines of equal value and of limits \[px\].
const LINES: [f64; 2] = [0.9, 2.6];
/// Steps of the bar of colours.
const STEPS: usize = 64;
/// How far a cell reaches into its neighbours \[px\].
const OVERLAP: f64 = 0.6;
/// A line of equal value carries its number if it is longer than this \[px\].
const LEAST_LABELLED: f64 = 90.0;

/// Where everything is \[px\].
struct Frame {
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
    x: Axis,
    y: Axis,
}

impl Frame {
    fn at(&self, x: f64, y: f64) -> (f64, f64) {
        (
            self.left + self.x.fraction(x) * (self.right - self.left),
            self.bottom - self.y.fraction(y) * (self.bottom - self.top),
        )
    }
}

impl Map {
    /// The map as one SVG element, 760 pixels wide, without any outer resource.
    pub fn svg(&self) -> String {
        let (x, y) = self.axes((theme::X_TICKS, theme::Y_TICKS));
        let values = Axis::over(self.finite(), false, theme::Y_TICKS);
        let widest = |axis: &Axis| {
            let widths = axis.ticks().iter();
            widths
                .map(|own| text_width(&axis.tick_label(*own), theme::TICK_SIZE))
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
        self.values.iter().copied().filter(|own| own.is_finite())
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

    /// A place in units of the grid's steps on the canvas.
    fn place(&self, frame: &Frame, (column, row): (f64, f64)) -> (f64, f64) {
        let between = |places: &[f64], at: f64, canvas: &dyn Fn(f64) -> f64| {
            let first = at.floor();
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "places lie on the grid"
            )]
            let index = (first as usize).min(places.len().saturating_sub(1));
            let next = (index + 1).min(places.len().saturating_sub(1));
            let share = at - first;
            (1.0 - share) * canvas(places[index]) + share * canvas(places[next])
        };
        let (x0, y0) = (self.x[0], self.y[0]);
        (
            between(&self.x, column, &|own| frame.at(own, y0).0),
            between(&self.y, row, &|own| frame.at(x0, own).1),
        )
    }

    fn on_canvas(&self, frame: &Frame, values: &[f64], level: f64) -> Vec<Vec<(f64, f64)>> {
        if self.x.is_empty() || self.y.is_empty() || values.len() != self.x.len() * self.y.len() {
            return Vec::new();
        }
        let lines = contours(values, self.x.len(), level);
        let on_canvas = |line: Vec<(f64, f64)>| {
            line.into_iter().map(|own| self.place(frame, own)).collect::<Vec<_>>()
        };
        lines.into_iter().map(on_canvas).collect()
    }

    fn draw_lines(&self, svg: &mut String, frame: &Frame, values: &Axis) {
        let _ = writeln!(
            svg,
            "<g class=\"contours\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" \
             stroke-linejoin=\"round\">",
            theme::PAPER.hex(),
            LINES[0]
        );
        let mut texts = Vec::new();
        for &level in values.ticks() {
            let lines = self.on_canvas(frame, &self.values, level);
            lines.iter().for_each(|line| draw_path(svg, line));
            let longest = lines.iter().max_by(|a, b| length(a).total_cmp(&length(b)));
            if let Some(line) = longest.filter(|line| length(line) >= LEAST_LABELLED) {
                texts.push((line[line.len() / 2], values.tick_label(level)));
            }
        }
        svg.push_str("</g>\n");
        draw_texts(svg, frame, "labels", &texts, false);
    }

    fn draw_limit(&self, svg: &mut String, frame: &Frame, limit: &MapLimit) {
        let lines = self.on_canvas(frame, &limit.values, limit.at);
        let _ = writeln!(
            svg,
            "<g class=\"limits\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" \
             stroke-linejoin=\"round\">",
            theme::LIMIT.hex(),
            LINES[1]
        );
        lines.iter().for_each(|line| draw_path(svg, line));
        svg.push_str("</g>\n");
        if let Some(line) = lines.iter().max_by(|a, b| length(a).total_cmp(&length(b))) {
            let text = (line[line.len() / 3], one_line(&limit.label));
            draw_texts(svg, frame, "limit-labels", &[text], true);
        }
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
        for &own in frame.x.ticks() {
            let (at, _) = frame.at(own, y0.unwrap_or(1.0));
            draw_path(svg, &[(at, bottom), (at, bottom + theme::MINOR_LENGTH)]);
            texts.push(text(
                (at, bottom + 18.0),
                "middle",
                theme::TICK_SIZE,
                &frame.x.tick_label(own),
            ));
        }
        for &own in frame.y.ticks() {
            let (_, at) = frame.at(x0.unwrap_or(1.0), own);
            draw_path(svg, &[(left - theme::MINOR_LENGTH, at), (left, at)]);
            texts.push(text(
                (left - 8.0, at + 4.5),
                "end",
                theme::TICK_SIZE,
                &frame.y.tick_label(own),
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
        texts.iter().for_each(|own| svg.push_str(own));
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
        for &own in values.ticks() {
            let at = frame.bottom - values.fraction(own) * height;
            let place = (left + BAR + 6.0, at + 4.5);
            svg.push_str(&text(place, "start", theme::TICK_SIZE, &values.tick_label(own)));
        }
        let label = clip_width(&values.title(&self.value_label), theme::LABEL_SIZE, height);
        let at = theme::CHART_WIDTH - theme::MARGIN;
        svg.push_str(&upright(at, 0.5 * (frame.top + frame.bottom), &label));
        svg.push_str("</g>\n");
    }
}

fn length(line: &[(f64, f64)]) -> f64 {
    line.windows(2).map(|pair| (pair[1].0 - pair[0].0).hypot(pair[1].1 - pair[0].1)).sum()
}

fn draw_path(svg: &mut String, line: &[(f64, f64)]) {
    let places: Vec<String> = line.iter().map(|own| format!("{:.1},{:.1}", own.0, own.1)).collect();
    let _ = writeln!(svg, "<polyline points=\"{}\"/>", places.join(" "));
}

/// Texts on the map, with a border in the colour of the paper.
fn draw_texts(
    svg: &mut String,
    frame: &Frame,
    class: &str,
    texts: &[((f64, f64), String)],
    is_bold: bool,
) {
    let weight = if is_bold { " font-weight=\"bold\"" } else { "" };
    let _ = writeln!(
        svg,
        "<g class=\"{class}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"3\" \
         stroke-linejoin=\"round\" paint-order=\"stroke\"{weight}>",
        theme::INK.hex(),
        theme::PAPER.hex()
    );
    for (at, label) in texts {
        let half = 0.5 * text_width(label, theme::TICK_SIZE) + 4.0;
        let x = at.0.clamp(frame.left + half, (frame.right - half).max(frame.left + half));
        let y = (at.1 + 4.5).clamp(frame.top + theme::TICK_SIZE, frame.bottom - 4.0);
        svg.push_str(&text((x, y), "middle", theme::TICK_SIZE, label));
    }
    svg.push_str("</g>\n");
}

fn text((x, y): (f64, f64), anchor: &str, size: f64, content: &str) -> String {
    if content.is_empty() {
        return String::new();
    }
    format!(
        "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\" font-size=\"{size}\">{}</text>\n",
        escape(content)
    )
}

/// A text along the vertical, which reads upwards.
fn upright(x: f64, y: f64, content: &str) -> String {
    format!(
        "<text transform=\"translate({x:.1} {y:.1}) rotate(-90)\" text-anchor=\"middle\" \
         font-size=\"{}\">{}</text>\n",
        theme::LABEL_SIZE,
        escape(content)
    )
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
}
