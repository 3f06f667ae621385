//! What becomes of a pad once it has let go what struck it.

use dashpot_network::{Instance, ParametricSystem};
use dashpot_numerics::small::dot;

use super::stepped::{Course, Nodes, Stepped};

/// What is left to dissipate, in parts of the energy of the impact and of the tolerance, is of no account.
const LITTLE: f64 = 1e-3;
/// What strikes meets the pad again where it comes as near as this, in parts of the largest deformation.
const NEAR: f64 = 1e-3;
/// Parts of a step at which that is looked at.
const PLACES: [f64; 8] = [0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0];
/// It may seem to be in the pad by so much of that.
const ROUNDING: f64 = 1e-6;

/// Whether what has struck a pad leaves it for good: the pad is followed from the release on for the dimensionless time
/// `left`, at a tolerance. Not where it cannot be followed, a law leaves its range, or it meets again what has left it.
pub(crate) fn is_left<const N: usize>(
    (form, instance): (&ParametricSystem, &Instance<N>),
    numbers: &[f64],
    course: &Course<N>,
    (left, rtol): (f64, f64),
) -> bool {
    let Some(behind) = form.parted(instance) else { return false };
    let from = course.last.at(course.release);
    let pull = form.constant_force(numbers) / form.impactor_mass(numbers);
    let face = form.speed_of_face(instance);
    let speed = dot(&face, &from);
    // How far what leaves the pad has come [m] after so many seconds.
    let flown = |time: f64| (speed + 0.5 * pull * time) * time;
    let least = LITTLE * rtol * form.energy_at_start(numbers);
    let is_massless = form.masses() == 1;
    let stepped = Stepped { instance: &behind, unknowns: form.unknowns(), end: left };
    let is_over = |nodes: &Nodes<N>| {
        let last = &nodes.values[nodes.values.len() - 1];
        is_massless && form.stored_at_most(numbers, &behind, last) <= least
    };
    let Some(steps) = stepped.settle(&from, rtol, &is_over) else { return false };
    if steps.iter().any(|own| own.leave(&behind.curves, own.end)) {
        return false;
    }
    let time = form.time_scale();
    let (mut way, mut at) = (0.0, 0.0);
    for step in &steps {
        let panel = step.panel(&|z| dot(&face, z));
        let gone = panel.antiderivative();
        // Where no mass swings, nothing comes back within a step.
        let looks = if is_massless { &[1.0][..] } else { &PLACES };
        for part in looks {
            at = if *part < 1.0 { panel.start + part * panel.length() } else { panel.end };
            let here = way + gone.value(at) * time;
            at *= time;
            if here - flown(at) < -ROUNDING * course.deepest.value {
                return false;
            }
        }
        way += gone.value(panel.end) * time;
    }
    let end = left * time;
    let is_away = way - flown(end) > NEAR * course.deepest.value;
    is_away && at <= end * (1.0 + ROUNDING)
}
