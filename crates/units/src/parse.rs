//! Reading quantities.

use thiserror::Error;

use super::{
    Dimension, Exponent, STANDARD_GRAVITY,
    symbols::{self, Unit},
};

/// A quantity is not longer than this, in bytes.
const LONGEST: usize = 200;

/// A number with its dimension.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quantity {
    /// The value in SI units, finite.
    pub value: f64,
    /// What it measures; `None` where no unit was given, which fits everywhere.
    pub dimension: Option<Dimension>,
    /// Exponent of the angle in its unit: 1 for `rad` and `rad/s`, 0 for `Hz`.
    pub angle: i8,
    /// Exponent of the amount of substance in its unit: 1 for `mol`, which counts as a number, −1 for `J/mol`.
    pub amount: i8,
    /// Whether it was given in degrees Celsius, so that it is no difference of temperatures.
    pub is_celsius: bool,
    /// Whether its unit is `g` alone: the gram, but standard gravity where an acceleration is expected.
    pub is_gram: bool,
}

impl Quantity {
    /// The quantity of this value in SI units.
    pub const fn of(value: f64, dimension: Dimension) -> Self {
        let dimension = Some(dimension);
        Self { value, dimension, angle: 0, amount: 0, is_celsius: false, is_gram: false }
    }

    /// What it is where this dimension is expected: `"250 g"` is an acceleration where one is.
    ///
    /// # Examples
    ///
    /// ```
    /// use dashpot_units::{Dimension, parse_quantity};
    ///
    /// let written = parse_quantity("250 g")?;
    /// assert_eq!(written.meant(Dimension::MASS).value, 0.25);
    /// assert_eq!(written.meant(Dimension::ACCELERATION).value, 250.0 * 9.80665);
    /// # Ok::<(), dashpot_units::UnitError>(())
    /// ```
    #[must_use]
    pub fn meant(self, expected: Dimension) -> Self {
        if !self.is_gram || expected != Dimension::ACCELERATION {
            return self;
        }
        let value = self.value * 1e3 * STANDARD_GRAVITY;
        Self { value, dimension: Some(Dimension::ACCELERATION), is_gram: false, ..self }
    }
}

/// Why a text is not a quantity.
///
/// `text` is what was given.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum UnitError {
    /// There is no number at the start.
    #[error("`{text}` does not begin with a number")]
    NoNumber { text: String },
    /// NaN or infinity.
    #[error("`{text}` is not finite: every quantity is a finite number")]
    NotFinite { text: String },
    /// Larger than the largest double.
    #[error("`{text}` is too large: it does not fit into double precision")]
    TooLarge { text: String },
    /// Not zero, but smaller than the smallest double.
    #[error("`{text}` is too small: it would be rounded to zero")]
    TooSmall { text: String },
    /// A comma in a number.
    #[error("`{text}` has a comma: decimals are written with a point")]
    DecimalComma { text: String },
    /// A space or another mark between the digits of a number.
    #[error("`{text}` has a space or a mark within the number, which is not read")]
    Separated { text: String, joined: String },
    /// A symbol that is no unit.
    #[error("`{symbol}` is not a known unit")]
    UnknownUnit { symbol: String, unit: String, meant: Option<String> },
    /// Degrees Celsius as a part of a unit.
    #[error("`{unit}` has degrees Celsius in it, which count from a point of their own")]
    CelsiusInProduct { unit: String },
    /// A unit that cannot be read.
    #[error("`{text}` is not a unit that can be read")]
    Malformed { text: String },
}

/// Reads a quantity such as `"20 MN/m"` or `"0.1 %"`.
///
/// # Examples
///
/// ```
/// use dashpot_units::{Dimension, parse_quantity};
///
/// let stiffness = parse_quantity("20 MN/m")?;
/// assert_eq!(stiffness.value, 2e7);
/// assert_eq!(stiffness.dimension, Some(Dimension::STIFFNESS));
/// assert_eq!(parse_quantity("0.25")?.dimension, None);
/// # Ok::<(), dashpot_units::UnitError>(())
/// ```
///
/// # Errors
///
/// [`UnitError`] when the text is not a number with a known unit, or not finite.
pub fn parse_quantity(text: &str) -> Result<Quantity, UnitError> {
    let text = text.trim();
    if text.len() > LONGEST {
        let shown = text.chars().take(20).collect::<String>() + "…";
        return Err(UnitError::Malformed { text: shown });
    }
    let (number, rest) = split_number(text)?;
    let unit_text = rest.trim();
    if symbols::is_celsius(unit_text) {
        return celsius(text, number);
    }
    let unit = match unit_text {
        "" => None,
        _ => match parse_unit(unit_text) {
            Err(UnitError::Malformed { .. }) if begins_with_digits(rest) => {
                return Err(UnitError::Separated { text: text.to_owned(), joined: joined(text) });
            }
            found => Some(found?),
        },
    };
    let (factor, exponent) = unit.map_or((1.0, 0), |unit| (unit.factor, unit.exponent));
    let value = scaled(number, exponent).map_or(f64::NAN, |value| value * factor);
    if !value.is_finite() {
        return Err(UnitError::TooLarge { text: text.to_owned() });
    }
    if value == 0.0 && has_digit_above_zero(number) {
        return Err(UnitError::TooSmall { text: text.to_owned() });
    }
    Ok(Quantity {
        value,
        dimension: unit.map(|unit| unit.dimension),
        angle: unit.map_or(0, |unit| unit.angle),
        amount: unit.map_or(0, |unit| unit.amount),
        is_celsius: false,
        is_gram: unit_text == "g",
    })
}

