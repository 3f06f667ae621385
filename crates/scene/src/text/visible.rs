//! Control characters, made visible.

use std::{borrow::Cow, fmt::Write as _};

/// Whether a character does something to a terminal instead of being seen: control characters but the
/// end of a line and the tab, and hidden ones.
pub fn is_control(own: char) -> bool {
    own.is_control() && !matches!(own, '\n' | '\t') || is_hidden(own)
}

/// Whether a character is none to be seen: one that turns the direction of what is around it, has no
/// width, separates lines, is a tag or never a character. What joins letters or keeps them apart belongs to them.
pub fn is_hidden(own: char) -> bool {
    matches!(
        own,
        '\u{ad}'
            | '\u{61c}'
            | '\u{180e}'
            | '\u{200b}'
            | '\u{200e}'..='\u{200f}'
            | '\u{2028}'..='\u{202e}'
            | '\u{2060}'..='\u{206f}'
            | '\u{fdd0}'..='\u{fdef}'
            | '\u{feff}'
            | '\u{fff9}'..='\u{fffb}'
            | '\u{fffe}'..='\u{ffff}'
            | '\u{e0000}'..='\u{e007f}'
    )
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
            let _ = match u32::from(own) {
                code @ ..=0xffff => write!(shown, "\\u{code:04x}"),
                code => write!(shown, "\\U{code:08x}"),
            };
        } else {
            shown.push(own);
        }
    }
    Cow::Owned(shown)
}
