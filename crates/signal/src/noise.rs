//! How far a channel may be off besides what lines between its samples hide: noise, resolution, what it reads at rest.

use serde::Serialize;

use crate::{Cfc, Channel, Offset};

/// The standard deviation in parts of the median magnitude of normal noise.
const OF_MEDIAN: f64 = 1.0 / 0.674_49;
/// The sum of squares of 1, 4, 6, 4, 1: the variance of a fourth difference of independent samples.
const FOURTH: f64 = 70.0;
/// Noise bandwidth of both passes of a class in parts of its design frequency: `∫ (1 + x⁴)⁻² dx = 3π/(8 √2)`.
const BANDWIDTH: f64 = 0.833_04;
/// Samples of which one at most is beyond [`Noise::extreme`], where it is not counted how many are near.
pub(crate) const NEAR: usize = 20;

/// Noise of the samples of a channel.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Noise {
    /// Standard deviation of a sample, in the unit of the channel.
    pub deviation: f64,
    /// Variance of its integral over time, per time \[unit² s\]: `deviation²` times the step where samples are independent.
    pub intensity: f64,
    /// Whether it was measured at rest before the pulse; otherwise by fourth differences of the whole record, which see no
    /// noise that was filtered before.
    #[serde(rename = "at_rest")]
    pub is_of_rest: bool,
}

impl Noise {
    /// That of a record with its reading at rest, behind a filter. At rest the intensity is the larger one of that of
    /// independent samples and that of the means of eight blocks. Without a rest the deviation is that of the median
    /// magnitude of fourth differences, which a smooth pulse adds nothing to; uneven steps tell none.
    pub(crate) fn of(raw: &Channel, rest: Option<&Offset>, cfc: Option<Cfc>) -> Self {
        let steps = raw.steps();
        let (deviation, blocks) = match rest {
            Some(rest) => {
                (rest.noise, rest.standard_error.powi(2) * (rest.window.1 - rest.window.0))
            }
            None if steps.are_even => (of_differences(raw.values()), 0.0),
            None => (0.0, 0.0),
        };
        let intensity = blocks.max(deviation * deviation / steps.rate);
        // A filter leaves the integral as it is, and of the samples what its band passes.
        let passed = cfc.map_or(f64::INFINITY, |cfc| {
            (2.0 * BANDWIDTH * cfc.design_frequency() * intensity).sqrt()
        });
        Self { deviation: deviation.min(passed), intensity, is_of_rest: rest.is_some() }
    }

    /// What its integral over this length \[s\] exceeds in one of twenty cases: two standard deviations \[unit s\].
    pub(crate) fn area(&self, length: f64) -> f64 {
        2.0 * (self.intensity * length).sqrt()
    }

    /// What the largest of so many samples exceeds in one of twenty cases at most.
    pub(crate) fn extreme(&self, samples: usize) -> f64 {
        self.deviation * (2.0 * (20.0 * samples.max(1) as f64).ln()).sqrt()
    }

    /// The same of the samples within four deviations of a level, of which there are as many as may be the extreme.
    pub(crate) fn extreme_near(&self, values: &[f64], level: f64) -> f64 {
        let is_near = |own: &&f64| (own.abs() - level).abs() <= 4.0 * self.deviation;
        self.extreme(values.iter().filter(is_near).count())
    }
}

fn of_differences(values: &[f64]) -> f64 {
    let difference = |own: &[f64]| own[0] - 4.0 * own[1] + 6.0 * own[2] - 4.0 * own[3] + own[4];
    let mut all: Vec<f64> = values.windows(5).map(|own| difference(own).abs()).collect();
    all.sort_by(f64::total_cmp);
    all.get(all.len() / 2).map_or(0.0, |median| OF_MEDIAN * median / FOURTH.sqrt())
}

/// How far the samples of a channel may be off.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Uncertainty {
    /// All in the same direction, in the unit of the channel: by half a resolution, by the error of the offset that was
    /// taken off or the reading at rest that was not, and by what else is stated.
    pub floor: f64,
    /// What the channel reads at rest as it is read; 0 where that is not known.
    pub rest: f64,
    /// Each by itself.
    pub noise: Noise,
}

impl Uncertainty {
    /// How far a passage of a level may be off to either side, in the unit of the channel.
    pub(crate) fn of_passages(&self) -> f64 {
        self.floor + self.noise.extreme(NEAR)
    }

    /// The same of all values over a divisor.
    pub(crate) fn over(&self, divisor: f64) -> Self {
        let Noise { deviation, intensity, is_of_rest } = self.noise;
        let (deviation, intensity) = (deviation / divisor, intensity / divisor / divisor);
        let noise = Noise { deviation, intensity, is_of_rest };
        Self { floor: self.floor / divisor, rest: self.rest / divisor, noise }
    }
}
