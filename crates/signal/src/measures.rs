//! What is read off a channel, and how far each number may be off.

use std::cell::OnceCell;

use dashpot_analysis::{
    Counted,
    measures::{Exceedance, STANDARD_GRAVITY, hic_search::Windows},
};
use dashpot_units::Dimension;
use thiserror::Error;

use crate::{
    Approach, Channel, Contact, Motion, Truth, Uncertainty, clipping::Clipping, sampling::Sampling,
};

/// The time of a clip \[s\].
const CLIP: f64 = 0.003;
/// The exponent of the severity index.
const EXPONENT: f64 = 2.5;
/// Rounding of a criterion, in parts of it.
const ROUNDING: f64 = 1e-9;

dashpot_units::words! {
    /// What is read off a channel.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    #[non_exhaustive]
    pub enum Measure, pub fn word(self) {
        /// The largest magnitude.
        Peak = "peak",
        /// How long the magnitude stays at or above 5 % of the peak, about the peak \[s\].
        ContactTime = "contact-time",
        /// The integral of an acceleration over the whole record \[m/s\].
        VelocityChange = "velocity-change",
        /// The integral of a force over the whole record \[N s\].
        Impulse = "impulse",
        /// Head injury criterion over intervals up to 15 ms \[s\].
        Hic15 = "hic15",
        /// The same up to 36 ms.
        Hic36 = "hic36",
        /// The same over any interval.
        Hic = "hic",
        /// Gadd's severity index, `∫ (|a|/g0)^2.5 dt` \[s\].
        SeverityIndex = "severity-index",
        /// The largest magnitude that is exceeded for 3 ms, all times added up.
        Clip3ms = "clip-3ms",
        /// The same within one stretch.
        Clip3msAtOnce = "clip-3ms-at-once",
        /// The largest displacement since the impact began \[m\].
        Displacement = "peak-displacement",
        /// The speed at which a body comes back \[m/s\].
        ReboundVelocity = "rebound-velocity",
        /// The part of the speed of approach with which it comes back.
        Restitution = "coefficient-of-restitution",
        /// The work done until the deepest point \[J\].
        EnergyTaken = "energy-taken",
        /// What comes back of it \[J\].
        EnergyReturned = "energy-returned",
        /// What does not \[J\].
        EnergyAbsorbed = "energy-absorbed",
    }
}

dashpot_units::words! {
    /// Why a measure has no value.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
    pub enum Reason, pub fn code(self) {
        /// The record is shorter than the time of a clip.
        #[error("the record is too short")]
        RecordTooShort = "record-too-short",
        /// It is clipped, and nothing bounds it.
        #[error("clipped, which leaves it open")]
        Clipped = "clipped",
        /// The body does not stop, so that it does not come back.
        #[error("the body does not stop")]
        DoesNotStop = "does-not-stop",
    }
}

/// A number read off a channel, in SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    /// What it is.
    pub measure: Measure,
    /// The value, on straight lines between samples and over continuous windows.
    pub value: Result<f64, Reason>,
    /// What it says of the truth.
    pub truth: Truth,
    /// How far it may be off: by what samples do not tell, by the offset, by the resolution, by noise; 0 of a bound.
    pub error: f64,
    /// When it is \[s\], where it is at one time.
    pub time: Option<f64>,
    /// From when to when it is \[s\], where it belongs to an interval.
    pub window: Option<(f64, f64)>,
    /// The value by the samples alone: windows from sample to sample, sums of trapezoids; `None` where it is the same.
    pub on_samples: Option<f64>,
}

impl Reading {
    pub(crate) fn new(measure: Measure, value: f64, error: f64) -> Self {
        let (value, truth) = (Ok(value), Truth::Within);
        Self { measure, value, truth, error, time: None, window: None, on_samples: None }
    }

    /// Its error, where it has a value that is no bound.
    pub fn bar(&self) -> Option<f64> {
        self.value.ok().filter(|_| self.truth == Truth::Within).map(|_| self.error)
    }

    fn over(self, window: (f64, f64)) -> Self {
        Self { window: Some(window), ..self }
    }
}

impl Measure {
    const READ: [Self; 10] = [
        Self::Peak,
        Self::ContactTime,
        Self::VelocityChange,
        Self::Impulse,
        Self::Hic15,
        Self::Hic36,
        Self::Hic,
        Self::SeverityIndex,
        Self::Clip3ms,
        Self::Clip3msAtOnce,
    ];

    /// The measures of every channel of this dimension; those of motion and work depend on what is known besides.
    pub fn of(dimension: Dimension) -> impl Iterator<Item = Self> {
        let is_one = move |own: &Self| match own {
            Self::Peak | Self::ContactTime => true,
            Self::Impulse => dimension == Dimension::FORCE,
            _ => dimension == Dimension::ACCELERATION,
        };
        Self::READ.into_iter().filter(is_one)
    }

