//! What is odd about a network, but not wrong.

use std::collections::{HashMap, VecDeque};

use super::{
    bodies::Groups,
    expand::{Primitive, Shape},
    parts::Parts,
};
use crate::{
    Network, NetworkWarning, Support,
    elements::Law,
    outputs::place,
    phases::{Phase, PhaseLaw, Phases},
};

/// All oddities.
pub(super) fn warnings(network: &Network, parts: &Parts<'_>) -> Vec<NetworkWarning> {
    let distance = distances(network, parts);
    let direction = direction(parts);
    let ahead = direction.map(|forward| ahead(network, parts, &distance, forward));
    let mut linked = None;
    let mut warnings = Vec::new();
    for (at, connection) in network.connections.iter().enumerate() {
        let [a, b] = connection.between.map(|id| parts.bodies.of_joint[id.0]);
        let name = &connection.name;
        if a == b {
            let ends = connection.between.map(|id| id.0);
            if !is_rigid(parts, at)
                && is_linked(parts, linked.get_or_insert_with(|| links(parts)), ends)
            {
                warnings.push(NetworkWarning::RigidlyLinked { element: name.clone() });
            }
        } else if let (Some(from), Some(to)) = (distance[a], distance[b])
            && let (Some(forward), Some(ahead)) = (direction, &ahead)
            && is_against(forward, [from, to])
            && !ahead[if from < to { a } else { b }]
        {
            warnings.push(NetworkWarning::Reversed { element: name.clone() });
        }
    }
    warnings.extend(idle_restitutions(network, parts));
    warnings.extend(shared_contacts(parts));
    warnings
}

/// Contacts between the same bodies that close at one deformation: what each of them carries is not
/// determined, their sum is.
fn shared_contacts(parts: &Parts<'_>) -> Vec<NetworkWarning> {
    let mut last: HashMap<([usize; 2], u64), &Primitive> = HashMap::new();
    let mut warnings = Vec::new();
    for primitive in &parts.expansion.primitives {
        let ends = primitive.ends.map(|joint| parts.bodies.of_joint[joint]);
        let Some(level) = primitive.origin.phases().and_then(closing_level) else { continue };
        if ends[0] == ends[1] {
            continue;
        }
        if let Some(one) = last.insert((ends, level.to_bits()), primitive) {
            let elements =
                [one, primitive].map(|own| place(&own.name, own.origin.kind()).to_owned());
            warnings.push(NetworkWarning::SharedContacts { elements });
        }
    }
    warnings
}

/// The deformation \[m\] at which a rigid contact closes.
fn closing_level(phases: &dyn Phases) -> Option<f64> {
    if !super::phased::is_contact(phases) {
        return None;
    }
    (0..phases.names().len()).find_map(|index| match phases.law(Phase { index, memory: 0.0 }) {
        PhaseLaw::Held(level) => Some(level),
        _ => None,
    })
}

/// Whether a connection between bodies at these distances from the impactor runs against its way.
fn is_against(forward: bool, [from, to]: [usize; 2]) -> bool {
    if forward { from > to } else { from < to }
}

/// Whether each body has something before it in the impactor's way: what runs the other way from it
/// then lies behind it, and is pressed when it comes back.
fn ahead(
    network: &Network,
    parts: &Parts<'_>,
    distance: &[Option<usize>],
    forward: bool,
) -> Vec<bool> {
    let mut ahead = vec![false; distance.len()];
    for connection in &network.connections {
        let [a, b] = connection.between.map(|id| parts.bodies.of_joint[id.0]);
        let near = if forward { a } else { b };
        if let (Some(from), Some(to)) = (distance[a], distance[b]) {
            ahead[near] |= from != to && !is_against(forward, [from, to]);
        }
    }
    ahead
}

