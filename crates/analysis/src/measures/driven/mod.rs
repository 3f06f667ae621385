//! A mass on a linear model whose other end follows a body: the networks that measures are.

use dashpot_dae::{Panel, Signal};
use dashpot_network::{Model, first_nonlinear, linear_model, parameters::WindowWish};
use dashpot_numerics::chebyshev::{self, Coefficients};

use super::Reading;
use crate::{Note, Solution, VelocityJump};

/// Rounds of the iteration on one stretch. The error of round `n` is at most `(λ h)ⁿ/n!` of the
/// solution, with the rate `λ` of the equations and the length `h ≤ 1/λ` of the stretch.
const ROUNDS: usize = 18;
/// A signal is cut into so many stretches at most.
const MOST_STRETCHES: f64 = 200_000.0;

/// A unit mass on springs and dashpots, at rest and unloaded when it begins.
///
/// With the deformation `y`, positive where the body comes nearer to the mass,
/// `y″ = a(t) − f`, `f = k y + c y′ + Σ fᵢ`, `fᵢ′ = kᵢ y′ − rᵢ fᵢ`, where `a` is what an accelerometer
/// on the body reads and `f` the force of the model per mass.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Oscillator {
    spring: f64,
    dashpot: f64,
    /// Stiffness and rate of each Maxwell element.
    elements: Vec<(f64, f64)>,
}

impl Oscillator {
    /// The oscillator of the angular frequency `omega` \[rad/s\] and this damping ratio.
    pub(super) fn new(omega: f64, damping_ratio: f64) -> Self {
        let dashpot = 2.0 * damping_ratio * omega;
        Self { spring: omega * omega, dashpot, elements: Vec::new() }
    }

    /// `mass` \[kg\] on a model; `None` where the model is not linear, or cannot deform.
    pub(super) fn of(model: &Model, mass: f64) -> Option<Self> {
        if first_nonlinear(model).is_some() {
            return None;
        }
        let linear = linear_model(model);
        let form = linear.maxwell().filter(|_| linear.is_in_range())?;
        let elements = form.elements().into_iter();
        Some(Self {
            spring: form.spring() / mass,
            dashpot: form.dashpot() / mass,
            elements: elements
                .map(|element| (element.stiffness / mass, element.stiffness / element.damping))
                .collect(),
        })
    }

    /// The deformation \[m\] while the body has this acceleration \[m/s²\] and these jumps of speed (time and size),
    /// from the window's start to its end. `None` where the model is so stiff that the window is too long for it.
    pub(super) fn deformation(
        &self,
        acceleration: &Signal,
        kicks: &[(f64, f64)],
        window: (f64, f64),
    ) -> Option<Signal> {
        let (from, to) = window;
        let stiffness = self.spring + self.elements.iter().map(|element| element.0).sum::<f64>();
        let unit = if stiffness > 0.0 { stiffness.sqrt() } else { 1.0 };
        let rate = self.rate(unit);
        if (to - from) * rate > MOST_STRETCHES {
            return None;
        }
        let mut state = vec![0.0; 2 + self.elements.len()];
        let (mut panels, mut stretches) = (Vec::new(), 0.0);
        let mut left = kicks.iter().filter(|kick| kick.0 >= from && kick.0 <= to).peekable();
        for panel in &acceleration.panels {
            let (start, end) = (panel.start.max(from), panel.end.min(to));
            let mut at = start;
            while at < end {
                while let Some(kick) = left.next_if(|kick| kick.0 <= at) {
                    state[1] += kick.1;
                }
                let until = left.peek().map_or(end, |kick| kick.0.min(end));
                let count = ((until - at) * rate).ceil().max(1.0);
                let next = if count > 1.0 { (at + (until - at) / count).min(until) } else { until };
                let next = if next > at { next } else { until };
                let part = panel.part(at, next);
                panels.push(self.stretch(&part, unit, &mut state));
                stretches += 1.0;
                at = next;
            }
        }
        let magnitude = panels.iter().map(|panel| chebyshev::bound(&panel.coefficients));
        let magnitude = magnitude.fold(0.0, f64::max);
        let noise = f64::EPSILON * (16.0 + stretches) * magnitude;
        // A passive model slows the mass down, so that an error ε of the acceleration can make a speed of ε t at most.
        let error = acceleration.error.map(|error| 0.5 * error * (to - from).powi(2) + noise);
        Some(Signal::new(panels, error, noise))
    }

