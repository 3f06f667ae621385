//! The model's answer to a piecewise linear history, mode by mode and in closed form.
//!
//! Every mode is a convolution of an exponential with straight lines. The lines are written over
//! their two end values, so that all terms of a history of one sign have one sign: nothing cancels.

use dashpot_rheology::{KelvinForm, MaxwellForm};

use super::history::{History, Instant};

/// Below this exponent the weights of a line are summed as series.
const SHORT: f64 = 1.0;
/// Terms of these series: 1/20! is beyond the digits of a double.
const TERMS: u32 = 20;

/// The parts of a deformation \[m\] that a force makes; the thesis calls them `ε₂`, `ε₁` and `ε₃`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Parts {
    /// Elastic and at once.
    pub(super) instantaneous: f64,
    /// Elastic and late.
    pub(super) delayed: f64,
    /// By flow, for good.
    pub(super) viscous: f64,
}

impl Parts {
    pub(super) fn total(self) -> f64 {
        self.instantaneous + self.delayed + self.viscous
    }
}

/// The deformation \[m\] under a force \[N\].
pub(super) fn deformation(form: &KelvinForm, force: &History, at: Instant) -> Parts {
    let mut delayed = 0.0;
    for element in form.elements() {
        let rate = element.rate.high();
        for line in force.lines_until(at) {
            let [first, last] = weights(rate * line.length);
            let since = at.time - (line.start + line.length);
            let left = if since > 0.0 { (-rate * since).exp() } else { 1.0 };
            delayed += element.compliance * left * (line.from * first + line.to * last);
        }
    }
    let flowed: f64 =
        force.lines_until(at).map(|line| line.length * 0.5 * (line.from + line.to)).sum();
    Parts {
        instantaneous: form.spring_compliance() * force.value(at),
        delayed,
        viscous: form.fluidity() * flowed,
    }
}

/// The force \[N\] under a deformation \[m\], without the impulses that a dashpot beside all else
/// answers jumps with.
pub(super) fn force(form: &MaxwellForm, deformation: &History, at: Instant) -> f64 {
    let mut force = form.spring() * deformation.value(at);
    if form.dashpot() > 0.0 {
        force += form.dashpot() * deformation.slope(at);
    }
    for element in form.elements() {
        let rate = element.rate.high();
        for (time, height) in deformation.jumps_until(at) {
            force += element.stiffness * height * (-rate * (at.time - time)).exp();
        }
        for line in deformation.lines_until(at) {
            let since = (at.time - (line.start + line.length)).max(0.0);
            let grown = -(-rate * line.length).exp_m1();
            force += element.damping * line.slope * grown * (-rate * since).exp();
        }
    }
    force
}

/// What the two end values of a line of the length `x` weigh at its end, in units of the decay:
/// `x ∫₀¹ e^(−x(1−w)) (1−w) dw` and `x ∫₀¹ e^(−x(1−w)) w dw`.
fn weights(x: f64) -> [f64; 2] {
    if x < SHORT {
        let (mut term, mut first, mut last) = (0.5, 0.0, 0.0);
        for k in 0..TERMS {
            first += f64::from(k + 1) * term;
            last += term;
            term *= -x / f64::from(k + 3);
        }
        return [x * first, x * last];
    }
    let left = (-x).exp();
    let first = (1.0 - left) / x - left;
    [first, -(-x).exp_m1() - first]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_weights_of_both_ends_add_up_to_the_creep() {
        for x in [1e-300, 1e-9, 0.3, 0.999_999, 1.000_001, 3.0, 50.0, 1e12] {
            let [first, last] = weights(x);
            let whole = -(-x).exp_m1();
            assert!(((first + last) / whole - 1.0).abs() < 4.0 * f64::EPSILON, "{x}");
            assert!(first > 0.0 && last >= first, "{x}: {first}, {last}");
        }
    }

    #[test]
    fn the_series_meets_the_closed_form() {
        let below = weights(SHORT * (1.0 - f64::EPSILON));
        let above = weights(SHORT);
        for (below, above) in below.iter().zip(above) {
            assert!((below / above - 1.0).abs() < 8.0 * f64::EPSILON);
        }
    }
}
