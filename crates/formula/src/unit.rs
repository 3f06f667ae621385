//! Numbers with their units, where other things may follow.

use dashpot_units::{Quantity, parse_dimension, parse_quantity};

use crate::{FormulaError, FormulaFault};

/// The number at the start of `text`, without a sign: how many bytes it has; `None` where there is none.
pub(crate) fn number(text: &str) -> Option<usize> {
    let bytes = text.as_bytes();
    let digits =
        |from: usize| from + bytes[from..].iter().take_while(|byte| byte.is_ascii_digit()).count();
    let whole = digits(0);
    let mut end = whole;
    let mut count = whole;
    if bytes.get(end) == Some(&b'.') {
        end = digits(end + 1);
        count += end - whole - 1;
    }
    if count == 0 {
        return None;
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        let exponent = (end + 1 + sign).min(bytes.len());
        if digits(exponent) > exponent {
            end = digits(exponent);
        }
    }
    Some(end)
}

/// The quantity at the start of `text`, which begins with a number of so many bytes, and how many bytes it has with
/// its unit.
pub(crate) fn quantity(
    text: &str,
    number: usize,
    is_name: &dyn Fn(&str) -> bool,
) -> Result<(Quantity, usize), FormulaError> {
    let end = number
        + unit(&text[number..], is_name).map_err(|(word, at)| FormulaError {
            span: number + at..number + at + word.len(),
            fault: FormulaFault::Ambiguous { word },
        })?;
    let read = parse_quantity(&text[..end]);
    let read =
        read.map_err(|error| FormulaError { fault: FormulaFault::Quantity(error), span: 0..end })?;
    Ok((read, end))
}

fn spaces(text: &str) -> usize {
    text.len() - text.trim_start_matches([' ', '\t', '\u{a0}', '\u{202f}']).len()
}

fn is_symbol(own: char) -> bool {
    own.is_alphabetic() || matches!(own, '%' | '°' | '_')
}

/// How many bytes of `text`, which follows a number, are its unit; a word that is both a unit and a name, and its
/// place, where that cannot be told.
fn unit(text: &str, is_name: &dyn Fn(&str) -> bool) -> Result<usize, (String, usize)> {
    let mut end = 0;
    let mut at = spaces(text);
    // `0.5 1/MPa`
    if text[at..].starts_with("1/") {
        (end, at) = (at + 1, at + 1);
    }
    loop {
        let rest = &text[at..];
        let gap = at - end;
        if let Some(length) = factor(rest) {
            end = at + length;
        } else if let Some(operator @ ('*' | '·' | '⋅' | '/')) =
            rest.chars().next().filter(|_| end > 0)
        {
            let behind = at + operator.len_utf8();
            let next = behind + spaces(&text[behind..]);
            let (rest, word) = (&text[next..], word(&text[next..]));
            let is_tight = gap == 0 && next == behind;
            // Directly behind a unit, a word that is nothing else is one that is misspelt.
            let is_unit = is_tight && operator == '/' && is_nothing_else(word, rest, is_name);
            let meant = || factor(rest).filter(|_| is_unit);
            let Some(length) =
                group(rest, |own| !is_tight && is_name(own)).or_else(|| known(rest)).or_else(meant)
            else {
                return Ok(end);
            };
            if is_name(word) {
                match operator {
                    '/' if is_tight => {}
                    '/' => return Err((word.to_owned(), next)),
                    _ => return Ok(end),
                }
            }
            end = next + length;
        } else {
            return Ok(end);
        }
        at = end + spaces(&text[end..]);
    }
}

/// The word at the start of `text`.
fn word(text: &str) -> &str {
    let end = text.find(|own: char| !is_symbol(own)).unwrap_or(text.len());
    if text.starts_with("g0") { &text[..2] } else { &text[..end] }
}

/// A symbol with its power directly behind a number or another symbol: any word, which is an error where it is no
/// unit, because no name may stand there.
fn factor(text: &str) -> Option<usize> {
    let word = word(text);
    (!word.is_empty()).then(|| word.len() + power(&text[word.len()..]))
}

/// A symbol of a unit that is known, with its power.
fn known(text: &str) -> Option<usize> {
    let word = word(text);
    let is_unit = !word.is_empty() && parse_dimension(word).is_ok();
    is_unit.then(|| word.len() + power(&text[word.len()..]))
}

/// Whether a word at the start of `text` can be neither a name, nor a constant, nor a function.
fn is_nothing_else(word: &str, text: &str, is_name: &dyn Fn(&str) -> bool) -> bool {
    let rest = text[word.len()..].trim_start();
    let goes_on = rest.starts_with(|own: char| own.is_ascii_digit() || own == '-');
    !is_name(word) && !["pi", "π"].contains(&word) && !rest.starts_with('(') && !goes_on
}

/// A parenthesis around nothing but units, none of which `is_name`.
fn group(text: &str, is_name: impl Fn(&str) -> bool) -> Option<usize> {
    let inner = text.strip_prefix('(')?;
    let end = inner.find(')')?;
    let mut words = inner[..end].split(|own| !is_symbol(own)).filter(|word| !word.is_empty());
    let is_unit = words.clone().next().is_some()
        && parse_dimension(&inner[..end]).is_ok()
        && !words.any(is_name);
    is_unit.then_some(end + 2)
}

/// The power behind a symbol: `^-2`, `^1.5`, `^(2/3)`, `²`, `2`.
fn power(text: &str) -> usize {
    const RAISED: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻";
    let raised = text.find(|own: char| !RAISED.contains(own)).unwrap_or(text.len());
    if raised > 0 {
        return raised;
    }
    if let Some(inner) = text.strip_prefix("^(") {
        let is_inner = |own: char| own.is_ascii_digit() || "-./ ".contains(own);
        let end = inner.find(|own: char| !is_inner(own)).unwrap_or(inner.len());
        return if inner[end..].starts_with(')') { end + 3 } else { 0 };
    }
    let explicit = text.strip_prefix('^');
    let body = explicit.map_or(text, |body| body.strip_prefix('-').unwrap_or(body));
    let is_digit = |own: char| own.is_ascii_digit() || (own == '.' && explicit.is_some());
    let digits = body.find(|own: char| !is_digit(own)).unwrap_or(body.len());
    if digits == 0 { 0 } else { text.len() - body.len() + digits }
}
