//! Which elements can part, and what becomes of their contacts.

use std::collections::HashMap;

use dashpot_dae::{Switch, Trajectory};
use dashpot_network::{
    Assembly, ConnectionOutputs, NodeId, PrimitiveOutputs,
    elements::{Contact, Law},
    parameters::Kind as _,
    phases::{Phase, PhaseLaw},
};

use crate::energy::roles::Accounts;

/// The parts of a connection.
fn parts<'a>(assembly: &'a Assembly, connection: &ConnectionOutputs) -> &'a [PrimitiveOutputs] {
    assembly.primitives.get(connection.primitives.clone()).unwrap_or(&[])
}

/// Whether a part is a contact.
pub(crate) fn is_contact(primitive: &PrimitiveOutputs) -> bool {
    primitive.element.kind() == Contact::KIND
}

/// Whether a connection has a contact in it.
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
            && !Accounts::of(primitive_outputs.element.as_ref()).stores
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
        let mut switched = own.filter_map(|own| last.get(own.name.as_str()));
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
        let part = parts.iter().find(|part| part.name == own.name);
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
