//! `[limits]`: what measures may be at most and at least, and where that is from.

use dashpot_analysis::{
    Bound, Limit,
    limits::standards::{STANDARDS, standard},
    measures::{MEASURES, MeasureEntry},
};
use dashpot_network::parameters::{Dimension, registered};
use dashpot_units::{Unit, nearest, parse_dimension, parse_quantity};

use super::{
    Reading, Targets,
    of_measures::{OfMeasure, Said, of_measures},
};
use crate::{
    diagnostics::fault::Fault,
    quantities::{
        arithmetic::names,
        quantity::INDEX_HELP,
        words::{in_both_units, with_units},
    },
    text::{
        document::{Content, Entry, Item},
        table::{Table, one_or_many, text_of, wrong_type},
    },
    vary::variation::Written,
};

/// What a table says where it is a limit, and not one of measures.
const KEYS: [&str; 5] = ["max", "min", "standard", "from", "mean"];

const SAID: Said = Said {
    noun: "limit",
    example: "\"250 g\"`",
    is_value: |item: &Item| {
        let of_limit =
            |entries: &[Entry]| entries.iter().any(|own| KEYS.contains(&own.key.as_str()));
        item.table().is_none_or(|entries| entries.is_empty() || of_limit(entries))
    },
};

pub(crate) fn read_limits(reading: &Reading<'_>, targets: &Targets<'_, '_>) -> Vec<Limit> {
    let mut limits = Vec::new();
    for entry in reading.section("limits") {
        for own in of_measures(reading, targets, &SAID, entry) {
            let all = one_or_many(&own.entry.item).iter();
            let all = all.flat_map(|item| one(reading, &own, item).unwrap_or_default());
            let all: Vec<Limit> = all.collect();
            if let Some((kind, [most, least])) = own.kind.zip(Limit::contradiction(&all)) {
                let level = |limit: &Limit| in_both_units(limit.bound.level(), dimension(kind));
                let message = format!(
                    "nothing is at most {} and at least {}: no value keeps the limits of `{}`",
                    level(most),
                    level(least),
                    own.key
                );
                let help = "`max` is the most that is allowed, `min` the least";
                reading.faults.error(own.entry.key_place, Fault::odd(message, help));
            }
            limits.extend(all);
        }
    }
    limits
}

/// A bound with its sign in the text, as on the command line: `< 1000`.
fn signed(text: &str) -> Option<(&'static str, &str)> {
    let text = text.trim();
    [("<=", "max"), ("<", "max"), ("≤", "max"), (">=", "min"), (">", "min"), ("≥", "min")]
        .into_iter()
        .find_map(|(sign, key)| Some((key, text.strip_prefix(sign)?.trim())))
}

/// The limits that one value states: a number is the most that is allowed, a word is that of a standard.
fn one(reading: &Reading<'_>, own: &OfMeasure<'_>, item: &Item) -> Option<Vec<Limit>> {
    let kind = own.kind?;
    if let Content::Text(text) = &item.value
        && let Some((key, level)) = signed(text)
    {
        let message = format!("`{text}` has a sign, which the key says here");
        let help = format!(
            "write {{ {key} = \"{level}\" }}; a quantity alone is the most that is allowed"
        );
        reading.faults.error(item.place, Fault::odd(message, help));
        return None;
    }
    match &item.value {
        Content::Text(word) if is_word(reading, word) => by_standard(reading, own, item, word),
        Content::Number(_) | Content::Text(_) => Some(vec![at_most(reading, own, kind, item)?]),
        Content::Table(_) => in_full(reading, own, kind, item),
        _ => {
            let expected = "a quantity, the word of a standard, or a table such as \
                            { max = \"250 g\", from = \"EN 1078:2012\" }";
            wrong_type(item, &format!("the limit of `{}`", own.key), expected, reading.faults);
            None
        }
    }
}

/// Whether a text can but be the word of a standard.
fn is_word(reading: &Reading<'_>, text: &str) -> bool {
    let values = reading.library.values();
    let is_value = values.contains_key(text.trim()) || !names(text, values).is_empty();
    let begins = text.trim_start().starts_with(|first: char| first.is_alphabetic());
    standard(text).is_some() || begins && !is_value && text.contains('-')
}

