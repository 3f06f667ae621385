//! Numbers as people read them: in handy units, with no more digits than their errors justify.

use std::{ops::Range, time::Duration};

use dashpot_network::parameters::Dimension;
use dashpot_scene::units::{format_quantity, format_short, parse_dimension, parse_quantity};

/// More significant digits are never shown.
pub(crate) const MOST_DIGITS: usize = 7;
/// Digits of a number whose error is not known.
const UNKNOWN: usize = 4;
/// Fewer digits are never shown.
const FEWEST: usize = 2;

/// Units in which impacts are read where others would suit as well: SI unit, range of the value,
/// symbol and factor.
const USUAL: [(&str, Range<f64>, &str, f64); 3] =
    [("s", 1e-5..1.0, "ms", 1e-3), ("m", 1e-5..1.0, "mm", 1e-3), ("m/s", 1e-2..1e3, "m/s", 1.0)];

/// A unit in which a quantity is shown.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Unit {
    /// Its symbol; empty for pure numbers.
    pub(crate) symbol: String,
    factor: f64,
}

impl Unit {
    /// The SI unit `si` with the prefix that suits `value`, which is in SI units.
    pub(crate) fn suiting(value: f64, si: &str) -> Self {
        if let Some((_, _, symbol, factor)) =
            USUAL.iter().find(|usual| usual.0 == si && usual.1.contains(&value.abs()))
        {
            return Self::new(symbol, *factor);
        }
        let Ok(dimension) = parse_dimension(si) else { return Self::plain(si) };
        let text = format_short(value, dimension, MOST_DIGITS);
        let Some((_, symbol)) = text.split_once(' ') else { return Self::plain("") };
        match parse_quantity(&format!("1 {symbol}")) {
            Ok(one) => Self { symbol: pretty(symbol), factor: one.value },
            Err(_) => Self::plain(si),
        }
    }

    /// The SI unit as it is.
    pub(crate) fn plain(si: &str) -> Self {
        let symbol = if si == "1" { String::new() } else { pretty(si) };
        Self { symbol, factor: 1.0 }
    }

    /// A unit of `factor` SI units.
    pub(crate) fn new(symbol: &str, factor: f64) -> Self {
        Self { symbol: symbol.to_owned(), factor }
    }

    /// The number of units in `value`.
    pub(crate) fn of(&self, value: f64) -> f64 {
        value / self.factor
    }

    /// The number of units in `value` to so many significant digits.
    pub(crate) fn number(&self, value: f64, digits: usize) -> String {
        significant(value / self.factor, digits)
    }

    /// The number of units in `value` with so many decimals.
    pub(crate) fn decimal(&self, value: f64, decimals: usize) -> String {
        let text = format!("{:.decimals$}", value / self.factor);
        // A zero has no sign.
        match text.strip_prefix('-') {
            Some(rest) if rest.bytes().all(|byte| matches!(byte, b'0' | b'.')) => rest.to_owned(),
            _ => text,
        }
    }

    /// How many decimals an absolute error justifies, at most `most`.
    pub(crate) fn decimals(&self, error: f64, most: usize) -> usize {
        let units = error / self.factor;
        (0..most).find(|&decimals| units > 0.1_f64.powf(decimals as f64 + 1.0)).unwrap_or(most)
    }

    /// Number and symbol.
    pub(crate) fn text(&self, value: f64, digits: usize) -> String {
        let number = self.number(value, digits);
        if self.symbol.is_empty() { number } else { format!("{number} {}", self.symbol) }
    }
}

/// A quantity in SI units as text in the unit that suits it.
pub(crate) fn quantity(value: f64, si: &str, digits: usize) -> String {
    Unit::suiting(value, si).text(value, digits)
}

/// A constant of a scene: without zeros at its end.
pub(crate) fn constant(value: f64, si: &str) -> String {
    rounded(value, si, MOST_DIGITS)
}

/// The same to so many significant digits.
pub(crate) fn rounded(value: f64, si: &str, digits: usize) -> String {
    let unit = Unit::suiting(value, si);
    let number = unit.number(value, digits);
    let (mantissa, power) = number.find('e').map_or((&*number, ""), |at| number.split_at(at));
    let short = match mantissa.split_once('.') {
        Some(_) => mantissa.trim_end_matches('0').trim_end_matches('.'),
        None => mantissa,
    };
    format!("{short}{power} {}", unit.symbol).trim_end().to_owned()
}

/// A time that a computer took.
pub(crate) fn duration(time: Duration) -> String {
    format_quantity(time.as_secs_f64(), Dimension::TIME, 2)
}

/// A tolerance as a power of ten, to three significant digits without zeros at the end.
pub(crate) fn tolerance(value: f64) -> String {
    let rounded = format!("{value:.2e}");
    rounded.parse::<f64>().map_or(rounded, |value| format!("{value:e}"))
}

/// How many significant digits of `value` its absolute error justifies, at most `most`: the unit of
/// the last digit is not larger than the error, so that rounding stays within it.
pub(crate) fn digits(value: f64, error: Option<f64>, most: usize) -> usize {
    let Some(error) = error else { return UNKNOWN.min(most) };
    let justified = (value.abs().log10().floor() + 1.0 - error.log10()).ceil();
    if justified.is_nan() {
        return if error == 0.0 { most } else { FEWEST };
    }
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a difference of logarithms; negative ones and infinities saturate"
    )]
    let justified = justified as usize;
    justified.clamp(FEWEST, most)
}

