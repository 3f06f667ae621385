//! Slips that TOML answers with a row of errors, put right so that each is told once.

use std::ops::Range;

use crate::diagnostics::{fault::Fault, fault_help::comma_help};

/// The text with all its slips put right, byte for byte as long as `text`, and the slips with their bytes.
///
/// Known are decimal commas in bare numbers and pairs of texts without brackets.
pub(crate) fn repaired(text: &str) -> (String, Vec<(Range<usize>, Fault)>) {
    let mut bytes = text.as_bytes().to_vec();
    let mut slips = Vec::new();
    let mut at = 0;
    while at < text.len() {
        match text.as_bytes()[at] {
            b'#' => at += rest_of_line(text, at),
            quote @ (b'"' | b'\'') => at += string(&text[at..], quote),
            b'=' => {
                let start = at + 1 + spaces(&text[at + 1..]);
                if let Some(length) = bare_comma(&text[start..]) {
                    let number = &text[start..start + length];
                    let comma = start + number.find(',').unwrap_or(0);
                    bytes[comma] = b'.';
                    let message =
                        format!("`{number}` has a comma: decimals are written with a point");
                    let fault = Fault::Syntax { message }.with_help(comma_help(number, ""));
                    slips.push((start..start + length, fault));
                    at = start + length;
                } else if let Some(pair) = bare_pair(&text[start..]) {
                    let end = start + pair.first.len() + pair.gap + pair.second.len();
                    // The brackets take the place of a space before and one within the pair.
                    if start > at + 1 && pair.gap > 1 {
                        let spaces = " ".repeat(pair.gap - 2);
                        let closed = format!("[{},{spaces}{}]", pair.first, pair.second);
                        bytes[start - 1..end].copy_from_slice(closed.as_bytes());
                        let message = "brackets are missing around a pair of nodes".to_owned();
                        let help = format!("write [{}, {}]", pair.first, pair.second);
                        slips.push((start..end, Fault::Syntax { message }.with_help(help)));
                    }
                    at = end;
                } else {
                    at = start;
                }
            }
            _ => at += 1,
        }
    }
    match String::from_utf8(bytes) {
        Ok(repaired) => (repaired, slips),
        Err(_) => (text.to_owned(), Vec::new()),
    }
}

fn rest_of_line(text: &str, at: usize) -> usize {
    text[at..].find('\n').unwrap_or(text.len() - at)
}

fn spaces(text: &str) -> usize {
    text.len() - text.trim_start_matches([' ', '\t']).len()
}

/// Length of the string at the start of `text`, which ends with its line at the latest.
fn string(text: &str, quote: u8) -> usize {
    let mut is_escaped = false;
    for (at, byte) in text.bytes().enumerate().skip(1) {
        match byte {
            b'\n' => return at,
            _ if is_escaped => is_escaped = false,
            b'\\' if quote == b'"' => is_escaped = true,
            byte if byte == quote => return at + 1,
            _ => {}
        }
    }
    text.len()
}

/// Whether a value may end before `text`.
fn ends(text: &str) -> bool {
    let rest = text.trim_start_matches([' ', '\t']);
    rest.is_empty() || rest.starts_with([',', '}', '\r', '\n', '#'])
}

/// Length of a number such as `5,5` at the start of `text`.
fn bare_comma(text: &str) -> Option<usize> {
    let sign = usize::from(text.starts_with(['+', '-']));
    let digits = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
    let whole = digits(&text[sign..]);
    let after = text[sign + whole..].strip_prefix(',')?;
    let decimals = digits(after);
    let length = sign + whole + 1 + decimals;
    (whole > 0 && decimals > 0 && ends(&text[length..])).then_some(length)
}

/// Two strings with a comma between them.
struct Pair<'t> {
    first: &'t str,
    /// Length of the comma and the spaces that follow it.
    gap: usize,
    second: &'t str,
}

/// Two strings such as `"head", "ground"` at the start of `text`.
fn bare_pair(text: &str) -> Option<Pair<'_>> {
    let quoted = |text: &str| {
        let quote = text.bytes().next().filter(|quote| matches!(quote, b'"' | b'\''))?;
        let length = string(text, quote);
        (length > 1 && text.as_bytes()[length - 1] == quote).then_some(length)
    };
    let first = quoted(text)?;
    let gap = text[first..].strip_prefix(',').map(|rest| 1 + spaces(rest))?;
    let end = first + gap + quoted(&text[first + gap..])?;
    // A quoted key of an inline table is followed by `=`.
    let pair = Pair { first: &text[..first], gap, second: &text[first + gap..end] };
    ends(&text[end..]).then_some(pair)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_are_put_right_in_place() {
        let table = [
            ("a = 5,5", "a = 5.5"),
            ("a = { b = -0,25, c = 1 }", "a = { b = -0.25, c = 1 }"),
            ("a = \"x\", \"y\" # b", "a =[\"x\",\"y\"] # b"),
            ("a = 'x',   'y'", "a =['x',  'y']"),
        ];
        for (text, expected) in table {
            let (found, slips) = repaired(text);
            assert_eq!((found.as_str(), slips.len()), (expected, 1), "{text}");
        }
    }

    #[test]
    fn nothing_else_is_touched() {
        for text in [
            "a = { b = 5,5 = 1 }",
            "a = [5,5]",
            "a = \"b = 5,5\"",
            "# a = 5,5",
            "a = \"x\", \"y\" = 1",
            "a=\"x\",\"y\"",
            "a = \"x\", \"y",
            "a = \"",
            "a = 5,5é",
            "=",
        ] {
            assert_eq!(repaired(text), (text.to_owned(), Vec::new()), "{text}");
        }
    }
}
