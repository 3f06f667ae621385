//! The axes of a chart: grid, ticks, labels, and the heading above.

use plotters::{
    element::Text,
    style::{
        FontTransform,
        text_anchor::{HPos, Pos, VPos},
    },
};

use super::{
    Chart, Heading,
    canvas::{Area, Drawn, canvas, line, path, text_style},
};
use crate::{
    axis::Frame,
    text_metrics::{clip_width, one_line, text_width},
    theme,
};

impl Chart {
    /// Draws the grid, ticks, axes and what they are labelled with, in a drawing of this width \[px\]; the horizontal
    /// axis only where it `is_labelled`.
    pub(super) fn draw_axes(
        &self,
        area: &Area<'_>,
        frame: &Frame,
        width: f64,
        is_labelled: bool,
    ) -> Drawn {
        let Frame { left, right, top, bottom, .. } = *frame;
        let grid = line(theme::GRID, theme::HAIR_WIDTH);
        let tick = |pos| text_style(theme::TICK_SIZE, theme::INK, pos);
        for value in frame.x.ticks() {
            let (at, _) = frame.at(*value, 0.0);
            area.draw(&path(&[(at, top), (at, bottom)], grid))?;
            if !is_labelled {
                continue;
            }
            let style = tick(Pos::new(HPos::Center, VPos::Top));
            let label = frame.x.tick_label(*value);
            let room = 0.5 * text_width(&label, theme::TICK_SIZE);
            let at = at.min(width - room - 1.0);
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
        self.draw_labels(area, frame, width, is_labelled)
    }

    fn draw_labels(&self, area: &Area<'_>, frame: &Frame, width: f64, is_labelled: bool) -> Drawn {
        let Frame { top, bottom, .. } = *frame;
        let text = |text: &str, size: f64, room: f64| clip_width(&one_line(text), size, room);
        let x_label =
            text(&frame.x.title(&self.x_label), theme::LABEL_SIZE, width - 2.0 * theme::MARGIN);
        let below = text_style(theme::LABEL_SIZE, theme::INK, Pos::new(HPos::Center, VPos::Top));
        let at = canvas((frame.middle_of(&x_label, width), bottom + 13.0 + theme::TICK_SIZE));
        if is_labelled {
            area.draw(&Text::new(x_label, at, below))?;
        }
        let y_label = text(
            &frame.y.title(&self.y_label),
            theme::LABEL_SIZE,
            bottom - top + theme::UPRIGHT_ROOM,
        );
        let beside = text_style(theme::LABEL_SIZE, theme::INK, Pos::new(HPos::Center, VPos::Top))
            .transform(FontTransform::Rotate270);
        area.draw(&Text::new(y_label, canvas((theme::MARGIN, 0.5 * (top + bottom))), beside))
    }
}

/// Writes a heading from this place on \[px\].
pub(super) fn draw_heading(area: &Area<'_>, heading: &Heading, left: f64) -> Drawn {
    heading.lines.iter().try_for_each(|(top, size, text)| {
        let colour = if *size > theme::TICK_SIZE { theme::INK } else { theme::FAINT };
        let style = text_style(*size, colour, Pos::new(HPos::Left, VPos::Top));
        area.draw(&Text::new(text.clone(), canvas((left, *top)), style))
    })
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
