//! Quantities as people read them: in handy units, to so many digits.

use std::ops::Range;

use super::{Dimension, format::handy, parse_dimension, si_unit};

/// Digits by which a unit is chosen.
const MOST_DIGITS: usize = 7;

/// Units with the prefixes of energies: what is lost in a volume is no pressure.
const AS_ENERGIES: [&str; 4] = ["J/m³", "W", "W/m^2", "W/N^2"];

/// Units in which impacts are read where others would suit as well: SI unit, range of the value, symbol and factor.
const USUAL: [(&str, Range<f64>, &str, f64); 3] =
    [("s", 1e-5..1.0, "ms", 1e-3), ("m", 1e-5..1.0, "mm", 1e-3), ("m/s", 1e-2..1e3, "m/s", 1.0)];

/// A unit in which a quantity is shown.
#[derive(Debug, Clone, PartialEq)]
pub struct Unit {
    /// Its symbol; empty for pure numbers.
    pub symbol: String,
    factor: f64,
}

impl Unit {
    /// The SI unit `si` with the prefix that suits `value`, which is in SI units.
    pub fn suiting(value: f64, si: &str) -> Self {
        if AS_ENERGIES.contains(&si) {
            let energy = Self::suiting(value, "J");
            let prefix = energy.symbol.trim_end_matches('J');
            return Self { symbol: pretty(&format!("{prefix}{si}")), ..energy };
        }
        if let Some((_, _, symbol, factor)) =
            USUAL.iter().find(|usual| usual.0 == si && usual.1.contains(&value.abs()))
        {
            return Self::new(symbol, *factor);
        }
        let Ok(dimension) = parse_dimension(si) else { return Self::plain(si) };
        let rounded = format!("{value:.*e}", MOST_DIGITS - 1);
        let exponent = rounded.split_once('e').and_then(|own| own.1.parse().ok());
        let Some(exponent) = exponent.filter(|_| value != 0.0 && dimension != Dimension::NUMBER)
        else {
            return Self::plain(&si_unit(dimension));
        };
        let (symbol, power) = handy(dimension, exponent);
        // As a literal, which is rounded once.
        let factor = format!("1e{power}").parse().unwrap_or(1.0);
        Self { symbol: pretty(&symbol), factor }
    }

    /// The SI unit as it is.
    pub fn plain(si: &str) -> Self {
        let symbol = if si == "1" { String::new() } else { pretty(si) };
        Self { symbol, factor: 1.0 }
    }

    /// A unit of `factor` SI units.
    pub fn new(symbol: &str, factor: f64) -> Self {
        Self { symbol: symbol.to_owned(), factor }
    }

    /// The number of units in `value`.
    pub fn of(&self, value: f64) -> f64 {
        value / self.factor
    }

    /// The number of units in `value` to so many significant digits.
    pub fn number(&self, value: f64, digits: usize) -> String {
        significant(value / self.factor, digits)
    }

    /// The number of units in `value` with so many decimals.
    pub fn decimal(&self, value: f64, decimals: usize) -> String {
        let text = format!("{:.decimals$}", value / self.factor);
        // A zero has no sign.
        match text.strip_prefix('-') {
            Some(rest) if rest.bytes().all(|byte| matches!(byte, b'0' | b'.')) => rest.to_owned(),
            _ => text,
        }
    }

    /// How many decimals an absolute error justifies, at most `most`.
    pub fn decimals(&self, error: f64, most: usize) -> usize {
        let units = error / self.factor;
        (0..most).find(|&decimals| units > 0.1_f64.powf(decimals as f64 + 1.0)).unwrap_or(most)
    }

    /// Number and symbol.
    pub fn text(&self, value: f64, digits: usize) -> String {
        let number = self.number(value, digits);
        if self.symbol.is_empty() { number } else { format!("{number} {}", self.symbol) }
    }
}

/// A quantity in SI units as text in the unit that suits it.
pub fn quantity(value: f64, si: &str, digits: usize) -> String {
    Unit::suiting(value, si).text(value, digits)
}

/// The same without zeros at the end.
pub fn rounded(value: f64, si: &str, digits: usize) -> String {
    let unit = Unit::suiting(value, si);
    let number = unit.number(value, digits);
    let (mantissa, power) = number.find('e').map_or((&*number, ""), |at| number.split_at(at));
    let short = match mantissa.split_once('.') {
        Some(_) => mantissa.trim_end_matches('0').trim_end_matches('.'),
        None => mantissa,
    };
    format!("{short}{power} {}", unit.symbol).trim_end().to_owned()
}

/// A share in percent to so many significant digits.
pub fn percent(share: f64, digits: usize) -> String {
    let percent = 100.0 * share;
    let is_small = percent != 0.0 && percent.abs() < 0.995e-3;
    if is_small {
        format!("{percent:.0e} %")
    } else {
        format!("{} %", significant(percent, digits))
    }
}

/// A number to so many significant digits.
pub fn significant(value: f64, digits: usize) -> String {
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

/// Powers as people write them.
fn pretty(text: &str) -> String {
    text.replace("^2", "²").replace("^3", "³")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantities_have_a_handy_unit() {
        assert_eq!(quantity(38_359.41, "N", 4), "38.36 kN");
        assert_eq!(quantity(3835.941, "m/s^2", 4), "3836 m/s²");
        assert_eq!(quantity(-1.5321, "m/s", 3), "-1.53 m/s");
        assert_eq!(quantity(0.25, "1", 3), "0.250");
        assert_eq!(quantity(0.007_425_568, "s", 3), "7.43 ms");
        assert_eq!(quantity(1500.0, "s", 3), "1500 s");
        assert_eq!(quantity(3e-12, "s", 3), "0.00300 ns");
        assert_eq!(Unit::plain("s").text(5019.61, 3), "5020 s");
        assert_eq!(rounded(2e7, "N/m", 7), "20 MN/m");
        assert_eq!(rounded(2e-4, "m", 7), "0.2 mm");
        assert_eq!(rounded(0.0, "N", 7), "0 N");
        assert_eq!(rounded(1e300, "N", 7), "1e291 GN");
        assert_eq!(rounded(82.549_88, "J", 4), "82.55 J");
        assert_eq!(quantity(2.5e5, "J/m³", 3), "250 kJ/m³");
        assert_eq!(quantity(1.5e6, "J/m³", 3), "1.50 MJ/m³");
        assert_eq!(quantity(0.0, "J/m³", 3), "0 J/m³");
        assert_eq!(quantity(2.5e-5, "W", 3), "25.0 µW");
        assert_eq!(quantity(9.2e6, "W/m^2", 3), "9.20 MW/m²");
    }

    #[test]
    fn decimals_have_no_negative_zero() {
        let joule = Unit::plain("J");
        assert_eq!(joule.decimal(-1e-9, 2), "0.00");
        assert_eq!(joule.decimal(-1.0, 2), "-1.00");
    }
}
