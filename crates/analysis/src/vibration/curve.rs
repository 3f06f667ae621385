//! A response as a function of the frequency.

use nalgebra::Complex;

use super::{
    Swing, Vibration,
    near_pole::NearPole,
    observed::{Found, Observed},
};

/// The response of what is observed as a function of the angular frequency.
pub(super) struct Curve<'a> {
    vibration: &'a Vibration,
    observed: &'a Observed,
    near_poles: Vec<NearPole>,
}

impl<'a> Curve<'a> {
    /// The response over a range of angular frequencies \[rad/s\] of a network with these `poles`.
    pub(super) fn new(
        vibration: &'a Vibration,
        observed: &'a Observed,
        poles: &[(f64, f64)],
        range: [f64; 2],
    ) -> Self {
        let near_poles = NearPole::all(vibration, observed, poles, range);
        Self { vibration, observed, near_poles }
    }

    /// What is observed at the angular frequency `omega` \[rad/s\]; `None` where it cannot be told.
    pub(super) fn at(&self, omega: f64) -> Option<Found> {
        let near = || self.near_poles.iter().filter_map(|own| Some((own, own.at(omega)?)));
        // As it stands it is nothing but rounding so near to a pole.
        if let Some((_, found)) = near().find(|own| own.0.has_pole()) {
            return Some(found);
        }
        let rate = Complex::new(0.0, omega);
        let direct = self.vibration.at(rate).and_then(|harmonic| self.observed.at(&harmonic, rate));
        let all = direct.into_iter().chain(near().map(|own| own.1));
        all.min_by(|a, b| a.error.total_cmp(&b.error))
    }

    /// The same as a swing.
    pub(super) fn swing(&self, omega: f64) -> Option<Swing> {
        self.at(omega).map(|found| Swing::of(found.value, found.error))
    }
}
