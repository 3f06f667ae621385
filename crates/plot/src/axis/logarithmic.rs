//! Logarithmic axes: decades, their parts where decades are few, and labels with prefixes.

use super::{Axis, LARGEST, PADDING, decimals_of, power_of_ten, round_ticks};

/// Spans \[decades\] below this hold nothing to be seen and are drawn as a constant.
const FLAT: f64 = 1e-4;
/// Room around a constant, at each end \[decades\].
const AROUND: f64 = 0.5;
/// Slack of a tick at the end of an axis \[decades\].
const SLACK: f64 = 1e-9;

/// Prefixes by their power of ten.
const PREFIXES: [(i32, &str); 9] =
    [(-12, "p"), (-9, "n"), (-6, "µ"), (-3, "m"), (0, ""), (3, "k"), (6, "M"), (9, "G"), (12, "T")];

/// Units that take prefixes, and the greatest power of ten they take. Nobody reads kiloseconds.
const PREFIXED: [(&str, i32); 9] = [
    ("s", 0),
    ("m", 0),
    ("m/N", 0),
    ("N", 12),
    ("N/m", 12),
    ("N s/m", 12),
    ("Pa", 12),
    ("Pa s", 12),
    ("Hz", 12),
];

/// What the labels of a logarithmic axis have in common.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Labels {
    unit: String,
    /// Greatest power of ten that has a prefix; `None` for a unit without prefixes.
    prefixed_to: Option<i32>,
    /// Whether all ticks are numbers of a few digits.
    is_plain: bool,
}

/// Decimal logarithm of a positive value, kept within what an axis can span; NaN for any other.
pub(super) fn coordinate(value: f64) -> f64 {
    if value > 0.0 { value.clamp(LARGEST.recip(), LARGEST).log10() } else { f64::NAN }
}

/// A logarithmic axis over the positive ones of `values`; without any from 1 to 10.
pub(super) fn axis(
    values: impl Iterator<Item = f64>,
    padded: bool,
    wanted: usize,
    unit: &str,
) -> Axis {
    let (low, high) = range(values, padded);
    let (ticks, minor) = ticks(low, high, wanted);
    let prefixed_to = PREFIXED.iter().find(|(name, _)| *name == unit).map(|(_, most)| *most);
    let is_plain = ticks.iter().all(|tick| (0.99e-3..1.01e4).contains(tick));
    let labels = super::Labels::Logarithmic(Labels { unit: unit.into(), prefixed_to, is_plain });
    Axis { low, high, ticks, minor, labels }
}

fn range(values: impl Iterator<Item = f64>, padded: bool) -> (f64, f64) {
    let (low, high) = values
        .filter(|v| v.is_finite())
        .map(coordinate)
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    if low > high {
        return (0.0, 1.0);
    }
    if high - low < FLAT {
        return (low - AROUND, high + AROUND);
    }
    let room = if padded { PADDING * (high - low) } else { 0.0 };
    (low - room, high + room)
}

/// Labelled and unlabelled ticks between two powers of ten.
fn ticks(low: f64, high: f64, wanted: usize) -> (Vec<f64>, Vec<f64>) {
    let (first, last) = (whole((low - SLACK).ceil()), whole((high + SLACK).floor()));
    let within = |value: &f64| (low - SLACK..=high + SLACK).contains(&value.log10());
    let parts = |parts: &[f64]| -> Vec<f64> {
        let of_decade = |e: i32| parts.iter().map(move |part| part * 10_f64.powi(e));
        (first - 1..=last).flat_map(of_decade).filter(within).collect()
    };
    let decades = last - first + 1;
    if decades < 3 {
        let few = parts(&[1.0, 2.0, 5.0]);
        return if few.len() < 3 {
            (round_ticks(10_f64.powf(low), 10_f64.powf(high), wanted).0, Vec::new())
        } else {
            (few, parts(&[3.0, 4.0, 6.0, 7.0, 8.0, 9.0]))
        };
    }
    let wanted = i32::try_from(wanted).unwrap_or(i32::MAX / 8);
    let most = (wanted + wanted / 2).max(3);
    let multiples = |stride: i32| last.div_euclid(stride) - (first - 1).div_euclid(stride);
    let mut stride = 1;
    while multiples(stride) > most {
        stride = if stride == 1 { 3 } else { stride + 3 };
    }
    let (labelled, rest): (Vec<i32>, Vec<i32>) =
        (first..=last).partition(|e| e.rem_euclid(stride) == 0);
    let powers = |exponents: &[i32]| exponents.iter().map(|e| 10_f64.powi(*e)).collect();
    let minor = match stride {
        1 if decades <= wanted => parts(&[2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]),
        1 => Vec::new(),
        _ if decades <= 6 * wanted => powers(&rest),
        _ => Vec::new(),
    };
    (powers(&labelled), minor)
}

impl Labels {
    /// Label of a tick with its unit, or as a power of ten.
    pub(super) fn tick(&self, tick: f64) -> String {
        let exponent = whole((tick.log10() + SLACK).floor());
        let prefix = self.prefixed_to.and_then(|most| {
            let thousands = (3 * exponent.div_euclid(3)).min(most);
            PREFIXES.iter().find(|(power, _)| *power == thousands)
        });
        match (prefix, self.prefixed_to) {
            (Some((power, prefix)), _) if exponent < power + 3 => {
                format!("{} {prefix}{}", number(tick / 10_f64.powi(*power)), self.unit)
            }
            (_, Some(_)) => format!("{} {}", power(tick, exponent), self.unit),
            _ if self.is_plain => number(tick),
            _ => power(tick, exponent),
        }
    }

