//! What is odd about a network, but not wrong.

use std::collections::VecDeque;

use super::{Parts, expand::Shape};
use crate::{Network, elements::Law};

/// All oddities, one sentence each.
pub(super) fn warnings(network: &Network, parts: &Parts<'_>) -> Vec<String> {
    let distance = distances(network, parts);
    let direction = direction(parts);
    let mut warnings = Vec::new();
    for (at, connection) in network.connections.iter().enumerate() {
        let [a, b] = connection.between.map(|id| parts.bodies.of_joint[id.0]);
        let name = &connection.name;
        if a == b {
            if !is_rigid(parts, at) {
                warnings.push(format!(
                    "rigid links join both ends of `{name}`: it never deforms and carries no force"
                ));
            }
        } else if let (Some(from), Some(to)) = (distance[a], distance[b])
            && direction.is_some_and(|forward| if forward { from > to } else { from < to })
        {
            warnings.push(format!(
                "`{name}` looks reversed: `between` runs along the impactor's way, so that \
                 compression counts positive, but here it counts negative"
            ));
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

/// Whether a connection consists of rigid links only.
fn is_rigid(parts: &Parts<'_>, connection: usize) -> bool {
    let leaves = parts.expansion.shapes[connection].iter().filter_map(Shape::leaf);
    leaves.map(|at| parts.expansion.primitives[at].law).all(|law| law == Law::Rigid)
}

/// Number of connections between each body and the nearest impactor, not passing through fixed
/// nodes.
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
        if parts.bodies.all[body].role == super::Role::Fixed {
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
