//! The same network with the names of another.

use std::{collections::HashMap, sync::Arc};

use dashpot_network::{
    Connection, Effect, Model, Network, NodeId,
    effects::EFFECTS,
    parameters::{InvalidParameter, ParameterKind, Value, registered},
};
use dashpot_rheology::{Branch, Tree};

use crate::measures::STANDARD_GRAVITY;

/// The network with the names that nodes, elements, branches and loads at the same places have in
/// another; `None` where it has not as many of each.
pub(super) fn renamed(
    network: &Network,
    like: &Network,
) -> Result<Option<Network>, InvalidParameter> {
    let counts = |network: &Network| {
        [
            network.nodes().count(),
            network.connections().len(),
            network.loads().len(),
            network.effects().len(),
        ]
    };
    if counts(network) != counts(like) {
        return Ok(None);
    }
    let mut again = Network::new();
    let mut names: HashMap<&str, &str> = HashMap::new();
    for ((id, node), (_, other)) in network.nodes().zip(like.nodes()) {
        names.insert(&node.name, &other.name);
        if id != network.ground() {
            let mut node = node.clone();
            node.name.clone_from(&other.name);
            again.add_node(node);
        }
    }
    for (own, other) in network.connections().iter().zip(like.connections()) {
        names.insert(&own.name, &other.name);
        let [from, to] = own.between;
        if let Some(layers) = &own.layers {
            let mut layers = layers.clone();
            let others = other.layers.iter().flat_map(|other| &other.all);
            for (layer, other) in layers.all.iter_mut().zip(others) {
                layer.name.clone_from(&other.name);
                layer.model = with_names(&layer.model, &other.model);
            }
            again.connect_layers(&*other.name, from, to, layers).area = own.area;
        } else {
            let model = with_names(&own.model, &other.model);
            connect_as(&mut again, own, (&other.name, own.between), model);
        }
    }
    for (load, other) in network.loads().iter().zip(like.loads()) {
        again.add_load(&*other.name, load.node, load.force.clone());
    }
    for effect in network.effects() {
        again.add_shared_effect(retargeted(effect, &names)?);
    }
    Ok(Some(again))
}

/// Connects two nodes as in another network, with a size of the same kind.
pub(super) fn connect_as(
    network: &mut Network,
    like: &Connection,
    (name, [from, to]): (&str, [NodeId; 2]),
    model: Model,
) {
    let connection = network.connect(name, from, to, model);
    (connection.thickness, connection.area) = (like.thickness, like.area);
    connection.pads.clone_from(&like.pads);
}

/// The gravitational acceleration \[m/s²\] in a network, where gravity is on.
pub(super) fn gravity(network: &Network) -> Option<f64> {
    network.effects().iter().find_map(|effect| effect.gravity())
}

/// The speed \[m/s\] after a fall from this height \[m\], under standard gravity where it is off.
pub(super) fn speed_of_fall(network: &Network, height: f64) -> f64 {
    (2.0 * gravity(network).unwrap_or(STANDARD_GRAVITY) * height).max(0.0).sqrt()
}

/// The model with the names of branches of another, as far as both have the same shape.
pub(super) fn with_names(model: &Model, like: &Model) -> Model {
    // The places of both at which names are to be found, in the order in which a fold meets them.
    let mut names: Vec<Vec<String>> = Vec::new();
    let mut left = vec![(model, Some(like))];
    while let Some((own, other)) = left.pop() {
        if matches!(own, Tree::Part(_)) {
            continue;
        }
        let fits = |other: &&Model| {
            other.branches().len() == own.branches().len() && other.is_series() == own.is_series()
        };
        let other = other.filter(fits);
        let called = other.unwrap_or(own);
        names.push(called.branches().iter().map(|branch| branch.name.clone()).collect());
        for (at, branch) in own.branches().iter().enumerate() {
            let below = other.and_then(|other| other.branches().get(at));
            left.push((&branch.tree, below.map(|branch| &branch.tree)));
        }
    }
    // That walk goes down the last branch first, a fold puts compositions together from the first
    // one up, so the names stand in the opposite order.
    model.fold(
        |element| Tree::Part(Arc::clone(element)),
        |node, parts: Vec<Model>| {
            let names = names.pop().unwrap_or_default();
            let branches = names.into_iter().zip(parts);
            let branches = branches.map(|(name, tree)| Branch::new(name, tree)).collect();
            if node.is_series() { Tree::Series(branches) } else { Tree::Parallel(branches) }
        },
    )
}

/// The effect on the element, and at the node, of another name.
pub(super) fn retargeted(
    effect: &Arc<dyn Effect>,
    names: &HashMap<&str, &str>,
) -> Result<Arc<dyn Effect>, InvalidParameter> {
    let new = |name: &str| names.get(name).copied().unwrap_or(name).to_owned();
    let values = effect.parameters().iter().zip(effect.values()).map(|(own, value)| match value {
        Value::Word(word) if own.kind == ParameterKind::Node => Value::Word(new(&word)),
        value => value,
    });
    let values: Vec<Value> = values.collect();
    again(effect, effect.target().map(new).as_deref(), &values)
}

/// An effect of the same kind with other values, on `target` where it acts on an element; the same
/// one where its kind is in no register.
pub(super) fn again(
    effect: &Arc<dyn Effect>,
    target: Option<&str>,
    values: &[Value],
) -> Result<Arc<dyn Effect>, InvalidParameter> {
    let Some(kind) = registered(EFFECTS, effect.kind()) else { return Ok(Arc::clone(effect)) };
    let made = (kind.make)(values)?;
    Ok(target.and_then(|target| made.on(target)).unwrap_or(made))
}