    /// The quantity, with its unit where the ticks leave it out.
    pub(super) fn title(&self, quantity: &str) -> String {
        if self.prefixed_to.is_some() || self.unit.is_empty() {
            quantity.to_owned()
        } else {
            format!("{quantity} ({})", self.unit)
        }
    }
}

/// A number with the decimals it needs.
fn number(value: f64) -> String {
    format!("{value:.*}", decimals_of(value))
}

/// A number with a power of ten, as in `10⁻⁶` and `2·10⁴`.
fn power(value: f64, exponent: i32) -> String {
    let factor = number(value / 10_f64.powi(exponent));
    match (exponent, factor.as_str()) {
        (0, _) => factor,
        (1, "1") => "10".to_owned(),
        (_, "1") => power_of_ten(exponent),
        _ => format!("{factor}·{}", power_of_ten(exponent)),
    }
}

#[expect(clippy::cast_possible_truncation, reason = "powers of ten of an axis are within ±291")]
fn whole(exponent: f64) -> i32 {
    exponent as i32
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(unit: &str, low: f64, high: f64) -> Vec<String> {
        let axis = axis([low, high].into_iter(), false, 8, unit);
        axis.ticks().iter().map(|tick| axis.tick_label(*tick)).collect()
    }

    #[test]
    fn decades_carry_prefixes_as_far_as_the_unit_takes_them() {
        assert_eq!(labels("s", 1e-5, 1e-2), ["10 µs", "100 µs", "1 ms", "10 ms"]);
        assert_eq!(labels("s", 1e-1, 1e4), ["100 ms", "1 s", "10 s", "100 s", "10³ s", "10⁴ s"]);
        assert_eq!(labels("N/m", 1e2, 1e5), ["100 N/m", "1 kN/m", "10 kN/m", "100 kN/m"]);
        assert_eq!(labels("m/N", 1e-15, 1e-13), ["10⁻¹⁵ m/N", "10⁻¹⁴ m/N", "10⁻¹³ m/N"]);
    }

    #[test]
    fn units_without_prefixes_stand_behind_the_quantity() {
        let far = axis([1e-3, 1e5].into_iter(), false, 8, "rad/s");
        assert_eq!(far.title("angular frequency"), "angular frequency (rad/s)");
        assert_eq!(labels("rad/s", 1e-2, 1e2), ["0.01", "0.1", "1", "10", "100"]);
        assert_eq!(labels("1/Pa", 1e-7, 1e-5), ["10⁻⁷", "10⁻⁶", "10⁻⁵"]);
        assert_eq!(labels("", 1e3, 1e6), ["10³", "10⁴", "10⁵", "10⁶"]);
        assert_eq!(axis([1.0].into_iter(), false, 8, "").title("loss factor"), "loss factor");
    }

    #[test]
    fn few_decades_are_parted_and_many_are_skipped() {
        assert_eq!(labels("s", 1e-3, 5e-2), ["1 ms", "2 ms", "5 ms", "10 ms", "20 ms", "50 ms"]);
        assert_eq!(labels("s", 3.0, 9.5), ["3 s", "4 s", "5 s", "6 s", "7 s", "8 s", "9 s"]);
        let many = labels("s", 1e-12, 1e12);
        assert_eq!(many[..6], ["1 ps", "1 ns", "1 µs", "1 ms", "1 s", "10³ s"]);
        assert_eq!(many.len(), 9);
    }

    #[test]
    fn minor_ticks_lie_between_the_labelled_ones() {
        for (low, high) in [(1e-4, 1e2), (2.0, 90.0), (1e-12, 1e12)] {
            let axis = axis([low, high].into_iter(), false, 8, "s");
            assert!(!axis.minor().is_empty());
            assert!(axis.minor().iter().all(|v| axis.holds(*v) && !axis.ticks().contains(v)));
        }
    }

    #[test]
    fn equal_ratios_are_at_equal_distances_and_values_without_logarithm_nowhere() {
        let axis = axis([1e-6, 1e6].into_iter(), false, 8, "s");
        for (value, place) in [(1e-6, 0.0), (1e-3, 0.25), (1.0, 0.5), (1e6, 1.0), (1e9, 1.25)] {
            assert!((axis.fraction(value) - place).abs() < 1e-14, "{value}");
        }
        for value in [0.0, -1.0, f64::NAN] {
            assert!(axis.fraction(value).is_nan() && !axis.holds(value) && !axis.takes(value));
        }
    }

    #[test]
    fn any_input_gives_a_finite_axis_with_ticks() {
        let hard: [&[f64]; 9] = [
            &[],
            &[f64::NAN, f64::INFINITY, -1.0, 0.0],
            &[5.0],
            &[1.0, 1.0 + 1e-15],
            &[1.0, 1.001],
            &[9.9e4, 1.01e5],
            &[f64::from_bits(1), f64::MAX],
            &[f64::MAX],
            &[1e-280, 1e280],
        ];
        for (values, wanted) in hard.iter().flat_map(|values| [1, 5, 8].map(|n| (*values, n))) {
            let axis = axis(values.iter().copied(), true, wanted, "N/m");
            assert!(axis.low < axis.high, "{values:?}");
            assert!((1..=25).contains(&axis.ticks().len()), "{values:?}: {:?}", axis.ticks());
            let labels: Vec<String> = axis.ticks().iter().map(|t| axis.tick_label(*t)).collect();
            assert!(labels.iter().all(|l| l.chars().count() < 18), "{labels:?}");
            let distinct: std::collections::BTreeSet<_> = labels.iter().collect();
            assert_eq!(distinct.len(), labels.len(), "{labels:?}");
        }
    }
}
