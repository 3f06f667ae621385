//! What a recorder makes of a curve: samples at its times, through the filter that its record went through.

use crate::{Cfc, Channel, Padding, SettingsFault, Steps};

/// Times of samples, and the filter behind them. It makes of a model's curve what a record has made of the measured
/// one, so that both can be compared.
///
/// # Examples
///
/// A half-sine of 1 ms and 100 at 20 kHz loses half of its peak in CFC 180:
///
/// ```
/// use dashpot_signal::{Cfc, Padding, Recorder};
///
/// let times = (0..400).map(|at| 5e-5 * f64::from(at));
/// let recorder = Recorder::new(times.collect(), Some((Cfc::new(180.0)?, Padding::Odd)))?;
/// let pulse = |time: f64| {
///     let phase = (time - 0.01) / 0.001;
///     if (0.0..=1.0).contains(&phase) { 100.0 * (std::f64::consts::PI * phase).sin() } else { 0.0 }
/// };
/// let peak = recorder.record(pulse).into_iter().fold(0.0, f64::max);
/// assert!(peak > 45.0 && peak < 55.0, "{peak}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Recorder {
    times: Vec<f64>,
    filter: Option<Filter>,
}

/// A class, what stands beyond the ends, and the rate \[Hz\].
#[derive(Debug, Clone, Copy, PartialEq)]
struct Filter {
    cfc: Cfc,
    padding: Padding,
    rate: f64,
}

impl Recorder {
    /// That of samples at these times \[s\], and of a filter where there is one.
    ///
    /// # Errors
    ///
    /// Times that are no record; for a filter uneven steps, and a rate at which it does not exist.
    pub fn new(times: Vec<f64>, filter: Option<(Cfc, Padding)>) -> Result<Self, SettingsFault> {
        let Some((cfc, padding)) = filter else { return Ok(Self { times, filter: None }) };
        let values = vec![0.0; times.len()];
        let channel = Channel::new("", dashpot_units::Dimension::NUMBER, times, values)
            .map_err(SettingsFault::NothingLeft)?;
        let Steps { rate, range, are_even, .. } = channel.steps();
        if !are_even {
            return Err(SettingsFault::UnevenSteps { range });
        }
        cfc.filter(&[0.0], rate, padding)?;
        let times = channel.times().to_vec();
        Ok(Self { times, filter: Some(Filter { cfc, padding, rate }) })
    }

    /// The times of its samples \[s\].
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// What it records of a curve over time \[s\].
    pub fn record(&self, curve: impl Fn(f64) -> f64) -> Vec<f64> {
        self.passed(self.times.iter().map(|time| curve(*time)).collect())
    }

    /// What its filter makes of samples at its times.
    pub fn passed(&self, samples: Vec<f64>) -> Vec<f64> {
        let Some(Filter { cfc, padding, rate }) = self.filter else { return samples };
        // Only a rate at which the filter does not exist fails, which none of a recorder is.
        cfc.filter(&samples, rate, padding).unwrap_or(samples)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::CfcFault;

    #[test]
    fn a_tone_passes_with_the_gain_of_the_class_and_its_own_phase() {
        let times: Vec<f64> = (0..8000).map(|at| 5e-5 * f64::from(at)).collect();
        let cfc = Cfc::new(180.0).unwrap();
        let recorder = Recorder::new(times.clone(), Some((cfc, Padding::Odd))).unwrap();
        for frequency in [50.0, 180.0, 373.95, 900.0] {
            let tone = |time: f64| (TAU * frequency * (time - 0.2)).sin();
            let recorded = recorder.record(tone);
            let gain = cfc.gain(frequency, 2e4);
            for at in 2000..6000 {
                assert!((recorded[at] - gain * tone(times[at])).abs() < 1e-9, "{frequency} {at}");
            }
        }
    }

    #[test]
    fn what_no_filter_can_be_run_on_is_refused() {
        let cfc = Cfc::new(600.0).unwrap();
        let of = |times: Vec<f64>| Recorder::new(times, Some((cfc, Padding::Odd)));
        let uneven = vec![0.0, 1e-4, 3e-4, 3.5e-4];
        assert!(matches!(of(uneven.clone()), Err(SettingsFault::UnevenSteps { .. })));
        let slow = (0..9).map(|at| 1e-3 * f64::from(at)).collect();
        assert!(matches!(of(slow), Err(SettingsFault::Cfc(CfcFault::TooSlow { .. }))));
        assert!(matches!(of(vec![0.0]), Err(SettingsFault::NothingLeft(_))));
        // Without a filter any times will do.
        let plain = Recorder::new(uneven, None).unwrap();
        assert_eq!(plain.record(|time| 2.0 * time)[2].to_bits(), 6e-4_f64.to_bits());
    }
}
