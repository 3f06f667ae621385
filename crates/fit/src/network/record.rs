//! How a test was recorded, and which of its rows are independent.

use dashpot_signal::{Padding, Recorder, SettingsFault, Whitener};

use super::{Kind, Test, jump::Jump};

/// How a test was recorded, and what it is counted in.
pub(super) struct Record {
    pub(super) recorder: Recorder,
    pub(super) whitener: Option<Whitener>,
    /// What the filter makes of a constant 1.
    pub(super) constant: Vec<f64>,
    /// Length and mean step \[s\], and the largest magnitude, with the time of that.
    pub(super) length: f64,
    pub(super) step: f64,
    pub(super) peak: f64,
    pub(super) peak_time: f64,
    /// What its rows are counted in.
    pub(super) unit: f64,
    /// Where its curve jumps, once that is known.
    pub(super) jump: Option<Jump>,
}

impl Record {
    pub(super) fn of(test: &Test) -> Result<Self, SettingsFault> {
        let (mut first, mut last, mut peak) = (f64::INFINITY, f64::NEG_INFINITY, (0.0, 0.0));
        for &(time, value) in &test.rows {
            (first, last) = (first.min(time), last.max(time));
            if value.abs() > f64::abs(peak.1) {
                peak = (time, value);
            }
        }
        let times: Vec<f64> = test.rows.iter().map(|own| own.0).collect();
        let count = times.len();
        let recorder = Recorder::new(times, test.filter)?;
        let length = (last - first).max(f64::MIN_POSITIVE);
        let rate = count.saturating_sub(1) as f64 / length;
        let whitener = |(cfc, padding): (_, Padding)| Whitener::new(count, cfc, rate, padding);
        Ok(Self {
            constant: recorder.record(|_| 1.0),
            whitener: test.filter.map(whitener).transpose()?,
            recorder,
            length,
            step: length / count as f64,
            peak: f64::abs(peak.1),
            peak_time: peak.0,
            // Moduli are counted in parts.
            unit: if test.kind == Kind::Modulus { 1.0 } else { f64::abs(peak.1) },
            jump: None,
        })
    }

    pub(super) fn rows(&self) -> usize {
        self.whitener.as_ref().map_or(self.recorder.times().len(), Whitener::count)
    }

    /// Independent rows of something that has a value for each sample.
    pub(super) fn independent(&self, values: Vec<f64>) -> Vec<f64> {
        match &self.whitener {
            Some(own) => own.whitened(&values),
            None => values,
        }
    }
}
