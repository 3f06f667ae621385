//! Quantities in running text.

/// A quantity with three significant digits and the prefix that suits it, for instance `7.43 ms`.
/// Units of mechanics with a common prefix are `s`, `m`, `N` and `J`; others are left as they are.
pub(crate) fn quantity(value: f64, unit: &str) -> String {
    const PREFIXES: [(f64, &str); 6] =
        [(1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n")];
    let size = value.abs();
    if !matches!(unit, "s" | "m" | "N" | "J") || size == 0.0 || !size.is_finite() {
        return format!("{} {unit}", three_digits(value));
    }
    let prefixes = match unit {
        "s" | "m" => &PREFIXES[2..],
        _ => &PREFIXES[..],
    };
    // Values that round up to the next prefix belong to it.
    let fits = |prefix: &&(f64, &str)| size >= 0.9995 * prefix.0;
    let (factor, prefix) = prefixes.iter().find(fits).copied().unwrap_or((1e-9, "n"));
    format!("{} {prefix}{unit}", three_digits(value / factor))
}

/// A share in percent with two significant digits.
pub(crate) fn percent(share: f64) -> String {
    let value = 100.0 * share;
    if value != 0.0 && !(1e-3..1e3).contains(&value.abs()) {
        return format!("{value:.1e} %");
    }
    format!("{} %", digits(value, 2))
}

fn three_digits(value: f64) -> String {
    if value != 0.0 && !(1e-3..1e6).contains(&value.abs()) {
        return format!("{value:.2e}");
    }
    digits(value, 3)
}

fn digits(value: f64, significant: usize) -> String {
    let mut decimals = significant - 1;
    let mut limit = 10.0;
    while decimals > 0 && value.abs() >= 0.9995 * limit {
        limit *= 10.0;
        decimals -= 1;
    }
    let mut small = 1.0;
    while value != 0.0 && value.abs() < 0.9995 * small && decimals < 12 {
        small /= 10.0;
        decimals += 1;
    }
    format!("{value:.decimals$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantities_have_three_digits_and_a_fitting_prefix() {
        assert_eq!(quantity(0.007_425_568, "s"), "7.43 ms");
        assert_eq!(quantity(0.999_96e-3, "s"), "1.00 ms");
        assert_eq!(quantity(38_359.4, "N"), "38.4 kN");
        assert_eq!(quantity(0.0, "m"), "0.00 m");
        assert_eq!(quantity(1500.0, "s"), "1500 s");
        assert_eq!(quantity(-0.48, "m/s"), "-0.480 m/s");
        assert_eq!(quantity(3e-12, "s"), "0.00300 ns");
    }

    #[test]
    fn shares_have_two_digits() {
        assert_eq!(percent(0.001), "0.10 %");
        assert_eq!(percent(0.0123), "1.2 %");
        assert_eq!(percent(2e-9), "2.0e-7 %");
    }
}
