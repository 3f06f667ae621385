//! Slopes, energy and structure of a law of which the force alone is known.

use dashpot_numerics::quadrature::integral_to;

use super::{Element, Tangent};

/// Deformation \[m\] and rate \[m/s\] where slopes count as typical unless a law says others.
pub(super) const TYPICAL: [f64; 2] = [0.01, 1.0];
/// Step of central differences in parts of the place: the cube root of a double's digits, where
/// truncation and rounding are alike.
const STEP: f64 = 6e-6;
/// Error of the work, in parts of that of the typical secant.
const AGREEMENT: f64 = 1e-13;

/// The secants of a law at its typical deformation \[N/m\] and rate \[N s/m\].
pub(super) fn secants<E: Element + ?Sized>(law: &E) -> [f64; 2] {
    let [deformation, rate] = law.typical();
    let steady = law.force(deformation, 0.0);
    [steady / deformation, (law.force(deformation, rate) - steady) / rate]
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
