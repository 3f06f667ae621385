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
    /// Rows beside later jumps of the curve, which take no part.
    pub(super) skipped: Vec<usize>,
    /// How many samples are averaged to a row while the search is coarse; 1 where none are.
    window: usize,
}

/// Fewer samples are not averaged, and rows of averages are no fewer.
const FEWEST: usize = 3;
const ROWS: usize = 12;

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
            skipped: Vec::new(),
            window: 1,
        })
    }

    pub(super) fn rows(&self) -> usize {
        if self.window > 1 {
            return (self.recorder.times().len() - self.window) / self.stride() + 1;
        }
        self.whitener.as_ref().map_or(self.recorder.times().len(), Whitener::count)
    }

    /// From here on rows are averages over one of so many parts of a pulse, or samples as they are. Whether they are
    /// averages.
    pub(super) fn average(&mut self, test: &Test, parts: Option<usize>) -> bool {
        let most = test.rows.len() / ROWS;
        let window = parts.map_or(1, |parts| pulse(&test.rows) / parts);
        let window = window.max(FEWEST).min(most);
        let is_averaged = parts.is_some() && test.kind == Kind::Blow && window >= FEWEST;
        self.window = if is_averaged { window } else { 1 };
        is_averaged
    }

    /// Averages overlap by half.
    fn stride(&self) -> usize {
        self.window.div_ceil(2)
    }

    /// Independent rows of something that has a value for each sample. Averages have the weight of the samples between them.
    pub(super) fn independent(&self, mut values: Vec<f64>) -> Vec<f64> {
        if self.window > 1 {
            let weight = (self.stride() as f64).sqrt() / self.window as f64;
            let all = values.windows(self.window).step_by(self.stride());
            return all.map(|own| weight * own.iter().sum::<f64>()).collect();
        }
        if let Some(own) = &self.whitener {
            return own.whitened(&values);
        }
        self.skipped.iter().for_each(|at| values[*at] = 0.0);
        values
    }
}

/// How many samples a pulse has: the longest stretch on the side of the peak of the middle between a low and a high
/// percentile, so that no spike is one.
fn pulse(rows: &[(f64, f64)]) -> usize {
    let mut sorted: Vec<f64> = rows.iter().map(|own| own.1).collect();
    sorted.sort_by(f64::total_cmp);
    let far = sorted.len() / 100;
    let [low, middle, high] = [far, sorted.len() / 2, sorted.len() - 1 - far].map(|at| sorted[at]);
    let side = if high - middle >= middle - low { 1.0 } else { -1.0 };
    let is_beyond = |own: &(f64, f64)| side * (own.1 - f64::midpoint(low, high)) > 0.0;
    let stretches = rows.split(|own| !is_beyond(own)).map(<[_]>::len);
    stretches.max().unwrap_or(0)
}