/// The temperature of `number` degrees Celsius.
fn celsius(text: &str, number: &str) -> Result<Quantity, UnitError> {
    let value = scaled(number, 0).map_or(f64::NAN, |number| number + symbols::CELSIUS_ZERO);
    if !value.is_finite() {
        return Err(UnitError::TooLarge { text: text.to_owned() });
    }
    Ok(Quantity {
        value,
        dimension: Some(Dimension::TEMPERATURE),
        angle: 0,
        amount: 0,
        is_celsius: true,
        is_gram: false,
    })
}

/// The dimension of a unit such as `"N s/m"`.
///
/// # Errors
///
/// [`UnitError`] when the unit is not known.
pub fn parse_dimension(unit: &str) -> Result<Dimension, UnitError> {
    match unit.trim() {
        "" | "1" => Ok(Dimension::NUMBER),
        unit if symbols::is_celsius(unit) => Ok(Dimension::TEMPERATURE),
        unit => parse_unit(unit).map(|unit| unit.dimension),
    }
}

/// `number · 10^exponent`, rounded once.
fn scaled(number: &str, exponent: i32) -> Option<f64> {
    if exponent == 0 {
        return number.parse().ok();
    }
    let (mantissa, own) = number.split_once(['e', 'E']).unwrap_or((number, "0"));
    // An exponent beyond i32 is beyond double precision as well.
    let own = own.parse::<i32>().unwrap_or(if own.starts_with('-') { -9999 } else { 9999 });
    format!("{mantissa}e{}", own.saturating_add(exponent)).parse().ok()
}

/// Whether digits go on after a space or a mark, as in `60 000`.
fn begins_with_digits(rest: &str) -> bool {
    let digits = rest.trim_start_matches([' ', '\u{a0}', '\u{202f}', '\'', '’', '_']);
    digits.len() < rest.len() && digits.starts_with(|first: char| first.is_ascii_digit())
}

/// `text` without what stands between two digits and is none itself, points excepted.
fn joined(text: &str) -> String {
    let all = text.chars().collect::<Vec<_>>();
    let is_digit = |at: Option<usize>| {
        at.and_then(|at| all.get(at)).is_some_and(|digit: &char| digit.is_ascii_digit())
    };
    let is_mark = |at: usize| {
        matches!(all[at], ' ' | '\u{a0}' | '\u{202f}' | '\'' | '’' | '_')
            && is_digit(at.checked_sub(1))
            && is_digit(Some(at + 1))
    };
    (0..all.len()).filter(|&at| !is_mark(at)).map(|at| all[at]).collect()
}

fn has_digit_above_zero(number: &str) -> bool {
    let mantissa = number.split(['e', 'E']).next().unwrap_or_default();
    mantissa.chars().any(|digit| ('1'..='9').contains(&digit))
}

/// The number at the start of `text`, and the rest.
fn split_number(text: &str) -> Result<(&str, &str), UnitError> {
    let bytes = text.as_bytes();
    let digits = |mut at: usize| {
        while bytes.get(at).is_some_and(u8::is_ascii_digit) {
            at += 1;
        }
        at
    };
    let sign = |at: usize| at + usize::from(matches!(bytes.get(at), Some(b'+' | b'-')));
    let start = sign(0);
    let whole = digits(start);
    let mut end = whole;
    let mut count = whole - start;
    if bytes.get(end) == Some(&b'.') {
        end = digits(end + 1);
        count += end - whole - 1;
    }
    if count == 0 {
        let word = text[start..].split_whitespace().next().unwrap_or_default().to_lowercase();
        let text = text.to_owned();
        return Err(match word.as_str() {
            "nan" | "inf" | "infinity" | "∞" => UnitError::NotFinite { text },
            _ => UnitError::NoNumber { text },
        });
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let exponent = sign(end + 1);
        let stop = digits(exponent);
        if stop > exponent {
            end = stop;
        }
    }
    if bytes.get(end) == Some(&b',') && bytes.get(end + 1).is_some_and(u8::is_ascii_digit) {
        return Err(UnitError::DecimalComma { text: text.to_owned() });
    }
    Ok(text.split_at(end))
}