    /// What it is in, of a channel of this dimension.
    pub fn dimension(self, channel: Dimension) -> Dimension {
        match self {
            Self::Peak | Self::Clip3ms | Self::Clip3msAtOnce => channel,
            Self::VelocityChange | Self::ReboundVelocity => Dimension::VELOCITY,
            Self::Displacement => Dimension::LENGTH,
            Self::Restitution => Dimension::NUMBER,
            Self::EnergyTaken | Self::EnergyReturned | Self::EnergyAbsorbed => Dimension::ENERGY,
            Self::Impulse => Dimension::IMPULSE,
            _ => Dimension::TIME,
        }
    }

    /// Whether it is an index that the field writes without a unit.
    pub fn is_index(self) -> bool {
        matches!(self, Self::Hic | Self::Hic15 | Self::Hic36 | Self::SeverityIndex)
    }

    /// Whether a magnitude has it, which has no direction to be added up along.
    pub(crate) fn is_of_magnitudes(self) -> bool {
        !matches!(self, Self::VelocityChange | Self::Impulse)
    }

    /// Whether that of a body is the one of the resultant of its axes, which no axis alone exceeds: peak, HIC, severity
    /// index and clips of an acceleration.
    pub fn is_of_body(self, channel: Dimension) -> bool {
        let is_clip = matches!(self, Self::Peak | Self::Clip3ms | Self::Clip3msAtOnce);
        channel == Dimension::ACCELERATION && (is_clip || self.is_index())
    }

    fn cap(self) -> f64 {
        match self {
            Self::Hic15 => 0.015,
            Self::Hic36 => 0.036,
            _ => f64::INFINITY,
        }
    }
}

/// A channel as measures see it.
pub(crate) struct Reader<'c> {
    channel: &'c Channel,
    sampling: Sampling<'c>,
    uncertainty: Uncertainty,
    clipping: Option<Clipping>,
    exceedance: Option<Exceedance>,
    criteria: OnceCell<Vec<Reading>>,
}

impl<'c> Reader<'c> {
    pub(crate) fn new(
        channel: &'c Channel,
        uncertainty: Uncertainty,
        clipping: Option<Clipping>,
    ) -> Self {
        let is_acceleration = channel.dimension() == Dimension::ACCELERATION;
        let exceedance =
            is_acceleration.then(|| Exceedance::new(&channel.signal(1.0), channel.span()));
        let (sampling, criteria) = (Sampling::of(channel), OnceCell::new());
        Self { channel, sampling, uncertainty, clipping, exceedance, criteria }
    }

    /// The motion of the body that an acceleration is on, or that a force acts on.
    pub(crate) fn motion(&self, approach: Approach) -> Motion {
        let (contact, uncertainty) = (self.contact(), &self.uncertainty);
        match approach.mass.filter(|_| self.channel.dimension() == Dimension::FORCE) {
            None => Motion::of(self.channel, &self.sampling, approach, contact, uncertainty),
            Some(mass) => {
                let channel = self.channel.over(mass, Dimension::ACCELERATION);
                let sampling = Sampling::of(&channel);
                Motion::of(&channel, &sampling, approach, contact, &uncertainty.over(mass))
            }
        }
    }

    pub(crate) fn contact(&self) -> Contact {
        Contact::of(self.channel, &self.sampling, &self.uncertainty)
    }

    /// What a measure says, as far as the record is not clipped; `None` of one of another dimension, of motion or of work.
    pub(crate) fn read(&self, measure: Measure) -> Option<Reading> {
        let reading = match measure {
            Measure::Peak => self.peak(),
            Measure::ContactTime => {
                let contact = self.contact();
                Reading::new(measure, contact.length(), contact.error).over(contact.window)
            }
            Measure::VelocityChange | Measure::Impulse => self.integral(measure),
            Measure::Hic15 | Measure::Hic36 | Measure::Hic => {
                let criteria = self.criteria.get_or_init(|| self.criteria());
                *criteria.iter().find(|own| own.measure == measure)?
            }
            Measure::SeverityIndex => self.severity(),
            Measure::Clip3ms => self.clip(measure, Counted::Together)?,
            Measure::Clip3msAtOnce => self.clip(measure, Counted::AtOnce)?,
            _ => return None,
        };
        Some(self.clipping.map_or(reading, |own| own.left(reading, None)))
    }

    fn peak(&self) -> Reading {
        let (at, value) = self.channel.largest();
        let Uncertainty { floor, noise, .. } = self.uncertainty;
        let noise = noise.extreme_near(self.channel.values(), value);
        // Above the end of a range no line tells what is hidden.
        let hidden = if self.clipping.is_some() { 0.0 } else { self.sampling.overshoot() };
        let error = hidden + floor + noise;
        let reading = Reading::new(Measure::Peak, value, error);
        Reading { time: self.channel.times().get(at).copied(), ..reading }
    }

    fn integral(&self, measure: Measure) -> Reading {
        let span = self.channel.span();
        let samples = self.channel.times().windows(2).zip(self.channel.values().windows(2));
        let value = samples.map(|(t, v)| 0.5 * (t[1] - t[0]) * (v[0] + v[1])).sum();
        let error = self.hidden(span);
        Reading::new(measure, value, error).over(span)
    }

