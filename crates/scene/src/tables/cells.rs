//! Fields of a line, and the numbers that they are.

use std::{borrow::Cow, ops::Range};

use dashpot_units::{UnitError, parse_dimension, parse_quantity};

use super::{fault::TableFault, guard::unguarded};

/// What stands between the fields of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Separator {
    /// One character.
    Mark(char),
    /// Spaces and tabs, any number of them.
    Spaces,
}

/// What stands before the decimals of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Decimal {
    Point,
    Comma,
}

/// One field of a line and where it stands in the text.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Field<'t> {
    /// Without spaces and quotes around it.
    pub(crate) text: &'t str,
    /// Its first byte.
    pub(crate) at: usize,
}

impl<'t> Field<'t> {
    /// The bytes of the field.
    pub(crate) fn span(&self) -> Range<usize> {
        self.at..self.at + self.text.len()
    }

    /// The name and the unit of a column: `force` and `kN` in `force [kN]`, `force (kN)`, `force / kN` and
    /// `force in kN`. Without brackets a unit is one only where it can be read.
    pub(super) fn name_and_unit(&self) -> (&'t str, Option<Self>) {
        let text = unguarded(self.text);
        let at = self.at + self.text.len() - text.len();
        let open = match text.chars().last() {
            Some(']') => text.rfind('['),
            Some(')') => text.rfind('('),
            _ => None,
        };
        if let Some(open) = open {
            let unit = trimmed(&text[open + 1..text.len() - 1], at + open + 1);
            return (text[..open].trim_end(), Some(unit));
        }
        for between in [" / ", " in "] {
            if let Some(from) = text.rfind(between) {
                let unit = trimmed(&text[from + between.len()..], at + from + between.len());
                if is_unit(unit.text) {
                    return (text[..from].trim_end(), Some(unit));
                }
            }
        }
        (text, None)
    }

    /// The field without brackets around all of it: the unit in a row of units.
    pub(super) fn bare_unit(&self) -> Self {
        let inner = [('[', ']'), ('(', ')')]
            .into_iter()
            .find_map(|(open, close)| self.text.strip_prefix(open)?.strip_suffix(close));
        inner.map_or(*self, |inner| trimmed(inner, self.at + 1))
    }

    /// The number that the field is, without a unit.
    pub(super) fn number(&self, decimal: Decimal) -> Result<f64, TableFault> {
        match decimal {
            Decimal::Point => number(self.text, self.text),
            Decimal::Comma => match (self.text.contains('.'), self.text.matches(',').count()) {
                (false, 0) => number(self.text, self.text),
                (false, 1) => number(&self.text.replacen(',', ".", 1), self.text),
                (true, 0) => Err(TableFault::PointAmongCommas { text: self.text.to_owned() }),
                _ => Err(TableFault::Thousands { text: self.text.to_owned() }),
            },
        }
    }

    /// Whether the field is a number, whichever its decimal mark is.
    pub(super) fn is_number(&self) -> bool {
        number_and_rest(self.text).is_some_and(|(_, rest)| rest.is_empty())
    }

    /// Whether the field begins as a number does.
    pub(super) fn begins_with_number(&self) -> bool {
        number_and_rest(self.text).is_some()
    }

    /// Whether the field is a number or was meant as one: with a unit, not finite, or with marks between thousands.
    pub(crate) fn is_like_number(&self) -> bool {
        let bare = self.text.trim_start_matches(SIGNS);
        if ["nan", "inf", "infinity"].into_iter().any(|word| bare.eq_ignore_ascii_case(word)) {
            return true;
        }
        number_and_rest(self.text).is_some_and(|(_, rest)| {
            let after = rest.trim_start_matches([' ', '\u{a0}', '\u{202f}', '\'', '’', '_']);
            let goes_on =
                after.len() < rest.len() && after.starts_with(|first: char| first.is_ascii_digit());
            rest.is_empty() || goes_on || is_unit(rest.trim())
        })
    }
}

const SIGNS: [char; 2] = ['+', '-'];

/// The number `text`, which was written as `written`.
fn number(text: &str, written: &str) -> Result<f64, TableFault> {
    if text.is_empty() {
        return Err(TableFault::EmptyCell);
    }
    let is_plain = text.bytes().all(|byte| matches!(byte, b'0'..=b'9' | b'.' | b'-'));
    if is_plain && let Some(value) = text.parse::<f64>().ok().filter(|own| own.is_normal()) {
        return Ok(value);
    }
    let written = || written.to_owned();
    match parse_quantity(text) {
        Ok(quantity) if quantity.dimension.is_none() => Ok(quantity.value),
        Ok(_) => Err(TableFault::UnitInCell { text: written() }),
        Err(
            error @ (UnitError::DecimalComma { .. }
            | UnitError::Separated { .. }
            | UnitError::NotFinite { .. }
            | UnitError::TooLarge { .. }
            | UnitError::TooSmall { .. }),
        ) => Err(TableFault::Unreadable(error)),
        Err(_) => Err(TableFault::NoNumber { text: written() }),
    }
}