fn parse_unit(text: &str) -> Result<Unit, UnitError> {
    let malformed = || UnitError::Malformed { text: text.to_owned() };
    let mut product = Unit::ONE;
    // Sign of the power outside each open parenthesis, and that of the next symbol.
    let mut outer = vec![1_i8];
    let mut sign = 1_i8;
    let mut rest = text;
    let mut expects_factor = true;
    while let Some(next) = rest.chars().next() {
        let around = *outer.last().ok_or_else(malformed)?;
        match next {
            ' ' | '\u{a0}' | '\u{202f}' => rest = &rest[next.len_utf8()..],
            '*' | '·' | '⋅' | '/' if !expects_factor => {
                sign = if next == '/' { -1 } else { 1 };
                rest = &rest[next.len_utf8()..];
                expects_factor = true;
            }
            '(' => {
                outer.push(around * sign);
                sign = 1;
                rest = &rest[1..];
                expects_factor = true;
            }
            ')' if outer.len() > 1 && !expects_factor => {
                outer.pop();
                rest = &rest[1..];
            }
            '1' if expects_factor => {
                sign = 1;
                rest = &rest[1..];
                expects_factor = false;
            }
            _ => {
                let (word, after) = split_symbol(rest);
                if word.is_empty() {
                    return Err(malformed());
                }
                if symbols::is_celsius(word) {
                    return Err(UnitError::CelsiusInProduct { unit: text.trim().to_owned() });
                }
                let factor = symbols::symbol(word).ok_or_else(|| UnitError::UnknownUnit {
                    symbol: word.to_owned(),
                    unit: text.trim().to_owned(),
                    meant: symbols::meant(word),
                })?;
                let (power, after) = split_power(after).ok_or_else(malformed)?;
                let power = if sign * around < 0 { -power } else { power };
                product = times(product, factor, power).ok_or_else(malformed)?;
                (sign, rest, expects_factor) = (1, after, false);
            }
        }
    }
    if outer.len() > 1 || expects_factor { Err(malformed()) } else { Ok(product) }
}

fn split_symbol(text: &str) -> (&str, &str) {
    if let Some(rest) = text.strip_prefix("g0") {
        return (&text[..2], rest);
    }
    let end = text
        .find(|c: char| !(c.is_alphabetic() || matches!(c, '%' | '°' | 'µ')))
        .unwrap_or(text.len());
    text.split_at(end)
}

/// The power after a symbol, 1 where there is none; `None` where it cannot be read.
fn split_power(text: &str) -> Option<(Exponent, &str)> {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let explicit = text.strip_prefix('^');
    let body = explicit.unwrap_or(text);
    let (sign, digits) =
        body.strip_prefix(['-', '−', '⁻']).map_or((1.0, body), |digits| (-1.0, digits));
    if let Some(inner) = explicit.and_then(|body| body.strip_prefix('(')) {
        let (inner, rest) = inner.split_once(')')?;
        let (above, below) = inner.split_once('/').unwrap_or((inner, "1"));
        let [above, below] = [above, below].map(|own| own.trim().parse::<f64>().ok());
        return Some((Exponent::of(above? / below?)?, rest));
    }
    let end = digits.find(|own: char| !(own.is_ascii_digit() || own == '.'));
    let decimal = &digits[..end.unwrap_or(digits.len())];
    if explicit.is_some() && !decimal.is_empty() {
        return Some((
            Exponent::of(sign * decimal.parse::<f64>().ok()?)?,
            &digits[decimal.len()..],
        ));
    }
    let digit = digits.chars().next().and_then(|c| {
        let raised = RAISED.iter().position(|&raised| raised == c);
        let value = raised.or_else(|| c.to_digit(10).map(|digit| digit as usize))?;
        Some((f64::from(u8::try_from(value).ok()?), c.len_utf8()))
    });
    match digit {
        Some((value, length)) => Some((Exponent::of(sign * value)?, &digits[length..])),
        None if explicit.is_none() && sign > 0.0 => Some((Exponent::whole(1), text)),
        None => None,
    }
}

/// `unit · factor^power`, `None` where an exponent leaves its range, or a part of an angle or amount remains.
fn times(unit: Unit, factor: Unit, power: Exponent) -> Option<Unit> {
    let power = power.value();
    let ten = f64::from(factor.exponent) * power;
    let counted = |own: i8, other: i8| {
        let sum = f64::from(own) + power * f64::from(other);
        #[expect(clippy::cast_possible_truncation, reason = "it is whole and in range")]
        (sum.fract() == 0.0 && sum.abs() <= f64::from(i8::MAX)).then_some(sum as i8)
    };
    #[expect(clippy::cast_possible_truncation, reason = "they are small, or whole")]
    let (whole, tens) = (power as i32, ten.floor() as i32);
    let raised = if power.fract() == 0.0 {
        factor.factor.powi(whole)
    } else {
        factor.factor.powf(power) * 10_f64.powf(ten - ten.floor())
    };
    Some(Unit {
        factor: unit.factor * raised,
        exponent: unit.exponent + tens,
        dimension: unit.dimension.times(factor.dimension, power)?,
        angle: counted(unit.angle, factor.angle)?,
        amount: counted(unit.amount, factor.amount)?,
    })
}
