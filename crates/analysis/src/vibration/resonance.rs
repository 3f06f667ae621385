//! Resonances: how high, how wide.

use std::f64::consts::{LN_2, TAU};

use super::{
    Swing,
    curve::Curve,
    extrema::{Extremum, UNKNOWN},
};

/// A peak of the response over frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resonance {
    /// Its frequency \[Hz\]: that of the highest response, not that of free oscillation.
    pub frequency: f64,
    /// How wrong the frequency may be \[Hz\].
    pub frequency_error: f64,
    /// The response there; `None` where nothing damps it, so that it has no limit.
    pub swing: Option<Swing>,
    /// The frequencies \[Hz\] below and above at which the response has fallen to 1/√2 of the peak.
    /// `None` where it does not on either side before it rises again, and without damping.
    pub band: Option<[f64; 2]>,
}

impl Resonance {
    /// Quality factor: the frequency over the width of the band \[1\].
    pub fn quality(&self) -> Option<f64> {
        self.band.map(|[low, high]| self.frequency / (high - low))
    }
}

/// The resonances from `low` to `high` \[Hz\] of a response whose extrema are known.
pub(super) fn resonances(
    curve: &Curve<'_>,
    extrema: &[Extremum],
    range: [f64; 2],
) -> Vec<Resonance> {
    let inner = extrema.windows(3).filter(|three| three[1].is_peak);
    inner
        .map(|three| of(curve, three))
        .filter(|own| (range[0]..=range[1]).contains(&own.frequency))
        .collect()
}

fn of(curve: &Curve<'_>, three: &[Extremum]) -> Resonance {
    let peak = three[1];
    let omega = peak.probe.omega;
    let swing = curve.swing(omega).filter(|own| own.error <= UNKNOWN * own.amplitude);
    let level = peak.probe.level - LN_2;
    let side = |far: &Extremum| {
        let (left, right) = if far.probe.omega < omega { (far, &peak) } else { (&peak, far) };
        (far.probe.level < level)
            .then(|| curve.root(left.probe, right.probe, |own| own.level - level).omega / TAU)
    };
    let band = swing.and_then(|_| Some([side(&three[0])?, side(&three[2])?]));
    Resonance {
        frequency: omega / TAU,
        frequency_error: peak.width / TAU + f64::EPSILON * omega,
        swing,
        band,
    }
}