/// What looks like a number at the beginning of `text`, without its sign, and what follows.
fn number_and_rest(text: &str) -> Option<(&str, &str)> {
    let bare = text.strip_prefix(SIGNS).unwrap_or(text);
    let is_part = |own: char| own.is_ascii_digit() || matches!(own, '.' | ',');
    let end = bare.find(|own| !is_part(own)).unwrap_or(bare.len());
    if !bare[..end].contains(|own: char| own.is_ascii_digit()) {
        return None;
    }
    let exponent = bare[end..].strip_prefix(['e', 'E']).map_or(0, |power| {
        let digits = power.strip_prefix(SIGNS).unwrap_or(power);
        let stop = digits.find(|own: char| !own.is_ascii_digit()).unwrap_or(digits.len());
        if stop == 0 { 0 } else { bare.len() - end - (digits.len() - stop) }
    });
    Some((&bare[..end], &bare[end + exponent..]))
}

/// The decimal mark of a field that shows one: that of `0,5`, not of `1,000`, where a comma may as well stand
/// between thousands. `Err` where it cannot be told.
pub(super) fn decimal_of(field: &Field<'_>) -> Option<Result<Decimal, ()>> {
    let (mantissa, rest) = number_and_rest(field.text)?;
    if !rest.is_empty() {
        return None;
    }
    let commas = mantissa.matches(',').count();
    match (mantissa.contains('.'), commas) {
        (false, 0) => None,
        // A point between thousands stands before a decimal comma: `1.234,5`.
        (true, _) if mantissa.rfind('.') < mantissa.rfind(',') => Some(Ok(Decimal::Comma)),
        (false, 1) => {
            let (whole, decimals) = mantissa.split_once(',')?;
            let may_be_thousands =
                decimals.len() == 3 && (1..=3).contains(&whole.len()) && !whole.starts_with('0');
            Some(if may_be_thousands { Err(()) } else { Ok(Decimal::Comma) })
        }
        // A point for decimals, or commas between thousands.
        _ => Some(Ok(Decimal::Point)),
    }
}

/// Whether a text is a unit that can be read, or the sign for none.
pub(super) fn is_unit(text: &str) -> bool {
    is_no_unit(text) || (!text.is_empty() && parse_dimension(&spelt(text)).is_ok())
}

/// A unit with its symbol for the second, which machines write as `sec`.
pub(super) fn spelt(unit: &str) -> Cow<'_, str> {
    if unit.contains("sec") { unit.replace("sec", "s").into() } else { unit.into() }
}

/// Whether a text says that a column has no unit.
pub(crate) fn is_no_unit(text: &str) -> bool {
    matches!(text, "-" | "–" | "—" | "1")
}

/// The fields of a line that begins at `at`. A separator between quotes separates nothing, and empty fields at
/// the end of the line are none.
pub(super) fn split<'t>(
    line: &'t str,
    at: usize,
    separator: Separator,
    fields: &mut Vec<Field<'t>>,
) {
    fields.clear();
    match separator {
        Separator::Mark(mark) => split_by(line, at, mark, fields),
        Separator::Spaces => split_words(line, at, fields),
    }
    while fields.len() > 1 && fields.last().is_some_and(|last| last.text.is_empty()) {
        fields.pop();
    }
}

fn split_by<'t>(line: &'t str, at: usize, mark: char, fields: &mut Vec<Field<'t>>) {
    let (mut start, mut quoted) = (0, false);
    for (place, found) in line.char_indices() {
        if found == '"' {
            quoted = !quoted;
        } else if found == mark && !quoted {
            fields.push(trimmed(&line[start..place], at + start));
            start = place + mark.len_utf8();
        }
    }
    fields.push(trimmed(&line[start..], at + start));
}

/// Words between spaces; a unit in brackets belongs to the name before it.
fn split_words<'t>(line: &'t str, at: usize, fields: &mut Vec<Field<'t>>) {
    let (mut start, mut quoted, mut opened) = (None, false, 0_usize);
    let mut ranges: Vec<Range<usize>> = Vec::new();
    for (place, found) in line.char_indices() {
        if found.is_whitespace() && !quoted && opened == 0 {
            ranges.extend(start.take().map(|from| from..place));
            continue;
        }
        match found {
            '"' => quoted = !quoted,
            '[' | '(' if !quoted => {
                if start.is_none() && opened == 0 {
                    start = ranges.pop().map(|before| before.start);
                }
                opened += 1;
            }
            ']' | ')' if !quoted => opened = opened.saturating_sub(1),
            _ => {}
        }
        start = start.or(Some(place));
    }
    ranges.extend(start.map(|from| from..line.len()));
    fields.extend(ranges.into_iter().map(|own| trimmed(&line[own.clone()], at + own.start)));
    if fields.is_empty() {
        fields.push(trimmed(line, at));
    }
}

/// A field without what stands around it.
fn trimmed(text: &str, at: usize) -> Field<'_> {
    let outer = text.trim();
    let inner = outer.strip_prefix('"').and_then(|own| own.strip_suffix('"'));
    let own = inner.unwrap_or(outer).trim();
    // The trimmed text is a part of the text.
    let before = text.find(own).unwrap_or(0);
    Field { text: own, at: at + before }
}
