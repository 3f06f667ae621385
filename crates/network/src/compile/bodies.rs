//! Joints merged into bodies by rigid links.

use super::expand::{Expansion, Primitive};
use crate::{Network, NetworkError, Subject, Support, elements::Law, network::start_velocity};

/// Joints that move as one.
#[derive(Debug, Clone)]
pub(crate) struct Body {
    /// Its joints in rising order.
    pub(crate) joints: Vec<usize>,
    pub(crate) role: Role,
    /// Start velocity \[m/s\].
    pub(crate) velocity: f64,
    /// Where it begins \[m\], where it has mass and nothing else says so.
    pub(crate) position: f64,
    pub(crate) is_impactor: bool,
    /// Sum of the masses of its nodes \[kg\], whatever rules its motion.
    pub(crate) whole_mass: f64,
}

/// What rules a body's motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Role {
    Fixed,
    /// Index of the node whose motion is prescribed.
    Prescribed(usize),
    /// Total mass \[kg\].
    Mass(f64),
    Massless,
}

/// The bodies and which of them each joint belongs to.
#[derive(Debug, Clone)]
pub(crate) struct Bodies {
    pub(crate) all: Vec<Body>,
    pub(crate) of_joint: Vec<usize>,
    /// How far each joint is from the place of its body \[m\]: rigid links may keep a deformation.
    pub(crate) offset: Vec<f64>,
}

/// Groups of numbers that are joined in pairs.
#[derive(Debug, Clone)]
pub(crate) struct Groups {
    parent: Vec<usize>,
}

impl Groups {
    pub(crate) fn new(count: usize) -> Self {
        Self { parent: (0..count).collect() }
    }

    pub(crate) fn of(&mut self, mut at: usize) -> usize {
        while self.parent[at] != at {
            self.parent[at] = self.parent[self.parent[at]];
            at = self.parent[at];
        }
        at
    }

    /// Joins two groups; false if they were one already.
    pub(crate) fn join(&mut self, first: usize, second: usize) -> bool {
        let (first, second) = (self.of(first), self.of(second));
        let (low, high) = (first.min(second), first.max(second));
        self.parent[high] = low;
        low != high
    }
}

impl Bodies {
    /// Merges the joints at the ends of rigid links.
    pub(crate) fn of(network: &Network, expansion: &Expansion) -> Result<Self, Vec<NetworkError>> {
        let mut groups = Groups::new(expansion.joints);
        for primitive in expansion.primitives.iter().filter(|p| p.law == Law::Rigid) {
            groups.join(primitive.ends[0], primitive.ends[1]);
        }
        let mut of_joint = vec![usize::MAX; expansion.joints];
        let mut members: Vec<Vec<usize>> = Vec::new();
        for joint in 0..expansion.joints {
            let first = groups.of(joint);
            if of_joint[first] == usize::MAX {
                of_joint[first] = members.len();
                members.push(Vec::new());
            }
            of_joint[joint] = of_joint[first];
            members[of_joint[joint]].push(joint);
        }
        let mut errors = Vec::new();
        let offset = offsets(network, expansion, &of_joint, &mut errors);
        let all = members
            .into_iter()
            .map(|joints| Body::of(network, joints, expansion.switches, &mut errors))
            .collect();
        if errors.is_empty() { Ok(Self { all, of_joint, offset }) } else { Err(errors) }
    }
}

/// The place of each joint within its body \[m\], zero where rigid links keep no deformation.
fn offsets(
    network: &Network,
    expansion: &Expansion,
    of_joint: &[usize],
    errors: &mut Vec<NetworkError>,
) -> Vec<f64> {
    let mut offset = vec![0.0; expansion.joints];
    let links: Vec<&Primitive> =
        expansion.primitives.iter().filter(|part| part.law == Law::Rigid).collect();
    if links.iter().all(|link| link.held == 0.0) {
        return offset;
    }
    let mut neighbours: Vec<Vec<(usize, f64)>> = vec![Vec::new(); expansion.joints];
    for link in &links {
        let [a, b] = link.ends;
        neighbours[a].push((b, -link.held));
        neighbours[b].push((a, link.held));
    }
    let is_given =
        |joint: usize| network.nodes.get(joint).is_some_and(|node| node.support != Support::Free);
    let mut is_placed = vec![false; expansion.joints];
    // The place of a body is that of the node that is held, where one is.
    let starts = (0..expansion.joints).filter(|&joint| is_given(joint)).chain(0..expansion.joints);
    let mut body_is_placed = vec![false; expansion.joints];
    for start in starts {
        if is_placed[start] || body_is_placed[of_joint[start]] {
            continue;
        }
        body_is_placed[of_joint[start]] = true;
        is_placed[start] = true;
        let mut reached = vec![start];
        while let Some(joint) = reached.pop() {
            for &(next, further) in &neighbours[joint] {
                if !is_placed[next] {
                    is_placed[next] = true;
                    offset[next] = offset[joint] + further;
                    reached.push(next);
                }
            }
        }
    }
    for link in links {
        let [a, b] = link.ends;
        let kept = offset[a] - offset[b];
        let size = offset[a].abs().max(offset[b].abs()).max(link.held.abs());
        if (kept - link.held).abs() > 1e-12 * size {
            let name = |joint: usize| joint_name(network, expansion, joint);
            errors.push(NetworkError::ContradictingMotions {
                first: name(a),
                second: name(b),
                difference: "the distances that rigid links and closed contacts keep differ",
            });
        }
    }
    offset
}