    /// How far the integral over a window may be off \[unit s\].
    fn hidden(&self, window: (f64, f64)) -> f64 {
        let Uncertainty { floor, noise, .. } = self.uncertainty;
        let length = window.1 - window.0;
        self.sampling.area(window) + floor * length + noise.area(length)
    }

    /// The criteria, which share what is known of the signal.
    fn criteria(&self) -> Vec<Reading> {
        let signal = self.channel.signal(STANDARD_GRAVITY);
        let windows = Windows::of(&signal, self.channel.span());
        let all = [Measure::Hic15, Measure::Hic36, Measure::Hic];
        all.into_iter().map(|measure| self.hic(&windows, measure)).collect()
    }

    fn hic(&self, windows: &Windows<'_>, measure: Measure) -> Reading {
        let cap = measure.cap();
        let found = windows.optimum(cap);
        let (from, to) = found.interval;
        let length = to - from;
        if length <= 0.0 {
            return Reading::new(measure, 0.0, 0.0).over(found.interval);
        }
        let hidden = self.hidden(found.interval);
        let mean = (found.value / length).powf(0.4);
        // The true signal may have the larger mean, and with it the steeper criterion.
        let growth = EXPONENT * (mean + hidden / STANDARD_GRAVITY / length).powf(1.5);
        let error = growth * hidden / STANDARD_GRAVITY + found.threshold + ROUNDING * found.value;
        let reading = Reading::new(measure, found.value, error).over(found.interval);
        let on_samples = windows.optimum_between(cap, (self.channel.times(), found.interval));
        Reading { on_samples: Some(on_samples.value), ..reading }
    }

    fn severity(&self) -> Reading {
        let (times, values) = (self.channel.times(), self.channel.values());
        let (mut value, mut error, mut variance, mut on_samples) = (0.0, 0.0, 0.0, 0.0);
        let Uncertainty { floor, noise, .. } = self.uncertainty;
        let scatter = noise.deviation / STANDARD_GRAVITY;
        let index = |own: f64| (own.abs() / STANDARD_GRAVITY).powf(EXPONENT);
        for at in 0..times.len() - 1 {
            let step = times[at + 1] - times[at];
            let ends = [values[at], values[at + 1]].map(|own| own / STANDARD_GRAVITY);
            value += step * power_of_line(ends, EXPONENT);
            on_samples += 0.5 * step * (index(values[at]) + index(values[at + 1]));
            let hidden = self.sampling.hidden(at);
            let most =
                ends[0].abs().max(ends[1].abs()) + (hidden.height.abs() + floor) / STANDARD_GRAVITY;
            let growth = EXPONENT * most.powf(EXPONENT - 1.0);
            error += growth * (hidden.area + floor * step) / STANDARD_GRAVITY;
            variance += noise.intensity * step * (growth / STANDARD_GRAVITY).powi(2);
            // The index is convex, so that noise adds half of the second derivative times its variance.
            let bend = EXPONENT * (EXPONENT - 1.0) * most.max(scatter).powf(EXPONENT - 2.0);
            error += 0.5 * bend * scatter * scatter * step;
        }
        error += 2.0 * variance.sqrt();
        let reading = Reading::new(Measure::SeverityIndex, value, error).over(self.channel.span());
        Reading { on_samples: Some(on_samples), ..reading }
    }

    fn clip(&self, measure: Measure, counted: Counted) -> Option<Reading> {
        let span = self.channel.span();
        let exceedance = self.exceedance.as_ref()?;
        let reading = Reading::new(measure, 0.0, 0.0);
        if span.1 - span.0 < CLIP {
            return Some(Reading { value: Err(Reason::RecordTooShort), ..reading });
        }
        // Where the magnitude passes zero, rounding leaves it above.
        let rounding = ROUNDING * self.channel.largest().1;
        let level = |duration: f64| {
            let level = exceedance.level(duration, counted).value;
            if level <= rounding { 0.0 } else { level }
        };
        let value = level(CLIP);
        let shifts = self.sampling.passages(value, span, f64::abs);
        let shift = match counted {
            Counted::Together => shifts.sum(),
            // A stretch has two ends.
            Counted::AtOnce => 2.0 * shifts.fold(0.0, f64::max),
        };
        let apart = [CLIP - shift, CLIP + shift].map(|own| (level(own.max(0.0)) - value).abs());
        let noise = self.uncertainty.noise.extreme_near(self.channel.values(), value);
        let error = apart[0].max(apart[1]) + self.uncertainty.floor + noise;
        Some(Reading::new(measure, value, error))
    }
}

/// The mean of `|s|^n` over a line with these values at its ends.
fn power_of_line(ends: [f64; 2], n: f64) -> f64 {
    let [one, other] = ends;
    let whole = |own: f64| own.abs().powf(n + 1.0) * own.signum();
    let apart = other - one;
    if apart.abs() <= 1e-4 * (one + other).abs() {
        return (0.5 * (one + other).abs()).powf(n);
    }
    (whole(other) - whole(one)) / ((n + 1.0) * apart)
}
