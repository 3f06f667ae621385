//! Which elements can part, and what becomes of their contacts.

use std::collections::HashMap;

use dashpot_dae::{Switch, Trajectory};
use dashpot_network::{
    Assembly, ConnectionOutputs, NodeId, NodeOutputs, PrimitiveOutputs,
    elements::{Contact, Law},
    parameters::Kind as _,
    phases::{Phase, PhaseLaw},
};

use crate::energy::roles::EnergyRole;

fn parts<'a>(assembly: &'a Assembly, connection: &ConnectionOutputs) -> &'a [PrimitiveOutputs] {
    assembly.primitives.get(connection.primitives.clone()).unwrap_or(&[])
}

/// Whether a part is a contact.
pub(crate) fn is_contact(primitive: &PrimitiveOutputs) -> bool {
    primitive.element.kind() == Contact::KIND
}

pub(crate) fn has_contact(assembly: &Assembly, connection: &ConnectionOutputs) -> bool {
    parts(assembly, connection).iter().any(is_contact)
}

/// Word for what leaves a phase as it was.
const IMPACT: &str = "impact";

/// Whether an element can part from what lies at one of its ends: it has a contact of its own there,
/// or nothing but contacts holds a massless end of it.
fn separates(assembly: &Assembly, at: usize) -> bool {
    let connection = &assembly.connections[at];
    let own = assembly.pad(at).and_then(|pad| assembly.connections.get(pad.contact?));
    if own.is_some_and(|own| has_contact(assembly, own)) {
        return true;
    }
    connection.between.iter().any(|end| {
        let node = &assembly.nodes[end.index()];
        let mut others = assembly
            .connections
            .iter()
            .filter(|other| other.between.contains(end) && other.name != connection.name)
            .peekable();
        node.mass == 0.0
            && node.free
            && others.peek().is_some()
            && others.all(|other| has_contact(assembly, other))
    })
}

/// Whether the force of an element only resists: the sign of a slider's is the way it slides, not
/// whether it pushes or pulls.
fn is_slider(assembly: &Assembly, connection: &ConnectionOutputs) -> bool {
    let parts = parts(assembly, connection);
    let slides = |primitive_outputs: &PrimitiveOutputs| {
        primitive_outputs.element.law() == Law::Phased
            && !is_contact(primitive_outputs)
            && !EnergyRole::of(primitive_outputs.element.as_ref()).stores
    };
    !parts.is_empty() && parts.iter().all(slides)
}

/// Whether an element pulls where its force turns to tension.
pub(crate) fn is_glued(assembly: &Assembly, at: usize) -> bool {
    let connection = &assembly.connections[at];
    !connection.never_pulls && !separates(assembly, at) && !is_slider(assembly, connection)
}

/// Whether an impulse acts in a contact that was closed and stays so.
pub(crate) fn stays_closed(switch: &Switch) -> bool {
    switch.time > 0.0 && switch.phase > 0 && switch.what == IMPACT
}

/// Free masses that nothing but one contact touches, where it is open at the end of a run: the
/// node and the element that it has left, with the time \[s\].
pub(crate) fn left_for_good<'a>(
    assembly: &'a Assembly,
    trajectory: &Trajectory,
) -> Vec<(f64, [&'a str; 2])> {
    let last: HashMap<&str, &Switch> =
        trajectory.switches.iter().map(|switch| (switch.name.as_str(), switch)).collect();
    if last.is_empty() {
        return Vec::new();
    }
    let mut touching = vec![0_usize; assembly.nodes.len()];
    for connection in &assembly.connections {
        let [a, b] = connection.between.map(NodeId::index);
        touching[a] += 1;
        touching[b] += usize::from(a != b);
    }
    let is_alone = |end: &usize| {
        let node = &assembly.nodes[*end];
        node.free && node.mass > 0.0 && touching[*end] == 1
    };
    let left = assembly.connections.iter().enumerate().filter_map(|(at, connection)| {
        let node = connection.between.map(NodeId::index).into_iter().find(is_alone)?;
        let own = parts(assembly, connection).iter().filter(|part| is_contact(part));
        let mut switched = own.filter_map(|own| last.get(&*own.name));
        let opened = switched.next_back().filter(|switch| switch.phase == 0)?;
        let pad = assembly.pad_behind(at);
        let element = pad.map_or(connection, |pad| &assembly.connections[pad.element]);
        Some((opened.time, [assembly.nodes[node].name.as_str(), &element.name]))
    });
    left.collect()
}

/// How often an element meets something again after `time` \[s\], at its own contact or, where it is
/// one, in itself: what was open, and pushes nothing, comes to push.
pub(crate) fn meetings_after(
    assembly: &Assembly,
    trajectory: &Trajectory,
    element: usize,
    time: f64,
) -> usize {
    let own = Some(element).filter(|&at| assembly.connections[at].never_pulls);
    let contact = assembly.pad(element).and_then(|pad| pad.contact);
    let parts: Vec<&PrimitiveOutputs> = own
        .into_iter()
        .chain(contact)
        .flat_map(|at| parts(assembly, &assembly.connections[at]))
        .collect();
    let opens = |own: &Switch, index: usize, memory: f64| {
        let part = parts.iter().find(|part| *part.name == *own.name);
        part.and_then(|part| part.element.phases())
            .map(|phases| matches!(phases.law(Phase { index, memory }), PhaseLaw::Open))
    };
    let mut was_open: HashMap<usize, bool> = HashMap::new();
    let mut count = 0;
    for switch in &trajectory.switches {
        let Some(is_open) = opens(switch, switch.phase, switch.memory) else { continue };
        let before = was_open.insert(switch.part, is_open).unwrap_or(!is_open);
        let meets = if switch.impulse > 0.0 { !stays_closed(switch) } else { before && !is_open };
        count += usize::from(meets && switch.time > time);
    }
    count
}

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