impl Body {
    /// Where the network `switches`, bodies that a phase joins may have begun at different speeds.
    fn of(
        network: &Network,
        joints: Vec<usize>,
        switches: bool,
        errors: &mut Vec<NetworkError>,
    ) -> Self {
        let nodes: Vec<usize> =
            joints.iter().copied().filter(|&joint| joint < network.nodes.len()).collect();
        let mut held: Option<usize> = None;
        let mut moving: Option<usize> = None;
        for &node in &nodes {
            if network.nodes[node].support != Support::Free {
                if let Some(other) = held
                    && network.nodes[other].support != network.nodes[node].support
                {
                    errors.push(contradiction(network, other, node, "their given motions differ"));
                }
                held = held.or(Some(node));
            }
            if network.nodes[node].mass > 0.0 {
                let speed = |node: usize| start_velocity(network, network.nodes[node].start);
                if let Some(other) = moving
                    && !switches
                    && (speed(other) - speed(node)).abs() > 0.0
                {
                    errors.push(contradiction(network, other, node, "their start speeds differ"));
                }
                let place = |node: usize| network.nodes[node].position;
                if let Some(other) = moving
                    && !switches
                    && (place(other) - place(node)).abs() > 0.0
                {
                    let difference = "their start positions differ";
                    errors.push(contradiction(network, other, node, difference));
                }
                moving = moving.or(Some(node));
            }
        }
        let mass: f64 = nodes.iter().map(|&node| network.nodes[node].mass).sum();
        let role = match held.map(|node| (node, &network.nodes[node].support)) {
            Some((_, Support::Fixed)) => Role::Fixed,
            Some((node, Support::Prescribed(_))) => Role::Prescribed(node),
            _ if mass > 0.0 => Role::Mass(mass),
            _ => Role::Massless,
        };
        let impactor = nodes.iter().copied().find(|&node| network.nodes[node].is_impactor());
        if let Some(node) = impactor.filter(|_| !switches) {
            let reason = match role {
                Role::Fixed => Some("nothing moves it: it is fixed"),
                Role::Prescribed(_) => Some("its motion is prescribed"),
                Role::Massless => Some("no mass"),
                Role::Mass(_) => None,
            };
            if let Some(reason) = reason {
                let node = network.nodes[node].name.clone();
                errors.push(NetworkError::StartSpeed { node, reason });
            }
        }
        let massive = nodes.iter().filter(|&&node| network.nodes[node].mass > 0.0);
        let speeds = massive.map(|&node| start_velocity(network, network.nodes[node].start));
        let velocity =
            speeds.fold(0.0, |most: f64, own| if own.abs() > most.abs() { own } else { most });
        let position = match role {
            Role::Mass(_) => moving.map_or(0.0, |node| network.nodes[node].position),
            _ => 0.0,
        };
        let is_impactor = impactor.is_some();
        Self { joints, role, velocity, position, is_impactor, whole_mass: mass }
    }

    pub(crate) fn is_massless(&self) -> bool {
        self.role == Role::Massless
    }
}

fn contradiction(
    network: &Network,
    first: usize,
    second: usize,
    difference: &'static str,
) -> NetworkError {
    let name = |node: usize| network.nodes[node].name.clone();
    NetworkError::ContradictingMotions { first: name(first), second: name(second), difference }
}

/// The name by which an error speaks of a joint.
pub(crate) fn joint_name(network: &Network, expansion: &Expansion, joint: usize) -> String {
    match &expansion.owners[joint] {
        Some(connection) => format!("a joint inside of {connection}"),
        None => network.nodes[joint].name.clone(),
    }
}

/// The subject of an error about a node.
pub(crate) fn node_subject(network: &Network, node: usize) -> Subject {
    Subject::Node(network.nodes[node].name.clone())
}