    /// A bound of how fast the state can change, for a state in units of `1/unit`, 1 and `unit`.
    fn rate(&self, unit: f64) -> f64 {
        let in_elements: f64 = self.elements.iter().map(|_| unit).sum();
        let of_force = self.spring / unit + self.dashpot + in_elements;
        let of_elements = self.elements.iter().map(|element| element.0 / unit + element.1);
        of_elements.fold(unit.max(of_force), f64::max)
    }

    /// Carries the state over a stretch of the acceleration, by iterating the integral equation on
    /// Chebyshev series; the deformation there.
    fn stretch(&self, acceleration: &Panel, unit: f64, state: &mut [f64]) -> Panel {
        let half = 0.5 * acceleration.length();
        let length = acceleration.coefficients.len() + ROUNDS;
        let mut series: Vec<Coefficients> = state.iter().map(|&own| [own].into()).collect();
        for _ in 0..ROUNDS {
            let rates = self.rates(&series, &acceleration.coefficients, unit);
            for ((own, rate), &start) in series.iter_mut().zip(&rates).zip(state.iter()) {
                *own = chebyshev::antiderivative(rate);
                own.resize(own.len().min(length));
                own.iter_mut().for_each(|c| *c *= half);
                own[0] += start;
            }
        }
        for (end, own) in state.iter_mut().zip(&series) {
            *end = chebyshev::evaluate(own, 1.0);
        }
        let coefficients = series[0].iter().map(|c| c / unit).collect();
        Panel { start: acceleration.start, end: acceleration.end, coefficients }
    }

    fn rates(&self, series: &[Coefficients], acceleration: &[f64], unit: f64) -> Vec<Vec<f64>> {
        let length = series.iter().map(|own| own.len()).fold(acceleration.len(), usize::max);
        let at = |own: &[f64], k: usize| own.get(k).copied().unwrap_or(0.0);
        let (position, speed, forces) = (&series[0], &series[1], &series[2..]);
        let combined = |f: &dyn Fn(usize) -> f64| (0..length).map(f).collect::<Vec<f64>>();
        let mut rates = vec![
            combined(&|k| unit * at(speed, k)),
            combined(&|k| {
                let in_elements: f64 = forces.iter().map(|force| at(force, k)).sum();
                let force = self.spring / unit * at(position, k) + self.dashpot * at(speed, k);
                at(acceleration, k) - force - unit * in_elements
            }),
        ];
        rates.extend(self.elements.iter().zip(forces).map(|(&(stiffness, decay), own)| {
            combined(&|k| stiffness / unit * at(speed, k) - decay * at(own, k))
        }));
        rates
    }
}

/// The largest magnitude of `factor` times the deformation of an oscillator that the node `target`
/// carries, driven from the start of the window on.
pub(super) fn largest_deformation(
    solution: &Solution<'_>,
    target: usize,
    (oscillator, factor): (&Oscillator, f64),
    window: WindowWish,
) -> Result<Reading, Note> {
    let acceleration = solution.node_acceleration(target)?;
    let span = solution.node_span(target, window)?;
    let jumps = solution.node_jumps(target);
    let mass = solution.body_mass(target);
    let kicks = VelocityJump::within(&jumps, span.window()).iter();
    let kicks: Vec<(f64, f64)> = kicks.map(|kick| (kick.time, kick.impulse / mass)).collect();
    let deformation = oscillator.deformation(acceleration, &kicks, span.window());
    let deformation = deformation.ok_or(Note::TooStiff)?;
    let reading = Reading::peak(&deformation.scaled(factor), &span);
    let is_rising = reading.value.is_some_and(|value| value > 0.0) && reading.time >= Some(span.to);
    Ok(reading.noting_if(is_rising, Note::StillRising))
}

#[cfg(test)]
mod tests;
