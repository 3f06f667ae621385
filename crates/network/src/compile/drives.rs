//! What acts on a network from outside: loads, body forces of effects, given motions.

use std::collections::BTreeMap;

use dashpot_dae::Waveform;

use super::{
    bodies::{Bodies, Role},
    row::Row,
    scales::{Drives, Force},
    structure::jumps,
    unknowns::Inputs,
};
use crate::{
    network::{Network, Support},
    outputs::Source,
};

/// What acts on a body from outside.
#[derive(Debug, Clone)]
pub(super) struct Drive {
    pub(super) name: String,
    pub(super) source: Source,
    pub(super) node: usize,
    pub(super) body: usize,
    /// The force \[N\]; `None` where the motion is given.
    pub(super) force: Option<Row>,
    /// Mass times acceleration \[N\] of a body with given motion.
    pub(super) inertia: Row,
    /// Whether an accelerometer does not feel it.
    pub(super) is_body_force: bool,
    /// When the given motion jumps \[s\].
    pub(super) jumps: Vec<f64>,
}

/// The given displacements of bodies as rows.
pub(super) fn motions(
    network: &Network,
    bodies: &Bodies,
    duration: f64,
    inputs: &mut Inputs,
    sizes: &mut Drives,
) -> BTreeMap<usize, Row> {
    let mut motions = BTreeMap::new();
    for (at, body) in bodies.all.iter().enumerate() {
        let Role::Prescribed(node) = body.role else { continue };
        if let Support::Prescribed(motion) = &network.nodes[node].support {
            sizes.motions.push((at, motion.bound(duration)));
            let waveform = inputs.waveform(motion.clone());
            motions.insert(at, inputs.row(waveform, 0));
        }
    }
    motions
}

/// Loads, body forces and given motions, in this order.
pub(super) fn drives(
    network: &Network,
    bodies: &Bodies,
    motions: &BTreeMap<usize, Row>,
    duration: f64,
    inputs: &mut Inputs,
    sizes: &mut Drives,
) -> Vec<Drive> {
    let mut drives = Vec::new();
    let mut force = |name: String, node: usize, force: Waveform, source: Source| {
        let body = bodies.of_joint[node];
        let (largest, impulse) = (force.bound(duration), force.area_bound(duration));
        sizes.forces.push(Force { body, largest, impulse });
        let waveform = inputs.waveform(force);
        let force = Some(inputs.row(waveform, 0));
        drives.push(Drive {
            name,
            source,
            node,
            body,
            force,
            inertia: Row::default(),
            is_body_force: matches!(source, Source::Effect(_)),
            jumps: Vec::new(),
        });
    };
    for load in &network.loads {
        force(load.name.clone(), load.node.0, load.force.clone(), Source::Load);
    }
    for effect in &network.effects {
        for (node, weight) in effect.body_forces(network) {
            if weight.bound(duration) > 0.0 {
                let name = format!("{} on {}", effect.kind(), network.nodes[node.0].name);
                force(name, node.0, weight, Source::Effect(effect.kind()));
            }
        }
    }
    for (at, body) in bodies.all.iter().enumerate() {
        let Role::Prescribed(node) = body.role else { continue };
        if let Support::Prescribed(motion) = &network.nodes[node].support {
            let mass = body.whole_mass;
            let inertia = match motions.get(&at) {
                Some(row) if mass > 0.0 => {
                    let velocity = inputs.rate(row);
                    inputs.rate(&velocity).times(mass)
                }
                _ => Row::default(),
            };
            drives.push(Drive {
                inertia,
                name: format!("motion of {}", network.nodes[node].name),
                source: Source::Motion,
                node,
                body: at,
                force: None,
                is_body_force: false,
                jumps: jumps(network, motion, duration).collect(),
            });
        }
    }
    drives
}
