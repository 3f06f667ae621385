//! Axes: scales, a range that holds the data, round tick values, short tick labels; the plotting frame.

mod logarithmic;

use crate::{text_metrics::text_width, theme};

/// Values beyond this magnitude are drawn at it, so that a span never overflows.
const LARGEST: f64 = 1e290;
/// Ranges narrower than this part of their values hold nothing but round-off and are drawn as a constant.
const ROUND_OFF: f64 = 1e-6;
/// A bound that is zero but for this part of the range needs no room beside it.
const NEARLY_ZERO: f64 = 1e-3;
/// Empty part of a padded range, at each end.
const PADDING: f64 = 0.08;

/// One axis of a chart, in the units of its label.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Axis {
    // Ends as coordinates: values of a linear axis, decimal logarithms of a logarithmic one.
    low: f64,
    high: f64,
    ticks: Vec<f64>,
    minor: Vec<f64>,
    labels: Labels,
}

/// How ticks and title are written.
#[derive(Debug, Clone, PartialEq)]
enum Labels {
    /// Multiples of a power of ten, with so many decimals.
    Linear { exponent: i32, decimals: usize },
    /// Each with its own power of ten.
    Logarithmic(logarithmic::Labels),
}

impl Axis {
    /// An axis of this `scale` over those of `values` that it can show, as [`Axis::over`] says.
    pub(crate) fn of(
        scale: &Scale,
        values: impl Iterator<Item = f64>,
        padded: bool,
        wanted: usize,
    ) -> Self {
        match scale {
            Scale::Linear => Self::over(values, padded, wanted),
            Scale::Logarithmic { unit } => logarithmic::axis(values, padded, wanted.max(1), unit),
        }
    }

    /// An axis over the finite ones of `values`, with about `wanted` ticks; a `padded` one leaves room at its ends,
    /// except at a bound that is zero. Without any value it runs from 0 to 1.
    pub(crate) fn over(values: impl Iterator<Item = f64>, padded: bool, wanted: usize) -> Self {
        let (low, high) = range(values, padded);
        let (ticks, step) = round_ticks(low, high, wanted.max(1));
        let exponent = exponent_of(low.abs().max(high.abs()));
        let decimals = decimals_of(step / 10_f64.powi(exponent));
        let labels = Labels::Linear { exponent, decimals };
        Self { low, high, ticks, minor: Vec::new(), labels }
    }

    /// Tick values, ascending.
    pub(crate) fn ticks(&self) -> &[f64] {
        &self.ticks
    }

    /// Values between the ticks that deserve a mark without a label.
    pub(crate) fn minor(&self) -> &[f64] {
        &self.minor
    }

    /// Place of `value` along the axis: 0 at its low end, 1 at its high end, beyond them outside; NaN for a value
    /// that has no place.
    pub(crate) fn fraction(&self, value: f64) -> f64 {
        (self.coordinate(value).clamp(-LARGEST, LARGEST) - self.low) / (self.high - self.low)
    }

    /// Place of the feet of stems: that of zero, or the end nearest to it.
    pub(crate) fn foot(&self) -> f64 {
        match self.labels {
            Labels::Linear { .. } => self.fraction(0.0).clamp(0.0, 1.0),
            Labels::Logarithmic(_) => 0.0,
        }
    }

    /// Whether `value` lies on the axis.
    pub(crate) fn holds(&self, value: f64) -> bool {
        (self.low..=self.high).contains(&self.coordinate(value))
    }

    /// Whether `value` has a place on the axis or beyond its ends.
    pub(crate) fn takes(&self, value: f64) -> bool {
        value.is_finite() && self.coordinate(value).is_finite()
    }

    fn coordinate(&self, value: f64) -> f64 {
        match self.labels {
            Labels::Linear { .. } => value,
            Labels::Logarithmic(_) => logarithmic::coordinate(value),
        }
    }

