//! The scales of what happens to a network.

use std::f64::consts::TAU;

use dashpot_rheology::Tree;

use super::depth;
use crate::{
    Connection, Model, Network, NodeId, Start, Support,
    compile::bodies::start_velocity,
    effects,
    elements::{Contact, Law},
    layers::stiffness::Stiffness,
    parameters::Kind as _,
};

/// Rounds after which a frequency is settled: each at least halves the distance in decades.
const ROUNDS: usize = 64;

/// A network, how long it is looked at, and the scales of what happens to it.
#[derive(Debug, Clone)]
pub struct Situation<'n> {
    /// The network.
    pub network: &'n Network,
    /// Length of the run \[s\].
    pub duration: f64,
    /// The scales of the impact, where there is one on something that resists.
    pub impact: Option<ImpactScales>,
    /// The largest force of all loads together \[N\].
    pub load: f64,
    /// The largest force of all body forces of effects together \[N\].
    pub weight: f64,
    /// The largest displacement of all given motions together \[m\].
    pub motion: f64,
    /// Whether something falls before it touches.
    pub falls: bool,
}

/// The scales of an impact: that of the impactor with the largest energy.
#[derive(Debug, Clone, PartialEq)]
pub struct ImpactScales {
    /// The impactor.
    pub node: NodeId,
    /// Its mass `m1` \[kg\], > 0.
    pub mass: f64,
    /// Its speed `V0` \[m/s\], > 0.
    pub speed: f64,
    /// Positions of the connections that it strikes.
    pub struck: Vec<usize>,
    /// Stiffness `K` \[N/m\] of those at the frequency `√(K/m1)`.
    pub stiffness: f64,
    /// Thickness `δ` \[m\] of the thinnest of them that has one.
    pub thickness: Option<f64>,
}

impl ImpactScales {
    /// The time `√(m1/K)` \[s\].
    pub fn time(&self) -> f64 {
        (self.mass / self.stiffness).sqrt()
    }

    /// The force `V0 √(K m1)` \[N\].
    pub fn force(&self) -> f64 {
        self.speed * (self.stiffness * self.mass).sqrt()
    }

    /// The length `δ` \[m\], or without a thickness the depth `V0 √(m1/K)`.
    pub fn length(&self) -> f64 {
        self.thickness.unwrap_or_else(|| self.speed * self.time())
    }

    /// The time `J` \[s\]: [`length`](Self::length) over speed.
    pub fn passage(&self) -> f64 {
        self.length() / self.speed
    }
}

impl<'n> Situation<'n> {
    /// The scales of `network` in a run of `duration` \[s\].
    pub fn of(network: &'n Network, duration: f64) -> Self {
        let mut rewritten = network.clone();
        let is_rewritten = effects::rewrite(&mut rewritten).is_ok();
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

    /// The depth \[m\] to which a connection is pressed in at most, as far as scales tell:
    /// `V0 √(m1/K)` by an impact, at which its spring would hold all of the energy (of a law that is
    /// not linear, the depth at which it has taken that up), `F/K` by forces,
    /// and the given motions. `None` where nothing acts on it, or nothing resists.
    pub fn depth(&self, connection: &Connection) -> Option<f64> {
        let struck = self.impact.as_ref().and_then(|impact| {
            let energy = 0.5 * impact.mass * impact.speed * impact.speed;
            if let Some(depth) = depth::at_energy(&connection.model, energy) {
                return Some(depth);
            }
            let omega = frequency(&[&connection.model], impact.mass)?;
            Some(impact.speed / omega)
        });
        let stiffness = self.stiffness(connection);
        let force = self.load + self.weight;
        let pressed = if force > 0.0 { force / stiffness } else { 0.0 };
        let depth = struck.unwrap_or(0.0) + pressed + self.motion;
        (depth > 0.0 && depth.is_finite()).then_some(depth)
    }

    /// The largest force \[N\] that loads and given motions make in a connection, as far as scales
    /// tell.
    pub fn drive_without_weight(&self, connection: &Connection) -> f64 {
        let pressed =
            if self.motion > 0.0 { self.stiffness(connection) * self.motion } else { 0.0 };
        self.load + pressed
    }

    /// The connections that the impactor strikes.
    pub fn struck(&self) -> impl Iterator<Item = &'n Connection> {
        let struck = self.impact.iter().flat_map(|own| &own.struck);
        struck.filter_map(|&at| self.network.connections.get(at))
    }

    /// Stiffness \[N/m\] of a connection at the frequency of one period in the run.
    fn stiffness(&self, connection: &Connection) -> f64 {
        Stiffness::of(&connection.model, TAU / self.duration).size()
    }
}

/// The frequency `√(K/mass)` \[rad/s\] on these models side by side, with their stiffness there.
fn frequency(models: &[&Model], mass: f64) -> Option<f64> {
    let mut omega = 1.0;
    for _ in 0..ROUNDS {
        let sizes = models.iter().map(|model| Stiffness::of(model, omega).size());
        omega = (sizes.sum::<f64>() / mass).sqrt();
        if !omega.is_normal() {
            return None;
        }
    }
    Some(omega)
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
