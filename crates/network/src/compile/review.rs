//! What is odd about a network, but not wrong.

use std::collections::VecDeque;

use super::Parts;
use crate::Network;

/// All oddities, one sentence each.
pub(super) fn warnings(network: &Network, parts: &Parts<'_>) -> Vec<String> {
    let distance = distances(network, parts);
    let mut warnings = Vec::new();
    for connection in &network.connections {
        let [a, b] = connection.between.map(|id| parts.bodies.of_joint[id.0]);
        let name = &connection.name;
        if a == b {
            warnings.push(format!(
                "rigid links join both ends of `{name}`: it never deforms and carries no force"
            ));
        } else if let (Some(from), Some(to)) = (distance[a], distance[b])
            && from > to
        {
            let [from, to] = connection.between.map(|id| &network.node(id).name);
            warnings.push(format!(
                "`{name}` looks reversed: `between` runs from the impactor's side to the \
                 support's, but `{to}` is nearer to the impactor than `{from}`; compression \
                 counts negative here"
            ));
        }
    }
    warnings
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
