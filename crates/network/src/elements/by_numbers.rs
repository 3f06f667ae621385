//! Slopes, energy and structure of a law of which the force alone is known.

use dashpot_numerics::quadrature::integral_to;

use super::{Element, Tangent};
use crate::parameters::InvalidParameter;

/// Deformation \[m\] and rate \[m/s\] where slopes count as typical unless a law says others.
pub(super) const TYPICAL: [f64; 2] = [0.01, 1.0];
/// Step of central differences in parts of the place: the cube root of a double's digits, where
/// truncation and rounding are alike.
const STEP: f64 = 6e-6;
/// Error of the work, in parts of that of the typical secant.
const AGREEMENT: f64 = 1e-13;

/// Places at which a law is looked at, in parts of what is typical, on both sides of zero.
pub(super) const PLACES: [f64; 13] =
    [-3.0, -1.0, -0.5, -0.1, -0.01, -0.001, 0.0, 0.001, 0.01, 0.1, 0.5, 1.0, 3.0];

/// What a force may fall by, and have at rest, in parts of the largest one: its rounding.
const ROUNDING: f64 = 1e-12;

/// What is asked of a law, and where one pulls back while it is still pressed in, what makes it so.
const RISES: &str = "a law that falls nowhere";
const NEVER_PULLS: &str =
    "a law that falls nowhere, as `max(0, …)` of one of a contact, which never pulls, does";

/// Whether a law, given by `parameter`, has a force at all [`PLACES`], none of it at rest, and falls between none of
/// them.
pub(super) fn rises<E: Element + ?Sized>(
    law: &E,
    parameter: &'static str,
) -> Result<(), InvalidParameter> {
    let places = law.typical().map(|unit| PLACES.map(|part| part * unit));
    let forces = places[0].map(|y| places[1].map(|v| law.force(y, v)));
    let all = forces.as_flattened();
    let size = all.iter().map(|own| own.abs()).fold(0.0, f64::max);
    let told = |y: usize, v: usize| {
        let force = forces[y][v];
        format!("{force:.6} N at {:.6} m and {:.6} m/s", places[0][y], places[1][v])
    };
    let invalid = |range: &'static str, found| Err(InvalidParameter::new(parameter, range, found));
    let middle = PLACES.len() / 2;
    for y in 0..PLACES.len() {
        for v in 0..PLACES.len() {
            let own = forces[y][v];
            if !own.is_finite() {
                return invalid("a law with a force everywhere", told(y, v));
            }
            for (y_before, v_before) in [(y.saturating_sub(1), v), (y, v.saturating_sub(1))] {
                if own < forces[y_before][v_before] - ROUNDING * size {
                    let found = format!("{} after {}", told(y, v), told(y_before, v_before));
                    return invalid(
                        if y > middle && own < 0.0 { NEVER_PULLS } else { RISES },
                        found,
                    );
                }
            }
        }
    }
    if forces[middle][middle].abs() > ROUNDING * size {
        return invalid("a law without a force at rest", told(middle, middle));
    }
    Ok(())
}

/// The secants of a law at its typical deformation \[N/m\] and rate \[N s/m\]; where one is zero, the largest at any of
/// the [`PLACES`]: a law that begins beyond a gap, or damps one way only, has a stiffness and a damping all the same.
pub(super) fn secants<E: Element + ?Sized>(law: &E) -> [f64; 2] {
    let [deformation, rate] = law.typical();
    let over_y = |y: f64| law.force(y, 0.0) / y;
    let over_v = |y: f64, v: f64| (law.force(y, v) - law.force(y, 0.0)) / v;
    let own = [over_y(deformation), over_v(deformation, rate)];
    if own.iter().all(|own| *own != 0.0) {
        return own;
    }
    let places = |unit: f64| PLACES.iter().map(move |part| part * unit);
    let largest = |found: f64, own: f64| if own > found { own } else { found };
    let stiffness = places(deformation).filter(|y| *y != 0.0).map(over_y).fold(own[0], largest);
    let pairs = places(deformation).flat_map(|y| places(rate).map(move |v| (y, v)));
    let damping = pairs.filter(|own| own.1 != 0.0).map(|(y, v)| over_v(y, v));
    [stiffness, damping.fold(own[1], largest)]
}

pub(super) fn central_differences<E: Element + ?Sized>(
    law: &E,
    deformation: f64,
    rate: f64,
) -> Tangent {
    let [y, v] = law.typical().map(|own| STEP * own);
    let (y, v) = (y.max(STEP * deformation.abs()), v.max(STEP * rate.abs()));
    let over_y = law.force(deformation + y, rate) - law.force(deformation - y, rate);
    let over_v = law.force(deformation, rate + v) - law.force(deformation, rate - v);
    Tangent { stiffness: over_y / (2.0 * y), damping: over_v / (2.0 * v) }
}

/// `∫ F(s, 0) ds` from 0 to the deformation \[J\].
pub(super) fn work_at_rest<E: Element + ?Sized>(law: &E, deformation: f64) -> f64 {
    let size = (law.force(deformation, 0.0) * deformation).abs();
    integral_to(|own| law.force(own, 0.0), 0.0, deformation, AGREEMENT * size)
}
