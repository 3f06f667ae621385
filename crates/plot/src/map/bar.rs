//! The bar of a map's colours, with arrows where values lie beyond them.

use std::fmt::Write as _;

use super::{
    BANDS,
    colours::Colours,
    texts::{text, upright},
};
use crate::{
    axis::Frame,
    text_metrics::{clip_width, text_width},
    theme,
};

/// Width of the bar \[px\].
const BAR: f64 = 16.0;
/// Room between the frame and the bar, and between the bar and its numbers \[px\].
const GAP: [f64; 2] = [18.0, 8.0];
/// Height of an arrow at an end \[px\].
const ARROW: f64 = 13.0;
/// Numbers nearer to an arrow than this are left out \[px\].
const CLEAR: f64 = 15.0;

/// Width of the bar with its numbers and its label, from the frame on \[px\].
pub(super) fn width(colours: &Colours) -> f64 {
    let ticks = colours.axis.ticks().iter().map(|own| colours.axis.tick_label(*own));
    let ends = colours.beyond.iter().flatten().map(|own| end_label(colours, *own));
    let widths = ticks.chain(ends).map(|own| text_width(&own, theme::TICK_SIZE));
    GAP[0] + BAR + GAP[1] + widths.fold(0.0, f64::max) + 1.5 * theme::LABEL_SIZE
}

/// What is said of values beyond the colours: `to 57.3`.
fn end_label(colours: &Colours, value: f64) -> String {
    let power = 10_f64.powf(value.abs().log10().floor() - 2.0);
    let rounded = if value == 0.0 { 0.0 } else { (value / power).round() * power };
    format!("to {}", colours.axis.tick_label(rounded))
}

/// Draws the bar, its numbers and its label at the right of the frame.
pub(super) fn draw(svg: &mut String, frame: &Frame, colours: &Colours, label: &str) {
    let left = frame.right + GAP[0];
    let [below, above] = colours.beyond.map(|own| if own.is_some() { ARROW } else { 0.0 });
    let (top, bottom) = (frame.top + above, frame.bottom - below);
    let height = bottom - top;
    svg.push_str("<g class=\"bar\">\n");
    for band in 0..BANDS {
        let upper = bottom - (band + 1) as f64 / BANDS as f64 * height;
        let _ = writeln!(
            svg,
            "<rect x=\"{left:.1}\" y=\"{upper:.1}\" width=\"{BAR}\" height=\"{:.1}\" fill=\"{}\" \
             shape-rendering=\"crispEdges\"/>",
            height / BANDS as f64 + 0.1,
            theme::map_colour((band as f64 + 0.5) / BANDS as f64).hex()
        );
    }
    let mut arrow = |base: f64, tip: f64, share: f64| {
        let (middle, right) = (left + 0.5 * BAR, left + BAR);
        let _ = writeln!(
            svg,
            "<polygon points=\"{left:.1},{base:.1} {right:.1},{base:.1} {middle:.1},{tip:.1}\" fill=\"{}\"/>",
            theme::map_colour(share).hex()
        );
    };
    let half = 0.5 / BANDS as f64;
    if below > 0.0 {
        arrow(bottom, frame.bottom, half);
    }
    if above > 0.0 {
        arrow(top, frame.top, 1.0 - half);
    }
    svg.push_str("</g>\n");
    let _ = writeln!(svg, "<g class=\"texts\" fill=\"{}\">", theme::INK.hex());
    let place = left + BAR + 6.0;
    for &tick in colours.axis.ticks() {
        let at = bottom - colours.axis.fraction(tick) * height;
        let is_clear = |is_told: bool, end: f64| !is_told || (at - end).abs() >= CLEAR;
        if is_clear(below > 0.0, frame.bottom - 4.5) && is_clear(above > 0.0, frame.top + 4.5) {
            let number = colours.axis.tick_label(tick);
            svg.push_str(&text((place, at + 4.5), "start", theme::TICK_SIZE, &number));
        }
    }
    let ends = colours.beyond.into_iter().zip([frame.bottom, frame.top + 9.0]);
    for (value, at) in ends.filter_map(|(own, at)| Some((own?, at))) {
        svg.push_str(&text((place, at), "start", theme::TICK_SIZE, &end_label(colours, value)));
    }
    let title = clip_width(
        &colours.axis.title(label),
        theme::LABEL_SIZE,
        frame.bottom - frame.top + theme::UPRIGHT_ROOM,
    );
    let at = left + width(colours) - GAP[0];
    svg.push_str(&upright(at, 0.5 * (frame.top + frame.bottom), &title));
    svg.push_str("</g>\n");
}
