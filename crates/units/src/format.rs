//! Quantities as text, in engineering units.

use super::{Dimension, parse_quantity, si_unit, symbols::MOLE};

/// Units to choose from, smallest first: symbol and power of ten over the SI unit.
fn scales(dimension: Dimension) -> &'static [(&'static str, i32)] {
    match dimension {
        Dimension::MASS => &[("mg", -6), ("g", -3), ("kg", 0), ("t", 3)],
        Dimension::LENGTH => &[("nm", -9), ("µm", -6), ("mm", -3), ("m", 0), ("km", 3)],
        Dimension::TIME => &[("ns", -9), ("µs", -6), ("ms", -3), ("s", 0)],
        Dimension::FREQUENCY => &[("mHz", -3), ("Hz", 0), ("kHz", 3), ("MHz", 6)],
        Dimension::VELOCITY => &[("µm/s", -6), ("mm/s", -3), ("m/s", 0), ("km/s", 3)],
        Dimension::ACCELERATION => &[("mm/s^2", -3), ("m/s^2", 0)],
        Dimension::FORCE => &[("µN", -6), ("mN", -3), ("N", 0), ("kN", 3), ("MN", 6), ("GN", 9)],
        Dimension::STIFFNESS => &[("N/m", 0), ("kN/m", 3), ("MN/m", 6), ("GN/m", 9)],
        Dimension::DAMPING => {
            &[("mN s/m", -3), ("N s/m", 0), ("kN s/m", 3), ("MN s/m", 6), ("GN s/m", 9)]
        }
        Dimension::IMPULSE => &[("mN s", -3), ("N s", 0), ("kN s", 3)],
        Dimension::ENERGY => &[("µJ", -6), ("mJ", -3), ("J", 0), ("kJ", 3), ("MJ", 6)],
        Dimension::PRESSURE => &[("Pa", 0), ("kPa", 3), ("MPa", 6), ("GPa", 9)],
        Dimension::VISCOSITY => {
            &[("mPa s", -3), ("Pa s", 0), ("kPa s", 3), ("MPa s", 6), ("GPa s", 9)]
        }
        Dimension::COMPLIANCE => &[("nm/N", -9), ("µm/N", -6), ("mm/N", -3), ("m/N", 0)],
        _ => &[],
    }
}

/// A value in SI units as text in a handy unit, to `digits` significant digits (at least 1).
///
/// # Examples
///
/// ```
/// use dashpot_units::{Dimension, format_quantity};
///
/// assert_eq!(format_quantity(38_359.4, Dimension::FORCE, 4), "38.36 kN");
/// assert_eq!(format_quantity(7.4256e-3, Dimension::TIME, 3), "7.43 ms");
/// assert_eq!(format_quantity(999.96, Dimension::FORCE, 4), "1.000 kN");
/// ```
pub fn format_quantity(value: f64, dimension: Dimension, digits: usize) -> String {
    written(value, &format!("{value:.*e}", digits.saturating_sub(1)), dimension)
}

/// Like [`format_quantity`], without zeros at the end: `20 MN/m`.
pub fn format_short(value: f64, dimension: Dimension, digits: usize) -> String {
    let rounded = format!("{value:.*e}", digits.saturating_sub(1));
    let Some((mantissa, exponent)) = rounded.split_once('e') else {
        return written(value, &rounded, dimension);
    };
    let mantissa = if mantissa.contains('.') {
        mantissa.trim_end_matches('0').trim_end_matches('.')
    } else {
        mantissa
    };
    written(value, &format!("{mantissa}e{exponent}"), dimension)
}

/// A value as text that is read back to the same bits, or as [`tidy`].
pub fn exact_quantity(value: f64, dimension: Dimension) -> String {
    let molar = if dimension == Dimension::ENERGY { exact_molar(value) } else { None };
    let value = tidy(value);
    molar.unwrap_or_else(|| written(value, &format!("{value:e}"), dimension))
}

/// The value, or where it is a number of few digits but for the rounding of what it was computed by,
/// that number: 2 for 1.9999999999999998. Both differ by 4.5e-16 at most, relatively.
pub fn tidy(value: f64) -> f64 {
    const ROUNDING: f64 = 2.0 * f64::EPSILON;
    /// Of 15 digits.
    const FEW: usize = 12;
    let text = format!("{value:.14e}");
    let mantissa = text.split_once('e').map_or("", |own| own.0).trim_end_matches('0');
    let digits = mantissa.chars().filter(char::is_ascii_digit).count();
    match text.parse::<f64>() {
        Ok(near) if digits <= FEW && (near - value).abs() <= ROUNDING * value.abs() => near,
        _ => value,
    }
}

/// The energy \[J\] of one molecule as that of a mole, where its shortest text is short and comes
/// back to the same bits.
fn exact_molar(value: f64) -> Option<String> {
    const LARGEST: f64 = 1e-16;
    if value.abs() >= LARGEST || !value.is_normal() {
        return None;
    }
    let molar = value * MOLE * 1e20;
    // One digit less than a double may have, so that no digits come from rounding.
    let digits = format!("{molar:.14e}").parse::<f64>().ok()?;
    let text = format!("{digits} kJ/mol");
    let is_same = parse_quantity(&text).is_ok_and(|own| own.value.to_bits() == value.to_bits());
    is_same.then_some(text)
}

/// The symbol of a unit in which what is of this power of ten \[SI\] is handy, and the power of ten of that unit.
pub(crate) fn handy(dimension: Dimension, exponent: i32) -> (String, i32) {
    let scales = scales(dimension);
    let fitting = scales.iter().rev().find(|(_, power)| *power <= exponent).or(scales.first());
    match fitting {
        Some((symbol, power)) => ((*symbol).to_owned(), *power),
        None => (symbol_of(dimension), 0),
    }
}

/// The SI unit, nothing for pure numbers.
fn symbol_of(dimension: Dimension) -> String {
    if dimension == Dimension::NUMBER { String::new() } else { si_unit(dimension) }
}

/// `rounded` is the value in the form `d.ddde±x`.
fn written(value: f64, rounded: &str, dimension: Dimension) -> String {
    let Some((mantissa, exponent)) = rounded.split_once('e') else {
        return joined(&value.to_string(), &symbol_of(dimension));
    };
    if value == 0.0 {
        return joined("0", &symbol_of(dimension));
    }
    let exponent = exponent.parse::<i32>().unwrap_or(0);
    let (unit, power) = handy(dimension, exponent);
    joined(&positional(mantissa, exponent - power), &unit)
}

fn joined(number: &str, unit: &str) -> String {
    if unit.is_empty() { number.to_owned() } else { format!("{number} {unit}") }
}

/// The digits of `mantissa` with the point moved by `shift`; far shifts stay powers of ten.
fn positional(mantissa: &str, shift: i32) -> String {
    let (sign, digits) = mantissa.strip_prefix('-').map_or(("", mantissa), |digits| ("-", digits));
    let digits = digits.replace('.', "");
    match usize::try_from(shift) {
        Ok(shift @ 0..=5) => {
            let whole = shift + 1;
            if digits.len() <= whole {
                format!("{sign}{digits:0<whole$}")
            } else {
                format!("{sign}{}.{}", &digits[..whole], &digits[whole..])
            }
        }
        Err(_) if shift >= -4 => {
            let zeros = "0".repeat((-shift - 1).unsigned_abs() as usize);
            format!("{sign}0.{zeros}{digits}")
        }
        _ => format!("{mantissa}e{shift}"),
    }
}
