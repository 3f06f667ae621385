//! A response over frequency, near its poles as well.

use std::{cell::OnceCell, f64::consts::TAU};

use nalgebra::Complex;

use super::{
    Swing, Vibration,
    observed::{Found, Observed, Response},
};

/// A response as a function of the angular frequency.
pub(super) struct Curve<'a> {
    vibration: &'a Vibration,
    response: &'a Response,
    /// What is near the poles, of each part of the response.
    near_poles: Vec<Vec<NearPole>>,
}

impl<'a> Curve<'a> {
    /// The response over a range of angular frequencies \[rad/s\] of a network with these `poles`.
    pub(super) fn new(
        vibration: &'a Vibration,
        response: &'a Response,
        poles: &[(f64, f64)],
        range: [f64; 2],
    ) -> Self {
        let near = |part: &Observed| NearPole::all(vibration, part, poles, range);
        Self { vibration, response, near_poles: response.parts.iter().map(near).collect() }
    }

    /// The response at the angular frequency `omega` \[rad/s\]; `None` where it cannot be told.
    pub(super) fn at(&self, omega: f64) -> Option<Found> {
        let rate = Complex::new(0.0, omega);
        let harmonic = OnceCell::new();
        let part = |(part, near_poles): (&Observed, &Vec<NearPole>)| {
            let near = || {
                near_poles.iter().filter_map(|near_pole| Some((near_pole, near_pole.at(omega)?)))
            };
            // As it stands it is nothing but rounding so near to a pole.
            if let Some((_, found)) = near().find(|own| own.0.has_pole()) {
                return Some(found);
            }
            let harmonic = harmonic.get_or_init(|| self.vibration.at(rate)).as_ref();
            let direct = harmonic.and_then(|harmonic| part.at(harmonic, rate));
            let all = direct.into_iter().chain(near().map(|own| own.1));
            all.min_by(|a, b| a.error.total_cmp(&b.error))
        };
        let parts = self.response.parts.iter().zip(&self.near_poles).map(part);
        self.response.form.of(&parts.collect::<Option<Vec<Found>>>()?)
    }

    pub(super) fn swing(&self, omega: f64) -> Option<Swing> {
        self.at(omega).map(|found| self.response.form.swing(&found))
    }
}

/// Values on the circle.
const VALUES: usize = 20;
/// Terms of the power series inside. The last coefficients of all are those of negative powers, which a pole
/// brings: those of the series have fallen below rounding by then.
const TERMS: usize = 16;
/// The next pole outside is so many radii away, and those inside are within a radius over this.
const APART: f64 = 8.0;
/// Poles that are nearer to each other than this part of their size are looked at together.
const ALIKE: f64 = 1e-6;
/// The power series is used up to this part of the radius.
const WITHIN: f64 = 0.5;
/// So near to a pole that does not cancel, in parts of the radius, this is used.
const LOST: f64 = 1e-6;
/// Damping, in parts of the frequency, that is none to rounding. Where there is more, what is observed is known
/// at a pole that does not cancel.
const UNDAMPED: f64 = 1e-12;
/// Poles are known to so many roundings of the largest one.
const ROUNDINGS: f64 = 16.0;

/// What is observed near a pole: a power series, and the part of the pole.
#[derive(Debug, Clone)]
pub(super) struct NearPole {
    centre: Complex<f64>,
    radius: f64,
    series: Vec<Complex<f64>>,
    pole: Option<Pole>,
    error: f64,
}

/// The part `strength / (z − at)` of what is observed, with z in radii from the centre.
#[derive(Debug, Clone, Copy)]
struct Pole {
    strength: Complex<f64>,
    at: Complex<f64>,
    /// Error of its place.
    shift: f64,
}

impl NearPole {
    /// Those around the `poles` (angular frequency and damping, \[rad/s\]) with a frequency in the `range` at
    /// which `observed` is lost in rounding.
    pub(super) fn all(
        vibration: &Vibration,
        observed: &Observed,
        poles: &[(f64, f64)],
        range: [f64; 2],
    ) -> Vec<Self> {
        let largest = poles.iter().map(|pole| pole.0.hypot(pole.1)).fold(0.0, f64::max);
        let mut looked_at: Vec<(Complex<f64>, f64)> = Vec::new();
        let mut found = Vec::new();
        let reach = 1.0 + WITHIN / APART;
        let is_near = |omega: f64| range[0] <= reach * omega && omega <= reach * range[1];
        for &(omega, damping) in poles.iter().filter(|pole| pole.0 > 0.0 && is_near(pole.0)) {
            let centre = Complex::new(-damping, omega);
            let is_known = |own: &(Complex<f64>, f64)| (own.0 - centre).norm() <= own.1 / APART;
            if looked_at.iter().any(is_known) || is_clear(vibration, observed, omega) {
                continue;
            }
            let Some((radius, count)) = radius(centre, poles) else { continue };
            looked_at.push((centre, radius));
            let near = Self::around(vibration, observed, centre, radius);
            let shift = ROUNDINGS * f64::EPSILON * largest / radius;
            let near = near.and_then(|near| near.with_pole(count, shift));
            found.extend(near.filter(|near| !near.has_pole() || damping <= UNDAMPED * omega));
        }
        found
    }

