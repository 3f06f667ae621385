//! What tells the form of one network from that of another.

use crate::{
    Network, Support,
    compile::{expand::Expansion, validate},
    elements::Law,
};

/// What tells the form of one network from that of another.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Fingerprint {
    parts: Vec<([usize; 2], u8)>,
    roles: Vec<u8>,
    of_joint: Vec<usize>,
    names: Vec<String>,
}

/// The form of a network; `None` where it has anything but springs, dashpots and rigid links between
/// free and fixed nodes, or is not valid.
pub(super) fn fingerprint(network: &Network, expansion: &Expansion) -> Option<Fingerprint> {
    let is_plain = network.connections.iter().all(|connection| connection.layers.is_none());
    let is_displaced = network.nodes.iter().any(|node| node.position != 0.0);
    if !is_plain || is_displaced || !validate::faults(network, expansion).is_empty() {
        return None;
    }
    let word = |law: Law| match law {
        Law::Spring(constant) if constant > 0.0 => Some(0),
        Law::Dashpot(constant) if constant > 0.0 => Some(1),
        Law::Rigid => Some(2),
        _ => None,
    };
    let parts =
        expansion.primitives.iter().map(|primitive| Some((primitive.ends, word(primitive.law)?)));
    let roles = network.nodes.iter().map(|node| match node.support {
        Support::Free => Some(u8::from(node.mass > 0.0) + 2 * u8::from(node.is_impactor())),
        Support::Fixed => Some(4),
        Support::Prescribed(_) => None,
    });
    Some(Fingerprint {
        parts: parts.collect::<Option<_>>()?,
        roles: roles.collect::<Option<_>>()?,
        of_joint: network
            .connections
            .iter()
            .flat_map(|connection| connection.between.map(|end| end.0))
            .collect(),
        names: network.connections.iter().map(|connection| connection.name.clone()).collect(),
    })
}