fn at_most(
    reading: &Reading<'_>,
    own: &OfMeasure<'_>,
    kind: &MeasureEntry,
    item: &Item,
) -> Option<Limit> {
    let level = level(reading, kind, item)?;
    let unit = unit_of(item.text().unwrap_or_default(), dimension(kind));
    Some(Limit { unit, ..Limit::new(own.key.clone(), Bound::Max(level)) })
}

/// The unit of a plain quantity.
fn unit_of(text: &str, expected: Dimension) -> Option<Unit> {
    let unit = parse_quantity(text).is_ok().then(|| Written::split(text).unit)?;
    let one = parse_quantity(&format!("1 {unit}")).ok()?.meant(expected);
    (one.dimension == Some(expected)).then(|| Unit::new(unit, one.value))
}

/// The dimension of a level that is to have a unit: a bare one would be read in one that is perhaps not meant.
/// Indices are plain numbers to the field.
pub(crate) fn unit_wanted(kind: &MeasureEntry, level: f64) -> Option<Dimension> {
    let own = dimension(kind);
    (level != 0.0 && !is_index(kind) && own != Dimension::NUMBER).then_some(own)
}

fn is_index(kind: &MeasureEntry) -> bool {
    (kind.about.default)().gravities() != 0.0
}

fn level(reading: &Reading<'_>, kind: &MeasureEntry, item: &Item) -> Option<f64> {
    let quantities = reading.quantities();
    let quantities = if is_index(kind) { quantities.index() } else { quantities.unwatched() };
    let level = quantities.read(item, dimension(kind))?;
    if let Some(expected) = unit_wanted(kind, level).filter(|_| quantities.is_bare(item)) {
        quantities.without_unit(item, level, expected, true);
    }
    Some(level)
}

fn dimension(kind: &MeasureEntry) -> Dimension {
    let unit = kind.about.unit;
    parse_dimension(unit).unwrap_or(Dimension::NUMBER)
}

fn by_standard(
    reading: &Reading<'_>,
    own: &OfMeasure<'_>,
    item: &Item,
    word: &str,
) -> Option<Vec<Limit>> {
    let Some(standard) = standard(word) else {
        let known = STANDARDS.iter().map(|own| own.word).collect();
        let fault =
            Fault::UnknownWord { family: "a standard".to_owned(), word: word.to_owned(), known };
        reading.faults.error(item.place, fault);
        return None;
    };
    let limits = standard.on(&own.key);
    if limits.is_none() {
        let kinds = standard.kinds.join("` or `");
        let fault = Fault::WrongType {
            what: format!("the limit of `{}`", own.key),
            expected: "one on its own kind of measure".to_owned(),
            found: format!("one on `{kinds}`"),
        };
        reading.faults.error(item.place, fault);
    }
    limits
}

/// `{ max = "250 g", min = …, from = "EN 1078:2012", mean = true }` or `{ standard = "en-1078" }`.
fn in_full(
    reading: &Reading<'_>,
    own: &OfMeasure<'_>,
    kind: &MeasureEntry,
    item: &Item,
) -> Option<Vec<Limit>> {
    let owner = format!("the limit of `{}`", own.key);
    let table = Table::new(item, owner.clone(), own.entry.key_place, reading.faults)?;
    let word = table.take("standard");
    let [max, min] = ["max", "min"].map(|key| table.take(key));
    let from = table.take("from").and_then(|own| text_of(&own.item, "`from`", reading.faults));
    let of_mean = table.take("mean").is_some_and(|own| {
        let is_on = matches!(own.item.value, Content::Switch(true));
        if !is_on {
            wrong_type(&own.item, "`mean`", "`true`, or left out", reading.faults);
        }
        is_on
    });
    table.finish();
    if let Some(word) = word {
        if let Some(other) = max.or(min) {
            let fault = Fault::Exclusive { first: "standard", second: "max` or `min" };
            reading.faults.error(other.key_place, fault);
        }
        let text = text_of(&word.item, "`standard`", reading.faults)?;
        return by_standard(reading, own, &word.item, text);
    }
    if max.or(min).is_none() {
        let example = "max = \"250 g\"".to_owned();
        let fault = Fault::MissingKey { key: "max` or `min".to_owned(), owner, example };
        reading.faults.missing(table.place, fault);
        return None;
    }
    let limit = |entry: Option<&Entry>, bound: fn(f64) -> Bound| {
        let item = &entry?.item;
        let level = level(reading, kind, item)?;
        let unit = unit_of(item.text().unwrap_or_default(), dimension(kind));
        let from = from.map(str::to_owned);
        Some(Limit { from, of_mean, unit, ..Limit::new(own.key.clone(), bound(level)) })
    };
    Some([limit(max, Bound::Max), limit(min, Bound::Min)].into_iter().flatten().collect())
}

