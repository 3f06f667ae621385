//! Bare numbers that are unusual for what they measure.

use std::ops::RangeInclusive;

use crate::{document::Entry, fault::Fault, quantity::Quantities};

/// What a bare number at a key usually is.
struct Usual {
    key: &'static str,
    /// The SI unit in which a bare number counts; none of a pure number.
    unit: &'static str,
    range: RangeInclusive<f64>,
    /// The units that are probably meant below and above the range; none where it is just odd.
    meant: [&'static str; 2],
}

const USUAL: &[Usual] = &[
    Usual { key: "mass", unit: "kg", range: 1e-6..=1e5, meant: ["t", "g"] },
    Usual { key: "thickness", unit: "m", range: 1e-5..=1.0, meant: ["m", "mm"] },
    Usual { key: "area", unit: "m^2", range: 1e-8..=10.0, meant: ["m^2", "cm^2"] },
    Usual { key: "drop", unit: "m", range: 1e-5..=100.0, meant: ["m", "mm"] },
    Usual { key: "temperature", unit: "K", range: 100.0..=2000.0, meant: ["degC", "degC"] },
    Usual { key: "reference", unit: "K", range: 100.0..=2000.0, meant: ["degC", "degC"] },
    Usual { key: "limit", unit: "m", range: 1e-6..=1.0, meant: ["m", "mm"] },
    Usual { key: "modulus", unit: "Pa", range: 1e2..=f64::INFINITY, meant: ["MPa", "Pa"] },
    Usual { key: "plateau", unit: "Pa", range: 1e2..=f64::INFINITY, meant: ["kPa", "Pa"] },
    Usual { key: "gain", unit: "", range: 0.0..=2.0, meant: ["", "%"] },
    Usual { key: "exponent", unit: "", range: 0.0..=20.0, meant: ["", ""] },
    Usual { key: "unloading-exponent", unit: "", range: 0.0..=20.0, meant: ["", ""] },
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
    let most = usual.range.end();
    let is_more = value > *most;
    let meant = if is_more { above } else { below };
    // What is measured by a length in a model is a strain in a material.
    if quantities.basis.is_material() && *unit == "m" {
        return;
    }
    let written = if unit.is_empty() { value.to_string() } else { format!("{value} {unit}") };
    let message = match (is_more, meant.is_empty()) {
        (true, true) => format!("`{key}` is {written}, which is very much"),
        (true, false) => format!("`{key}` is {written}: did you mean {above}?"),
        (false, _) => format!("`{key}` is {written}, which is very little"),
    };
    let help = match (meant.is_empty(), unit.is_empty()) {
        (true, _) => format!("{most} is a lot already"),
        (false, true) => format!("write \"{value} {meant}\""),
        (false, false) => {
            format!("a bare number is in {unit}; write it with its unit: \"{value} {meant}\"")
        }
    };
    quantities.faults.warning(entry.item.place, Fault::odd(message, help));
}
