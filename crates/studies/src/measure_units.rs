//! The units in which measures are read.

use dashpot_analysis::measures::{Hic, Hic15, Hic36, PeakStrain, SeverityIndex};
use dashpot_network::parameters::Kind as _;
use dashpot_report::numbers::Unit;
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
