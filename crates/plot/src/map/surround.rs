//! What surrounds a map: frame, axes, heading and the bar of colours.

use std::fmt::Write as _;

use super::{
    Map,
    marks::{draw_path, text, upright},
    svg::Frame,
};
use crate::{
    axis::Axis,
    lettering::{clip_width, one_line},
    theme,
};

/// Width of the bar of colours \[px\].
pub(super) const BAR: f64 = 16.0;
/// Room between the frame and the bar \[px\].
pub(super) const GAP: f64 = 18.0;
/// Steps of the bar of colours.
pub(super) const STEPS: usize = 64;

impl Map {
    pub(super) fn draw_axes(&self, svg: &mut String, frame: &Frame) {
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

    pub(super) fn draw_bar(&self, svg: &mut String, frame: &Frame, values: &Axis) {
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
