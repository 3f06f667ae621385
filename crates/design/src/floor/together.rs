//! What several instants ask for together, where a support that springs back makes more than one of them tell.

use dashpot_numerics::quadrature::GaussLegendre;

use super::kernel::Kernel;

/// Instants, at equal distances from touch on.
const INSTANTS: usize = 96;
/// Rounds in which their weights are found.
const ROUNDS: usize = 600;

/// The largest lower bound of the norm `(∫ |u|^n dt)^(1/n)` of all forces `u(t)` that make the approach of each instant
/// up to `end` \[s\] what is `missing` there at least: the most of `Σ λ missing` over the norm of `Σ λ G` with the
/// exponent `n/(n − 1)`, for all weights `λ ≥ 0` (Hölder).
///
/// It is a bound whatever the weights are. They go where instants ask for more than the force of the others gives.
pub(super) fn least_norm(
    kernel: &Kernel,
    exponent: f64,
    end: f64,
    missing: impl Fn(f64) -> f64,
) -> f64 {
    let (step, other) = (end / INSTANTS as f64, exponent / (exponent - 1.0));
    let missing: Vec<f64> = (1..=INSTANTS).map(|at| missing(at as f64 * step).max(0.0)).collect();
    let (places, shares) = GaussLegendre::on_unit::<4>();
    // The approach at an instant after a unit impulse within the step that is so many before it.
    let lag = |at: usize| places.map(|place| kernel.value((at as f64 + place) * step));
    let approach: Vec<[f64; 4]> = (0..INSTANTS).map(lag).collect();
    let mut weights: Vec<f64> = missing.iter().map(|own| f64::from(u8::from(*own > 0.0))).collect();
    let mut best = 0.0_f64;
    for _ in 0..ROUNDS {
        // The sum of weighted approaches in each step, and the force that it asks for.
        let (mut power, mut force) = (0.0, vec![[0.0; 4]; INSTANTS]);
        for (at, force) in force.iter_mut().enumerate() {
            for (node, share) in shares.into_iter().enumerate() {
                let later = weights[at..].iter().zip(&approach);
                let sum: f64 = later.map(|(weight, own)| weight * own[node]).sum();
                power += step * share * sum.abs().powf(other);
                force[node] = step * share * sum.signum() * sum.abs().powf(other - 1.0);
            }
        }
        let asked: f64 = weights.iter().zip(&missing).map(|(own, missing)| own * missing).sum();
        let bound = asked / power.powf(1.0 / other);
        if !bound.is_finite() {
            break;
        }
        best = best.max(bound);
        for (at, weight) in weights.iter_mut().enumerate().filter(|own| *own.1 > 0.0) {
            let earlier = force[..=at].iter().rev().zip(&approach);
            let given: f64 = earlier
                .map(|(own, lag)| own.iter().zip(lag).map(|own| own.0 * own.1).sum::<f64>())
                .sum();
            // Alike at all instants that tell.
            let ratio = missing[at] * power / (given.max(f64::MIN_POSITIVE) * asked);
            *weight *= ratio.clamp(0.1, 10.0);
        }
        let most = weights.iter().copied().fold(0.0, f64::max);
        weights.iter_mut().for_each(|own| *own /= most);
    }
    best
}
