//! What several instants ask for together, where a support that springs back makes more than one of them tell.

use dashpot_numerics::quadrature::GaussLegendre;

use super::kernel::Kernel;

/// Instants, at equal distances from touch on.
const INSTANTS: usize = 96;
/// Rounds in which their weights are found.
const ROUNDS: usize = 600;
/// An instant tells if it has this part of the largest weight.
const TELLS: f64 = 1e-3;

/// The largest lower bound of the norm `(∫ |u|^n dt)^(1/n)` of all forces `u(t)` that make the approach of each instant
/// up to `end` \[s\] what is `missing` there at least, behind the last instant that tells \[s\]: the most of
/// `Σ λ missing` over the norm of `Σ λ G` with the exponent `n/(n − 1)`, for all weights `λ ≥ 0` (Hölder).
///
/// It is a bound whatever the weights are. They go where instants ask for more than the force of the others gives; the
/// norm of the best ones is taken once more on three times as many places.
pub(super) fn least_norm(
    kernel: &Kernel,
    exponent: f64,
    end: f64,
    missing: impl Fn(f64) -> f64,
) -> (f64, f64) {
    let (step, other) = (end / INSTANTS as f64, exponent / (exponent - 1.0));
    let missing: Vec<f64> = (1..=INSTANTS).map(|at| missing(at as f64 * step).max(0.0)).collect();
    let approach = Approach::<4>::of(kernel, step);
    let mut weights: Vec<f64> = missing.iter().map(|own| f64::from(u8::from(*own > 0.0))).collect();
    let asked =
        |weights: &[f64]| weights.iter().zip(&missing).map(|own| own.0 * own.1).sum::<f64>();
    let mut best = (0.0, weights.clone());
    for _ in 0..ROUNDS {
        let sums = approach.sums(&weights);
        let (power, asked) = (approach.power(&sums, other), asked(&weights));
        let bound = asked / power.powf(1.0 / other);
        if !bound.is_finite() {
            break;
        }
        if bound > best.0 {
            best = (bound, weights.clone());
        }
        // What the force that the weights ask for gives each instant, alike at all that tell.
        let force =
            sums.iter().map(|own| own.map(|own| own.signum() * own.abs().powf(other - 1.0)));
        let force: Vec<[f64; 4]> = force.collect();
        for (at, weight) in weights.iter_mut().enumerate().filter(|own| *own.1 > 0.0) {
            let given = approach.given(&force[..=at]).max(f64::MIN_POSITIVE);
            *weight *= (missing[at] * power / (given * asked)).clamp(0.1, 10.0);
        }
        let most = weights.iter().copied().fold(0.0, f64::max);
        weights.iter_mut().for_each(|own| *own /= most);
    }
    let weights = best.1;
    let fine = Approach::<12>::of(kernel, step);
    let bound = asked(&weights) / fine.power(&fine.sums(&weights), other).powf(1.0 / other);
    let most = weights.iter().copied().fold(0.0, f64::max);
    let last = weights.iter().rposition(|own| *own > TELLS * most).map_or(0, |at| at + 1);
    (last as f64 * step, if bound.is_finite() { bound } else { 0.0 })
}

/// The approach at an instant after a unit impulse at `N` places in each of the steps before it, the next one first.
struct Approach<const N: usize> {
    steps: Vec<[f64; N]>,
    /// The part of an integral that each place has \[s\].
    shares: [f64; N],
}

impl<const N: usize> Approach<N> {
    fn of(kernel: &Kernel, step: f64) -> Self {
        let (places, shares) = GaussLegendre::on_unit::<N>();
        let before = |at: usize| places.map(|place| kernel.value((at as f64 + place) * step));
        Self { steps: (0..INSTANTS).map(before).collect(), shares: shares.map(|own| own * step) }
    }

    /// The weighted sum of what an impulse at each place does to all later instants.
    fn sums(&self, weights: &[f64]) -> Vec<[f64; N]> {
        let sum = |at: usize, place: usize| {
            let later = weights[at..].iter().zip(&self.steps);
            later.map(|(weight, own)| weight * own[place]).sum()
        };
        (0..INSTANTS).map(|at| std::array::from_fn(|place| sum(at, place))).collect()
    }

    /// `∫ |sum|^p`.
    fn power(&self, sums: &[[f64; N]], power: f64) -> f64 {
        let of_step = |own: &[f64; N]| {
            own.iter()
                .zip(&self.shares)
                .map(|(own, share)| share * own.abs().powf(power))
                .sum::<f64>()
        };
        sums.iter().map(of_step).sum()
    }

    /// The approach at the end of the last step of a force.
    fn given(&self, force: &[[f64; N]]) -> f64 {
        let of_step = |(force, own): (&[f64; N], &[f64; N])| {
            (0..N).map(|at| self.shares[at] * force[at] * own[at]).sum::<f64>()
        };
        force.iter().rev().zip(&self.steps).map(of_step).sum()
    }
}
