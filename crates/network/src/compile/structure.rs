//! What follows from the graph alone: which places have a rate of their own, which follow from a
//! balance, and which follow from nothing.

use std::collections::{BTreeMap, BTreeSet};

use dashpot_dae::{Piece, Waveform};

use super::{
    bodies::{Bodies, Body, Groups, Role, joint_name},
    expand::Expansion,
    mesh::Mesh,
};
use crate::{Network, NetworkError, Support, elements::Law};

/// Deformations instead of positions are unknowns up to this many bodies only, because they make dense rows.
pub(super) const MOST_RELATIVE: usize = 100;
/// Up to so many times the momentum of a mass, dashpots may take up within the run at its velocity and
/// their rounding does no harm: six bits.
const HARMLESS: f64 = 64.0;
/// Beyond so many times, what rounding leaves of the velocity between two masses makes a force between them
/// that is worth mentioning, though no other dashpot holds them: twenty bits.
const STRONG: f64 = 1_048_576.0;

/// A spring or dashpot that takes part, between two different bodies.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    pub(super) primitive: usize,
    pub(super) ends: [usize; 2],
    /// Stiffness \[N/m\] or damping \[N s/m\], positive.
    pub(super) constant: f64,
    /// Its deformation where both bodies are at one place \[m\].
    pub(super) offset: f64,
}

/// The numbers of a network as the coefficients of rows.
pub(super) struct Numbers<'a, T> {
    /// The constant of a spring or dashpot.
    pub(super) slope: &'a dyn Fn(&Edge) -> T,
    /// The mass of a body, which is this many kilograms.
    pub(super) mass: &'a dyn Fn(usize, f64) -> T,
}

/// Massless bodies that dashpots join.
#[derive(Debug, Clone)]
pub(super) struct Cluster {
    /// The bodies in rising order.
    pub(super) bodies: Vec<usize>,
    /// The bodies with mass or given motion to which dashpots lead.
    pub(super) anchors: BTreeSet<usize>,
}

/// The graph of a network, taken apart.
#[derive(Debug, Clone, Default)]
pub(super) struct Structure {
    pub(super) springs: Vec<Edge>,
    pub(super) dashpots: Vec<Edge>,
    pub(super) clusters: Vec<Cluster>,
    /// The cluster of each body that has one.
    pub(super) cluster_of: Vec<Option<usize>>,
    /// Whether each body hangs together with a node through springs and dashpots.
    pub(super) held: Vec<bool>,
    /// For each body the first time at which its given displacement jumps \[s\], if it does.
    pub(super) first_jump: Vec<Option<f64>>,
    /// The mass that each mass's velocity is counted from, if any.
    pub(super) velocity_base: Vec<Option<usize>>,
    /// When what holds a mass to a given place must give way, in rising order: the motion has a kink there \[s\].
    pub(super) kinks: Vec<f64>,
}

impl Structure {
    pub(super) fn of(
        network: &Network,
        expansion: &Expansion,
        bodies: &Bodies,
        duration: f64,
    ) -> Result<Self, Vec<NetworkError>> {
        let mut structure = Self::default();
        let held = held_bodies(expansion, bodies);
        for (primitive, part) in expansion.primitives.iter().enumerate() {
            let ends = part.ends.map(|joint| bodies.of_joint[joint]);
            if ends[0] == ends[1] || !held[ends[0]] {
                continue;
            }
            let offset = bodies.offset[part.ends[0]] - bodies.offset[part.ends[1]];
            let [stiffness, damping] = part.slopes();
            if stiffness > 0.0 {
                structure.springs.push(Edge { primitive, ends, constant: stiffness, offset });
            }
            if damping > 0.0 {
                structure.dashpots.push(Edge { primitive, ends, constant: damping, offset });
            }
        }
        let first_jump = |body: &Body| match body.role {
            Role::Prescribed(node) => match &network.nodes[node].support {
                // What switches begins where its motions do.
                Support::Prescribed(motion) => {
                    jumps(network, motion, duration).find(|&time| time > 0.0 || !expansion.switches)
                }
                _ => None,
            },
            _ => None,
        };
        structure.first_jump = bodies.all.iter().map(first_jump).collect();
        structure.find_clusters(bodies, &held);
        structure.held = held;
        structure.velocity_base = velocity_bases(bodies, &structure, duration);
        let mut errors = structure.undetermined(network, expansion, bodies);
        errors.extend(structure.steps_across_dashpots(network, expansion, bodies));
        errors.extend(structure.motions_of_masses(network, expansion, bodies, duration));
        if errors.is_empty() { Ok(structure) } else { Err(errors) }
    }

