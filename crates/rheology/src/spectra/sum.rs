//! Sums of Kelvin–Voigt elements while they are fitted.

use super::approach;

/// A sum `Σ e^(s_i) (1 − e^(−t/λ_i))`, dimensionless, known by `ln λ_i` and `s_i`. Whatever values
/// these take, strengths and times are positive.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Sum {
    /// `ln λ_i` and `s_i`, by rising time.
    pub(super) terms: Vec<(f64, f64)>,
}

impl Sum {
    /// Value at `ln t = place`.
    pub(super) fn share(&self, place: f64) -> f64 {
        self.terms
            .iter()
            .map(|(time, strength)| strength.exp() * approach((place - time).exp()))
            .sum()
    }

    /// `sum/share − 1` at `ln t = place`, and its derivatives by all `ln λ_i`, then all `s_i`.
    pub(super) fn deviation(&self, place: f64, share: f64, slopes: &mut [f64]) -> f64 {
        let (by_times, by_strengths) = slopes.split_at_mut(self.terms.len());
        let mut value = 0.0;
        let each = self.terms.iter().zip(by_times).zip(by_strengths);
        for (((time, strength), by_time), by_strength) in each {
            // Beyond this ratio the exponential is zero, and ratio times it not a number.
            let ratio = (place - time).exp().min(1e3);
            let strength = strength.exp();
            let part = strength * approach(ratio);
            value += part;
            *by_time = -strength * ratio * (-ratio).exp() / share;
            *by_strength = part / share;
        }
        (value - share) / share
    }

    /// The sum with `change` added to its parameters, in the order of the derivatives.
    pub(super) fn moved(&self, change: &[f64]) -> Self {
        let (by_times, by_strengths) = change.split_at(self.terms.len());
        let mut terms: Vec<(f64, f64)> = self
            .terms
            .iter()
            .zip(by_times.iter().zip(by_strengths))
            .map(|((time, strength), (longer, stronger))| (time + longer, strength + stronger))
            .collect();
        terms.sort_by(|a, b| a.0.total_cmp(&b.0));
        Self { terms }
    }
}
