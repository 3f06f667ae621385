//! Numbers as text.

/// A number to so many significant digits; powers of ten only where it is very large or small.
pub(crate) fn significant(value: f64, digits: usize) -> String {
    if value.is_infinite() {
        return "∞".to_owned();
    }
    let text = dashpot_units::significant(value, digits).replace('-', "−");
    match text.split_once('e') {
        Some((mantissa, power)) => format!("{mantissa}×10{}", superscript(power)),
        None => text,
    }
}

/// The same without zeros at the end.
pub(crate) fn short(value: f64, digits: usize) -> String {
    let text = significant(value, digits);
    let (mantissa, power) = text.split_at(text.find('×').unwrap_or(text.len()));
    if mantissa.contains('.') {
        format!("{}{power}", mantissa.trim_end_matches('0').trim_end_matches('.'))
    } else {
        text
    }
}

/// A change relative to a base, in percent with its sign.
pub(crate) fn change(relative: f64) -> String {
    let percent = 100.0 * relative;
    let sign = if percent < 0.0 { "−" } else { "+" };
    format!("{sign}{:.1} %", percent.abs())
}

/// The least and the largest of some values.
pub(crate) fn extremes(values: impl IntoIterator<Item = f64>) -> [f64; 2] {
    let start = [f64::INFINITY, f64::NEG_INFINITY];
    values.into_iter().fold(start, |[low, high], own| [low.min(own), high.max(own)])
}

/// Words in a row, with `and` before the last one.
pub(crate) fn listed(words: &[String]) -> String {
    match words {
        [] => "none".to_owned(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

fn superscript(power: &str) -> String {
    let digit = |own: char| match own {
        '−' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        other => char::from_u32(0x2070 + other.to_digit(10).unwrap_or(0)).unwrap_or(other),
    };
    power.chars().map(digit).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_digits_asked_for() {
        assert_eq!(significant(26.666_666, 5), "26.667");
        assert_eq!(significant(-0.001_234, 2), "−0.0012");
        assert_eq!(significant(8.737e-10, 3), "8.74×10⁻¹⁰");
        assert_eq!(significant(20_128_523.0, 4), "2.013×10⁷");
        assert_eq!(significant(38_359.4, 3), "38400");
        assert_eq!(significant(0.0, 3), "0");
        assert_eq!(short(20.0, 4), "20");
        assert_eq!(short(26.6, 6), "26.6");
        assert_eq!(short(4.0e-12, 6), "4×10⁻¹²");
    }

    #[test]
    fn changes_have_a_sign_and_lists_an_and() {
        assert_eq!((change(0.05), change(-0.125)), ("+5.0 %".into(), "−12.5 %".into()));
        let words = ["a", "b", "c"].map(str::to_owned);
        assert_eq!(listed(&words), "a, b and c");
        assert_eq!(listed(&words[..1]), "a");
        assert_eq!(listed(&[]), "none");
    }
}
