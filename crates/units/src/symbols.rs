//! The units that can be read.

use std::f64::consts::PI;

use super::{Dimension, STANDARD_GRAVITY, nearest};

/// A unit as a multiple of the SI unit of its dimension: `factor · 10^exponent`.
///
/// Powers of ten are kept apart so that `"0.1 mN"` is read as exactly as `1e-4`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Unit {
    /// Part that is not a power of ten.
    pub(crate) factor: f64,
    /// Power of ten.
    pub(crate) exponent: i32,
    /// What is measured.
    pub(crate) dimension: Dimension,
    /// Exponent of the angle: 1 for `rad` and `rad/s`, 0 for `Hz`.
    pub(crate) angle: i8,
    /// Exponent of the amount of substance: 1 for `mol`.
    pub(crate) amount: i8,
}

impl Unit {
    /// That of pure numbers.
    pub(crate) const ONE: Self =
        Self { factor: 1.0, exponent: 0, dimension: Dimension::NUMBER, angle: 0, amount: 0 };
}

struct Symbol {
    word: &'static str,
    unit: Unit,
    takes_prefix: bool,
}

const fn unit(
    word: &'static str,
    factor: f64,
    exponent: i32,
    dimension: Dimension,
    takes_prefix: bool,
) -> Symbol {
    Symbol { word, unit: Unit { factor, exponent, dimension, ..Unit::ONE }, takes_prefix }
}

const fn angle(word: &'static str, factor: f64, takes_prefix: bool) -> Symbol {
    Symbol { word, unit: Unit { factor, angle: 1, ..Unit::ONE }, takes_prefix }
}

/// The mole, which counts as a number.
const fn mole() -> Symbol {
    let unit = Unit { factor: MOLE, exponent: 23, amount: 1, ..Unit::ONE };
    Symbol { word: "mol", unit, takes_prefix: true }
}

const SYMBOLS: &[Symbol] = &[
    unit("g", 1.0, -3, Dimension::MASS, true),
    unit("t", 1.0, 3, Dimension::MASS, true),
    unit("m", 1.0, 0, Dimension::LENGTH, true),
    unit("s", 1.0, 0, Dimension::TIME, true),
    unit("min", 60.0, 0, Dimension::TIME, false),
    unit("h", 3600.0, 0, Dimension::TIME, false),
    unit("d", 86_400.0, 0, Dimension::TIME, false),
    unit("N", 1.0, 0, Dimension::FORCE, true),
    unit("daN", 1.0, 1, Dimension::FORCE, false),
    unit("J", 1.0, 0, Dimension::ENERGY, true),
    unit("W", 1.0, 0, Dimension::new(1, 2, -3), true),
    unit("Pa", 1.0, 0, Dimension::PRESSURE, true),
    unit("Hz", 1.0, 0, Dimension::FREQUENCY, true),
    unit("g0", STANDARD_GRAVITY, 0, Dimension::ACCELERATION, false),
    unit("K", 1.0, 0, Dimension::TEMPERATURE, true),
    mole(),
    unit("%", 1.0, -2, Dimension::NUMBER, false),
    angle("rad", 1.0, true),
    angle("deg", PI / 180.0, false),
    angle("°", PI / 180.0, false),
    unit("in", 254.0, -4, Dimension::LENGTH, false),
    unit("ft", 3048.0, -4, Dimension::LENGTH, false),
    unit("lb", 45_359_237.0, -8, Dimension::MASS, false),
    unit("lbf", 4.448_221_615_260_5, 0, Dimension::FORCE, false),
    unit("kgf", STANDARD_GRAVITY, 0, Dimension::FORCE, false),
    unit("mph", 44_704.0, -5, Dimension::VELOCITY, false),
];

/// Degrees Celsius; not among the others, because they count from a point of their own.
const CELSIUS: &[&str] = &["degC", "°C"];

/// 0 °C \[K\].
pub(super) const CELSIUS_ZERO: f64 = 273.15;

/// Molecules in a mole over 10²³, exact by the definition of the mole (SI brochure, 2019).
pub(super) const MOLE: f64 = 6.022_140_76;

/// Both signs for micro are read, and `u`.
const PREFIXES: &[(char, i32)] = &[
    ('T', 12),
    ('G', 9),
    ('M', 6),
    ('k', 3),
    ('d', -1),
    ('c', -2),
    ('m', -3),
    ('u', -6),
    ('µ', -6),
    ('μ', -6),
    ('n', -9),
    ('p', -12),
];

/// What people write for a unit besides its symbol.
const SPOKEN: &[(&str, &str)] = &[
    ("sec", "s"),
    ("second", "s"),
    ("seconds", "s"),
    ("msec", "ms"),
    ("minute", "min"),
    ("minutes", "min"),
    ("hour", "h"),
    ("hours", "h"),
    ("day", "d"),
    ("days", "d"),
    ("meter", "m"),
    ("metre", "m"),
    ("newton", "N"),
    ("joule", "J"),
    ("hertz", "Hz"),
    ("kilogram", "kg"),
    ("kilo", "kg"),
    ("gram", "g"),
    ("degree", "deg"),
    ("degrees", "deg"),
    ("percent", "%"),
    ("kelvin", "K"),
    ("degK", "K"),
    ("°K", "K"),
    ("C", "degC"),
    ("celsius", "degC"),
    ("mole", "mol"),
    ("lbs", "lb"),
    ("inch", "in"),
    ("inches", "in"),
    ("foot", "ft"),
    ("feet", "ft"),
    ("mi/h", "mph"),
    ("kp", "kgf"),
    ("gn", "g0"),
    ("kph", "km/h"),
    ("kmh", "km/h"),
];

