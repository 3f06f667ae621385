//! The same network with the names of another.

use std::{collections::HashMap, sync::Arc};

use dashpot_network::{
    Effect, Model, Network,
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
    let mut again = network.clone();
    for (own, (_, other)) in again.nodes_mut().iter_mut().zip(like.nodes().skip(1)) {
        own.name.clone_from(&other.name);
    }
    for (own, other) in again.connections_mut().iter_mut().zip(like.connections()) {
        own.name.clone_from(&other.name);
        let Some(layers) = &mut own.layers else {
            own.model = with_names(&own.model, &other.model);
            continue;
        };
        let others = other.layers.iter().flat_map(|other| &other.all);
        for (layer, other) in layers.all.iter_mut().zip(others) {
            layer.name.clone_from(&other.name);
            layer.model = with_names(&layer.model, &other.model);
        }
        own.model = layers.model();
    }
    for (own, other) in again.loads_mut().iter_mut().zip(like.loads()) {
        own.name.clone_from(&other.name);
    }
    let names = opposite(network, like);
    for effect in again.effects_mut() {
        *effect = retargeted(effect, &names)?;
    }
    Ok(Some(again))
}

/// The names of nodes and elements of one network with those at the same places in another.
pub(super) fn opposite<'n>(network: &'n Network, like: &'n Network) -> HashMap<&'n str, &'n str> {
    let nodes = network.nodes().zip(like.nodes());
    let nodes = nodes.map(|((_, own), (_, other))| (own.name.as_str(), other.name.as_str()));
    let elements = network.connections().iter().zip(like.connections());
    let elements = elements.map(|(own, other)| (own.name.as_str(), other.name.as_str()));
    nodes.chain(elements).collect()
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
    let (own, other) = (model.branches(), like.branches());
    if own.is_empty() || own.len() != other.len() || model.is_series() != like.is_series() {
        return model.clone();
    }
    let named = |(own, other): (&Branch<_>, &Branch<_>)| {
        Branch::new(other.name.clone(), with_names(&own.tree, &other.tree))
    };
    let branches = own.iter().zip(other).map(named).collect();
    if model.is_series() { Tree::Series(branches) } else { Tree::Parallel(branches) }
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
