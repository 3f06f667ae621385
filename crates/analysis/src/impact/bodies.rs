//! Nodes that rigid links join to bodies.

use dashpot_network::{Assembly, ConnectionOutputs, NodeOutputs};

/// How many numbers of bodies there are.
pub(crate) fn count(assembly: &Assembly) -> usize {
    assembly.nodes.iter().map(|node| node.body + 1).max().unwrap_or(0)
}

/// What belongs to each body, and what can deform at it.
#[derive(Debug)]
pub(crate) struct Members {
    nodes: Lists,
    connections: Lists,
    masses: Vec<f64>,
}

impl Members {
    pub(crate) fn of(assembly: &Assembly) -> Self {
        let bodies = count(assembly);
        let nodes = assembly.nodes.iter().enumerate().map(|(at, node)| (node.body, at));
        let connections = assembly.connections.iter().enumerate().filter(|own| !own.1.is_rigid);
        let ends = connections.flat_map(|(at, own)| {
            let [a, b] = between(assembly, own);
            [Some((a, at)), (a != b).then_some((b, at))].into_iter().flatten()
        });
        let mut masses = vec![0.0; bodies];
        for node in &assembly.nodes {
            masses[node.body] += node.mass;
        }
        Self { nodes: Lists::of(bodies, nodes), connections: Lists::of(bodies, ends), masses }
    }

    /// The nodes of a body, in order.
    pub(crate) fn nodes<'a>(
        &'a self,
        assembly: &'a Assembly,
        body: usize,
    ) -> impl Iterator<Item = &'a NodeOutputs> {
        self.nodes.of_body(body).iter().map(|&at| &assembly.nodes[at])
    }

    /// The mass of a body \[kg\].
    pub(crate) fn mass(&self, body: usize) -> f64 {
        self.masses[body]
    }

    /// The connections that can deform at a body, in order, each with the sign of its force on the body; of
    /// one with both ends there the sign is 0.
    pub(crate) fn connections<'a>(
        &'a self,
        assembly: &'a Assembly,
        body: usize,
    ) -> impl Iterator<Item = (&'a ConnectionOutputs, f64)> {
        self.connections.of_body(body).iter().map(move |&at| {
            let own = &assembly.connections[at];
            let [a, b] = between(assembly, own).map(|end| f64::from(u8::from(end == body)));
            (own, b - a)
        })
    }
}

/// Lists of numbers, one for each body.
#[derive(Debug)]
struct Lists {
    /// Where the list of each body ends.
    ends: Vec<usize>,
    all: Vec<usize>,
}

impl Lists {
    /// The lists of these pairs of a body and a number.
    fn of(bodies: usize, pairs: impl Iterator<Item = (usize, usize)>) -> Self {
        let mut pairs: Vec<(usize, usize)> = pairs.collect();
        pairs.sort_unstable();
        let ends = (0..bodies).map(|body| pairs.partition_point(|pair| pair.0 <= body)).collect();
        Self { ends, all: pairs.into_iter().map(|pair| pair.1).collect() }
    }

    fn of_body(&self, body: usize) -> &[usize] {
        let start = body.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.all[start..self.ends[body]]
    }
}

/// For each body whether an impactor belongs to it.
pub(crate) fn with_impactor(assembly: &Assembly) -> Vec<bool> {
    let mut found = vec![false; count(assembly)];
    for node in assembly.nodes.iter().filter(|node| node.is_impactor()) {
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