    fn find_clusters(&mut self, bodies: &Bodies, held: &[bool]) {
        let massless = |body: usize| bodies.all[body].is_massless();
        let mut groups = Groups::new(bodies.all.len());
        for edge in &self.dashpots {
            if edge.ends.iter().all(|&end| massless(end)) {
                groups.join(edge.ends[0], edge.ends[1]);
            }
        }
        let mut number: BTreeMap<usize, usize> = BTreeMap::new();
        self.cluster_of = vec![None; bodies.all.len()];
        for body in (0..bodies.all.len()).filter(|&body| massless(body) && held[body]) {
            let at = *number.entry(groups.of(body)).or_insert(self.clusters.len());
            if at == self.clusters.len() {
                self.clusters.push(Cluster { bodies: Vec::new(), anchors: BTreeSet::new() });
            }
            self.clusters[at].bodies.push(body);
            self.cluster_of[body] = Some(at);
        }
        for edge in &self.dashpots {
            for [inner, outer] in [edge.ends, [edge.ends[1], edge.ends[0]]] {
                if let Some(cluster) = self.cluster_of[inner]
                    && self.cluster_of[outer].is_none()
                {
                    self.clusters[cluster].anchors.insert(outer);
                }
            }
        }
    }

    /// Whether the place of the cluster as a whole follows from a balance of springs.
    pub(super) fn is_algebraic(&self, cluster: usize) -> bool {
        self.clusters[cluster].anchors.is_empty()
    }

    /// The algebraic cluster of a body, if it belongs to one.
    pub(super) fn algebraic_cluster(&self, body: usize) -> Option<usize> {
        self.cluster_of[body].filter(|&cluster| self.is_algebraic(cluster))
    }

    fn undetermined(
        &self,
        network: &Network,
        expansion: &Expansion,
        bodies: &Bodies,
    ) -> Vec<NetworkError> {
        let known = self.clusters.len();
        let place = |body: usize| self.algebraic_cluster(body).unwrap_or(known);
        let mut groups = Groups::new(known + 1);
        for spring in &self.springs {
            groups.join(place(spring.ends[0]), place(spring.ends[1]));
        }
        let mut loose: BTreeMap<usize, Vec<String>> = BTreeMap::new();
        for (at, cluster) in self.clusters.iter().enumerate() {
            if self.is_algebraic(at) && groups.of(at) != groups.of(known) {
                let names = cluster
                    .bodies
                    .iter()
                    .flat_map(|&body| &bodies.all[body].joints)
                    .filter(|&&joint| joint < network.nodes.len())
                    .map(|&joint| joint_name(network, expansion, joint));
                loose.entry(groups.of(at)).or_default().extend(names);
            }
        }
        loose.into_values().map(|nodes| NetworkError::Undetermined { nodes }).collect()
    }

    /// Refuses what would take an infinite force, and notes the kinks at which masses are let go.
    fn motions_of_masses(
        &mut self,
        network: &Network,
        expansion: &Expansion,
        bodies: &Bodies,
        duration: f64,
    ) -> Vec<NetworkError> {
        let mut errors = Vec::new();
        for (at, body) in bodies.all.iter().enumerate() {
            let Role::Prescribed(node) = body.role else { continue };
            let Support::Prescribed(motion) = &network.nodes[node].support else { continue };
            if body.whole_mass == 0.0 {
                continue;
            }
            let jump = self.first_jump[at].map(|time| ("jumps", time));
            if jump.is_none() && !bears_mass(network, expansion, body) {
                self.kinks.extend(kinks(motion, duration));
                continue;
            }
            let kink = || kinks(motion, duration).next().map(|time| ("has a kink", time));
            if let Some((fault, time)) = jump.or_else(kink) {
                let nodes = || body.joints.iter().filter_map(|&joint| network.nodes.get(joint));
                let heavy = nodes().find(|node| node.mass > 0.0).map(|node| node.name.clone());
                let node = network.nodes[node].name.clone();
                let heavy = heavy.unwrap_or_else(|| node.clone());
                errors.push(NetworkError::MotionOfMass { node, heavy, fault, time });
            }
        }
        self.kinks.sort_by(f64::total_cmp);
        errors
    }

