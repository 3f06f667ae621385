//! Energies over time.

use dashpot_dae::Signal;

use super::{does_work, steps};
use crate::{
    Solution,
    energy::roles::{self, EnergyRole},
};

/// Energies of a run at given times \[J\].
#[derive(Debug, Clone, PartialEq)]
pub struct EnergySeries {
    /// The times \[s\].
    pub times: Vec<f64>,
    /// Kinetic energy of all masses.
    pub kinetic: Vec<f64>,
    /// Energy stored in all springs.
    pub stored: Vec<f64>,
    /// Energy dissipated so far in all dashpots.
    pub dissipated: Vec<f64>,
    /// Work done so far from outside.
    pub work_in: Vec<f64>,
}

/// The energies of `solution` at these times \[s\], which rise.
pub fn energy_series(solution: &Solution<'_>, times: &[f64]) -> EnergySeries {
    let assembly = solution.assembly();
    let zero = || vec![0.0; times.len()];
    let mut series = EnergySeries {
        times: times.to_vec(),
        kinetic: zero(),
        stored: zero(),
        dissipated: zero(),
        work_in: zero(),
    };
    for node in assembly.nodes.iter().filter(|node| node.mass > 0.0) {
        if let Some(velocity) = node.velocity {
            let velocity = solution.signal(velocity);
            add(&mut series.kinetic, times, |t| 0.5 * node.mass * velocity.value(t).powi(2));
        }
    }
    for primitive in &assembly.primitives {
        let own = EnergyRole::of(primitive.element.as_ref());
        let stores = own.stores;
        let mut gained = vec![0.0; times.len()];
        if own.stores {
            let deformation = solution.signal(primitive.deformation);
            let energy = |t: f64| roles::stored(solution.run(), primitive, t, deformation.value(t));
            add(&mut gained, times, energy);
            for (sum, own) in series.stored.iter_mut().zip(&gained) {
                *sum += own;
            }
        }
        if own.dissipates {
            let start = solution.signal(primitive.deformation).value(0.0);
            let start = roles::stored(solution.run(), primitive, 0.0, start);
            if does_work(primitive) {
                accumulate(
                    &mut series.dissipated,
                    times,
                    solution.signal(primitive.force),
                    &solution.rate(primitive.rate, primitive.deformation),
                );
            }
            for ((sum, own), &time) in series.dissipated.iter_mut().zip(&gained).zip(times) {
                let gained = if stores { own - start } else { 0.0 };
                *sum +=
                    roles::lost_in_impacts(solution.trajectory(), primitive, (0.0, time)) - gained;
            }
        }
    }
    for drive in &assembly.drives {
        let force = solution.signal(drive.force);
        let velocity = solution.rate(drive.velocity, assembly.nodes[drive.node].position);
        accumulate(&mut series.work_in, times, force, &velocity);
    }
    let (mut sum, mut from) = (0.0, 0.0);
    for (work, &time) in series.work_in.iter_mut().zip(times) {
        // At a jump the values are those from the right, so it has been made.
        let just_after = time * (1.0 + 1e-12);
        sum += steps(solution, 0..assembly.primitives.len(), (from, just_after));
        from = just_after;
        let impacts = solution.trajectory().switches.iter().filter(|switch| switch.time <= time);
        *work += sum + impacts.map(|impact| impact.worked).sum::<f64>();
    }
    series
}

fn add(sums: &mut [f64], times: &[f64], energy: impl Fn(f64) -> f64) {
    for (sum, &time) in sums.iter_mut().zip(times) {
        *sum += energy(time);
    }
}

fn accumulate(sums: &mut [f64], times: &[f64], force: &Signal, velocity: &Signal) {
    let (mut work, mut from) = (0.0, 0.0);
    for (sum, &time) in sums.iter_mut().zip(times) {
        work += force.integral_of_product(velocity, (from, time));
        from = time;
        *sum += work;
    }
}
