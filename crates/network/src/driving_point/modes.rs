//! Poles of a circuit with their shapes: refined, with strength and condition.

use super::{
    circuit::Circuit,
    complex::Complex,
    dynamic::{forms, stretch},
};

/// A pole as it stands alone.
#[derive(Debug, Clone, Copy)]
pub(super) struct Mode {
    pub(super) pole: Complex,
    /// Residue of the receptance.
    pub(super) residue: Complex,
    /// Relative change of the pole when every constant changes by a relative 1 in the worst way.
    pub(super) condition: f64,
}

/// Steps of refinement.
const MOST_STEPS: usize = 3;
/// Relative change of a pole below which it is final.
const FINAL: f64 = 1e-22;
/// A step of refinement may be this part of the distance to the next pole.
const SHORT: f64 = 1e-3;

/// The modes of all poles; conjugate pairs are conjugates to the last digit.
pub(super) fn modes(circuit: &Circuit, poles: &[Complex]) -> Vec<Mode> {
    let mut modes = Vec::with_capacity(poles.len());
    for (at, &pole) in poles.iter().enumerate() {
        if pole.im < 0.0 {
            continue;
        }
        let others = poles.iter().enumerate().filter(|&(other, _)| other != at);
        let next = others.map(|(_, other)| (*other - pole).size()).fold(pole.size(), f64::min);
        let mode = refined(circuit, pole, next);
        modes.push(mode);
        if pole.im > 0.0 {
            modes.push(Mode {
                pole: mode.pole.conjugate(),
                residue: mode.residue.conjugate(),
                condition: mode.condition,
            });
        }
    }
    modes
}

/// Inverse iteration for the shape `x`, and Newton's step `xᵀP x/xᵀP′x` for the pole: `P` is
/// symmetric, so one shape is enough and the error is of second order.
fn refined(circuit: &Circuit, pole: Complex, next: f64) -> Mode {
    let is_real = pole.im <= 0.0;
    let mut mode = Mode { pole, residue: Complex::zero(), condition: f64::INFINITY };
    for _ in 0..MOST_STEPS {
        let factors = circuit.stiffness_at(mode.pole);
        let mut shape = start(circuit.bodies);
        for _ in 0..2 {
            shape = factors.solve(&shape);
            let (largest, at) = shape
                .iter()
                .enumerate()
                .map(|(at, value)| (value.size(), at))
                .fold((0.0, 0), |best, next| if next.0 > best.0 { next } else { best });
            if !(largest > 0.0 && largest.is_finite()) {
                return mode;
            }
            let unit = shape[at];
            shape.iter_mut().for_each(|value| *value = value.over(unit));
        }
        let (form, slope) = forms(circuit, mode.pole, &shape);
        if slope.size() <= 0.0 {
            return mode;
        }
        let seen = stretch(circuit.forces, &shape);
        mode.residue = (seen * seen).over(slope);
        mode.condition = form.size / (slope.size() * mode.pole.size());
        let mut change = form.value.over(slope);
        if is_real {
            change.im = 0.0.into();
        }
        let size = change.size();
        if size >= SHORT * next {
            break;
        }
        mode.pole = mode.pole - change;
        if size <= FINAL * mode.pole.size() {
            break;
        }
    }
    mode
}

/// A vector that no shape of a tidy network is orthogonal to.
fn start(count: usize) -> Vec<Complex> {
    let entry = |at: usize| 1.0 + (at as f64 * 0.618_033_988_75 + 0.3).fract();
    (0..count).map(|at| Complex::new(entry(at), 0.0)).collect()
}