    fn steps_across_dashpots(
        &self,
        network: &Network,
        expansion: &Expansion,
        bodies: &Bodies,
    ) -> Vec<NetworkError> {
        let mut errors = Vec::new();
        for (at, body) in bodies.all.iter().enumerate() {
            let (Role::Prescribed(node), Some(time)) = (body.role, self.first_jump[at]) else {
                continue;
            };
            let beyond = self.dashpots.iter().find_map(|edge| {
                let other = match edge.ends {
                    [from, other] | [other, from] if from == at => other,
                    _ => return None,
                };
                match self.cluster_of[other] {
                    None => Some(other),
                    Some(cluster) => {
                        self.clusters[cluster].anchors.iter().copied().find(|&end| end != at)
                    }
                }
            });
            if let Some(other) = beyond {
                errors.push(NetworkError::StepAcrossDashpots {
                    node: network.nodes[node].name.clone(),
                    other: joint_name(network, expansion, bodies.all[other].joints[0]),
                    time,
                });
            }
        }
        errors
    }
}

/// Whether each body hangs together with a node, through parts whose constants are not zero; a
/// joint between parts of constant zero does not, and is left out.
fn held_bodies(expansion: &Expansion, bodies: &Bodies) -> Vec<bool> {
    let mut groups = Groups::new(bodies.all.len());
    for part in &expansion.primitives {
        if part.slopes().iter().any(|&slope| slope > 0.0) {
            groups.join(bodies.of_joint[part.ends[0]], bodies.of_joint[part.ends[1]]);
        }
    }
    let mut held = vec![false; bodies.all.len()];
    for (joint, owner) in expansion.owners.iter().enumerate() {
        if owner.is_none() {
            held[groups.of(bodies.of_joint[joint])] = true;
        }
    }
    (0..bodies.all.len()).map(|body| held[groups.of(body)]).collect()
}

/// All times in `[0, duration]` at which a displacement jumps \[s\].
pub(super) fn jumps(
    network: &Network,
    motion: &Waveform,
    duration: f64,
) -> impl Iterator<Item = f64> + Clone {
    let at_start = jumps_at_start(network, motion, duration).then_some(0.0);
    let later = motion.jumps().map(|jump| jump.0);
    at_start.into_iter().chain(later.filter(move |&time| time > 0.0 && time <= duration))
}

/// Whether a displacement is not zero at the start, and the network does not begin in balance around it.
pub(super) fn jumps_at_start(network: &Network, motion: &Waveform, duration: f64) -> bool {
    let first = motion.value(0.0).abs();
    first > 0.0
        && !network.effects.iter().any(|effect| effect.starts_in_balance())
        && first > 1e-12 * motion.bound(duration)
}

/// Whether what is given the motion of a body has mass, or is linked to one by what never gives way.
fn bears_mass(network: &Network, expansion: &Expansion, body: &Body) -> bool {
    let mut groups = Groups::new(expansion.joints);
    for part in expansion
        .primitives
        .iter()
        .filter(|primitive| primitive.law == Law::Rigid && !primitive.is_phased())
    {
        groups.join(part.ends[0], part.ends[1]);
    }
    let nodes = || body.joints.iter().filter_map(|&at| Some((at, network.nodes.get(at)?)));
    let heavy = nodes().filter(|(_, own)| own.mass > 0.0).map(|node| node.0);
    let heavy: BTreeSet<usize> = heavy.map(|at| groups.of(at)).collect();
    let mut given = nodes().filter(|(_, own)| own.support != Support::Free);
    given.any(|(at, _)| heavy.contains(&groups.of(at)))
}

