//! Numbers as people read them: in handy units, with no more digits than their errors justify.

use std::time::Duration;

use dashpot_units::{Dimension, format_quantity, percent};
pub use dashpot_units::{Unit, quantity, rounded, significant};

/// More significant digits are never shown.
pub const MOST_DIGITS: usize = 7;
/// Digits of a number whose error is not known.
const UNKNOWN: usize = 4;
/// Fewer digits are never shown.
const FEWEST: usize = 2;

/// A constant of a scene: without zeros at its end.
pub fn constant(value: f64, si: &str) -> String {
    rounded(value, si, MOST_DIGITS)
}

/// A number of things: `1 design`, `2 designs`.
pub fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

/// A time that a computer took.
pub fn duration(time: Duration) -> String {
    format_quantity(time.as_secs_f64(), Dimension::TIME, 2)
}

/// A tolerance as a power of ten, to three significant digits without zeros at the end.
pub fn tolerance(value: f64) -> String {
    let rounded = format!("{value:.2e}");
    rounded.parse::<f64>().map_or(rounded, |value| format!("{value:e}"))
}

/// How many significant digits of `value` its absolute error justifies, at most `most`: the unit of
/// the last digit is not larger than the error, so that rounding stays within it.
pub fn digits(value: f64, error: Option<f64>, most: usize) -> usize {
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

/// A share in percent to two digits with its sign.
pub fn percent_signed(share: f64) -> String {
    let text = percent(share.abs(), 2);
    if share < 0.0 { format!("−{text}") } else { text }
}

/// An error relative to its value in percent, rounded up to one digit.
pub fn bound(relative: f64) -> String {
    if !relative.is_finite() {
        return "unknown".to_owned();
    }
    let percent = 100.0 * relative;
    if percent <= 0.0 {
        return "0 %".to_owned();
    }
    let power = 10.0_f64.powf(percent.log10().floor());
    // What exceeds a whole digit by rounding alone is that digit.
    self::percent((percent / power - 1e-9).ceil() * power / 100.0, 1)
}

/// A relative difference in percent: to two digits, or where it is tiny rounded up to one.
pub fn apart(relative: f64) -> String {
    if relative >= 1e-4 { share(relative) } else { bound(relative) }
}

/// A share in percent to two digits.
pub fn share(relative: f64) -> String {
    percent(relative, 2)
}

/// A formula with its estimated value, to two digits.
pub fn estimate(formula: &str, value: f64) -> String {
    format!("{formula} = {}", estimated(value))
}

/// An estimate to two digits; what is not positive is zero.
pub fn estimated(value: f64) -> String {
    if value > 0.0 { significant(value, 2) } else { "0".to_owned() }
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
}
