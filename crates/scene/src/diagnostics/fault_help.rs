//! How to put right what is wrong with a quantity or a name.

use dashpot_network::parameters::Dimension;
use dashpot_units::{UnitError, foreign, meant_as, parse_dimension, parse_quantity};

use crate::{
    quantities::words::{described, example},
    text::nearest::suggestion,
};

/// What to write in place of degrees Celsius in a product.
const KELVIN_HELP: &str = "within a unit write `K`: a difference of 1 degree Celsius is 1 K";

/// Help for a text that cannot be read as a quantity.
pub(crate) fn unreadable_help(error: &UnitError, expected: Dimension) -> String {
    let like = example(expected);
    match error {
        UnitError::UnknownUnit { symbol, unit, meant } => {
            let meant = meant.as_deref();
            let fitting = meant.filter(|meant| fits(meant, expected));
            if let Some(one) = foreign(symbol).filter(|_| fitting.is_some()) {
                return foreign_help(symbol, one);
            }
            if let Some(meant) = fitting.or_else(|| meant_as(unit, expected)) {
                return format!(
                    "did you mean `{meant}`? {} is expected, {like}",
                    described(expected)
                );
            }
            // A part of a unit may be misspelt; a whole one of another dimension is not meant.
            let is_same = |meant: &&str| symbol != unit || meant.eq_ignore_ascii_case(symbol);
            match meant.filter(is_same) {
                Some(meant) => format!("did you mean `{meant}`? {like}"),
                None => format!("{} is expected, {like}", described(expected)),
            }
        }
        UnitError::DecimalComma { text } => comma_help(text, "\""),
        UnitError::Separated { joined, .. } => format!("write \"{joined}\""),
        UnitError::CelsiusInProduct { .. } => KELVIN_HELP.to_owned(),
        UnitError::Malformed { text } if fits(&text.replace(['.', '-'], " "), expected) => {
            format!("did you mean `{}`? {like}", text.replace(['.', '-'], " "))
        }
        UnitError::Malformed { text } if text.starts_with('^') => {
            format!(
                "behind a power stands `*`: write `* 1` before the unit, or compute the number; {like}"
            )
        }
        _ => format!("{} is expected, {like}", described(expected)),
    }
}

/// Help for a named value that cannot be read.
pub(crate) fn bad_value_help(error: &UnitError, example: &str) -> String {
    match error {
        UnitError::UnknownUnit { symbol, meant: Some(meant), .. } => match foreign(symbol) {
            Some(one) => foreign_help(symbol, one),
            None => format!("did you mean `{meant}`?"),
        },
        UnitError::DecimalComma { text } => comma_help(text, "\""),
        UnitError::Separated { joined, .. } => format!("write \"{joined}\""),
        UnitError::CelsiusInProduct { .. } => KELVIN_HELP.to_owned(),
        _ => format!("a value is a quantity, for example \"{example}\""),
    }
}

/// Help for a unit that is known but not read.
fn foreign_help(symbol: &str, one: &str) -> String {
    format!("1 {symbol} is {one}: write it in that")
}

/// Help for a number with commas, written between two `quote`s.
///
/// A comma before three digits may stand between thousands; then both readings are offered.
pub(crate) fn comma_help(text: &str, quote: &str) -> String {
    let end = text.find(|c: char| !matches!(c, '0'..='9' | '+' | '-' | ',' | '.'));
    let (number, rest) = text.split_at(end.unwrap_or(text.len()));
    let groups = number.split(',').collect::<Vec<_>>();
    let whole = |group: &str| group.split('.').next().is_some_and(|digits| digits.len() == 3);
    let first = groups[0].trim_start_matches(['+', '-']);
    let may_be_thousands =
        (1..=3).contains(&first.len()) && first != "0" && groups[1..].iter().all(|own| whole(own));
    let decimal = number.replacen(',', ".", 1);
    let may_be_decimal = groups.len() == 2 && parse_quantity(&decimal).is_ok();
    let thousands = format!(
        "write {quote}{}{rest}{quote} (a comma between thousands is not read)",
        groups.concat()
    );
    match (may_be_thousands, may_be_decimal) {
        (true, false) => thousands,
        (true, true) => format!(
            "{thousands} or {quote}{decimal}{rest}{quote} (a decimal comma is written as a point)"
        ),
        _ => format!("write {quote}{decimal}{rest}{quote}"),
    }
}

/// Help for a name that stands for nothing.
pub(crate) fn unknown_name_help(family: &str, name: &str, known: &[String]) -> Option<String> {
    if known.is_empty() && family == "value" {
        return Some(format!("name it in [values]: {name} = \"…\""));
    }
    let known = known.iter().map(String::as_str).collect::<Vec<_>>();
    let families = format!("{}s", family.replace(", ", "s, ").replace(" or ", "s and "));
    suggestion(name, &families, &known).or_else(|| Some(format!("there are no {families}")))
}

fn fits(unit: &str, expected: Dimension) -> bool {
    parse_dimension(unit).is_ok_and(|dimension| dimension == expected)
}
