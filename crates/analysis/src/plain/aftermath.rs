//! What becomes of a pad once it has let go what struck it.

use dashpot_network::{Assembly, Instance, ParametricSystem, PartRow};
use dashpot_numerics::small::dot;

use super::{
    energies::stored_at_most,
    stepped::{Course, Nodes, Stepped, Track, is_outside},
};

/// What is left to dissipate, in parts of the energy of the impact and of the tolerance, is of no
/// account.
const LITTLE: f64 = 1e-3;
/// What strikes meets the pad again where it comes as near as this, in parts of the largest deformation.
const NEAR: f64 = 1e-3;
/// Parts of a step at which that is looked at.
const PLACES: [f64; 8] = [0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0];
/// It may seem to be in the pad by so much of that.
const ROUNDING: f64 = 1e-6;

/// The pad from the release on, and what has left it.
#[derive(Debug)]
pub(super) struct Aftermath<const N: usize> {
    /// Up to the end of the run, or until nothing moves any more.
    pub(super) track: Track<N>,
    pub(super) parts: Vec<PartRow<N>>,
    /// Masses \[kg\] that stay, and their speeds.
    pub(super) masses: Vec<(f64, [f64; N])>,
}

/// What leaves the pad: its speed \[m/s\], and what pulls it back \[m/s²\].
#[derive(Debug, Clone, Copy)]
pub(super) struct Flight {
    pub(super) speed: f64,
    pub(super) pull: f64,
}

impl Flight {
    /// How far it has come \[m\] after so many seconds.
    fn way(self, time: f64) -> f64 {
        (self.speed + 0.5 * self.pull * time) * time
    }

    /// Its speed then \[m/s\].
    pub(super) fn speed_after(self, time: f64) -> f64 {
        self.speed + self.pull * time
    }
}

/// Follows a pad that is `released` from some unknowns on for the dimensionless time `left`, at a tolerance. `None`
/// where it cannot be followed, a law leaves its range, or it meets again what has left it.
pub(super) fn follow<const N: usize>(
    (released, numbers): (&ParametricSystem, &[f64]),
    assembly: &Assembly,
    (course, from): (&Course<N>, &[f64; N]),
    flight: Flight,
    (left, rtol, energy): (f64, f64, f64),
) -> Option<Aftermath<N>> {
    let mut instance: Instance<N> = released.instance()?;
    if !released.fill(numbers, &mut instance) {
        return None;
    }
    let parts = released.parts(&instance);
    let masses = released.masses_and_speeds(numbers, &instance);
    let stepped = Stepped { instance: &instance, unknowns: released.unknowns(), end: left };
    let is_over = |nodes: &Nodes<N>| {
        let last = &nodes.values[nodes.values.len() - 1];
        masses.is_empty() && stored_at_most(assembly, &parts, last) <= LITTLE * rtol * energy
    };
    let track = stepped.settle(from, rtol, &is_over)?;
    if track.nodes().any(|z| instance.curves.iter().any(|curve| is_outside(curve, z))) {
        return None;
    }
    let (face, time) = (released.speed_of_face(&instance), released.time_scale());
    let (mut way, mut at) = (0.0, 0.0);
    for step in &track.steps {
        let panel = step.panel(&|z| dot(&face, z));
        // Where no mass swings, nothing comes back within a step.
        let looks = if masses.is_empty() { &[1.0][..] } else { &PLACES };
        for part in looks {
            at = if *part < 1.0 { panel.start + part * panel.length() } else { panel.end };
            let gone = panel.part(panel.start, at).integral() * time;
            at *= time;
            if way + gone - flight.way(at) < -ROUNDING * course.deepest.value {
                return None;
            }
        }
        way += panel.integral() * time;
    }
    let end = left * time;
    let is_away = way - flight.way(end) > NEAR * course.deepest.value;
    (is_away && at <= end * (1.0 + ROUNDING)).then_some(Aftermath { track, parts, masses })
}
