//! What scatter of the numbers of a scene makes of its measures: bands, and probabilities to keep limits.

use serde::Serialize;

use super::unevaluated::{Missing, Unevaluated};
use crate::{Judgement, Limit, Reason};

/// Half of the part of a sample that its 95 % range leaves out.
const TAIL: f64 = 0.025;
/// The part of the designs that has to keep a limit, where nothing else is asked for.
pub(crate) const WANTED: f64 = 0.95;
/// Standard deviations of the normal distribution within which 95 % lie.
const WITHIN: f64 = 1.959_963_984_540_054;

/// A number of the scene that is normally distributed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ScatterSource {
    /// Its name.
    pub name: String,
    /// As it is written: `20 ± 2 MN/m`.
    pub text: String,
    /// Its SI unit.
    pub unit: String,
    /// The mean, with which the run itself is solved.
    pub mean: f64,
    /// The standard deviation.
    pub deviation: f64,
    /// Below this the distribution is cut off; `None` where it is not.
    pub cut_below: Option<f64>,
    /// Above this it is.
    pub cut_above: Option<f64>,
    /// The part of the normal distribution that is cut off.
    pub beyond: f64,
    /// Whether it scatters together with others: then its logarithm is normally distributed.
    #[serde(rename = "together")]
    pub is_together: bool,
}

/// What a measure is over the sample, in its SI unit. The numerical errors of single designs are not in it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Band {
    /// Key of the measure.
    pub key: String,
    /// Its SI unit.
    pub unit: &'static str,
    /// The mean of the sample; `None` where any design has no value.
    pub mean: Option<f64>,
    /// The standard deviation of the sample, of n − 1; `None` where any design has no value.
    pub deviation: Option<f64>,
    /// Below this lie 2.5 % of the designs, those without a value left out; `None` where none has one.
    pub low: Option<f64>,
    /// Above this lie 2.5 %.
    pub high: Option<f64>,
    /// Designs that have no value.
    pub without: usize,
    /// Designs in all; the band is that of the others.
    pub designs: usize,
}

/// How often a limit is kept.
#[derive(Debug, Clone, PartialEq)]
pub struct Chance {
    /// The limit.
    pub limit: Limit,
    /// Designs that keep it, and that exceed it.
    pub odds: Odds,
    /// Designs that keep it by something that is pressed further than is known of it.
    pub beyond: usize,
    /// Designs that keep it in the impact, outside of which there is a larger peak.
    pub outside: usize,
}

/// How many designs keep what is asked of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Odds {
    /// Designs that keep it.
    pub kept: usize,
    /// Designs that exceed it.
    pub exceeded: usize,
    /// Designs in all; what is neither kept nor exceeded is not known.
    pub designs: usize,
}

/// What a sample of designs tells.
#[derive(Debug, Clone, PartialEq)]
pub struct ScatterReport {
    /// The numbers with scatter, in the order of the scene.
    pub sources: Vec<ScatterSource>,
    /// The probability with which a limit has to be kept for it to pass, from 0 to 1: no part of its range may be less.
    pub wanted: f64,
    /// How many designs were drawn.
    pub designs: usize,
    /// What they were drawn with.
    pub seed: u64,
    /// The measures, in the order of the run.
    pub bands: Vec<Band>,
    /// The limits, in the order of the run.
    pub limits: Vec<Chance>,
    /// How often all of them are kept at once; `None` of fewer than two.
    pub all_limits: Option<Odds>,
    /// How many of the designs were instantiated of one compiled form.
    pub instantiated: usize,
    /// Designs that could not be evaluated, or lack a measure.
    pub unevaluated: Unevaluated,
}

impl Band {
    /// A band of these values; NaN where there is none.
    pub fn of(key: &str, unit: &'static str, values: impl Iterator<Item = f64>) -> Self {
        let all: Vec<f64> = values.collect();
        let mut known: Vec<f64> = all.iter().copied().filter(|own| own.is_finite()).collect();
        known.sort_by(f64::total_cmp);
        let is_whole = known.len() == all.len() && !known.is_empty();
        let count = known.len() as f64;
        let mean = known.iter().sum::<f64>() / count;
        let squares: f64 = known.iter().map(|own| (own - mean).powi(2)).sum();
        Self {
            key: key.to_owned(),
            unit,
            mean: is_whole.then_some(mean),
            deviation: (is_whole && known.len() > 1).then(|| (squares / (count - 1.0)).sqrt()),
            low: share_below(&known, TAIL),
            high: share_below(&known, 1.0 - TAIL),
            without: all.len() - known.len(),
            designs: all.len(),
        }
    }

