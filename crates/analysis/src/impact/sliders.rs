//! Dry sliders: times over which their force follows from nothing, and whether they do what sliders can.
//!
//! They hold no more than their force, and never give energy. Energy balances close around a slider whatever it
//! does, so they cannot tell.

use dashpot_network::{IdleSlider, phases::Phase};
use thiserror::Error;

use crate::{Ledger, Solution, wording::quantity};

/// A time over which a slider is held by others while it slides neither way. Its force may be anything
/// that it can hold, and what holds it bears the rest; the motion does not depend on it.
#[derive(Debug, Clone, PartialEq, Error)]
#[error(
    "from {} to {} the force of the slider `{}` is not determined: `{}` holds its ends, and it \
     slides neither way; it is taken to keep the force that it had",
    quantity(*.from, "s"),
    quantity(*.to, "s"),
    .slider.sliders.first().map_or("", String::as_str),
    .slider.held_by.join("`, `"),
)]
pub struct Idle {
    /// When it begins \[s\].
    pub from: f64,
    /// When it ends \[s\].
    pub to: f64,
    /// The slider, and what holds it.
    pub slider: IdleSlider,
}

/// All such times, slider by slider in order of time.
pub(crate) fn idle_times(solution: &Solution<'_>) -> Vec<Idle> {
    let (assembly, trajectory) = (solution.assembly(), solution.trajectory());
    let has_sliders = || {
        assembly
            .primitives
            .iter()
            .any(|primitive| primitive.element.phases().is_some_and(|own| own.capacity().is_some()))
    };
    let Some(network) = assembly.switching.as_ref().filter(|_| has_sliders()) else {
        return Vec::new();
    };
    let first = trajectory.first_phases.iter();
    let mut phases: Vec<Phase> = first.map(|&(index, memory)| Phase { index, memory }).collect();
    let (mut found, mut from): (Vec<Idle>, f64) = (Vec::new(), 0.0);
    let mut add = |phases: &[Phase], from: f64, to: f64| {
        if to <= from {
            return;
        }
        for slider in network.idle_sliders(phases) {
            match found.iter_mut().find(|own| own.to >= from && own.slider == slider) {
                Some(own) => own.to = to,
                None => found.push(Idle { from, to, slider }),
            }
        }
    };
    for switch in &trajectory.switches {
        add(&phases, from, switch.time);
        from = switch.time;
        if let Some(phase) = phases.get_mut(switch.part) {
            *phase = Phase { index: switch.phase, memory: switch.memory };
        }
    }
    add(&phases, from, solution.end());
    found
}

/// Part of the largest force by which a slider may hold more than it can, and of the energy turned over
/// that sliders may give in jumps: as much as a method may lose of the energy.
const MOST: f64 = Ledger::MOST_LOST;

/// What no dry slider does.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SliderFault {
    /// It bears more than the force at which it slides.
    #[error(
        "at {} the slider `{part}` bears {}, and it can hold {}",
        quantity(*.time, "s"), quantity(*.force, "N"), quantity(*.capacity, "N")
    )]
    Overloaded {
        /// Its name.
        part: String,
        /// When \[s\].
        time: f64,
        /// What it bears \[N\].
        force: f64,
        /// What it can bear \[N\].
        capacity: f64,
    },
    /// It jumps against its own force.
    #[error(
        "at {} the slider `{part}` jumps against its force and gives {}",
        quantity(*.time, "s"), quantity(*.energy, "J")
    )]
    JumpsBack {
        /// Its name.
        part: String,
        /// When \[s\].
        time: f64,
        /// The energy that it gives \[J\].
        energy: f64,
    },
}

/// The first thing that a slider does and cannot.
pub(crate) fn slider_fault(solution: &Solution<'_>, energy: &Ledger) -> Option<SliderFault> {
    let mut sliders = solution.assembly().primitives.iter().filter_map(|primitive| {
        let own = primitive.element.phases()?;
        let capacity = own.capacity()? * own.static_to_kinetic();
        (solution.keeps(primitive.force) && solution.keeps(primitive.deformation))
            .then_some((primitive, capacity))
    });
    let mut largest = None;
    sliders.find_map(|(own, capacity)| {
        let force = solution.glance(own.force);
        let peak = force.absolute_maximum((force.start(), force.end()));
        if peak.value.abs() > capacity * (1.0 + MOST) {
            let largest = *largest.get_or_insert_with(|| largest_force(solution));
            if peak.value.abs() > capacity + MOST * largest {
                let (part, force) = (own.name.to_string(), peak.value.abs());
                return Some(SliderFault::Overloaded { part, time: peak.time, force, capacity });
            }
        }
        let place = solution.glance(own.deformation);
        let mut times: Vec<f64> =
            solution.trajectory().switches.iter().map(|switch| switch.time).collect();
        times.dedup();
        times.into_iter().find_map(|time| {
            let energy_given = -force.value(time) * (place.value(time) - place.left_value(time));
            (energy_given > MOST * energy.turned_over).then(|| SliderFault::JumpsBack {
                part: own.name.to_string(),
                time,
                energy: energy_given,
            })
        })
    })
}

