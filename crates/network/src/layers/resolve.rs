//! Layers cut into segments.

use dashpot_rheology::{Branch, Tree};

use super::{Layers, slice::slice, struck_mass};
use crate::{Model, Network, NetworkError, Node, NodeId, Subject};

/// Puts the masses of all layers into the network.
///
/// # Errors
///
/// [`NetworkError::Invalid`] for layers that cannot be resolved as asked.
pub(crate) fn resolve(network: &mut Network) -> Result<(), NetworkError> {
    for at in 0..network.connections.len() {
        let connection = &network.connections[at];
        let Some(layers) = connection.layers.clone() else { continue };
        let name = connection.name.clone();
        let struck = struck_mass(network, connection);
        let counts = layers.validate().and_then(|()| layers.segments(struck));
        let counts = counts.map_err(|invalid| NetworkError::Invalid {
            subject: Subject::Element { name: name.clone(), path: Vec::new() },
            invalid,
        })?;
        let Cut { masses, models } = cut(&layers, &counts);
        if masses.is_empty() {
            continue;
        }
        let node = |(at, mass): (usize, &f64)| Node::mass(format!("{name}.{}", at + 1), *mass);
        let nodes: Vec<Node> = masses.iter().enumerate().map(node).collect();
        let through: Vec<NodeId> = nodes.into_iter().map(|node| network.add_node(node)).collect();
        let connection = &mut network.connections[at];
        connection.model = Tree::Series(named(models));
        connection.through = through;
    }
    Ok(())
}

/// Masses in a row, and the models before, between and behind them.
pub(super) struct Cut {
    pub(super) masses: Vec<f64>,
    pub(super) models: Vec<Model>,
}

/// Layers of which each is cut into so many segments; those of none have no mass.
pub(super) fn cut(layers: &Layers, counts: &[usize]) -> Cut {
    let (mut masses, mut models) = (Vec::new(), Vec::new());
    // What stands between the last mass and the next one.
    let mut open: Vec<Model> = Vec::new();
    for (layer, &count) in layers.all.iter().zip(counts) {
        if count == 0 {
            open.push(layer.model.clone());
            continue;
        }
        let segments = count as f64;
        let half = slice(&layer.model, 2.0 * segments);
        open.push(half.clone());
        for at in 0..count {
            models.push(joined(std::mem::take(&mut open)));
            masses.push(layer.mass() / segments);
            open.push(if at + 1 < count { slice(&layer.model, segments) } else { half.clone() });
        }
    }
    models.push(joined(open));
    Cut { masses, models }
}

/// One model, or several in series.
fn joined(mut models: Vec<Model>) -> Model {
    match (models.len(), models.pop()) {
        (1, Some(only)) => only,
        (_, last) => Tree::series(models.into_iter().chain(last)),
    }
}

/// The models as branches by what they stand between: `front`, `1-2`, …, `back`.
fn named(models: Vec<Model>) -> Vec<Branch<std::sync::Arc<dyn crate::Element>>> {
    let last = models.len() - 1;
    let name = |at: usize| match at {
        0 => "front".to_owned(),
        at if at == last => "back".to_owned(),
        at => format!("{at}-{}", at + 1),
    };
    models.into_iter().enumerate().map(|(at, model)| Branch::new(name(at), model)).collect()
}
