//! The scales of what happens to a network.

use dashpot_rheology::Tree;

use crate::{
    elements::{Contact, Law},
    model::Model,
    network::{
        ImpactScales, Network, NodeId, Situation, Start, Support, frequency, start_velocity,
    },
    parameters::Kind as _,
    rewrite::rewrite,
};

impl<'n> Situation<'n> {
    /// The scales of `network` in a run of `duration` \[s\].
    pub fn of(network: &'n Network, duration: f64) -> Self {
        let mut rewritten = network.clone();
        let is_rewritten = rewrite(&mut rewritten).is_ok();
        let rewritten = if is_rewritten { &rewritten } else { network };
        let loads = network.loads.iter().map(|load| load.force.bound(duration));
        let body_forces = network.effects.iter().flat_map(|effect| effect.body_forces(network));
        let body_forces = body_forces.map(|(_, force)| force.bound(duration));
        let motions = network.nodes.iter().filter_map(|node| match &node.support {
            Support::Prescribed(motion) => Some(motion.bound(duration)),
            _ => None,
        });
        Self {
            network,
            duration,
            impact: impact(network),
            load: loads.sum(),
            weight: body_forces.sum(),
            motion: motions.sum(),
            falls: network.nodes().any(|(id, _)| falls(rewritten, id)),
        }
    }
}

/// The impactor with the largest energy, and what it strikes.
fn impact(network: &Network) -> Option<ImpactScales> {
    let energy = |id: NodeId| {
        let node = network.node(id);
        node.mass * start_velocity(network, node.start).powi(2)
    };
    let strikes =
        |id: &NodeId| network.node(*id).support == Support::Free && energy(*id).is_normal();
    let impactors = network.nodes().map(|(id, _)| id).filter(strikes);
    let node = impactors.max_by(|one, other| energy(*one).total_cmp(&energy(*other)))?;
    let (mass, speed) =
        (network.node(node).mass, start_velocity(network, network.node(node).start).abs());
    let struck = struck_by(network, node);
    let connections = || struck.iter().map(|&at| &network.connections[at]);
    let models: Vec<&Model> = connections().map(|connection| &connection.model).collect();
    let omega = frequency(&models, mass)?;
    let thickness = connections().filter_map(|connection| connection.thickness).reduce(f64::min);
    let stiffness = mass * omega * omega;
    Some(ImpactScales { node, mass, speed, struck, stiffness, thickness })
}

/// Whether a mass falls before it touches: it is dropped, gravity pulls it towards the support, and
/// it is joined to nothing but by contacts.
fn falls(network: &Network, node: NodeId) -> bool {
    let pulls =
        network.effects.iter().find_map(|effect| effect.gravity()).is_some_and(|own| own > 0.0);
    let is_dropped = matches!(network.node(node).start, Start::Drop(_));
    pulls
        && is_dropped
        && reached(network, node, is_rigid)
            .into_iter()
            .all(|at| is_contact(&network.connections[at].model))
}

/// Positions of the connections that a node strikes: those that touch it, or what rigid links and
/// contacts join to it, and are neither.
fn struck_by(network: &Network, node: NodeId) -> Vec<usize> {
    reached(network, node, |model| is_rigid(model) || is_contact(model))
}

/// Positions of the connections that touch a node, or what `joins` lets count as a part of it, and
/// do not join themselves.
fn reached(network: &Network, node: NodeId, joins: impl Fn(&Model) -> bool) -> Vec<usize> {
    let mut joined = vec![node];
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(&own) = joined.get(at) {
        at += 1;
        for (position, connection) in network.connections.iter().enumerate() {
            let [a, b] = connection.between;
            let other = if a == own { b } else { a };
            if !connection.between.contains(&own) || found.contains(&position) {
                continue;
            }
            if !joins(&connection.model) {
                found.push(position);
            } else if !joined.contains(&other) && network.node(other).support == Support::Free {
                joined.push(other);
            }
        }
    }
    found
}

fn is_rigid(model: &Model) -> bool {
    matches!(model, Tree::Part(element) if element.law() == Law::Rigid)
}

fn is_contact(model: &Model) -> bool {
    matches!(model, Tree::Part(element) if element.kind() == Contact::KIND)
}
