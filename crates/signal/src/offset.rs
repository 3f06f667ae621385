//! The reading of a sensor at rest, from the record before the pulse.

use serde::Serialize;

use crate::Channel;

/// Parts of the peak at which a pulse has begun for certain, and by which its steepness is judged.
const BEGUN: f64 = 0.05;
const RISEN: f64 = 0.5;
/// What scatters by more than this part of the peak is not at rest.
const RESTLESS: f64 = 0.03;
/// Samples on either side of one that are taken with it where noise hides a rest.
const AROUND: usize = 4;
/// Ends that read more than so many times their scatter do not rise or fall from zero, which makes that 1.7.
const LEVEL: f64 = 3.0;
/// What follows a pulse makes up for it where their integrals are as large as each other within this part.
const MADE_UP: f64 = 0.2;
/// Fewer samples before the pulse tell no offset.
const FEWEST: usize = 8;
/// What is further out than this part of the peak, so many samples in a row, is an impact of its own, and before the pulse
/// so many are looked for.
pub(crate) const IMPACT: f64 = 0.1;
pub(crate) const IN_A_ROW: usize = 3;
const IMPACTS: usize = 8;
/// What is below this part of a reading is rounding.
const ROUNDING: f64 = 1e-12;
/// Parts into which the record before the pulse is divided.
const BLOCKS: usize = 8;

/// What a channel reads at rest.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Offset {
    /// The mean before the pulse, in SI units.
    pub value: f64,
    /// How far the reading at rest during the pulse may be from it: twice the standard error of the mean of blocks,
    /// the change from the first to the second half, and half of the resolution where no noise blurs it.
    pub error: f64,
    /// Standard error of the mean, by the scatter of the means of eight blocks.
    #[serde(skip)]
    pub standard_error: f64,
    /// From when to when the mean is taken \[s\].
    pub window: (f64, f64),
    /// Samples in it.
    pub samples: usize,
    /// Standard deviation of a sample.
    pub noise: f64,
    /// Change from the first half of the window to the second, per time \[unit/s\].
    pub drift: f64,
    /// Whether the change is more than the noise explains.
    #[serde(skip)]
    pub is_drifting: bool,
}

impl Offset {
    /// The offset of a channel; `None` where fewer than eight samples stand before the pulse, or they are not at rest. Of
    /// several impacts it is that before the first one.
    ///
    /// The record before the pulse ends as long before the first passage of 5 % of the peak as it takes from there
    /// to 50 %, so that a gentle beginning is none of it. Where noise hides that, means of nine samples tell where it ends.
    pub fn before_pulse(channel: &Channel) -> Option<Self> {
        Self::at_rest(channel).or_else(|| {
            let values = channel.values();
            let around =
                |at: usize| &values[at.saturating_sub(AROUND)..(at + AROUND + 1).min(values.len())];
            let smooth = (0..values.len()).map(|at| mean(around(at))).collect();
            let rest = Self::at_rest(&channel.with_values(smooth))?;
            Self::within(channel, rest.window)
        })
    }

    fn at_rest(channel: &Channel) -> Option<Self> {
        let (mut times, mut values) = (channel.times(), channel.values());
        // The peak is counted from a first guess, which a large offset spoils otherwise.
        let guess = median(&values[..values.len().div_ceil(50)]);
        let far = |value: f64| (value - guess).abs();
        for _ in 0..IMPACTS {
            let peak = values.iter().copied().map(far).fold(0.0, f64::max);
            let top = values.iter().position(|own| far(*own) >= peak)?;
            let back = |level: f64, from: usize| {
                (0..from).rev().find(|&at| far(values[at]) < level * peak).map(|at| at + 1)
            };
            let risen = back(RISEN, top)?;
            let begun = back(BEGUN, risen)?;
            let rise = times[risen] - times[begun];
            let end = times[begun] - rise.max(times[begun] - times[begun - 1]);
            let count = times.partition_point(|time| *time <= end);
            if count < FEWEST {
                return None;
            }
            (times, values) = (&times[..count], &values[..count]);
            let own = Self::of(times, values, channel.resolution());
            let mut high = values.windows(IN_A_ROW);
            let has_impact = high.any(|own| own.iter().all(|own| far(*own) > IMPACT * peak));
            if own.noise <= RESTLESS * peak && !has_impact {
                return Some(own);
            }
        }
        None
    }

    /// The same behind the pulse, or behind the last one of several.
    pub(crate) fn behind_pulse(channel: &Channel) -> Option<Self> {
        let own = Self::before_pulse(&channel.reversed())?;
        let (from, to) = own.window;
        Some(Self { window: (-to, -from), drift: -own.drift, ..own })
    }