    /// Label of a tick: on a linear axis in units of the axis' power of ten.
    pub(crate) fn tick_label(&self, tick: f64) -> String {
        let (exponent, decimals) = match &self.labels {
            Labels::Linear { exponent, decimals } => (*exponent, *decimals),
            Labels::Logarithmic(labels) => return labels.tick(tick),
        };
        let number = format!("{:.*}", decimals, tick / 10_f64.powi(exponent));
        match number.strip_prefix('-') {
            Some(zero) if zero.chars().all(|c| c == '0' || c == '.') => zero.to_owned(),
            Some(magnitude) => format!("−{magnitude}"),
            None => number,
        }
    }

    /// Label of a value that stands away from the axis: with the power of ten that its ticks leave out.
    pub(crate) fn label_apart(&self, value: f64) -> String {
        let label = self.tick_label(value);
        match &self.labels {
            Labels::Linear { exponent, .. } if *exponent != 0 && value != 0.0 => {
                format!("{label}·{}", power_of_ten(*exponent))
            }
            _ => label,
        }
    }

    /// `label` followed by what the tick labels leave out: the power of ten, or the unit.
    pub(crate) fn title(&self, label: &str) -> String {
        match &self.labels {
            Labels::Linear { exponent: 0, .. } => label.to_owned(),
            Labels::Linear { exponent, .. } => format!("{label} × {}", power_of_ten(*exponent)),
            Labels::Logarithmic(labels) => labels.title(label),
        }
    }
}

/// `10` with a raised exponent.
fn power_of_ten(exponent: i32) -> String {
    let digits = exponent.to_string();
    let raised = digits.chars().map(|digit| {
        let raised = digit.to_digit(10).and_then(|d| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(d as usize));
        raised.unwrap_or('⁻')
    });
    ['1', '0'].into_iter().chain(raised).collect()
}

fn range(values: impl Iterator<Item = f64>, padded: bool) -> (f64, f64) {
    let (low, high) = values
        .filter(|v| v.is_finite())
        .map(|v| v.clamp(-LARGEST, LARGEST))
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    if low > high {
        return (0.0, 1.0);
    }
    let magnitude = low.abs().max(high.abs());
    if magnitude < 1.0 / LARGEST {
        return (-1.0, 1.0);
    }
    let span = high - low;
    if span <= ROUND_OFF * magnitude {
        return (low - 0.1 * magnitude, high + 0.1 * magnitude);
    }
    let room = if padded { PADDING * span } else { 0.0 };
    let beside = |bound: f64| if bound.abs() > NEARLY_ZERO * span { room } else { 0.0 };
    (low - beside(low), high + beside(high))
}

/// About `wanted` multiples of a round step from `low` to `high`, and the step.
fn round_ticks(low: f64, high: f64, wanted: usize) -> (Vec<f64>, f64) {
    let step = round_step((high - low) / wanted as f64);
    let first = (low / step - 1e-9).ceil();
    let ticks = (0..=4 * wanted)
        .map(|i| (first + i as f64) * step)
        .take_while(|tick| *tick <= high + 1e-9 * step)
        .collect();
    (ticks, step)
}

/// The smallest of 1, 2, 2.5, 5 times a power of ten that is at least `rough`.
fn round_step(rough: f64) -> f64 {
    let decade = 10_f64.powf(rough.log10().floor());
    [1.0, 2.0, 2.5, 5.0]
        .iter()
        .map(|m| m * decade)
        .find(|s| *s >= rough * (1.0 - 1e-9))
        .unwrap_or(10.0 * decade)
}

/// The power of ten left out of the labels: 0 for everyday numbers, else a multiple of three.
fn exponent_of(magnitude: f64) -> i32 {
    if (1e-2..1e4).contains(&magnitude) {
        return 0;
    }
    #[expect(
        clippy::cast_possible_truncation,
        reason = "the magnitude of an axis is within 1e±290"
    )]
    let thousands = (magnitude.log10() / 3.0 + 1e-12).floor() as i32;
    3 * thousands
}

