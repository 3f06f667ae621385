//! Where things stand at the start when weights have made them sag.

use std::sync::Arc;

use super::{
    super::{
        balance::{self, Surroundings, Touch},
        bodies::{Bodies, Role},
        expand::Expansion,
        structure::Structure,
    },
    is_contact, moving,
    start::predicted,
};
use crate::{
    Element as _, Network, NetworkErrors,
    elements::{Law, TableSpring},
    phases::{Phase, PhaseLaw},
};

/// What stands for a slider that may give way is as much stiffer than the stiffest spring.
const STIFFER: f64 = 1e6;

/// What is to be put in balance at the start.
pub(super) struct Loads<'a> {
    pub(super) network: &'a Network,
    pub(super) expansion: &'a Expansion,
    pub(super) parts: &'a [usize],
    pub(super) apart: &'a Bodies,
    pub(super) duration: f64,
}

impl Loads<'_> {
    /// Places of all joints in balance under the weight of what has no start speed; `unloaded` are those before.
    ///
    /// Sliders stick as far as they can hold; those that cannot have slid and hold with all their strength,
    /// as if the weights had grown slowly. An impactor begins where what it strikes is undeformed, or so high
    /// above it as it is dropped.
    pub(super) fn balanced(
        &self,
        phases: &[Phase],
        unloaded: &[f64],
        velocity: &[f64],
    ) -> Result<Vec<f64>, NetworkErrors> {
        let mut phases = self.with_impactors_sliding(phases, velocity);
        let mut forces = self.weights();
        self.give_way(&mut phases, &mut forces, unloaded, velocity)?;
        let expansion = self.expansion.at_rest(self.parts, &phases);
        self.places(&expansion, &phases, &forces, unloaded, balance::UNBALANCED)
    }

    /// The weight \[N\] at each joint of what has no start speed.
    fn weights(&self) -> Vec<f64> {
        let mut weights = vec![0.0; self.expansion.joints];
        let forces = self.network.effects.iter().flat_map(|own| own.body_forces(self.network));
        for (node, weight) in forces {
            if !self.apart.all[self.apart.of_joint[node.index()]].is_impactor {
                weights[node.index()] += weight.value(0.0);
            }
        }
        weights
    }

    /// Places of all joints in these phases under these forces \[N\] at the joints.
    fn places(
        &self,
        expansion: &Expansion,
        phases: &[Phase],
        forces: &[f64],
        unloaded: &[f64],
        unbalanced: f64,
    ) -> Result<Vec<f64>, NetworkErrors> {
        let &Self { network, apart, .. } = self;
        let bodies = Bodies::of(network, expansion).map_err(NetworkErrors)?;
        let structure = Structure::of(network, expansion, &bodies, self.duration);
        let structure = structure.map_err(NetworkErrors)?;
        let mut weights = vec![0.0; bodies.all.len()];
        for (&body, force) in bodies.of_joint.iter().zip(forces) {
            weights[body] += force;
        }
        let places: Vec<f64> = bodies
            .all
            .iter()
            .map(|body| match body.role {
                Role::Prescribed(_) => unloaded[body.joints[0]] - bodies.offset[body.joints[0]],
                _ => 0.0,
            })
            .collect();
        let height = |joint: usize| {
            let own = &apart.all[apart.of_joint[joint]];
            predicted(network, self.expansion, &own.joints).unwrap_or(0.0)
        };
        let low: Vec<f64> = unloaded.iter().enumerate().map(|(at, own)| own + height(at)).collect();
        let touches = self.touches(phases, &bodies, &low);
        let places = balance::positions(
            network,
            expansion,
            &bodies,
            &structure,
            &weights,
            &Surroundings { given: &places, touches: &touches, unbalanced },
        )
        .map_err(NetworkErrors)?;
        let place =
            |joint: usize| places[bodies.of_joint[joint]] + bodies.offset[joint] - height(joint);
        Ok((0..expansion.joints).map(place).collect())
    }

    /// Puts those sliders in motion that cannot hold under these forces, and adds what they hold with to the forces.
    ///
    /// Which ones they are follows from the balance with a stiff spring of the slider's strength in place of
    /// each: its energy is convex, so that there is one. What strikes or is driven is left out.
    fn give_way(
        &self,
        phases: &mut [Phase],
        forces: &mut [f64],
        unloaded: &[f64],
        velocity: &[f64],
    ) -> Result<(), NetworkErrors> {
        let mut expansion = self.expansion.at_rest(self.parts, phases);
        let stiffest = expansion.primitives.iter().map(|own| match own.element.law() {
            Law::Spring(stiffness) | Law::Nonlinear { stiffness, .. } => stiffness,
            _ => 0.0,
        });
        let stiffest = Some(stiffest.fold(0.0, f64::max)).filter(|own| *own > 0.0).unwrap_or(1.0);
        let mut sliders = Vec::new();
        for (at, (&part, &phase)) in self.parts.iter().zip(&*phases).enumerate() {
            let primitive = &mut expansion.primitives[part];
            let Some(own) = primitive.origin.phases() else { continue };
            let Some(capacity) = own.capacity() else { continue };
            // It stands for all others between the same joints.
            let part = primitive.share.map_or(1.0, |share| share.part);
            let strength = capacity * own.static_to_kinetic() / part;
            let [a, b] = primitive.ends;
            // What strikes or is driven moves it, not the weights.
            if !matches!(own.law(phase), PhaseLaw::Held(_))
                && (velocity[a] - velocity[b]).abs() > 0.0
            {
                continue;
            }
            let place = unloaded[a] - unloaded[b];
            let give = strength / stiffest / STIFFER;
            let points = [-2.0, -1.0, 1.0, 2.0]
                .map(|part: f64| (place + part * give, strength * part.clamp(-1.0, 1.0)));
            let spring = TableSpring::through(points.to_vec());
            primitive.law = spring.law();
            primitive.element = Arc::new(spring);
            primitive.held = 0.0;
            sliders.push((at, [a, b], [place, give, part]));
        }
        if sliders.is_empty() {
            return Ok(());
        }
        // Roundings in so stiff springs are nothing to refuse.
        let places = self.places(&expansion, phases, forces, unloaded, f64::INFINITY)?;
        for (at, [a, b], [place, give, part]) in sliders {
            let deformation = places[a] - places[b] - place;
            let Some(own) = self.expansion.primitives[self.parts[at]].origin.phases() else {
                continue;
            };
            if deformation.abs() < give {
                continue;
            }
            let Some(index) = moving(own, phases[at], deformation) else { continue };
            phases[at].index = index;
            if let PhaseLaw::Force(force) = own.law(phases[at]) {
                forces[a] -= force / part;
                forces[b] += force / part;
            }
        }
        Ok(())
    }

    /// The phases, but with those sliders in motion past which something begins with a speed.
    fn with_impactors_sliding(&self, phases: &[Phase], velocity: &[f64]) -> Vec<Phase> {
        let apart = self.apart;
        let slid = |(&at, &phase): (&usize, &Phase)| -> Phase {
            let primitive = &self.expansion.primitives[at];
            let ends = primitive.ends.map(|joint| &apart.all[apart.of_joint[joint]]);
            let is_between = ends.iter().all(|end| !end.is_massless());
            let rate = velocity[primitive.ends[0]] - velocity[primitive.ends[1]];
            let own = primitive.origin.phases().filter(|phase| !is_contact(*phase));
            let index = own
                .filter(|own| matches!(own.law(phase), PhaseLaw::Held(_)))
                .filter(|_| is_between && rate != 0.0 && ends.iter().any(|end| end.is_impactor))
                .and_then(|own| moving(own, phase, rate));
            Phase { index: index.unwrap_or(phase.index), ..phase }
        };
        self.parts.iter().zip(phases).map(slid).collect()
    }

    /// The parts that are open, between joints that are at these places before anything sags.
    fn touches(&self, phases: &[Phase], bodies: &Bodies, unloaded: &[f64]) -> Vec<Touch> {
        let open = self.parts.iter().zip(phases).filter_map(|(&at, &phase)| {
            let primitive = &self.expansion.primitives[at];
            let law = primitive.origin.phases()?.law(phase);
            matches!(law, PhaseLaw::Open).then_some(primitive.ends)
        });
        let touch = |[a, b]: [usize; 2]| Touch {
            ends: [bodies.of_joint[a], bodies.of_joint[b]],
            distance: unloaded[a] - unloaded[b] + bodies.offset[b] - bodies.offset[a],
        };
        open.map(touch).filter(|own| own.ends[0] != own.ends[1]).collect()
    }
}