    /// How far below this a sensor without a response to constants (a high-pass) reads at the end of the pulse: it comes
    /// back from there by the same part in equal times, until what it takes back makes up for the pulse. `None` where the
    /// record does not end so.
    pub(crate) fn sag(&self, channel: &Channel) -> Option<f64> {
        let (behind, times) = (Self::behind_pulse(channel)?, channel.times());
        let at = |time: f64| times.partition_point(|own| *own < time);
        let (begun, ended) = (at(self.window.1), at(behind.window.0));
        let values: Vec<f64> = channel.values().iter().map(|own| own - self.value).collect();
        let third = (values.len() - ended) / 3;
        let [one, two, three] = [0, 1, 2].map(|own| mean(&values[ended + own * third..][..third]));
        let (lost, more) = (one / two, two / three);
        let length = times[ended + third] - times[ended];
        let scatter =
            5.0 * self.noise.max(0.5 * channel.resolution()) * (2.0 / third as f64).sqrt();
        let reads = one * lost.sqrt();
        let back = reads * length / lost.ln();
        let steps = times.get(begun..=ended)?.windows(2).zip(values[begun..=ended].windows(2));
        let pulse: f64 = steps.map(|(t, own)| 0.5 * (t[1] - t[0]) * (own[0] + own[1])).sum();
        let is_one = lost > 1.0
            && more > 1.0
            && (one - two).abs() > scatter
            && (back / pulse + 1.0).abs() < MADE_UP;
        is_one.then_some(reads)
    }

    /// What the first eight samples and the last ones both read, where they are level; the larger
    /// of both.
    pub(crate) fn at_both_ends(channel: &Channel) -> Option<Self> {
        let (times, values) = (channel.times(), channel.values());
        let last = values.len().checked_sub(FEWEST).filter(|last| *last >= FEWEST)?;
        let own = |from: usize, to: usize| {
            Self::of(&times[from..to], &values[from..to], channel.resolution())
        };
        let ends = [own(0, FEWEST), own(last, values.len())];
        let is_level = |own: &Self| own.value.abs() > LEVEL * own.noise;
        let is_one = ends[0].value * ends[1].value > 0.0 && ends.iter().all(is_level);
        ends.into_iter().max_by(|a, b| a.value.abs().total_cmp(&b.value.abs())).filter(|_| is_one)
    }

    /// The same within a window \[s\] in which something else tells that nothing has begun; `None` of fewer than eight
    /// samples.
    pub fn within(channel: &Channel, window: (f64, f64)) -> Option<Self> {
        let times = channel.times();
        let from = times.partition_point(|time| *time < window.0);
        let to = times.partition_point(|time| *time <= window.1);
        let (times, values) = (times.get(from..to)?, channel.values().get(from..to)?);
        (times.len() >= FEWEST).then(|| Self::of(times, values, channel.resolution()))
    }

    fn of(times: &[f64], values: &[f64], resolution: f64) -> Self {
        let count = values.len();
        let value = mean(values);
        let spread = values.iter().map(|own| (own - value).powi(2)).sum::<f64>();
        let noise = (spread / (count - 1) as f64).sqrt();
        let blocks: Vec<f64> = values.chunks(count.div_ceil(BLOCKS)).map(mean).collect();
        let of_blocks = blocks.iter().map(|own| (own - value).powi(2)).sum::<f64>();
        let blocked = (blocks.len() as f64).max(2.0);
        let standard = (of_blocks / (blocked * (blocked - 1.0))).sqrt();
        let [first, second] = [mean(&values[..count / 2]), mean(&values[count / 2..])];
        let change = second - first;
        let length = times[count - 1] - times[0];
        let coarse = if noise < resolution { 0.5 * resolution } else { 0.0 };
        Self {
            value,
            standard_error: standard,
            error: 2.0 * standard + change.abs() + coarse,
            window: (times[0], times[count - 1]),
            samples: count,
            noise,
            drift: 2.0 * change / length,
            is_drifting: change.abs() > (5.0 * noise / (count as f64).sqrt()).max(coarse * 2.0),
        }
    }

    /// Its error, but where that is rounding.
    pub fn uncertainty(&self) -> Option<f64> {
        Some(self.error).filter(|error| *error > ROUNDING * self.value.abs())
    }

    /// Whether it is more than its error.
    pub fn is_there(&self) -> bool {
        self.value.abs() > self.error
    }
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(0.0)
}