/// An error relative to its value in percent, rounded up to one digit.
pub(crate) fn bound(relative: f64) -> String {
    if !relative.is_finite() {
        return "unknown".to_owned();
    }
    let percent = 100.0 * relative;
    if percent <= 0.0 {
        return "0 %".to_owned();
    }
    let power = 10.0_f64.powf(percent.log10().floor());
    // What exceeds a whole digit by rounding alone is that digit.
    shown_percent((percent / power - 1e-9).ceil() * power, 1)
}

/// A relative difference in percent: to two digits, or where it is tiny rounded up to one.
pub(crate) fn apart(relative: f64) -> String {
    if relative >= 1e-4 { share(relative) } else { bound(relative) }
}

/// A share in percent to two digits.
pub(crate) fn share(relative: f64) -> String {
    shown_percent(100.0 * relative, 2)
}

fn shown_percent(percent: f64, digits: usize) -> String {
    let small = percent != 0.0 && percent.abs() < 0.995e-3;
    if small {
        return format!("{percent:.0e} %");
    }
    format!("{} %", significant(percent, digits))
}

/// A number to so many significant digits.
pub(crate) fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 || !value.is_finite() {
        return if value == 0.0 { "0".to_owned() } else { "–".to_owned() };
    }
    let places = digits.max(1) - 1;
    let scientific = format!("{value:.places$e}");
    let exponent = scientific.split_once('e').and_then(|(_, power)| power.parse::<i32>().ok());
    let exponent = exponent.unwrap_or(0);
    let decimals = i32::try_from(places).unwrap_or(0) - exponent;
    match usize::try_from(decimals) {
        Ok(decimals) if exponent >= -5 => format!("{value:.decimals$}"),
        Err(_) if exponent < 7 => {
            let rounded: f64 = scientific.parse().unwrap_or(value);
            format!("{rounded:.0}")
        }
        _ => scientific,
    }
}

/// An estimate with its formula.
pub(crate) fn estimate(formula: &str, value: f64) -> String {
    let number = if value > 0.0 { significant(value, 2) } else { "0".to_owned() };
    format!("{formula} = {number}")
}

/// Powers as people write them.
fn pretty(text: &str) -> String {
    text.replace("^2", "²").replace("^3", "³")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_digits_that_their_errors_justify() {
        assert_eq!(digits(38_359.0, Some(3.8), 7), 5);
        assert_eq!(digits(38_359.0, Some(1e-7), 7), 7);
        assert_eq!(digits(104.8, Some(0.017), 7), 5);
        assert_eq!(digits(0.0, Some(1.0), 7), 2);
        assert_eq!(digits(1.0, Some(5.0), 7), 2);
        assert_eq!(digits(3886.6, Some(1.2), 7), 4);
        assert_eq!(digits(1.0, None, 7), 4);
        assert_eq!(digits(0.0, Some(0.0), 7), 7);
        assert_eq!(digits(1.0, Some(f64::INFINITY), 7), 2);
    }

    #[test]
    fn quantities_have_a_handy_unit() {
        assert_eq!(quantity(38_359.41, "N", 4), "38.36 kN");
        assert_eq!(quantity(3835.941, "m/s^2", 4), "3836 m/s²");
        assert_eq!(quantity(-1.5321, "m/s", 3), "-1.53 m/s");
        assert_eq!(quantity(0.25, "1", 3), "0.250");
        assert_eq!(Unit::plain("s").text(5019.61, 3), "5020 s");
        assert_eq!(constant(2e7, "N/m"), "20 MN/m");
        assert_eq!(constant(2e-4, "m"), "0.2 mm");
        assert_eq!(constant(0.0, "N"), "0 N");
        assert_eq!(constant(1e300, "N"), "1e291 GN");
        assert_eq!(rounded(82.549_88, "J", 4), "82.55 J");
    }

    #[test]
    fn errors_are_rounded_up_and_shares_to_the_nearest() {
        assert_eq!(bound(1e-3), "0.1 %");
        assert_eq!(bound(1.01e-4), "0.02 %");
        assert_eq!(bound(9.5e-5), "0.01 %");
        assert_eq!(bound(2.6e-12), "3e-10 %");
        assert_eq!(bound(f64::INFINITY), "unknown");
        assert_eq!(share(0.9752), "98 %");
    }

    #[test]
    fn tolerances_have_three_digits_at_most() {
        assert_eq!(tolerance(3.162_277_660_168_379e-6), "3.16e-6");
        assert_eq!(tolerance(1e-6), "1e-6");
        assert_eq!(tolerance(2.5e-13), "2.5e-13");
    }

    #[test]
    fn decimals_have_no_negative_zero() {
        let joule = Unit::plain("J");
        assert_eq!(joule.decimal(-1e-9, 2), "0.00");
        assert_eq!(joule.decimal(-1.0, 2), "-1.00");
    }
}
