//! The range of a map's colours: where most values lie, with what lies beyond told.

use crate::{Scale, axis::Axis};

/// Parts of the values between which the range of colours lies …
const QUANTILES: [f64; 2] = [0.05, 0.95];
/// … and the part of it by which it is widened at most, to hold all values.
const TAIL: f64 = 0.35;

/// Which values have which colours.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Colours {
    /// The axis of the bar, from the first colour to the last one.
    pub(super) axis: Axis,
    /// The lowest and the highest value, where they lie beyond the colours and have those of the ends.
    pub(super) beyond: [Option<f64>; 2],
}

impl Colours {
    /// For these values on a scale, and further ones that have a colour of their own where values reach them.
    pub(super) fn of(values: &[f64], shown: &[f64], scale: &Scale, ticks: usize) -> Self {
        let mut rising: Vec<f64> = values
            .iter()
            .filter(|own| scale.takes(**own))
            .map(|own| scale.coordinate(*own))
            .collect();
        rising.sort_by(f64::total_cmp);
        let (Some(&lowest), Some(&highest)) = (rising.first(), rising.last()) else {
            let axis = Axis::of(scale, std::iter::empty(), false, ticks);
            return Self { axis, beyond: [None; 2] };
        };
        let [low, high] = QUANTILES.map(|part| quantile(&rising, part));
        let span = high - low;
        let is_flat = span <= 0.0;
        let mut low = if is_flat || low - lowest <= TAIL * span { lowest } else { low };
        let mut high = if is_flat || highest - high <= TAIL * span { highest } else { high };
        for own in shown.iter().filter(|own| scale.takes(**own)).map(|own| scale.coordinate(*own)) {
            if (lowest..=highest).contains(&own) {
                (low, high) = (low.min(own), high.max(own));
            }
        }
        let ends = [low, high].map(|own| scale.value(own));
        let axis = Axis::of(scale, ends.into_iter(), false, ticks);
        let beyond = [
            (lowest < low).then(|| scale.value(lowest)),
            (highest > high).then(|| scale.value(highest)),
        ];
        Self { axis, beyond }
    }

    /// Place of a value among the colours: 0 to 1, beyond the ends outside; NaN of what has none.
    pub(super) fn share(&self, value: f64) -> f64 {
        if self.axis.takes(value) { self.axis.fraction(value) } else { f64::NAN }
    }
}

/// What this part of rising values stays below, linear between them.
fn quantile(rising: &[f64], part: f64) -> f64 {
    let place = part * (rising.len() - 1) as f64;
    let at = (0..rising.len()).rev().find(|at| *at as f64 <= place).unwrap_or(0);
    let next = (at + 1).min(rising.len() - 1);
    rising[at] + (place - at as f64) * (rising[next] - rising[at])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_without_tails_have_all_colours() {
        let values: Vec<f64> = (0..=100).map(f64::from).collect();
        let colours = Colours::of(&values, &[], &Scale::Linear, 5);
        assert_eq!(colours.beyond, [None, None]);
        assert!(colours.share(0.0).abs() < 1e-12 && (colours.share(100.0) - 1.0).abs() < 1e-12);
        assert!(colours.share(f64::NAN).is_nan());
    }

    #[test]
    fn few_values_far_away_do_not_take_the_colours_of_the_others() {
        let mut values: Vec<f64> = (0..=100).map(f64::from).collect();
        values.extend([5e3, 1e4]);
        let colours = Colours::of(&values, &[], &Scale::Linear, 5);
        assert_eq!(colours.beyond, [None, Some(1e4)]);
        assert!((colours.share(48.0) - 0.5).abs() < 0.02, "{}", colours.share(48.0));
        let shown = Colours::of(&values, &[2e3, 1e9], &Scale::Linear, 5);
        assert!((shown.share(2e3) - 1.0).abs() < 1e-12, "a limit has its own colour");
    }

    #[test]
    fn flat_values_and_none_have_an_axis() {
        for values in [&[][..], &[2.0; 9], &[f64::NAN]] {
            let colours = Colours::of(values, &[1.0], &Scale::Linear, 5);
            assert_eq!(colours.beyond, [None, None]);
        }
        let decades: Vec<f64> = (0..=40).map(|own| 10_f64.powf(0.1 * f64::from(own))).collect();
        let colours = Colours::of(&decades, &[], &Scale::logarithmic(""), 5);
        assert!((colours.share(100.0) - 0.5).abs() < 1e-12);
    }
}
