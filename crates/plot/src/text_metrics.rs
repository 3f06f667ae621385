//! Text in drawings: escaping, estimated widths, cutting to a width.
//!
//! No font is at hand where a drawing is made, so widths are estimated from classes of characters, on the wide side.

/// `text` as XML character data: markup characters escaped, line breaks and tabs as spaces, and characters that XML
/// forbids or nobody sees replaced by U+FFFD.
pub fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match printable(c) {
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '&' => escaped.push_str("&amp;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            other => escaped.push(other),
        }
    }
    escaped
}

/// `text` on one line without control characters, for places that escape by themselves and for the terminal.
pub(crate) fn one_line(text: &str) -> String {
    text.chars().map(printable).collect()
}

/// Whether a character turns the direction of what is around it, has no width, separates lines, is a tag, or is never
/// a character.
fn is_hidden(c: char) -> bool {
    matches!(c,
        '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{200b}' | '\u{200e}'..='\u{200f}' | '\u{2028}'..='\u{202e}'
        | '\u{2060}'..='\u{206f}' | '\u{fdd0}'..='\u{fdef}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}'
        | '\u{fffe}'..='\u{ffff}' | '\u{e0000}'..='\u{e007f}')
}

fn printable(c: char) -> char {
    match c {
        '\n' | '\r' | '\t' => ' ',
        c if c.is_control() || is_hidden(c) => '\u{fffd}',
        c => c,
    }
}

/// Estimated width \[px\] of `text` in a sans-serif font of `size` \[px\].
pub(crate) fn text_width(text: &str, size: f64) -> f64 {
    let em: f64 = text.chars().map(em_width).sum();
    em * size
}

fn em_width(c: char) -> f64 {
    match (columns_of(c), c) {
        (0, _) => 0.0,
        (2, _) => 1.0,
        (_, 'i' | 'j' | 'l' | '.' | ',' | ':' | ';' | '\'' | '|' | '!' | ' ' | 'I') => 0.34,
        (_, 'm' | 'w' | 'M' | 'W' | '→' | '←' | '…' | '%' | '@') => 0.95,
        (_, c) if c.is_uppercase() => 0.72,
        _ => 0.61,
    }
}

/// Terminal columns that `text` takes.
pub(crate) fn columns(text: &str) -> usize {
    text.chars().map(columns_of).sum()
}

/// Terminal columns of one character: 0 for combining marks, 2 for East Asian wide characters and emoji, else 1
/// (the main blocks of Unicode's East Asian Width, UAX #11).
pub(crate) fn columns_of(c: char) -> usize {
    match u32::from(c) {
        0x0300..=0x036F | 0x200B..=0x200F | 0x20D0..=0x20FF | 0xFE00..=0xFE0F | 0xFEFF => 0,
        0x1100..=0x115F
        | 0x2E80..=0x303E
        | 0x3041..=0xA4CF
        | 0xAC00..=0xD7A3
        | 0xF900..=0xFAFF
        | 0xFE30..=0xFE6F
        | 0xFF00..=0xFF60
        | 0xFFE0..=0xFFE6
        | 0x1F300..=0x1F64F
        | 0x1F900..=0x1F9FF
        | 0x20000..=0x3FFFD => 2,
        _ => 1,
    }
}

/// `text` cut to `limit` columns, with an ellipsis where something is lost.
pub(crate) fn clip_columns(text: &str, limit: usize) -> String {
    clip(text, |part| columns(part) <= limit)
}

/// `text` cut to `limit` \[px\] at font size `size` \[px\], with an ellipsis where something is lost.
pub(crate) fn clip_width(text: &str, size: f64, limit: f64) -> String {
    clip(text, |part| text_width(part, size) <= limit)
}

/// `text` in at most `most` lines of `limit` \[px\] at font size `size` \[px\], broken at blanks; the last one is cut
/// where something is left. No line of nothing.
pub(crate) fn wrap_width(text: &str, size: f64, limit: f64, most: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) => {
                let longer = format!("{line} {word}");
                if lines.len() == most || text_width(&longer, size) <= limit {
                    let last = lines.len() - 1;
                    lines[last] = longer;
                } else {
                    lines.push(word.to_owned());
                }
            }
            None => lines.push(word.to_owned()),
        }
    }
    lines.iter().map(|line| clip_width(line, size, limit)).collect()
}

fn clip(text: &str, fits: impl Fn(&str) -> bool) -> String {
    if fits(text) {
        return text.to_owned();
    }
    let mut kept = String::from("…");
    for c in text.chars() {
        let at = kept.len() - '…'.len_utf8();
        kept.insert(at, c);
        if !fits(&kept) {
            kept.remove(at);
            break;
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markup_and_control_characters_cannot_leave_the_text() {
        assert_eq!(escape("a<b> & \"c\"\n\u{1}'"), "a&lt;b&gt; &amp; &quot;c&quot; \u{fffd}&#39;");
    }

    #[test]
    fn columns_count_wide_and_combining_characters() {
        assert_eq!(columns("Köpfe"), 5);
        assert_eq!(columns("頭部"), 4);
        assert_eq!(columns("o\u{308}"), 1);
    }

    #[test]
    fn wrapped_text_keeps_its_words_and_its_width() {
        let text = "Peak force of padding over velocity of head";
        let lines = wrap_width(text, 17.0, 200.0, 3);
        assert_eq!(lines.join(" "), text);
        assert!(lines.len() > 1 && lines.iter().all(|own| text_width(own, 17.0) <= 200.0));
        let cut = wrap_width(text, 17.0, 150.0, 1);
        assert!(cut.len() == 1 && cut[0].ends_with('…'), "{cut:?}");
        assert!(wrap_width(" ", 17.0, 150.0, 2).is_empty());
    }

    #[test]
    fn clipped_text_keeps_its_limit() {
        assert_eq!(clip_columns("padding", 7), "padding");
        assert_eq!(clip_columns("padding", 4), "pad…");
        assert_eq!(columns(&clip_columns("頭部頭部頭部", 6)), 5);
        assert!(text_width(&clip_width(&"w".repeat(90), 10.0, 200.0), 10.0) <= 200.0);
    }
}