    /// The part of the designs that have a value, from 0 to 1: those of which the band is.
    pub fn share(&self) -> f64 {
        (self.designs - self.without) as f64 / self.designs.max(1) as f64
    }

    /// The standard error of the mean, of independent designs; that of a Latin hypercube is smaller.
    pub fn error_of_mean(&self) -> Option<f64> {
        Some(self.deviation? / (self.designs as f64).sqrt())
    }
}

/// The value below which this part of a rising sample lies, between its members by straight lines: the i-th of n
/// is the quantile of (i − 1/2)/n.
///
/// Source: R. J. Hyndman, Y. Fan, The American Statistician 50 (1996) 361–365, definition 5.
fn share_below(rising: &[f64], share: f64) -> Option<f64> {
    let last = rising.len().checked_sub(1)?;
    let place = (share * rising.len() as f64 - 0.5).clamp(0.0, last as f64);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a position in the sample"
    )]
    let below = place as usize;
    let part = place - below as f64;
    let above = rising[(below + 1).min(last)];
    Some(rising[below] + part * (above - rising[below]))
}

impl Chance {
    /// Why designs that keep the limit may not, where there are such.
    pub(crate) fn doubt(&self) -> Option<Reason> {
        let of = |count: usize, reason: Reason| (count > 0).then_some(reason);
        of(self.beyond, Reason::Beyond).or(of(self.outside, Reason::Outside))
    }
}

impl Odds {
    /// Those of designs of each of which one thing or more is judged: all must be kept, and one exceeded is enough.
    pub(crate) fn of(judged: &[Vec<Judgement>]) -> Self {
        let designs = judged.first().map_or(0, Vec::len);
        let count = |is: &dyn Fn(usize) -> bool| (0..designs).filter(|at| is(*at)).count();
        let has = |at: usize, own: Judgement| judged.iter().filter(move |of| of[at] == own).count();
        Self {
            kept: count(&|at| has(at, Judgement::Pass) == judged.len()),
            exceeded: count(&|at| has(at, Judgement::Fail) > 0),
            designs,
        }
    }

    /// Designs of which it is not known.
    pub fn not_known(&self) -> usize {
        self.designs - self.kept - self.exceeded
    }

    /// The part of the designs that keeps the limit, from 0 to 1.
    pub fn share(&self) -> f64 {
        self.kept as f64 / self.designs as f64
    }

    /// Between which values the probability lies with 95 %, for independent designs. What is not known of some
    /// designs widens it.
    ///
    /// Source: E. B. Wilson, Journal of the American Statistical Association 22 (1927) 209–212.
    pub fn range(&self) -> (f64, f64) {
        let count = self.designs as f64;
        let wilson = |kept: usize, sign: f64| {
            let share = kept as f64 / count;
            let square = WITHIN * WITHIN / count;
            let half = (share * (1.0 - share) * square + 0.25 * square * square).sqrt();
            ((share + 0.5 * square + sign * half) / (1.0 + square)).clamp(0.0, 1.0)
        };
        (wilson(self.kept, -1.0), wilson(self.designs - self.exceeded, 1.0))
    }

    /// How many of so many designs have to keep it so that the whole [range](Self::range) of the probability is `wanted`,
    /// from 0 to 1, or more; `None` where all of them are too few.
    pub fn least_kept(wanted: f64, designs: usize) -> Option<usize> {
        let odds = |kept: usize| Self { kept, exceeded: designs - kept, designs };
        (0..=designs).rev().take_while(|kept| odds(*kept).range().0 >= wanted).last()
    }

    /// The least number of designs of which that can be shown of a `wanted` probability below 1.
    pub fn least_designs(wanted: f64) -> f64 {
        (wanted * WITHIN * WITHIN / (1.0 - wanted)).ceil()
    }
}