/// Decimals that show `step` and its multiples apart.
fn decimals_of(step: f64) -> usize {
    let mut scaled = step;
    let mut decimals = 0;
    while decimals < 9 && (scaled - scaled.round()).abs() > 1e-6 * scaled {
        scaled *= 10.0;
        decimals += 1;
    }
    decimals
}

/// Decades by which a line may widen a logarithmic axis whatever the range of the data.
const LEAST_ROOM: f64 = 1.0;

/// Values of this ratio and more are laid out by their ratios.
const LEAST_RATIO: f64 = 100.0 * (1.0 - 1e-9);

/// How values are laid out along an axis.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum Scale {
    /// Equal differences at equal distances.
    #[default]
    Linear,
    /// Equal ratios at equal distances, for positive values; others have no place and break a curve.
    ///
    /// The axis is labelled with the quantity alone, as in `time`, and its values are in `unit`: ticks carry the
    /// prefixes that the unit is used with, as in `10 ms`, and otherwise powers of ten, with the unit behind the
    /// quantity.
    Logarithmic {
        /// Unit of the values without prefix, as in `s`, `N/m` or `rad/s`; empty for none.
        unit: String,
    },
}

impl Scale {
    /// A logarithmic scale in this unit.
    pub fn logarithmic(unit: &str) -> Self {
        Self::Logarithmic { unit: unit.to_owned() }
    }

    /// A logarithmic scale without a unit of its own for values that are positive and span two decades or more, else a
    /// linear one.
    pub fn suiting(values: impl IntoIterator<Item = f64>) -> Self {
        Self::of_ratios_from(LEAST_RATIO, values)
    }

    /// A logarithmic scale without a unit of its own for values that are positive and the largest of which is at least
    /// `ratio` times the smallest, else a linear one.
    pub fn of_ratios_from(ratio: f64, values: impl IntoIterator<Item = f64>) -> Self {
        let (low, high) = values
            .into_iter()
            .filter(|own| own.is_finite())
            .fold((f64::INFINITY, 0.0_f64), |(low, high), own| (low.min(own), high.max(own)));
        if low > 0.0 && high >= ratio * low { Self::logarithmic("") } else { Self::Linear }
    }

    /// Whether `value` has a place on the scale.
    pub(crate) fn takes(&self, value: f64) -> bool {
        value.is_finite() && (*self == Self::Linear || value > 0.0)
    }

    /// What is proportional to the distance along the axis.
    pub(crate) fn coordinate(&self, value: f64) -> f64 {
        if *self == Self::Linear { value } else { value.log10() }
    }

    /// The value at this distance along the axis.
    pub(crate) fn value(&self, coordinate: f64) -> f64 {
        if *self == Self::Linear { coordinate } else { 10_f64.powf(coordinate) }
    }

    /// Distance from data between two coordinates within which a line is near.
    pub(crate) fn room(&self, low: f64, high: f64) -> f64 {
        match self {
            Self::Linear => (high - low).max(low.abs()).max(high.abs()),
            Self::Logarithmic { .. } => (high - low).max(LEAST_ROOM),
        }
    }
}

/// Both ends of a straight line \[px\].
pub(crate) type Ends = [(f64, f64); 2];

/// The plotting frame and its axes \[px\].
#[derive(Debug)]
pub(crate) struct Frame {
    pub(crate) left: f64,
    pub(crate) right: f64,
    pub(crate) top: f64,
    pub(crate) bottom: f64,
    pub(crate) x: Axis,
    pub(crate) y: Axis,
}

impl Frame {
    /// The middle of a label below the frame, in a drawing of this width \[px\]: that of the frame, unless the label
    /// would reach beyond the margin.
    pub(crate) fn middle_of(&self, label: &str, width: f64) -> f64 {
        let half = 0.5 * text_width(label, theme::LABEL_SIZE) + theme::MARGIN;
        (0.5 * (self.left + self.right)).min(width - half).max(half)
    }

