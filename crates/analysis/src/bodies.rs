//! Nodes that rigid links join to bodies.

use dashpot_network::{Assembly, ConnectionOutputs};

use crate::solution::is_impactor;

/// How many numbers of bodies there are.
pub(crate) fn count(assembly: &Assembly) -> usize {
    assembly.nodes.iter().map(|node| node.body + 1).max().unwrap_or(0)
}

/// For each body whether an impactor belongs to it.
pub(crate) fn with_impactor(assembly: &Assembly) -> Vec<bool> {
    let mut found = vec![false; count(assembly)];
    for node in assembly.nodes.iter().filter(|node| is_impactor(node)) {
        found[node.body] = true;
    }
    found
}

/// The bodies at both ends of a connection.
pub(crate) fn between(assembly: &Assembly, connection: &ConnectionOutputs) -> [usize; 2] {
    connection.between.map(|end| assembly.nodes[end.index()].body)
}

/// Whether a connection that can deform has one of the `wanted` bodies at one of its ends.
pub(crate) fn is_touching(
    assembly: &Assembly,
    connection: &ConnectionOutputs,
    wanted: &[bool],
) -> bool {
    !connection.is_rigid && between(assembly, connection).iter().any(|&body| wanted[body])
}
