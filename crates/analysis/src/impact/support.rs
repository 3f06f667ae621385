//! What a padding bears on: the node behind it, with all of the padding that pushes there.

use dashpot_network::{Assembly, ConnectionOutputs, NodeId};

/// The connections of a padding that act on the node behind it, each with the sign of its force
/// there: the element itself, or the contact of a face at this end, and a stop that by-passes it.
pub(crate) fn on_support(assembly: &Assembly, element: usize) -> Vec<(usize, f64)> {
    let own = &assembly.connections[element];
    let ends = |connection: &ConnectionOutputs| connection.between.map(NodeId::index);
    let last = ends(own)[1];
    let pad = assembly.pad(element);
    let (contact, stop) = pad.map_or((None, None), |pad| (pad.contact, pad.stop));
    let behind_face = contact.filter(|_| pad.is_some_and(|pad| pad.face == Some(last)));
    let support = behind_face.map_or(last, |contact| ends(&assembly.connections[contact])[1]);
    let sign = |&at: &usize| {
        let [from, to] = ends(&assembly.connections[at]);
        match (from == support, to == support) {
            (false, true) => Some((at, 1.0)),
            (true, false) => Some((at, -1.0)),
            _ => None,
        }
    };
    [Some(element), contact, stop].into_iter().flatten().filter_map(|at| sign(&at)).collect()
}
