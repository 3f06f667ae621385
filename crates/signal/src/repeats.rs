//! Several tests of the same: mean, scatter, repeatability.

use crate::{Analysis, Measure, Truth};

/// Points of a band over time.
const POINTS: usize = 400;
/// How long before and behind the contact a band reaches, in parts of its length.
const AROUND: f64 = 0.25;
/// The difference of two tests that 95 % do not exceed, in standard deviations: 1.96 √2, as in ISO 5725-6.
const REPEATABILITY: f64 = 2.8;

/// A measure over several tests.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Repeated {
    /// What it is.
    pub measure: Measure,
    /// How many tests have a value.
    pub tests: usize,
    /// The mean of their values.
    pub mean: f64,
    /// How far that may be off because the single ones are.
    pub error: f64,
    /// Standard deviation of one test.
    pub deviation: f64,
    /// The smallest and the largest value.
    pub range: (f64, f64),
}

impl Repeated {
    /// The measures that two or more tests have.
    pub fn of(tests: &[&Analysis]) -> Vec<Self> {
        let Some(first) = tests.first() else { return Vec::new() };
        first.readings.iter().filter_map(|own| Self::one(tests, own.measure)).collect()
    }

    fn one(tests: &[&Analysis], measure: Measure) -> Option<Self> {
        let found = tests.iter().filter_map(|own| own.reading(measure));
        // Bounds have no mean and no scatter.
        if found.clone().any(|own| own.truth != Truth::Within) {
            return None;
        }
        let found: Vec<(f64, f64)> =
            found.filter_map(|own| Some((own.value.ok()?, own.error))).collect();
        let count = found.len() as f64;
        if found.len() < 2 {
            return None;
        }
        let mean = found.iter().map(|own| own.0).sum::<f64>() / count;
        let spread = found.iter().map(|own| (own.0 - mean).powi(2)).sum::<f64>();
        let low = found.iter().map(|own| own.0).fold(f64::INFINITY, f64::min);
        let high = found.iter().map(|own| own.0).fold(f64::NEG_INFINITY, f64::max);
        Some(Self {
            measure,
            tests: found.len(),
            mean,
            error: found.iter().map(|own| own.1).sum::<f64>() / count,
            deviation: (spread / (count - 1.0)).sqrt(),
            range: (low, high),
        })
    }

    /// Standard deviation in parts of the mean.
    pub fn variation(&self) -> Option<f64> {
        (self.mean != 0.0).then(|| self.deviation / self.mean.abs())
    }

    /// The difference that two tests exceed in one of twenty cases.
    pub fn repeatability(&self) -> f64 {
        REPEATABILITY * self.deviation
    }
}

/// The course of several tests: times since contact began \[s\], mean and standard deviation.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Band {
    /// Times since the contact of each began \[s\].
    pub times: Vec<f64>,
    /// Mean of the values then.
    pub mean: Vec<f64>,
    /// Standard deviation of one test.
    pub deviation: Vec<f64>,
}

impl Band {
    /// That of two or more tests, each from the beginning of its contact; `None` of fewer.
    pub fn of(tests: &[&Analysis]) -> Option<Self> {
        if tests.len() < 2 {
            return None;
        }
        let length = tests.iter().map(|own| own.contact.length()).fold(0.0, f64::max);
        let mut band = Self::default();
        for at in 0..=POINTS {
            let time = length * ((1.0 + 2.0 * AROUND) * at as f64 / POINTS as f64 - AROUND);
            let values = tests.iter().map(|own| own.channel.value(own.contact.window.0 + time));
            let values: Vec<f64> = values.collect();
            let count = values.len() as f64;
            let mean = values.iter().sum::<f64>() / count;
            let spread = values.iter().map(|own| (own - mean).powi(2)).sum::<f64>();
            band.times.push(time);
            band.mean.push(mean);
            band.deviation.push((spread / (count - 1.0)).sqrt());
        }
        Some(band)
    }
}
