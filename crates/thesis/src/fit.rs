//! The pulse `P τ e^(−mτ)` that comes nearest to a force.

use dashpot_numerics::{quadrature::GaussLegendre, roots::monotone_root};

use crate::{Impact, Pulse};

/// A pulse of an impact and how far it is from the force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fit {
    /// The pulse.
    pub pulse: Pulse,
    /// Root of the mean square of the difference up to the release, over that of the force.
    pub misfit: f64,
}

/// Panels of the integrals over the impact; the fastest rates of paddings are below 100.
const PANELS: usize = 256;
/// Points of the rule of Gauss and Legendre on each.
const POINTS: usize = 4;
/// Range of m times the length of the impact in which the best one is looked for, and trials in it.
const RANGE: (f64, f64) = (0.1, 200.0);
const TRIALS: i32 = 200;

/// The force of an impact up to its release at points of a quadrature.
struct Samples {
    /// Time, weight and force.
    points: Vec<[f64; 3]>,
    length: f64,
}

impl Samples {
    fn of(impact: &Impact) -> Self {
        let length = impact.end();
        let half = 0.5 * length / PANELS as f64;
        let place = |panel: usize| (2 * panel + 1) as f64 * half;
        let rule = GaussLegendre::with_points(POINTS);
        let points = (0..PANELS).flat_map(|panel| {
            rule.nodes().iter().zip(rule.weights()).map(move |(node, weight)| {
                let time = place(panel) + half * node;
                [time, half * weight, impact.force(time)]
            })
        });
        Self { points: points.collect(), length }
    }

    fn sum(&self, of: impl Fn(f64, f64) -> f64) -> f64 {
        self.points.iter().map(|&[time, weight, force]| weight * of(time, force)).sum()
    }

    /// The best P for a given m, by linear least squares.
    fn slope(&self, decay: f64) -> f64 {
        let shape = |t: f64| t * (-decay * t).exp();
        self.sum(|t, force| force * shape(t)) / self.sum(|t, _| shape(t).powi(2))
    }

    /// Half the derivative of the squared difference by m, at the best P, over P.
    fn gradient(&self, decay: f64) -> f64 {
        let p = self.slope(decay);
        self.sum(|t, force| {
            let shape = t * (-decay * t).exp();
            (force - p * shape) * t * shape
        })
    }

    fn misfit(&self, pulse: &Pulse) -> f64 {
        let difference = self.sum(|t, force| (force - pulse.force(t)).powi(2));
        (difference / self.sum(|_, force| force * force)).sqrt()
    }
}

/// The misfit of a given pulse to an impact.
pub fn misfit(impact: &Impact, pulse: &Pulse) -> f64 {
    Samples::of(impact).misfit(pulse)
}

/// The pulse with the least squared difference from the force of an impact up to its release; `None`
/// where none is better than those beside it.
///
/// P is linear, so what is left is a minimum over m alone: of all places where the derivative by m is
/// zero, the best one is taken.
pub fn best_pulse(impact: &Impact) -> Option<Fit> {
    let samples = Samples::of(impact);
    let (low, high) = (RANGE.0 / samples.length, RANGE.1 / samples.length);
    let trial = |at: i32| low * (high / low).powf(f64::from(at) / f64::from(TRIALS));
    let turns = (0..TRIALS)
        .filter_map(|at| monotone_root(|decay| samples.gradient(decay), trial(at), trial(at + 1)));
    let fits = turns.map(|decay| {
        let pulse = Pulse { padding: impact.groups, slope: samples.slope(decay), decay };
        Fit { pulse, misfit: samples.misfit(&pulse) }
    });
    fits.min_by(|one, other| one.misfit.total_cmp(&other.misfit))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Groups;

    #[test]
    fn no_pulse_beside_the_best_one_is_nearer() {
        let impact = Impact::of_groups(&Groups::PRINTED).unwrap();
        let best = best_pulse(&impact).unwrap();
        for (slope, decay) in [(1.001, 1.0), (0.999, 1.0), (1.0, 1.001), (1.0, 0.999), (2.0, 1.4)] {
            let beside = Pulse {
                slope: slope * best.pulse.slope,
                decay: decay * best.pulse.decay,
                ..best.pulse
            };
            assert!(misfit(&impact, &beside) > best.misfit);
        }
        assert!(misfit(&impact, &Pulse::PRINTED) > best.misfit);
    }

    #[test]
    fn the_difference_is_orthogonal_to_what_the_pulse_can_change() {
        let impact = Impact::of_groups(&Groups::PRINTED).unwrap();
        let best = best_pulse(&impact).unwrap();
        let samples = Samples::of(&impact);
        let force = samples.sum(|_, force| force * force).sqrt();
        assert!(samples.gradient(best.pulse.decay).abs() < 1e-12 * force);
        // The quadrature knows ∫ φ dτ, which is the change of the impactor's speed.
        let impulse = samples.sum(|_, force| force);
        let change = 1.0 - impact.impactor_speed(impact.end());
        assert!((impulse - change).abs() < 1e-10, "{impulse} {change}");
    }
}
