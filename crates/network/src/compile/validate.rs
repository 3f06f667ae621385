//! What can be said of a network before its equations are looked at.

use std::collections::HashSet;

use dashpot_rheology::MOST_LEVELS;

use super::{bodies::node_subject, expand::Expansion};
use crate::{
    Network, NetworkError, Node, Start, Subject, Support,
    parameters::{InvalidParameter, Range},
};

/// All faults of names and numbers.
pub(crate) fn faults(network: &Network, expansion: &Expansion) -> Vec<NetworkError> {
    let mut errors = Vec::new();
    names(network, &mut errors);
    nodes(network, expansion, &mut errors);
    connections(network, expansion, &mut errors);
    for effect in &network.effects {
        if let Err(invalid) = effect.validate() {
            errors.push(NetworkError::Invalid { subject: Subject::Effect(effect.kind()), invalid });
        }
    }
    errors
}

fn names(network: &Network, errors: &mut Vec<NetworkError>) {
    let mut check =
        |family: &'static str, name: &str, subject: Subject, seen: &mut HashSet<String>| {
            if !seen.insert(name.to_owned()) {
                errors.push(NetworkError::DuplicateName { family, name: name.to_owned(), subject });
            }
        };
    let mut seen = HashSet::new();
    for node in &network.nodes {
        check("nodes", &node.name, Subject::Node(node.name.clone()), &mut seen);
    }
    for connection in &network.connections {
        let subject = Subject::Element { name: connection.name.clone(), path: Vec::new() };
        check("nodes or elements", &connection.name, subject, &mut seen);
    }
    let mut seen = HashSet::new();
    for load in &network.loads {
        check("loads", &load.name, Subject::Load(load.name.clone()), &mut seen);
    }
}

fn nodes(network: &Network, expansion: &Expansion, errors: &mut Vec<NetworkError>) {
    let mut touched = vec![false; network.nodes.len()];
    for primitive in &expansion.primitives {
        for end in primitive.ends {
            if let Some(touched) = touched.get_mut(end) {
                *touched = true;
            }
        }
    }
    for (at, node) in network.nodes.iter().enumerate() {
        let subject = || node_subject(network, at);
        let start = match node.start {
            Start::Rest => Ok(()),
            Start::Velocity(velocity) => Range::Finite.check("velocity", velocity),
            Start::Drop(height) => Range::NonNegative.check("drop", height),
        };
        let position = Range::Finite.check("position", node.position);
        for invalid in [Range::NonNegative.check("mass", node.mass), start, position]
            .into_iter()
            .filter_map(Result::err)
        {
            errors.push(NetworkError::Invalid { subject: subject(), invalid });
        }
        if let Some(reason) = displaced_fault(network, node) {
            errors.push(NetworkError::StartPosition { node: node.name.clone(), reason });
        }
        let is_isolated = node.mass == 0.0 && node.support == Support::Free && !touched[at];
        if is_isolated {
            errors.push(NetworkError::IsolatedNode { node: node.name.clone() });
        }
    }
}

/// Why a node cannot begin at a position of its own.
fn displaced_fault(network: &Network, node: &Node) -> Option<&'static str> {
    let is_balanced = || network.effects.iter().any(|effect| effect.starts_in_balance());
    match (&node.support, node.start) {
        _ if node.position == 0.0 => None,
        (Support::Fixed, _) => Some("nothing moves it: it is fixed"),
        (Support::Prescribed(_), _) => Some("its motion is prescribed: give that another start"),
        _ if node.mass == 0.0 => Some("it has no mass: its place follows from the forces on it"),
        (_, Start::Drop(_)) => Some("it is dropped: its height says where it begins"),
        _ if is_balanced() => Some("gravity has it begin in balance"),
        _ => None,
    }
}

fn connections(network: &Network, expansion: &Expansion, errors: &mut Vec<NetworkError>) {
    for (connection, shape) in network.connections.iter().zip(&expansion.shapes) {
        let subject = || Subject::Element { name: connection.name.clone(), path: Vec::new() };
        let [from, to] = connection.between;
        if from == to {
            let (element, node) = (connection.name.clone(), network.node(from).name.clone());
            errors.push(NetworkError::BothEndsAtOneNode { element, node });
        }
        if let Some(Err(invalid)) =
            connection.thickness.map(|thickness| Range::Positive.check("thickness", thickness))
        {
            errors.push(NetworkError::Invalid { subject: subject(), invalid });
        }
        if connection.model.is_deeper_than(MOST_LEVELS) {
            errors.push(NetworkError::TooDeep { element: connection.name.clone() });
            continue;
        }
        for part in shape {
            match part {
                super::expand::Shape::Leaf(at) => {
                    let primitive = &expansion.primitives[*at];
                    if let Err(invalid) = primitive.element.validate() {
                        let path = primitive.name.split('.').skip(1).map(str::to_owned).collect();
                        let subject = Subject::Element { name: connection.name.clone(), path };
                        errors.push(NetworkError::Invalid { subject, invalid });
                    }
                }
                super::expand::Shape::Series(parts) | super::expand::Shape::Parallel(parts)
                    if parts.is_empty() =>
                {
                    let invalid =
                        InvalidParameter::new("series or parallel", "one part or more", "empty");
                    errors.push(NetworkError::Invalid { subject: subject(), invalid });
                }
                _ => {}
            }
        }
    }
}
