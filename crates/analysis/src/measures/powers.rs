//! Powers of a force, and their integral.

use dashpot_dae::{Panel, Signal};
use dashpot_numerics::quadrature::GaussLegendre;

/// Points of Gauss's rule for a step at one of whose ends a force is zero.
pub(crate) const ENDS: usize = 12;

/// `∫ F^n dt` of a force that pushes from the start to its release, zero at one of them or both.
pub(crate) fn power_of(force: &Signal, release: f64, exponent: f64) -> f64 {
    let (places, weights): ([f64; ENDS], [f64; ENDS]) = GaussLegendre::on_unit();
    let last = force.panels.len() - 1;
    let of_panel = |(at, panel): (usize, &Panel)| -> f64 {
        let length = panel.end.min(release) - panel.start;
        let at_place = |(u, weight): (f64, f64)| {
            // In the root of the time from where it is zero, powers of it are smooth.
            let (part, factor) = match at {
                0 => (u * u, 2.0 * u),
                at if at == last => (1.0 - u * u, 2.0 * u),
                _ => (u, 1.0),
            };
            let force = panel.value(panel.start + part * length).max(0.0);
            weight * factor * raised(force, exponent).0
        };
        length * places.into_iter().zip(weights).map(at_place).sum::<f64>()
    };
    force.panels.iter().enumerate().map(of_panel).sum()
}

/// The exponent of the severity index.
const GADD: f64 = 2.5;

/// `x^n` and `x^(n−1)`; the square root is much faster than any other power.
#[inline]
pub(crate) fn raised(x: f64, exponent: f64) -> (f64, f64) {
    if exponent.to_bits() == GADD.to_bits() {
        let root = x.sqrt();
        (x * x * root, x * root)
    } else if x > 0.0 {
        let power = x.powf(exponent);
        (power, power / x)
    } else {
        (0.0, 0.0)
    }
}
