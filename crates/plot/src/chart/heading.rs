//! The heading of a drawing: its title and a remark below, in as many lines as they take.

use crate::{
    text_metrics::{one_line, wrap_width},
    theme,
};

/// Most lines of a title and of a remark.
const MOST: usize = 3;
/// Height of a line \[font sizes\].
const LEADING: [f64; 2] = [1.35, 1.4];
/// Room below a title \[px\].
const ROOM: f64 = 3.0;

/// Lines of text below each other, and the height that they take.
#[derive(Debug)]
pub(crate) struct Heading {
    /// Upper edge \[px\], font size \[px\] and text of each line; the title's are in ink, those of the remark faint.
    pub(crate) lines: Vec<(f64, f64, String)>,
    /// Distance from the upper edge of the drawing to what stands below \[px\].
    pub(crate) bottom: f64,
}

impl Heading {
    /// Places a title and a remark in a width \[px\].
    pub(crate) fn new(title: &str, note: &str, width: f64) -> Self {
        let mut top = theme::MARGIN;
        let mut lines = Vec::new();
        let texts = [(title, theme::TITLE_SIZE), (note, theme::TICK_SIZE)];
        for ((text, size), leading) in texts.into_iter().zip(LEADING) {
            for line in wrap_width(&one_line(text), size, width, MOST) {
                lines.push((top, size, line));
                top += leading * size;
            }
            top += if size > theme::TICK_SIZE { ROOM } else { 0.0 };
        }
        Self { lines, bottom: top }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_stand_below_each_other() {
        let heading =
            Heading::new("Peak force of padding over velocity of head", "a remark", 200.0);
        assert!(heading.lines.len() >= 3);
        let is_apart = |pair: &[(f64, f64, String)]| pair[1].0 >= pair[0].0 + pair[0].1;
        assert!(heading.lines.windows(2).all(is_apart), "{heading:?}");
        let (top, size, _) = heading.lines.last().unwrap();
        assert!(heading.bottom >= top + size);
    }
}
