//! What is read off a channel, and how far each number may be off.

use dashpot_units::Dimension;
use std::cell::OnceCell;

use crate::{
    Approach, Channel, Contact, Measure, Motion, Reading, Reason, Uncertainty, clipping::Clipping,
    sampling::Sampling,
};
use dashpot_analysis::{
    Counted,
    measures::{Exceedance, STANDARD_GRAVITY, hic_search::Windows},
};

/// The time of a clip \[s\].
const CLIP: f64 = 0.003;
/// The exponent of the severity index.
const EXPONENT: f64 = 2.5;
/// Rounding of a criterion, in parts of it.
const ROUNDING: f64 = 1e-9;

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
