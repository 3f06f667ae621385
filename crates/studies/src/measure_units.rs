//! The units in which measures are read, and limits on them.

use dashpot_analysis::{
    Bound, Limit, MeasureReport,
    measures::{Hic, Hic15, Hic36, PeakStrain, SeverityIndex},
};
use dashpot_network::parameters::Kind as _;
use dashpot_report::numbers::{self, MOST_DIGITS, Unit};
use dashpot_units::STANDARD_GRAVITY;

/// The unit in which measures of a kind, in SI units `si`, are read whatever their size.
pub fn unit_of_kind(kind: &str, si: &str) -> Option<Unit> {
    match si {
        "m/s^2" => Some(Unit::new("g", STANDARD_GRAVITY)),
        // The field prints indices as plain numbers, of seconds and g.
        "s" if is_index(kind) => Some(Unit::plain("1")),
        "1" if kind == PeakStrain::KIND => Some(Unit::new("%", 0.01)),
        _ => None,
    }
}

/// The value of the measure of this key, in SI units `si`, in the unit in which such are read.
pub fn measure_text(key: &str, value: f64, si: &str, digits: usize) -> String {
    let kind = key.rsplit_once('.').map_or(key, |own| own.1);
    // A further measure of one kind has its number behind it.
    let numbered = kind.rsplit_once('-').filter(|own| own.1.parse::<usize>().is_ok());
    let kind = numbered.map_or(kind, |own| own.0);
    unit_of_kind(kind, si).unwrap_or_else(|| Unit::suiting(value, si)).text(value, digits)
}

/// Whether a measure of this kind is an index that has seconds as its unit but is no time.
pub fn is_index(kind: &str) -> bool {
    kind == SeverityIndex::KIND || is_hic(kind)
}

/// Whether it is a head injury criterion.
pub fn is_hic(kind: &str) -> bool {
    [Hic::KIND, Hic15::KIND, Hic36::KIND].contains(&kind)
}

/// The unit in which a limit on measures of a kind, in SI units `si`, is read: its own, or the usual one.
pub fn unit_of_limit(kind: &str, si: &str, limit: &Limit) -> Unit {
    let written = limit.unit.clone().or_else(|| unit_of_kind(kind, si));
    written.unwrap_or_else(|| Unit::suiting(limit.bound.level(), si))
}

/// `at most 250 g (EN 1078:2012)`.
pub fn stated(limit: &Limit, measure: Option<&MeasureReport>) -> String {
    let level = match measure {
        Some(own) => level(limit, own.kind, own.unit),
        None => limit.measure().map_or_else(
            || numbers::significant(limit.bound.level(), MOST_DIGITS),
            |own| level(limit, own.word, own.about.unit),
        ),
    };
    let word = match limit.bound {
        Bound::Max(_) => "at most",
        Bound::Min(_) => "at least",
    };
    let from = limit.from.as_ref().map_or(String::new(), |from| format!(" ({from})"));
    format!("{word} {level}{from}")
}

/// The bound as people write it.
pub fn level(limit: &Limit, kind: &str, si: &str) -> String {
    let unit = unit_of_limit(kind, si, limit);
    let text = unit.text(limit.bound.level(), MOST_DIGITS);
    let (number, rest) = text.split_once(' ').unwrap_or((&text, ""));
    let short = match number.split_once('.') {
        Some(_) if !number.contains('e') => number.trim_end_matches('0').trim_end_matches('.'),
        _ => number,
    };
    format!("{short} {rest}").trim_end().to_owned()
}
