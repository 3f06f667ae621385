//! Paths and texts of a map as SVG.

use std::fmt::Write as _;

use crate::{text_metrics::escape, theme};

/// A line through places on the canvas.
pub(super) fn draw_path(svg: &mut String, line: &[(f64, f64)]) {
    let places: Vec<String> = line.iter().map(|own| format!("{:.1},{:.1}", own.0, own.1)).collect();
    let _ = writeln!(svg, "<polyline points=\"{}\"/>", places.join(" "));
}

/// A text at a place on the canvas.
pub(super) fn text((x, y): (f64, f64), anchor: &str, size: f64, content: &str) -> String {
    if content.is_empty() {
        return String::new();
    }
    format!(
        "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\" font-size=\"{size}\">{}</text>\n",
        escape(content)
    )
}

/// A text along the vertical, which reads upwards.
pub(super) fn upright(x: f64, y: f64, content: &str) -> String {
    format!(
        "<text transform=\"translate({x:.1} {y:.1}) rotate(-90)\" text-anchor=\"middle\" \
         font-size=\"{}\">{}</text>\n",
        theme::LABEL_SIZE,
        escape(content)
    )
}
