//! Where a model damps most.

use dashpot_numerics::extrema::maximum;

use super::{Specimen, schedule::logarithmic};

/// How far beyond the model's times peaks are looked for.
const BEYOND: f64 = 10.0;
/// Frequencies in each decade at which the search begins; peaks are wider than a decade.
const EACH_DECADE: f64 = 24.0;
/// Steps of the golden section: `0.618^60` is beyond what the peak can resolve.
const STEPS: usize = 60;

/// A peak of the loss factor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Peak {
    /// Angular frequency \[rad/s\], good to about 1e-8 of itself.
    pub(super) omega: f64,
    /// The loss factor there.
    pub(super) value: f64,
}

/// The highest of the peaks that the loss factor has at finite frequencies; `None` where it has
/// none.
pub(super) fn highest_loss_factor(specimen: &Specimen) -> Option<Peak> {
    let (fastest, slowest) = specimen.range_of_times();
    let (low, high) = (1.0 / (BEYOND * slowest), BEYOND / fastest);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "some thousands")]
    let count = (EACH_DECADE * (high / low).log10()).ceil() as usize + 1;
    let places = logarithmic(low, high, count);
    let factor = |omega: f64| specimen.linear().loss_factor(omega);
    let values: Vec<f64> = places.iter().map(|&omega| factor(omega)).collect();
    let tops = (1..places.len().saturating_sub(1))
        .filter(|&at| values[at] > values[at - 1] && values[at] >= values[at + 1]);
    tops.map(|at| refined(&factor, places[at - 1], places[at + 1]))
        .max_by(|one, other| one.value.total_cmp(&other.value))
}

/// The peak between two frequencies, by golden section in the logarithm.
fn refined(factor: &impl Fn(f64) -> f64, low: f64, high: f64) -> Peak {
    let (place, value) = maximum(low.ln(), high.ln(), STEPS, |place| factor(place.exp()));
    Peak { omega: place.exp(), value }
}
