//! Texts as they go to a terminal: with our styles, and without any control character of others.
//!
//! Titles, names and files come from outside, and stand anywhere in a text. So all control characters
//! are made visible at the end, when the text is printed; until then our styles are marks that are no
//! characters.

use std::fmt::Write as _;

use clap::builder::styling::{AnsiColor, Style};
use dashpot_scene::visible;

/// What a text is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Tone {
    /// A heading.
    Heading,
    /// What the reader must know.
    Warning,
    /// Less important.
    Faint,
    /// The word before an error.
    Error,
    /// The word before a proposal.
    Help,
}

/// All of them, each with its mark; Unicode assigns no characters to these, and never will.
const MARKS: [(char, Tone); 5] = [
    ('\u{fdd0}', Tone::Heading),
    ('\u{fdd1}', Tone::Warning),
    ('\u{fdd2}', Tone::Faint),
    ('\u{fdd3}', Tone::Error),
    ('\u{fdd4}', Tone::Help),
];
/// Marks the end of a style.
const END: char = '\u{fdef}';

impl Tone {
    fn style(self) -> Style {
        match self {
            Self::Heading => Style::new().bold(),
            Self::Warning => AnsiColor::Yellow.on_default().bold(),
            Self::Faint => Style::new().dimmed(),
            Self::Error => AnsiColor::Red.on_default().bold(),
            Self::Help => AnsiColor::Cyan.on_default().bold(),
        }
    }
}

/// The text between the marks of a tone.
pub(crate) fn marked(tone: Tone, text: &str) -> String {
    let mark = MARKS.iter().find(|own| own.1 == tone).map(|own| own.0);
    mark.into_iter().chain(text.chars()).chain([END]).collect()
}

/// The text with styles for marks, and all else visible.
pub(crate) fn shown(text: &str) -> String {
    let visible = visible(text);
    let mut shown = String::with_capacity(visible.len());
    for char in visible.chars() {
        match MARKS.iter().find(|(mark, _)| *mark == char) {
            Some((_, tone)) => {
                let _ = write!(shown, "{}", tone.style());
            }
            None if char == END => {
                let _ = write!(shown, "{}", Tone::Heading.style().render_reset());
            }
            None => shown.push(char),
        }
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_our_styles_reach_a_terminal() {
        let text = format!("a{}\n", marked(Tone::Heading, "\u{1b}[31mb\u{9b}c"));
        assert_eq!(shown(&text), "a\u{1b}[1m\\u001b[31mb\\u009bc\u{1b}[0m\n");
    }
}
