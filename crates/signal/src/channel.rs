//! Samples of one quantity over time.

use dashpot_dae::{Panel, Signal};
use dashpot_units::Dimension;
use thiserror::Error;

/// Steps may differ from their mean by this share before they count as uneven: times are often written with few
/// digits.
const JITTER: f64 = 0.02;
/// A step of so many usual ones is one in which samples are missing.
const GAP: f64 = 1.5;
/// Fewer different values tell no resolution; a coarse curve bends by as much at this share of its changes.
const FEW_VALUES: usize = 5;
const ROUGH: f64 = 0.1;
/// How near to a multiple of a resolution steps are, and which part of them at least.
const MULTIPLE: f64 = 0.1;
const STEPPED: f64 = 0.8;
/// A record is read at so many times at most, or at as many as it has.
const MOST_SAMPLES: usize = 1_000_000;
/// Rounding of values, in parts of the largest.
const NOISE: f64 = 1e-14;

/// Samples of one quantity over time: at least two, finite, in order of time, in SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Channel {
    name: String,
    dimension: Dimension,
    times: Vec<f64>,
    values: Vec<f64>,
}

/// Why samples are no channel. Samples are counted from 0.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum ChannelFault {
    /// No sample, or one alone.
    #[error("{}; a signal has at least two samples", match .count { 0 => "there is no sample", _ => "there is one sample" })]
    TooFew { count: usize },
    /// Times and values that are not as many.
    #[error("there are {times} times and {values} values")]
    Uneven { times: usize, values: usize },
    /// A time or value that is no finite number.
    #[error("a sample is not a finite number")]
    NotFinite { at: usize },
    /// A rate at which there are more samples than are read.
    #[error("at this rate it has {count:.3e} samples, and at most {most} are read")]
    TooMany { count: f64, most: usize },
    /// A time that is not behind the one before.
    #[error("the time {time} s stands after {before} s: the time of samples rises")]
    TimeBack { at: usize, time: f64, before: f64 },
}

impl ChannelFault {
    /// The sample that it is about, where it is about one.
    pub fn sample(&self) -> Option<usize> {
        match self {
            Self::NotFinite { at } | Self::TimeBack { at, .. } => Some(*at),
            Self::TooFew { .. } | Self::Uneven { .. } | Self::TooMany { .. } => None,
        }
    }
}

/// The steps between samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Steps {
    /// Sampling rate: steps per length of the record \[Hz\].
    pub rate: f64,
    /// The shortest and the longest step \[s\].
    pub range: (f64, f64),
    /// Whether they are alike within 2 %.
    pub are_even: bool,
    /// Steps of more than 1.5 usual ones, in which samples are missing.
    pub gaps: usize,
}

impl Channel {
    /// The channel of these samples.
    ///
    /// # Errors
    ///
    /// Fewer than two samples, values that are not finite, and times that do not rise.
    pub fn new(
        name: impl Into<String>,
        dimension: Dimension,
        times: Vec<f64>,
        values: Vec<f64>,
    ) -> Result<Self, ChannelFault> {
        if times.len() != values.len() {
            return Err(ChannelFault::Uneven { times: times.len(), values: values.len() });
        }
        if times.len() < 2 {
            return Err(ChannelFault::TooFew { count: times.len() });
        }
        let is_odd = |(time, value): (&f64, &f64)| !(time.is_finite() && value.is_finite());
        if let Some(at) = times.iter().zip(&values).position(is_odd) {
            return Err(ChannelFault::NotFinite { at });
        }
        if let Some(at) = times.windows(2).position(|pair| pair[1] <= pair[0]) {
            let (before, time) = (times[at], times[at + 1]);
            return Err(ChannelFault::TimeBack { at: at + 1, time, before });
        }
        Ok(Self { name: name.into(), dimension, times, values })
    }

