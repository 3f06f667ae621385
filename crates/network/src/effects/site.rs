//! The end of an element at which an effect acts.

use crate::{Model, Network, NetworkError, Node, NodeId};

/// One end of one connection.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Site {
    /// Position of the connection.
    connection: usize,
    /// 0 on the impactor's side, 1 on the support's.
    end: usize,
}

/// Name of the node that takes the place of a node as an end of `element`.
pub(super) fn face_of(element: &str) -> String {
    format!("{element}.face")
}

/// Name of the connection between that node and its face.
fn contact_of(element: &str) -> String {
    format!("{element}.contact")
}

/// Position of the connection that an effect acts on.
pub(super) fn connection_of(
    network: &Network,
    effect: &'static str,
    element: &str,
) -> Result<usize, NetworkError> {
    let found = network.connections.iter().position(|connection| connection.name == element);
    found.ok_or_else(|| NetworkError::NoElement { effect, element: element.to_owned() })
}

impl Site {
    /// The end of `element` at the node `at`, or else its end on the impactor's side.
    pub(super) fn of(
        network: &Network,
        effect: &'static str,
        element: &str,
        at: Option<&str>,
    ) -> Result<Self, NetworkError> {
        let connection = connection_of(network, effect, element)?;
        let ends = network.connections[connection].between.map(|id| &network.node(id).name);
        let end = match at {
            None => Some(0),
            Some(at) => ends.iter().position(|name| *name == at),
        };
        let end = end.ok_or_else(|| NetworkError::NotAnEnd {
            effect,
            element: element.to_owned(),
            node: at.unwrap_or_default().to_owned(),
            ends: ends.map(String::clone),
        })?;
        Ok(Self { connection, end })
    }

    /// The node at this end.
    pub(super) fn node(self, network: &Network) -> NodeId {
        network.connections[self.connection].between[self.end]
    }

    /// Whether the element's law has no tension at this end.
    pub(super) fn never_pulls(self, network: &Network) -> bool {
        network.connections[self.connection].never_pulls(self.end)
    }

    /// Puts `face` in the place of the node at this end, and `link` between the two, in the order of the element.
    pub(super) fn put_face(self, network: &mut Network, face: Node, link: Model) {
        let body = self.node(network);
        let face = network.add_node(face);
        let element = &mut network.connections[self.connection];
        element.between[self.end] = face;
        let name = contact_of(&element.name);
        let [from, to] = if self.end == 0 { [body, face] } else { [face, body] };
        network.connect(name, from, to, link);
        let contact = network.connections.len() - 1;
        let pad = network.pad_mut(self.connection);
        (pad.face, pad.contact) = (Some(face.0), Some(contact));
    }
}
