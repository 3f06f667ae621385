//! Quantities that are unusual for what they measure: bare numbers whose unit was probably forgotten,
//! and units with a small letter in the place of a capital one.

use std::ops::RangeInclusive;

use dashpot_network::parameters::Dimension;
use dashpot_units::exact_quantity;

use super::basis::{AREA, DENSITY};
use crate::diagnostics::fault::Fault;

/// What a bare number usually is.
struct Usual {
    /// The key at which it is that; empty for all others.
    key: &'static str,
    dimension: Dimension,
    /// The SI unit in which a bare number counts; none of a pure number.
    unit: &'static str,
    range: RangeInclusive<f64>,
    /// The units that are probably meant below and above the range; none where it is just odd.
    meant: [&'static str; 2],
}

const fn usual(
    (key, dimension, unit): (&'static str, Dimension, &'static str),
    range: RangeInclusive<f64>,
    meant: [&'static str; 2],
) -> Usual {
    Usual { key, dimension, unit, range, meant }
}

/// The first one that fits counts.
const USUAL: &[Usual] = &[
    usual(("thickness", Dimension::LENGTH, "m"), 1e-5..=1.0, ["m", "mm"]),
    usual(("drop", Dimension::LENGTH, "m"), 1e-5..=100.0, ["m", "mm"]),
    usual(("limit", Dimension::LENGTH, "m"), 1e-6..=1.0, ["m", "mm"]),
    usual(("run.duration", Dimension::TIME, "s"), 1e-7..=10.0, ["s", "ms"]),
    usual(("modulus", Dimension::PRESSURE, "Pa"), 1e2..=f64::INFINITY, ["MPa", "Pa"]),
    usual(("plateau", Dimension::PRESSURE, "Pa"), 1e3..=f64::INFINITY, ["kPa", "Pa"]),
    usual(("densification", Dimension::PRESSURE, "Pa"), 1e2..=f64::INFINITY, ["kPa", "Pa"]),
    usual(("value", Dimension::ACCELERATION, "m/s^2"), 0.0..=100.0, ["", "cm/s^2"]),
    usual(("gain", Dimension::NUMBER, ""), 0.0..=2.0, ["", "%"]),
    usual(("exponent", Dimension::NUMBER, ""), 0.0..=20.0, ["", ""]),
    usual(("unloading-exponent", Dimension::NUMBER, ""), 0.0..=20.0, ["", ""]),
    usual(("", Dimension::MASS, "kg"), 1e-6..=1e5, ["t", "g"]),
    usual(("", Dimension::LENGTH, "m"), 1e-9..=1.0, ["m", "mm"]),
    usual(("", AREA, "m^2"), 1e-8..=10.0, ["m^2", "cm^2"]),
    usual(("", Dimension::TIME, "s"), 1e-9..=1.0, ["s", "ms"]),
    usual(("", DENSITY, "kg/m^3"), 1.0..=3e4, ["g/cm^3", "kg/m^3"]),
    usual(("", Dimension::TEMPERATURE, "K"), 100.0..=2000.0, ["degC", "degC"]),
];

/// Units that are too small to be meant in an impact below 1 of the SI unit, and what is meant.
const SLIPS: &[(&str, &str, Dimension)] =
    &[("mPa", "MPa", Dimension::PRESSURE), ("mN/m", "MN/m", Dimension::STIFFNESS)];

/// What is odd about a bare number of this dimension, in SI units, at the key `key`, where something is;
/// it is called `subject`.
pub(super) fn bare(key: &str, subject: &str, dimension: Dimension, value: f64) -> Option<Fault> {
    let fits = |usual: &&Usual| usual.dimension == dimension && [key, ""].contains(&usual.key);
    USUAL.iter().find(fits).and_then(|usual| usual.fault(subject, value))
}

impl Usual {
    /// What is odd about a bare number, where something is.
    fn fault(&self, subject: &str, value: f64) -> Option<Fault> {
        let Self { unit, range, meant: [below, above], .. } = self;
        let size = value.abs();
        if size == 0.0 || range.contains(&size) {
            return None;
        }
        let most = range.end();
        let is_more = size > *most;
        let meant = if is_more { above } else { below };
        let value = exact_quantity(value, Dimension::NUMBER);
        let written = if unit.is_empty() { value.clone() } else { format!("{value} {unit}") };
        let message = match (is_more, meant.is_empty()) {
            (true, true) => format!("`{subject}` is {written}, which is very much"),
            (true, false) => format!("`{subject}` is {written}: did you mean {above}?"),
            (false, _) => format!("`{subject}` is {written}, which is very little"),
        };
        let help = match (meant.is_empty(), unit.is_empty()) {
            (true, _) => format!("{most} is a lot already"),
            (false, true) => format!("write \"{value} {meant}\""),
            (false, false) => {
                format!("a bare number is in {unit}; write it with its unit: \"{value} {meant}\"")
            }
        };
        Some(Fault::odd(message, help))
    }
}

/// What is odd about a quantity `text` in a thousandth of a unit of which a million is usual.
pub(super) fn slip(text: &str, dimension: Dimension, value: f64) -> Option<Fault> {
    let (milli, mega, _) =
        SLIPS.iter().find(|own| own.2 == dimension && text.trim().ends_with(own.0))?;
    if value == 0.0 || value.abs() >= 1.0 {
        return None;
    }
    let meant = text.trim().strip_suffix(milli)?.to_owned() + mega;
    let message = format!("\"{}\" has a small `m`, for milli: did you mean {mega}?", text.trim());
    Some(Fault::odd(message, format!("write \"{meant}\", or the SI unit if it is meant")))
}
