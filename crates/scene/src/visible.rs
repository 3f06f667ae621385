//! Control characters, made visible.

use std::{borrow::Cow, fmt::Write as _};

/// Whether a character does something to a terminal instead of being seen: control characters but the
/// end of a line and the tab, and those that turn the direction of what is around them.
pub fn is_control(own: char) -> bool {
    let turns = matches!(own, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    own.is_control() && !matches!(own, '\n' | '\t') || turns
}

/// The text with its control characters as TOML and JSON write them in strings, `\u001b` for escape.
/// The end of a line may be a carriage return and a line feed.
///
/// # Examples
///
/// ```
/// assert_eq!(dashpot_scene::visible("\u{1b}]0;Kopf über Ζ\u{7}"), "\\u001b]0;Kopf über Ζ\\u0007");
/// ```
pub fn visible(text: &str) -> Cow<'_, str> {
    if !text.contains(is_control) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len());
    let mut all = text.chars().peekable();
    while let Some(own) = all.next() {
        let ends_line = own == '\r' && all.peek() == Some(&'\n');
        if is_control(own) && !ends_line {
            let _ = write!(shown, "\\u{:04x}", u32::from(own));
        } else {
            shown.push(own);
        }
    }
    Cow::Owned(shown)
}