/// Units that are not read, and what one of them is.
const FOREIGN: &[(&str, &str)] = &[
    ("bar", "100 kPa"),
    ("mbar", "0.1 kPa"),
    ("atm", "101.325 kPa"),
    ("psi", "6.894757 kPa"),
    ("ksi", "6.894757 MPa"),
    ("oz", "28.34952 g"),
];

/// Units with a prefix that are offered in place of an unknown one, the usual ones first.
const USUAL: &[&str] = &[
    "kN", "MN", "GN", "mN", "kg", "mm", "cm", "km", "µm", "ms", "µs", "ns", "kHz", "kJ", "mJ",
    "MPa", "kPa", "GPa", "mrad",
];

/// Units of more than one symbol that are offered where their dimension is expected.
const COMPOUND: &[&str] =
    &["m/s", "km/h", "mm/s", "m/s^2", "N/m", "kN/m", "MN/m", "N/mm", "N s/m", "kN s/m", "N s"];

/// Whether a unit is degrees Celsius.
pub(super) fn is_celsius(unit: &str) -> bool {
    CELSIUS.contains(&unit)
}

/// The unit of a symbol such as `kN`.
pub(crate) fn symbol(word: &str) -> Option<Unit> {
    let exact = |word: &str| SYMBOLS.iter().find(|symbol| symbol.word == word);
    if let Some(symbol) = exact(word) {
        return Some(symbol.unit);
    }
    let prefix = word.chars().next()?;
    let exponent = PREFIXES.iter().find(|entry| entry.0 == prefix)?.1;
    let base = exact(&word[prefix.len_utf8()..]).filter(|symbol| symbol.takes_prefix)?.unit;
    Some(Unit { exponent: base.exponent + exponent, ..base })
}

/// What one of a unit is that is known but not read.
pub fn foreign(word: &str) -> Option<&'static str> {
    FOREIGN.iter().find(|entry| entry.0.eq_ignore_ascii_case(word)).map(|entry| entry.1)
}

/// What was probably meant by a symbol that is not known.
pub(crate) fn meant(word: &str) -> Option<String> {
    if let Some((_, symbol)) = SPOKEN.iter().find(|entry| entry.0.eq_ignore_ascii_case(word)) {
        return Some((*symbol).to_owned());
    }
    if let Some((_, unit)) = foreign(word).and_then(|one| one.split_once(' ')) {
        return Some(unit.to_owned());
    }
    let known = || {
        let symbols = SYMBOLS.iter().map(|symbol| symbol.word);
        USUAL.iter().copied().chain(symbols).chain(CELSIUS.iter().copied())
    };
    // `KN` and `Kg` are meant as `kN` and `kg`, and not as products with the kelvin.
    let is_factor =
        |word: &str| symbol(word).is_some_and(|unit| unit.dimension != Dimension::TEMPERATURE);
    let product = word
        .char_indices()
        .skip(1)
        .map(|(at, _)| word.split_at(at))
        .find(|(first, second)| is_factor(first) && is_factor(second))
        .map(|(first, second)| format!("{first} {second}"));
    if product.is_some() {
        return product;
    }
    if let Some(same) = known().find(|known| known.eq_ignore_ascii_case(word)) {
        return Some(same.to_owned());
    }
    nearest(word, known()).map(str::to_owned)
}

/// What was probably meant by a unit that is not known where `expected` is measured.
pub fn meant_as(unit: &str, expected: Dimension) -> Option<&'static str> {
    let known = COMPOUND.iter().chain(USUAL).copied();
    let known = known.chain(SYMBOLS.iter().map(|symbol| symbol.word));
    let known = known.chain(CELSIUS.iter().copied());
    let fits =
        |known: &&str| super::parse_dimension(known).is_ok_and(|dimension| dimension == expected);
    nearest(unit, known.filter(fits))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_symbols_come_before_prefixes() {
        assert_eq!(symbol("min").unwrap().dimension, Dimension::TIME);
        assert!((crate::parse_quantity("1.5 d").unwrap().value - 129_600.0).abs() < 1e-9);
        assert_eq!(meant("days").as_deref(), Some("d"));
        assert_eq!(symbol("ft").unwrap().dimension, Dimension::LENGTH);
        assert_eq!(symbol("kg").unwrap().exponent, 0);
        assert_eq!(symbol("Mg").unwrap().exponent, symbol("t").unwrap().exponent);
        assert_eq!(symbol("daN").unwrap().exponent, 1);
        assert!(symbol("kmin").is_none() && symbol("KN").is_none() && symbol("").is_none());
    }

    #[test]
    fn every_symbol_is_in_the_document() {
        let document = include_str!("../../../docs/scene-format.md");
        let (_, rest) = document.split_once("### Symbols").unwrap();
        let (table, _) = rest.split_once("\nPrefixes are").unwrap();
        for Symbol { word, .. } in SYMBOLS {
            assert!(table.contains(&format!("`{word}`")), "{word}");
        }
    }

    #[test]
    fn an_unknown_symbol_is_understood() {
        assert_eq!(meant("KN").as_deref(), Some("kN"));
        assert_eq!(meant("Ns").as_deref(), Some("N s"));
        assert_eq!(meant("kNs").as_deref(), Some("kN s"));
        assert_eq!(meant("sec").as_deref(), Some("s"));
        assert_eq!(meant("Kg").as_deref(), Some("kg"));
        assert_eq!(meant("degc").as_deref(), Some("degC"));
        assert_eq!(meant("kelvin").as_deref(), Some("K"));
        assert_eq!(meant("furlong"), None);
        for (word, one) in FOREIGN {
            let value = crate::parse_quantity(one).unwrap();
            let meant = crate::parse_dimension(&meant(word).unwrap());
            assert_eq!(Some(meant.unwrap()), value.dimension, "{word}");
            assert!(symbol(word).is_none(), "{word}");
        }
    }
}