    /// Where the point (`x`, `y`) of the data lies.
    pub(crate) fn at(&self, x: f64, y: f64) -> (f64, f64) {
        (
            self.left + self.x.fraction(x) * (self.right - self.left),
            self.bottom - self.y.fraction(y) * (self.bottom - self.top),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis) -> Vec<String> {
        axis.ticks().iter().map(|t| axis.tick_label(*t)).collect()
    }

    #[test]
    fn ticks_are_round_and_within_the_range() {
        let axis = Axis::over([0.0, 20.0].into_iter(), false, 8);
        assert_eq!(
            labels(&axis),
            ["0.0", "2.5", "5.0", "7.5", "10.0", "12.5", "15.0", "17.5", "20.0"]
        );
        let axis = Axis::over([-9.7, 38.4].into_iter(), true, 6);
        assert_eq!(labels(&axis), ["−10", "0", "10", "20", "30", "40"]);
    }

    #[test]
    fn large_and_small_numbers_share_a_power_of_ten() {
        let axis = Axis::over([0.0, 2.4e7].into_iter(), false, 5);
        assert_eq!(axis.title("force (N)"), "force (N) × 10⁶");
        assert_eq!(labels(&axis), ["0", "5", "10", "15", "20"]);
        assert_eq!((axis.label_apart(5e6), axis.label_apart(0.0)), ("5·10⁶".into(), "0".into()));
        assert_eq!(Axis::over([0.0, 3e-5].into_iter(), false, 3).title("y"), "y × 10⁻⁶");
    }

    #[test]
    fn an_end_at_zero_but_for_round_off_has_no_room_beside_it() {
        let axis = Axis::over([-1e-9, 20.0].into_iter(), true, 6);
        assert!((axis.low + 1e-9).abs() < 1e-20 && (axis.high - 21.6).abs() < 1e-6, "{axis:?}");
    }

    #[test]
    fn any_input_gives_a_finite_axis() {
        let hard: [&[f64]; 8] = [
            &[],
            &[f64::NAN, f64::INFINITY],
            &[0.0],
            &[5.0, 5.0],
            &[1.0, 1.0 + 1e-15],
            &[-f64::MAX, f64::MAX],
            &[f64::MIN_POSITIVE],
            &[1e-280, 1e280],
        ];
        for values in hard {
            for padded in [false, true] {
                let axis = Axis::over(values.iter().copied(), padded, 6);
                assert!(axis.low < axis.high, "{values:?}");
                assert!((1..=24).contains(&axis.ticks().len()), "{values:?}: {:?}", axis.ticks());
                for v in values.iter().filter(|v| v.is_finite()) {
                    assert!((-1e-9..=1.0 + 1e-9).contains(&axis.fraction(*v)), "{v} on {axis:?}");
                }
                assert!(labels(&axis).iter().all(|l| l.len() < 16), "{:?}", labels(&axis));
            }
        }
    }

    #[test]
    fn positive_values_over_two_decades_are_laid_out_by_their_ratios() {
        let logarithmic = Scale::logarithmic("");
        for (values, scale) in [
            (&[1.0, 100.0][..], logarithmic.clone()),
            (&[1.0, f64::NAN, 3e5], logarithmic),
            (&[1.0, 90.0], Scale::Linear),
            (&[0.0, 1e4], Scale::Linear),
            (&[-1.0, 1e4], Scale::Linear),
            (&[], Scale::Linear),
        ] {
            assert_eq!(Scale::suiting(values.iter().copied()), scale, "{values:?}");
        }
    }

    #[test]
    fn only_positive_values_have_a_place_on_a_logarithmic_scale() {
        let scale = Scale::logarithmic("s");
        for (value, has_place) in
            [(1e-300, true), (0.0, false), (-1.0, false), (f64::NAN, false), (f64::INFINITY, false)]
        {
            assert_eq!(scale.takes(value), has_place, "{value}");
        }
        assert!(Scale::default().takes(-1.0));
    }
}
