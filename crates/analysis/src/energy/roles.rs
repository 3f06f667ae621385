//! What springs, dashpots and all other parts store and dissipate.

use dashpot_dae::Trajectory;
use dashpot_network::{
    Assembly, Element, PhasedNetwork, PrimitiveOutputs,
    elements::Law,
    phases::{Phase, PhaseLaw, Phases},
};

/// Which entries of an energy ledger a part has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct EnergyRole {
    /// It stores energy.
    pub(crate) stores: bool,
    /// It dissipates energy.
    pub(crate) dissipates: bool,
}

impl EnergyRole {
    pub(crate) fn of(element: &dyn Element) -> Self {
        match element.law() {
            Law::Spring(_) => Self { stores: true, dissipates: false },
            Law::Dashpot(_) => Self { stores: false, dissipates: true },
            Law::Rigid => Self { stores: false, dissipates: false },
            Law::Nonlinear { stiffness, damping } => {
                Self { stores: stiffness > 0.0, dissipates: damping > 0.0 }
            }
            Law::Phased => Self {
                stores: element.phases().is_some_and(|own| {
                    (0..own.names().len()).any(|index| {
                        matches!(own.law(Phase { index, memory: 0.0 }), PhaseLaw::Element(_))
                    })
                }),
                dissipates: !is_elastic(element),
            },
        }
    }
}

/// Whether the force of an element that switches is one of the deformation alone, whatever its phase.
pub(crate) fn is_elastic(element: &dyn Element) -> bool {
    let whole = element.phases().and_then(Phases::at_rest);
    matches!(whole, Some(Law::Nonlinear { damping, .. }) if damping <= 0.0)
}

/// The energy \[J\] that a part stores at `time` \[s\] at this deformation \[m\], just before what switches then.
pub(crate) fn stored(
    (assembly, trajectory): (&Assembly, &Trajectory),
    primitive: &PrimitiveOutputs,
    time: f64,
    deformation: f64,
) -> f64 {
    let phased = assembly.switching.as_deref();
    match phased.and_then(|phased| Some((phased, phased.part_named(&primitive.name)?))) {
        Some((own, part)) if primitive.element.law() == Law::Phased => {
            own.stored(part, phase_at(trajectory, own, part, time), deformation)
        }
        _ => primitive.element.stored(deformation),
    }
}

/// The phase of a part just before `time` \[s\].
fn phase_at(
    trajectory: &Trajectory,
    phased_network: &PhasedNetwork,
    part: usize,
    time: f64,
) -> Phase {
    let first = trajectory.first_phases.get(part);
    let first = first.map(|&(index, memory)| Phase { index, memory });
    let mut before =
        trajectory.switches.iter().filter(|switch| switch.part == part && switch.time < time);
    let last = before.next_back().map(|own| Phase { index: own.phase, memory: own.memory });
    last.or(first)
        .or_else(|| phased_network.first_phases().get(part).copied())
        .unwrap_or(Phase { index: 0, memory: 0.0 })
}

/// The energy \[J\] lost by impacts in a part within the window \[s\].
pub(crate) fn lost_in_impacts(
    trajectory: &Trajectory,
    primitive: &PrimitiveOutputs,
    window: (f64, f64),
) -> f64 {
    if primitive.element.law() != Law::Phased {
        return 0.0;
    }
    let switches = trajectory.switches.iter();
    let own = switches.filter(|switch| switch.impulse > 0.0 && *switch.name == *primitive.name);
    own.filter(|own| window.0 <= own.time && own.time <= window.1).map(|own| own.lost).sum()
}
