//! Bare numbers that are unusual for what they measure.

use std::ops::RangeInclusive;

use crate::{document::Entry, fault::Fault, quantity::Quantities};

/// What a bare number at a key usually is.
struct Usual {
    key: &'static str,
    /// The SI unit in which a bare number counts.
    unit: &'static str,
    range: RangeInclusive<f64>,
    /// The units that are probably meant below and above the range.
    meant: [&'static str; 2],
}

const USUAL: &[Usual] = &[
    Usual { key: "mass", unit: "kg", range: 1e-6..=1e5, meant: ["t", "g"] },
    Usual { key: "thickness", unit: "m", range: 1e-5..=1.0, meant: ["m", "mm"] },
    Usual { key: "area", unit: "m^2", range: 1e-8..=10.0, meant: ["m^2", "cm^2"] },
    Usual { key: "drop", unit: "m", range: 1e-5..=100.0, meant: ["m", "mm"] },
    Usual { key: "temperature", unit: "K", range: 100.0..=2000.0, meant: ["degC", "degC"] },
    Usual { key: "reference", unit: "K", range: 100.0..=2000.0, meant: ["degC", "degC"] },
    Usual { key: "duration", unit: "s", range: 1e-7..=10.0, meant: ["s", "ms"] },
];

/// Warns of the value of `entry`, in SI units, if it has no unit and is unusual for its key.
pub(crate) fn check(quantities: Quantities<'_>, entry: &Entry, value: Option<f64>) {
    let usual = USUAL.iter().find(|usual| usual.key == entry.key);
    let Some((usual, value)) = usual.zip(value) else { return };
    if value == 0.0 || usual.range.contains(&value) || !quantities.is_bare(&entry.item) {
        return;
    }
    let Usual { key, unit, meant: [below, above], .. } = usual;
    let message = if value > *usual.range.end() {
        format!("`{key}` is {value} {unit}: did you mean {above}?")
    } else {
        format!("`{key}` is {value} {unit}, which is very little")
    };
    let meant = if value > *usual.range.end() { above } else { below };
    let help = format!("a bare number is in {unit}; write it with its unit: \"{value} {meant}\"");
    quantities.faults.warning(entry.item.place, Fault::odd(message, help));
}