impl ScatterReport {
    /// The part of what the distributions say that designs are drawn from; the rest is cut off.
    pub fn within(&self) -> f64 {
        self.sources.iter().map(|own| 1.0 - own.beyond).product()
    }

    /// Designs without a solution, by their causes.
    pub fn unsolved(&self) -> impl Iterator<Item = &Missing> {
        self.unevaluated.causes.iter().filter(|own| own.cause.of.is_empty())
    }

    /// The band of the measure with this key.
    pub fn band(&self, key: &str) -> Option<&Band> {
        self.bands.iter().find(|own| own.key == key)
    }

    /// How often this limit is kept.
    pub fn chance(&self, limit: &Limit) -> Option<&Chance> {
        self.limits.iter().find(|own| own.limit == *limit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_band_has_the_mean_the_deviation_and_the_quantiles_of_its_sample() {
        let values = (1..=1000).map(f64::from);
        let own = Band::of("pad.peak-force", "N", values);
        assert_eq!(own.mean, Some(500.5));
        // (n² − 1)/12 · n/(n − 1)
        let right = (1000.0_f64 * 1001.0 / 12.0).sqrt();
        assert!((own.deviation.unwrap() / right - 1.0).abs() < 1e-14);
        assert!((own.low.unwrap() - 25.5).abs() < 1e-9 && (own.high.unwrap() - 975.5).abs() < 1e-9);
        assert!((own.error_of_mean().unwrap() - right / 1000.0_f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn a_design_without_a_value_leaves_no_mean() {
        let own = Band::of("pad.contact-time", "s", [1.0, f64::NAN, 3.0].into_iter());
        assert_eq!((own.mean, own.deviation, own.without), (None, None, 1));
        assert_eq!((own.low, own.high), (Some(1.0), Some(3.0)));
        assert_eq!(own.error_of_mean(), None);
        let none = Band::of("pad.contact-time", "s", [f64::NAN].into_iter());
        assert_eq!((none.mean, none.low), (None, None));
    }

    #[test]
    fn all_limits_are_kept_where_each_is_and_exceeded_where_one_is() {
        let [yes, no, open] =
            [Judgement::Pass, Judgement::Fail, Judgement::Undecided(Reason::Beyond)];
        let own = Odds::of(&[vec![yes, yes, no, open, open], vec![yes, no, no, yes, no]]);
        assert_eq!(own, Odds { kept: 1, exceeded: 3, designs: 5 });
        assert_eq!(own.not_known(), 1);
    }

    #[test]
    fn the_range_of_a_probability_is_wilsons_and_is_widened_by_what_is_not_known() {
        let of = |kept: usize, exceeded: usize| Odds { kept, exceeded, designs: 100 }.range();
        // Brown, Cai, DasGupta, Statistical Science 16 (2001) 101–133: 0 of n ends at z²/(n + z²).
        let square = WITHIN * WITHIN;
        let (low, high) = of(100, 0);
        assert!((low - 100.0 / (100.0 + square)).abs() < 1e-14 && (high - 1.0).abs() < 1e-14);
        let (low, high) = of(50, 50);
        let half = (0.25 * square / 100.0 + 0.25 * (square / 100.0).powi(2)).sqrt();
        assert!((high - low - 2.0 * half / (1.0 + square / 100.0)).abs() < 1e-14);
        assert!((low + high - 1.0).abs() < 1e-14);
        assert!(of(50, 40).1 > high && (of(50, 40).0 - low).abs() < 1e-15);
    }

    #[test]
    fn a_probability_is_shown_by_the_lower_end_of_its_range() {
        for (wanted, designs) in [(0.95, 500), (0.8, 400), (0.99, 1000)] {
            let least = Odds::least_kept(wanted, designs).unwrap();
            let low = |kept: usize| Odds { kept, exceeded: designs - kept, designs }.range().0;
            assert!(low(least) >= wanted && low(least - 1) < wanted, "{least} of {designs}");
        }
        // All of n end at n/(n + z²).
        assert!((Odds::least_designs(0.95) - 73.0).abs() < 1e-9);
        assert_eq!((Odds::least_kept(0.95, 73), Odds::least_kept(0.95, 72)), (Some(73), None));
    }
}
