//! Whether dry sliders do what sliders can: hold no more than their force, and never give energy.
//!
//! Energy balances close around a slider whatever it does, so they cannot tell.

use std::fmt;

use crate::{Ledger, Solution, wording::quantity};

/// Part of the largest force by which a slider may hold more than it can, and of the energy turned over
/// that sliders may give in jumps: as much as a method may lose of the energy.
const MOST: f64 = Ledger::MOST_LOST;

/// What no dry slider does.
#[derive(Debug, Clone, PartialEq)]
pub enum SliderFault {
    /// It bears more than the force at which it slides.
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
    JumpsBack {
        /// Its name.
        part: String,
        /// When \[s\].
        time: f64,
        /// The energy that it gives \[J\].
        energy: f64,
    },
}

impl fmt::Display for SliderFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Overloaded { part, time, force, capacity } => write!(
                f,
                "at {} the slider `{part}` bears {}, and it can hold {}",
                quantity(*time, "s"),
                quantity(*force, "N"),
                quantity(*capacity, "N")
            ),
            Self::JumpsBack { part, time, energy } => write!(
                f,
                "at {} the slider `{part}` jumps against its force and gives {}",
                quantity(*time, "s"),
                quantity(*energy, "J")
            ),
        }
    }
}

/// The first thing that a slider does and cannot.
pub(crate) fn slider_fault(solution: &Solution<'_>, energy: &Ledger) -> Option<SliderFault> {
    let mut sliders = solution.assembly().primitives.iter().filter_map(|own| {
        let capacity = own.element.phases()?.capacity()?;
        (solution.keeps(own.force) && solution.keeps(own.deformation)).then_some((own, capacity))
    });
    let mut largest = None;
    sliders.find_map(|(own, capacity)| {
        let force = solution.glance(own.force);
        let peak = force.absolute_maximum((force.start(), force.end()));
        if peak.value.abs() > capacity * (1.0 + MOST) {
            let largest = *largest.get_or_insert_with(|| largest_force(solution));
            if peak.value.abs() > capacity + MOST * largest {
                let (part, force) = (own.name.clone(), peak.value.abs());
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
                part: own.name.clone(),
                time,
                energy: energy_given,
            })
        })
    })
}

/// The largest force in any element \[N\].
fn largest_force(solution: &Solution<'_>) -> f64 {
    let forces = solution.assembly().connections.iter().filter_map(|own| own.force);
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

    use dashpot_dae::Silent;
    use dashpot_network::{
        Network, Node,
        elements::{Friction, Spring},
        part,
    };

    use super::*;
    use crate::{SolveSettings, energy::ledger::ledger, solve};

    #[test]
    fn a_slider_that_bears_more_than_it_can_is_found() {
        let mut network = Network::new();
        let head = network.add_node(Node::mass("head", 1.0).moving(2.0));
        let ground = network.ground();
        network.connect("spring", head, ground, part(Spring { stiffness: 100.0 }));
        network.connect("guard", head, ground, part(Friction { force: 3.0 }));
        let mut report =
            solve(&network, &SolveSettings::lasting(2.0).by_name("exact").unwrap(), &mut Silent)
                .unwrap();
        let energy = ledger(&report.solution(), 2.0);
        assert_eq!(slider_fault(&report.solution(), &energy), None);
        // The same motion, of a slider that can hold half as much.
        let mut assembly = (*report.assembly).clone();
        let own = assembly.primitives.iter_mut().find(|own| own.name == "guard.friction").unwrap();
        own.element = Arc::new(Friction { force: 1.5 });
        report.assembly = Arc::new(assembly);
        let fault = slider_fault(&report.solution(), &energy).unwrap();
        assert!(matches!(fault, SliderFault::Overloaded { capacity: 1.5, .. }), "{fault}");
        assert!(fault.to_string().contains("bears 3.00 N, and it can hold 1.50 N"), "{fault}");
    }
}
