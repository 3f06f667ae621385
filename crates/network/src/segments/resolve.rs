//! Layers cut into segments.

use dashpot_rheology::{Branch, Tree};

use super::{slice::slice, struck_mass};
use crate::{
    error::{NetworkError, Subject},
    layers::{Layer, Layers, Piece},
    model::Model,
    network::{Network, Node, NodeId},
};

/// Puts the masses of all layers into the network.
/// Errors: [`NetworkError::Invalid`] for layers that cannot be resolved as asked.
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
        let Cut { masses, models, pieces } = cut(&layers, &counts);
        network.connections[at].pieces = pieces;
        network.connections[at].passage = layers.passage(struck, &counts);
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

/// Masses in a row, the models before, between and behind them, and what these are pieces of.
pub(super) struct Cut {
    pub(super) masses: Vec<f64>,
    pub(super) models: Vec<Model>,
    pub(super) pieces: Vec<Vec<Piece>>,
}

/// What stands between the last mass and the next one.
#[derive(Default)]
struct Open {
    models: Vec<Model>,
    pieces: Vec<Piece>,
    /// Depth of its end below the face of the pad \[m\].
    depth: f64,
}

impl Open {
    /// Adds the part `1/count` of a layer.
    fn add(&mut self, layer: &Layer, count: f64) {
        let whole = count <= 1.0;
        self.models.push(if whole { layer.model.clone() } else { slice(&layer.model, count) });
        let thickness = layer.thickness / count;
        let (name, area, from) = (layer.name.clone(), layer.area, self.depth);
        self.pieces.push(Piece { layer: name, from, thickness, area });
        self.depth += thickness;
    }

    /// What has been added since the last time.
    fn take(&mut self) -> (Model, Vec<Piece>) {
        (joined(std::mem::take(&mut self.models)), std::mem::take(&mut self.pieces))
    }
}

/// Layers of which each is cut into so many segments; those of none have no mass.
pub(super) fn cut(layers: &Layers, counts: &[usize]) -> Cut {
    let (mut masses, mut between) = (Vec::new(), Vec::new());
    let mut open = Open::default();
    for (layer, &count) in layers.all.iter().zip(counts) {
        if count == 0 {
            open.add(layer, 1.0);
            continue;
        }
        let segments = count as f64;
        open.add(layer, 2.0 * segments);
        for at in 0..count {
            between.push(open.take());
            masses.push(layer.mass() / segments);
            open.add(layer, if at + 1 < count { segments } else { 2.0 * segments });
        }
    }
    between.push(open.take());
    let (models, pieces) = between.into_iter().unzip();
    Cut { masses, models, pieces }
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