    /// The coefficients of the powers of z on the circle.
    fn around(
        vibration: &Vibration,
        observed: &Observed,
        centre: Complex<f64>,
        radius: f64,
    ) -> Option<Self> {
        let turn = |share: usize| Complex::from_polar(1.0, TAU * share as f64 / VALUES as f64);
        let value = |at: usize| {
            let rate = centre + turn(at) * radius;
            observed.at(&vibration.at(rate)?, rate)
        };
        let values = (0..VALUES).map(value).collect::<Option<Vec<Found>>>()?;
        let error = values.iter().map(|value| value.error).fold(0.0, f64::max);
        let coefficient = |power: usize| {
            let term = |(at, own): (usize, &Found)| own.value * turn(at * power % VALUES).conj();
            values.iter().enumerate().map(term).sum::<Complex<f64>>() / VALUES as f64
        };
        let series = (0..VALUES).map(coefficient).collect();
        Some(Self { centre, radius, series, pole: None, error })
    }

    /// The same with the part of its only pole, which is known to `shift` in radii; without it where it is
    /// none to rounding. `None` where the parts of `count` poles cannot be told apart.
    fn with_pole(mut self, count: usize, shift: f64) -> Option<Self> {
        let negative = self.series.split_off(TERMS);
        let [.., second, strength] = negative[..] else { return None };
        if strength.norm().max(second.norm()) <= self.error {
            return Some(self);
        }
        // Where the pole is weak, its place shows better in the state than in what is observed.
        let of_circle = self.error / strength.norm();
        let zero = Complex::default();
        let (at, shift) =
            if of_circle < shift { (second / strength, of_circle) } else { (zero, shift) };
        self.pole = Some(Pole { strength, at, shift });
        (count == 1).then_some(self)
    }

    /// What is observed at the angular frequency `omega` \[rad/s\]; `None` where that is not near.
    pub(super) fn at(&self, omega: f64) -> Option<Found> {
        let place = (Complex::new(0.0, omega) - self.centre) / self.radius;
        let reach = if self.pole.is_some() { LOST } else { WITHIN };
        if place.norm() > reach {
            return None;
        }
        let zero = Complex::<f64>::default();
        let terms = self.series.iter().rev();
        let (mut value, mut slope) = terms.fold((zero, zero), |(value, slope), &term| {
            (value * place + term, slope * place + value)
        });
        let mut error = self.error;
        if let Some(pole) = self.pole {
            let away = place - pole.at;
            let part = pole.strength / away;
            value += part;
            slope -= part / away;
            error += (self.error + part.norm() * pole.shift) / away.norm();
        }
        let slope = slope * Complex::i() / self.radius;
        let is_finite = value.re.is_finite() && value.im.is_finite();
        let rise = 2.0 * omega * (slope / value).re;
        is_finite.then_some(Found { value, error, rise })
    }

    /// Whether a pole shows in what is observed.
    pub(super) fn has_pole(&self) -> bool {
        self.pole.is_some()
    }
}

/// Whether what is observed is known at the angular frequency `omega` \[rad/s\] as it stands.
fn is_clear(vibration: &Vibration, observed: &Observed, omega: f64) -> bool {
    let rate = Complex::new(0.0, omega);
    let found = vibration.at(rate).and_then(|harmonic| observed.at(&harmonic, rate));
    found.is_some_and(|own| own.is_clear())
}

/// The radius of a circle with one pole, or with several that are alike, well within and all others well
/// outside, and how many are within; `None` where there is none.
fn radius(centre: Complex<f64>, poles: &[(f64, f64)]) -> Option<(f64, usize)> {
    let others = poles.iter().map(|pole| (Complex::new(-pole.1, pole.0) - centre).norm());
    // Beyond its own size there are the conjugate ones, and what is read at rest.
    let mut distances: Vec<f64> = others.chain([centre.norm()]).collect();
    distances.sort_by(f64::total_cmp);
    let least = ALIKE * centre.norm();
    let is_gap = |pair: &[f64]| pair[1] > (APART * APART * pair[0]).max(least);
    let within = distances.windows(2).position(is_gap)?;
    Some((distances[within + 1] / APART, within + 1))
}