/// Restitutions that do nothing: they act between masses, and a part without mass takes the speed of what it meets.
fn idle_restitutions(network: &Network, parts: &Parts<'_>) -> Vec<NetworkWarning> {
    let mut groups = Groups::new(parts.expansion.joints);
    // What is between two contacts moves with what it touches, and is struck with it.
    let passes = |primitive: &&Primitive| {
        primitive.is_link
            || primitive.origin.phases().is_some_and(|phases| phases.restitution() == 0.0)
    };
    for primitive in parts.expansion.primitives.iter().filter(passes) {
        groups.join(primitive.ends[0], primitive.ends[1]);
    }
    let mut has_inertia = vec![false; parts.expansion.joints];
    for (joint, node) in network.nodes.iter().enumerate() {
        let group = groups.of(joint);
        has_inertia[group] |= node.mass > 0.0 || node.support != Support::Free;
    }
    let mut warnings = Vec::new();
    for (connection, shapes) in network.connections.iter().zip(&parts.expansion.shapes) {
        for primitive in shapes.iter().filter_map(Shape::leaf) {
            let primitive = &parts.expansion.primitives[primitive];
            let restitution = primitive.origin.phases().map_or(0.0, Phases::restitution);
            let light = primitive.ends.into_iter().find(|&end| !has_inertia[groups.of(end)]);
            let Some(light) = light.filter(|_| restitution > 0.0) else { continue };
            let node = network.nodes.get(light).map(|node| node.name.clone());
            let element = connection.name.clone();
            warnings.push(NetworkWarning::IdleRestitution { element, restitution, node });
        }
    }
    warnings
}

/// Whether the impactors move towards the support; `None` where they do not agree.
fn direction(parts: &Parts<'_>) -> Option<bool> {
    let mut ways =
        parts.bodies.all.iter().filter(|body| body.is_impactor).map(|b| b.velocity >= 0.0);
    let first = ways.next()?;
    ways.all(|way| way == first).then_some(first)
}

/// The joints that rigid links make one body of.
fn links(parts: &Parts<'_>) -> Groups {
    let mut groups = Groups::new(parts.expansion.joints);
    for link in parts.expansion.primitives.iter().filter(|primitive| primitive.is_link) {
        groups.join(link.ends[0], link.ends[1]);
    }
    groups
}

/// Whether rigid links make one body of two joints; in a network that switches, parts that hold for
/// the moment may do so as well.
fn is_linked(parts: &Parts<'_>, links: &mut Groups, joints: [usize; 2]) -> bool {
    !parts.expansion.switches || links.of(joints[0]) == links.of(joints[1])
}

/// Whether a connection consists of rigid links only.
fn is_rigid(parts: &Parts<'_>, connection: usize) -> bool {
    let leaves = parts.expansion.shapes[connection].iter().filter_map(Shape::leaf);
    leaves.map(|at| parts.expansion.primitives[at].law).all(|law| law == Law::Rigid)
}

/// Number of connections between each body and the nearest impactor, not passing through fixed nodes, which are beyond
/// all others: each way ends there.
fn distances(network: &Network, parts: &Parts<'_>) -> Vec<Option<usize>> {
    let count = parts.bodies.all.len();
    let mut neighbours: Vec<Vec<usize>> = vec![Vec::new(); count];
    for connection in &network.connections {
        let [a, b] = connection.between.map(|id| parts.bodies.of_joint[id.0]);
        neighbours[a].push(b);
        neighbours[b].push(a);
    }
    let mut distance = vec![None; count];
    let mut queue = VecDeque::new();
    for body in (0..count).filter(|&body| parts.bodies.all[body].is_impactor) {
        distance[body] = Some(0);
        queue.push_back((body, 0));
    }
    while let Some((body, steps)) = queue.pop_front() {
        if parts.bodies.all[body].role == super::bodies::Role::Fixed {
            distance[body] = Some(count);
            continue;
        }
        for &next in &neighbours[body] {
            if distance[next].is_none() {
                distance[next] = Some(steps + 1);
                queue.push_back((next, steps + 1));
            }
        }
    }
    distance
}