/// Limits as they are written on a command line: `head.peak-acceleration<=250 g`, `pad.contact-time>=5 ms`,
/// `head.peak-acceleration=en-1078`. Whether the scene has what they are on is not looked at.
///
/// # Examples
///
/// ```
/// use dashpot_analysis::Bound;
/// use dashpot_scene::parse_limits;
///
/// let limits = parse_limits("head.peak-acceleration <= 250 g").unwrap();
/// assert_eq!(limits[0].key, "head.peak-acceleration");
/// assert_eq!(limits[0].bound, Bound::Max(250.0 * 9.80665));
/// assert_eq!(parse_limits("pad.peak-force=en-1621-1-level-1").unwrap().len(), 2);
/// assert!(parse_limits("head.peak-acceleration<=250 mm").unwrap_err().contains("a length"));
/// assert!(parse_limits("hic15<=700").unwrap_err().contains("write `NAME.hic15<=700`"));
/// assert!(parse_limits("head.peak-acceleration<=250").unwrap_err().contains("write \"250 g\" or"));
/// ```
///
/// # Errors
///
/// What is wrong with the text, in a sentence.
pub fn parse_limits(text: &str) -> Result<Vec<Limit>, String> {
    let usage = "write a measure, `<=` or `>=` and a quantity, such as \"head.hic15<=700\", or `=` and \
                 a standard, such as \"head.peak-acceleration=en-1078\"";
    let place = text.find(['<', '>', '=']).ok_or(usage)?;
    let (key, rest) = (text[..place].trim(), &text[place..]);
    let [max, min] = ["<=", ">="].map(|sign| rest.strip_prefix(sign));
    let by_word = rest.strip_prefix('=').map(str::trim);
    let Some(kind) = Limit::new(key, Bound::Max(0.0)).measure() else {
        if registered(MEASURES, key).is_some() {
            return Err(format!(
                "`{key}` is a measure of what? write `NAME.{key}{rest}`, as in \"head.hic15<=700\""
            ));
        }
        let word = key.rsplit_once('.').map_or(key, |own| own.1);
        let meant = nearest(word, MEASURES.iter().map(|own| own.word)).map_or_else(
            || format!("a number of a scene has its bounds in `design --vary {key}=FROM..TO`"),
            |own| format!("did you mean `{own}`?"),
        );
        return Err(format!("`{key}` is no measure; `dashpot list measures` shows them; {meant}"));
    };
    if let Some(rest) = by_word {
        let known = || STANDARDS.iter().map(|own| own.word);
        let standard = standard(rest).ok_or_else(|| {
            let nearest = nearest(rest, known());
            let meant = nearest.map_or(String::new(), |own| format!("; did you mean `{own}`?"));
            format!("`{rest}` is no standard{meant}; `dashpot list limits` shows them")
        })?;
        let kinds = standard.kinds.join("` or `");
        return standard.on(key).ok_or(format!("`{rest}` is a limit on `{kinds}`"));
    }
    let strict = || {
        let (sign, level) = (&rest[..1], rest[1..].trim());
        format!("what is at the bound is within: write `{key}{sign}={level}`")
    };
    let rest = max.or(min).ok_or_else(strict)?.trim();
    let expected = dimension(kind);
    let meant = if is_index(kind) { Dimension::ACCELERATION } else { expected };
    let quantity = parse_quantity(rest).map_err(|error| error.to_string())?.meant(meant);
    match quantity.dimension {
        Some(found) if found != expected && is_index(kind) => {
            let expected = Dimension::NUMBER;
            let fault = Fault::WrongDimension { text: rest.to_owned(), found, expected };
            Err(format!("{fault}; {INDEX_HELP}"))
        }
        Some(found) if found != expected => {
            Err(Fault::WrongDimension { text: rest.to_owned(), found, expected }.to_string())
        }
        None if unit_wanted(kind, quantity.value).is_some() => {
            Err(format!("`{rest}` has no unit: write {}", with_units(rest, expected)))
        }
        _ => {
            let level = quantity.value;
            let bound = if max.is_some() { Bound::Max(level) } else { Bound::Min(level) };
            Ok(vec![Limit { unit: unit_of(rest, expected), ..Limit::new(key, bound) }])
        }
    }
}
