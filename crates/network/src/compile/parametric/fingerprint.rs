//! What tells the form of one network from that of another.

use super::first_phases::FirstPhases;
use crate::{Support, compile::validate, elements::Law};

/// What tells the form of one network from that of another.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Fingerprint {
    parts: Vec<([usize; 2], &'static str)>,
    roles: Vec<u8>,
    of_joint: Vec<usize>,
    names: Vec<String>,
}

/// The form of a network; `None` where it has anything but springs, dashpots, other laws and rigid links
/// between free and fixed nodes, or is not valid.
pub(super) fn fingerprint(first: &FirstPhases<'_>) -> Option<Fingerprint> {
    let FirstPhases { network, expansion, .. } = first;
    let is_plain = network.connections.iter().all(|connection| connection.layers.is_none());
    let is_displaced = network.nodes.iter().any(|node| node.position != 0.0);
    if !is_plain || is_displaced || !validate::faults(network, expansion).is_empty() {
        return None;
    }
    let parts = expansion.primitives.iter().enumerate().map(|(at, primitive)| {
        let word = match first.law(at)? {
            Law::Spring(constant) if constant > 0.0 => "spring",
            Law::Dashpot(constant) if constant > 0.0 => "dashpot",
            Law::Rigid => "rigid",
            Law::Nonlinear { .. } => primitive.element.kind(),
            _ => return None,
        };
        Some((primitive.ends, word))
    });
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