/// The times in `(0, duration]` at which the rate of a displacement jumps \[s\].
fn kinks(motion: &Waveform, duration: f64) -> impl Iterator<Item = f64> {
    let pairs = motion.pieces().windows(2);
    let kinks = pairs.filter(|pair| {
        let time = pair[1].start;
        let (before, after) = (pair[0].derivative(1, time), pair[1].derivative(1, time));
        let size = |piece: &Piece| {
            let s = time - piece.start;
            let bent = (piece.curvature * s).abs() + (0.5 * piece.jerk * s * s).abs();
            piece.slope.abs() + bent + piece.frequency(time) * piece.sine.hypot(piece.cosine)
        };
        (after - before).abs() > 1e-12 * (size(&pair[0]) + size(&pair[1]))
    });
    kinks.map(|pair| pair[1].start).filter(move |&time| time > 0.0 && time <= duration)
}

/// For each mass the one that its velocity is counted from, if any.
///
/// A mass that several dashpots hold has the sum of their constants in its row. Rounding of that sum
/// acts like a dashpot to the ground: beside one of 10¹⁰ N s/m it has 10⁻⁶ N s/m and slows down
/// what the two masses do together. With the velocity of one counted from the other each constant stands for
/// itself, and their common velocity has no part in the forces between them.
///
/// Masses that dashpots join, the strongest first, become one group; the lighter group's velocity is
/// counted from the heavier one, so that what moves a group as a whole is no small difference of
/// large terms. What is fixed or moved from outside is the heaviest, and nothing is counted from it. Where
/// no mass is held by more than one dashpot, or they are weak for a run of `duration` \[s\], all
/// velocities stand for themselves; those of two masses that a single one makes as good as one do not.
fn velocity_bases(bodies: &Bodies, structure: &Structure, duration: f64) -> Vec<Option<usize>> {
    let count = bodies.all.len();
    let mut parents = vec![None; count];
    if count > MOST_RELATIVE {
        return parents;
    }
    let mut mesh = Mesh::<f64>::new(count);
    for dashpot in &structure.dashpots {
        let [a, b] = dashpot.ends;
        mesh.link(a, b, dashpot.constant, &0.0);
    }
    let massless: Vec<usize> = (0..count)
        .filter(|&body| structure.cluster_of[body].is_some() && mesh.links(body).next().is_some())
        .collect();
    let mesh = mesh.eliminate(&massless, usize::MAX).rest;
    // What is fixed or moved from outside is as heavy as can be.
    let mass = |body: usize| match bodies.all[body].role {
        Role::Mass(mass) => mass,
        Role::Fixed | Role::Prescribed(_) => f64::INFINITY,
        Role::Massless => 0.0,
    };
    let masses = (0..count).filter(|&body| mass(body) > 0.0);
    let mut pairs: Vec<(f64, [usize; 2])> = Vec::new();
    for body in masses {
        let others = mesh.links(body).filter(|&(other, _)| other > body);
        pairs.extend(others.map(|(other, link)| (link.conductance.high(), [body, other])));
    }
    let is_mixed = |body: usize| {
        let damping: f64 = mesh.links(body).map(|(_, link)| link.conductance.high()).sum();
        let harmless = if mesh.links(body).count() > 1 { HARMLESS } else { STRONG };
        damping * duration > harmless * mass(body)
    };
    pairs.retain(|(_, ends)| ends.iter().any(|&end| is_mixed(end)));
    pairs.sort_by(|one, other| other.0.total_cmp(&one.0));
    let mut groups = Groups::new(count);
    let mut heaviest: Vec<usize> = (0..count).collect();
    for (_, [a, b]) in pairs {
        let [one, other] = [a, b].map(|body| heaviest[groups.of(body)]);
        if !groups.join(a, b) {
            continue;
        }
        let (light, heavy) = if mass(one) < mass(other) { (one, other) } else { (other, one) };
        if mass(heavy).is_finite() {
            parents[light] = Some(heavy);
        }
        heaviest[groups.of(a)] = heavy;
    }
    parents
}