    /// The same under another name.
    #[must_use]
    pub fn named(self, name: impl Into<String>) -> Self {
        Self { name: name.into(), ..self }
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What it measures.
    pub fn dimension(&self) -> Dimension {
        self.dimension
    }

    /// The times of its samples \[s\].
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Its samples, in SI units.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Beginning and end \[s\].
    pub fn span(&self) -> (f64, f64) {
        (self.times.first().copied().unwrap_or(0.0), self.times.last().copied().unwrap_or(0.0))
    }

    /// The largest magnitude of a sample, and which sample it is.
    pub fn largest(&self) -> (usize, f64) {
        let all = self.values.iter().map(|own| own.abs()).enumerate();
        all.fold((0, 0.0), |best, own| if own.1 > best.1 { own } else { best })
    }

    /// The sign of its largest value, 1 or −1: which way its peak points.
    pub fn sign(&self) -> f64 {
        if self.values[self.largest().0] < 0.0 { -1.0 } else { 1.0 }
    }

    /// The steps between its samples.
    pub fn steps(&self) -> Steps {
        let (start, end) = self.span();
        let mut steps: Vec<f64> = self.times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let mean = (end - start) / steps.len() as f64;
        steps.sort_by(f64::total_cmp);
        let usual = steps[steps.len() / 2];
        let range = (steps[0], steps[steps.len() - 1]);
        Steps {
            rate: mean.recip(),
            range,
            are_even: range.1 - mean <= JITTER * mean && mean - range.0 <= JITTER * mean,
            gaps: steps.len() - steps.partition_point(|step| *step <= GAP * usual),
        }
    }

    /// The step in which its values are written: the smallest difference of two that are not the same, where most
    /// differences are multiples of it; 0 where they are not, or where a few values tell nothing.
    pub(crate) fn step(&self) -> f64 {
        let mut sorted = self.values.clone();
        sorted.sort_by(f64::total_cmp);
        let rounding = NOISE * self.largest().1;
        let steps = sorted.windows(2).map(|pair| pair[1] - pair[0]);
        let steps: Vec<f64> = steps.filter(|step| *step > rounding).collect();
        let least = steps.iter().copied().fold(f64::INFINITY, f64::min);
        let is_multiple = |step: &&f64| (*step / least - (*step / least).round()).abs() < MULTIPLE;
        let multiples = steps.iter().filter(is_multiple).count();
        let is_stepped = multiples as f64 > STEPPED * steps.len() as f64;
        if steps.len() >= FEW_VALUES && is_stepped { least } else { 0.0 }
    }

    /// The resolution of its values: the step in which they are written where the curve is as rough as that; 0 where it is
    /// smoother.
    pub fn resolution(&self) -> f64 {
        let (step, rounding) = (self.step(), NOISE * self.largest().1);
        let bends = self.values.windows(3).map(|own| (own[2] - 2.0 * own[1] + own[0]).abs());
        let rough = bends.filter(|bend| *bend > 0.5 * step).count() as f64;
        let changes = self.values.windows(2).filter(|own| (own[1] - own[0]).abs() > rounding);
        if rough > ROUGH * changes.count() as f64 { step } else { 0.0 }
    }

    /// The same with other values, as many as it has.
    #[must_use]
    pub(crate) fn with_values(&self, values: Vec<f64>) -> Self {
        debug_assert_eq!(values.len(), self.times.len(), "one value for each time");
        Self { values, ..self.clone() }
    }

    /// The same with all values changed.
    #[must_use]
    pub fn map(&self, change: impl Fn(f64) -> f64) -> Self {
        self.with_values(self.values.iter().copied().map(change).collect())
    }

    /// The same backwards in time.
    #[must_use]
    pub(crate) fn reversed(&self) -> Self {
        let times = self.times.iter().rev().map(|own| -own).collect();
        let values = self.values.iter().rev().copied().collect();
        Self { times, values, ..self.clone() }
    }

    /// The same with so many samples before and behind at which nothing happens.
    pub(crate) fn between_rests(&self, rest: f64, count: f64) -> Option<Self> {
        let (first, last) = self.span();
        let step = 1.0 / self.steps().rate;
        let far = (1..).map(f64::from).take_while(|own| *own <= count);
        let far: Vec<f64> = far.map(|own| own * step).collect();
        let before = far.iter().rev().map(|own| (first - own, rest));
        let behind = far.iter().map(|own| (last + own, rest));
        let own = self.times.iter().copied().zip(self.values.iter().copied());
        let (times, values) = before.chain(own).chain(behind).unzip();
        Self::new(self.name.clone(), self.dimension, times, values).ok()
    }

    /// How far the values of another are from these at most, at the times of both.
    pub(crate) fn apart(&self, other: &Self) -> f64 {
        let from = other.times.partition_point(|own| *own < self.span().0);
        let pairs = self.values.iter().zip(&other.values[from..]);
        pairs.map(|(one, other)| (one - other).abs()).fold(0.0, f64::max)
    }

    /// The same over a divisor, as another quantity: of a force over a mass the acceleration.
    pub(crate) fn over(&self, divisor: f64, dimension: Dimension) -> Self {
        Self { dimension, ..self.map(|own| own / divisor) }
    }

    /// The value at a time \[s\], on the line between samples; beyond the ends that of the end.
    pub fn value(&self, time: f64) -> f64 {
        let after = self.times.partition_point(|own| *own <= time).clamp(1, self.times.len() - 1);
        let (from, to) = (self.times[after - 1], self.times[after]);
        let share = ((time - from) / (to - from)).clamp(0.0, 1.0);
        self.values[after - 1] * (1.0 - share) + self.values[after] * share
    }

    /// The part of it in a window \[s\], with ends on the line between samples.
    ///
    /// # Errors
    ///
    /// A window that holds fewer than two times of the record.
    pub fn cut(&self, window: (f64, f64)) -> Result<Self, ChannelFault> {
        let (start, end) = self.span();
        let (from, to) = (window.0.max(start), window.1.min(end));
        if from >= to {
            return Err(ChannelFault::TooFew { count: 0 });
        }
        let inside = self.times.iter().copied().filter(|time| *time > from && *time < to);
        let times: Vec<f64> = [from].into_iter().chain(inside).chain([to]).collect();
        let values = times.iter().map(|time| self.value(*time)).collect();
        Self::new(self.name.clone(), self.dimension, times, values)
    }

    /// The same at even steps of this rate \[Hz\], on the line between its samples.
    ///
    /// # Errors
    ///
    /// A rate at which it has fewer than two samples, or more than 10⁶ and more than it has.
    pub fn resampled(&self, rate: f64) -> Result<Self, ChannelFault> {
        let (start, end) = self.span();
        let count = ((end - start) * rate * (1.0 + 1e-12)).floor();
        let most = MOST_SAMPLES.max(self.times.len());
        if count >= most as f64 {
            return Err(ChannelFault::TooMany { count, most });
        }
        let mut times = Vec::new();
        let mut at = 0.0;
        while at <= count {
            times.push((start + at / rate).min(end));
            at += 1.0;
        }
        let values = times.iter().map(|time| self.value(*time)).collect();
        Self::new(self.name.clone(), self.dimension, times, values)
    }

    /// The line through its samples over a unit, as a continuous signal.
    pub fn signal(&self, unit: f64) -> Signal {
        let samples = self.times.iter().zip(self.values.iter().map(|own| own / unit));
        let samples: Vec<(f64, f64)> = samples.map(|(time, value)| (*time, value)).collect();
        let line = |pair: &[(f64, f64)]| Panel {
            start: pair[0].0,
            end: pair[1].0,
            coefficients: [0.5 * (pair[0].1 + pair[1].1), 0.5 * (pair[1].1 - pair[0].1)].into(),
        };
        let noise = NOISE * self.largest().1 / unit;
        Signal::new(samples.windows(2).map(line).collect(), None, noise)
    }
}
