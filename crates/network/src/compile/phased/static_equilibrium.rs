//! Where things stand at the start when weights have made them sag.

use super::{
    super::{
        balance::{self, Touch},
        bodies::{Bodies, Role},
        expand::Expansion,
        structure::Structure,
    },
    is_contact, moving,
    start::predicted,
};
use crate::{
    Network, NetworkErrors,
    phases::{Phase, PhaseLaw},
};

/// What is to be put in balance at the start.
pub(super) struct Loads<'a> {
    pub(super) network: &'a Network,
    pub(super) expansion: &'a Expansion,
    pub(super) parts: &'a [usize],
    pub(super) apart: &'a Bodies,
    pub(super) duration: f64,
}

impl Loads<'_> {
    /// Places of all joints in balance under the weight of what has no start speed; `unloaded` are
    /// those before.
    ///
    /// An impactor begins where what it strikes is undeformed, or so high above it as it is dropped.
    pub(super) fn balanced(
        &self,
        phases: &[Phase],
        unloaded: &[f64],
        velocity: &[f64],
    ) -> Result<Vec<f64>, NetworkErrors> {
        let &Self { network, apart, .. } = self;
        let phases = self.with_impactors_sliding(phases, velocity);
        let expansion = &self.expansion.in_phases(self.parts, &phases);
        let bodies = Bodies::of(network, expansion).map_err(NetworkErrors)?;
        let structure = Structure::of(network, expansion, &bodies, self.duration);
        let structure = structure.map_err(NetworkErrors)?;
        let mut weights = vec![0.0; bodies.all.len()];
        let forces = network.effects.iter().flat_map(|effect| effect.body_forces(network));
        for (node, weight) in forces {
            if !apart.all[apart.of_joint[node.index()]].is_impactor {
                weights[bodies.of_joint[node.index()]] += weight.value(0.0);
            }
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
        let touches = self.touches(&phases, &bodies, &low);
        let places = balance::positions(
            network, expansion, &bodies, &structure, &weights, &places, &touches,
        )
        .map_err(NetworkErrors)?;
        let place =
            |joint: usize| places[bodies.of_joint[joint]] + bodies.offset[joint] - height(joint);
        Ok((0..expansion.joints).map(place).collect())
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