/// The largest force in any element \[N\].
fn largest_force(solution: &Solution<'_>) -> f64 {
    let forces = solution.assembly().connections.iter().filter_map(|connection| connection.force);
    let kept = forces.filter(|&force| solution.keeps(force));
    kept.map(|force| {
        let force = solution.glance(force);
        force.absolute_maximum((force.start(), force.end())).value.abs()
    })
    .fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use dashpot_dae::Waveform;
    use dashpot_network::{
        Model, Network, Node,
        elements::{Contact, Friction, Spring},
        part,
    };

    use super::*;
    use crate::{RunReport, Solve, SolveSettings, Warning, energy::ledger::ledger};

    fn solved(network: &Network, method: &str) -> RunReport {
        network.solve_with(&SolveSettings::lasting(2.0).by_name(method).unwrap()).unwrap()
    }

    /// A mass that a force presses onto a stop, beside a spring and a slider.
    fn pressed(stops: bool) -> Network {
        let mut network = Network::new();
        let head = network.add_node(Node::mass("head", 1.0).moving(2.0));
        let ground = network.ground();
        let own = Model::parallel([
            part(Spring { stiffness: 100.0 }),
            part(Friction { force: 3.0, ratio: 1.0 }),
        ]);
        network.connect("pad", head, ground, own);
        if stops {
            network.connect("stop", head, ground, part(Contact { gap: 0.1, restitution: 0.0 }));
        }
        network.add_load("press", head, Waveform::constant(50.0));
        network
    }

    #[test]
    fn the_force_of_a_slider_beside_a_closed_stop_is_not_determined() {
        for method in ["exact", "bdf"] {
            let report = solved(&pressed(true), method);
            let times = idle_times(&report.solution());
            let [own] = &times[..] else { panic!("{times:?}") };
            // x = 0.47 - 0.47 cos 10 t + 0.2 sin 10 t, up to 0.1.
            let size = 0.47_f64.hypot(0.2);
            let arrives = 0.1 * ((0.37 / size).acos() - 0.2_f64.atan2(0.47));
            assert!((own.from - arrives).abs() < 1e-4, "{own}, not {arrives}");
            assert!((own.to - 2.0).abs() < 1e-12, "{own:?}");
            assert!(own.slider.held_by[0].starts_with("stop"), "{own}");
            assert!(
                report.warnings.contains(&Warning::IdleSlider(own.clone())),
                "{:?}",
                report.warnings
            );
            assert!(report.measure("pad.impulse").unwrap().is_undetermined);
            assert!(report.measure("stop.impulse").unwrap().is_undetermined);
            assert!(report.measure("pad.peak-deformation").unwrap().value.is_some());
        }
        let free = solved(&pressed(false), "exact");
        assert_eq!(idle_times(&free.solution()), []);
        assert!(free.measure("pad.impulse").unwrap().value.is_some());
    }

    #[test]
    fn three_sliders_between_three_bodies_brake_and_then_hold() {
        for method in ["exact", "bdf"] {
            let mut network = Network::new();
            let head = network.add_node(Node::mass("head", 1.0).moving(3.0));
            let panel = network.add_node(Node::mass("panel", 2.0));
            let ground = network.ground();
            network.connect("pad", head, panel, part(Friction { force: 1.0, ratio: 1.0 }));
            network.connect("mount", panel, ground, part(Friction { force: 5.0, ratio: 1.0 }));
            network.connect("guide", head, ground, part(Friction { force: 2.0, ratio: 1.0 }));
            let report = solved(&network, method);
            // 3 N brake 1 kg from 3 m/s in 1 s, and leave the panel where it is.
            let solution = report.solution();
            let place = solution.signal(solution.assembly().node("head").unwrap().position);
            assert!((place.value(2.0) - 1.5).abs() < 1e-3, "{}", place.value(2.0));
            let times = idle_times(&solution);
            assert!(times.iter().any(|time| (time.from - 1.0).abs() < 1e-3 && time.to > 1.999));
        }
    }

    #[test]
    fn a_slider_that_bears_more_than_it_can_is_found() {
        let mut network = Network::new();
        let head = network.add_node(Node::mass("head", 1.0).moving(2.0));
        let ground = network.ground();
        network.connect("spring", head, ground, part(Spring { stiffness: 100.0 }));
        network.connect("guard", head, ground, part(Friction { force: 3.0, ratio: 1.0 }));
        let mut report =
            network.solve_with(&SolveSettings::lasting(2.0).by_name("exact").unwrap()).unwrap();
        let energy = ledger(&report.solution(), 2.0);
        assert_eq!(slider_fault(&report.solution(), &energy), None);
        // The same motion, of a slider that can hold half as much.
        let mut assembly = (*report.assembly).clone();
        let own = assembly
            .primitives
            .iter_mut()
            .find(|primitive| &*primitive.name == "guard.friction")
            .unwrap();
        own.element = Arc::new(Friction { force: 1.5, ratio: 1.0 });
        report.assembly = Arc::new(assembly);
        let fault = slider_fault(&report.solution(), &energy).unwrap();
        assert!(matches!(fault, SliderFault::Overloaded { capacity: 1.5, .. }), "{fault}");
        assert!(fault.to_string().contains("bears 3.00 N, and it can hold 1.50 N"), "{fault}");
    }
}
