//! Ways of drawing one and the same network.

use std::{cmp::Ordering, collections::HashMap, sync::Arc};

use dashpot_network::{
    Effect, Model, Network, Node, Start, Support,
    effects::{Face, Gravity},
    parameters::{InvalidParameter, Value},
};
use dashpot_rheology::{Branch, Tree};

use super::{
    FourParameterImpact,
    names::{connect_as, gravity, retargeted, speed_of_fall, with_names},
};

/// The network with the effects of another that it has not, with nothing in them: no gravity is gravity of 0, and no
/// mass on a face one of 0. The same network where both have not as many nodes and elements.
pub(super) fn completed(network: &Network, like: &Network) -> Result<Network, InvalidParameter> {
    let counts = |network: &Network| (network.nodes().count(), network.connections().len());
    if counts(network) != counts(like) {
        return Ok(network.clone());
    }
    let nodes = like.nodes().zip(network.nodes());
    let nodes = nodes.map(|((_, other), (_, own))| (other.name.as_str(), own.name.as_str()));
    let elements = like.connections().iter().zip(network.connections());
    let elements = elements.map(|(other, own)| (other.name.as_str(), own.name.as_str()));
    let names: HashMap<&str, &str> = nodes.chain(elements).collect();
    let mut missing = Vec::new();
    for effect in like.effects().iter().filter_map(vanishing) {
        let nothing = retargeted(&effect, &names)?;
        let is_there = |own: &&Arc<dyn Effect>| {
            own.kind() == nothing.kind() && own.target() == nothing.target()
        };
        if !network.effects().iter().any(|effect| is_there(&effect)) {
            missing.push(nothing);
        }
    }
    if missing.is_empty() {
        return Ok(network.clone());
    }
    // A fall without gravity has the speed that it has under the standard one.
    let is_free = gravity(network).is_none();
    let mut again = with_nodes(network, |node| match node.start {
        Start::Drop(height) if is_free => {
            Node { start: Start::Velocity(speed_of_fall(network, height)), ..node.clone() }
        }
        _ => node.clone(),
    });
    copy_connections(network, &mut again, false);
    copy_rest(network, &mut again);
    missing.into_iter().for_each(|own| again.add_shared_effect(own));
    Ok(again)
}

/// The network seen from the other side: what was positive is negative.
pub(super) fn mirrored(network: &Network) -> Network {
    let mut again = with_nodes(network, |node| {
        let start = match node.start {
            Start::Rest => Start::Rest,
            Start::Velocity(own) => Start::Velocity(-own),
            Start::Drop(height) => Start::Velocity(-speed_of_fall(network, height)),
        };
        let support = match &node.support {
            Support::Prescribed(motion) => Support::Prescribed(motion.in_units(1.0, -1.0)),
            other => other.clone(),
        };
        Node { start, support, ..node.clone() }
    });
    copy_connections(network, &mut again, true);
    for load in network.loads() {
        again.add_load(&*load.name, load.node, load.force.in_units(1.0, -1.0));
    }
    for effect in network.effects() {
        match effect.of_kind::<Gravity>() {
            Some(own) => again.add_effect(Gravity { acceleration: -own.acceleration, ..*own }),
            None => again.add_shared_effect(Arc::clone(effect)),
        }
    }
    again
}

/// The network with the branches of each model in one order, that of their kinds and values: within a
/// model no order matters.
pub(super) fn sorted(network: &Network) -> Network {
    let mut again = network.clone();
    for (at, own) in network.connections().iter().enumerate() {
        // Pads within a model are told by the place of their branch.
        if own.layers.is_none() && own.pads.is_empty() {
            again.set_model(at, sorted_model(&own.model));
        }
    }
    again
}

/// [`sorted`], with the names that branches at the same places have in another network that is
/// sorted.
pub(super) fn sorted_like(network: &Network, like: &Network) -> Network {
    let mut again = sorted(network);
    for at in 0..again.connections().len() {
        let own = &again.connections()[at];
        let others = like.connections();
        let other = others.iter().find(|other| other.name == own.name).or(others.get(at));
        if let Some(other) = other.filter(|_| own.layers.is_none() && own.pads.is_empty()) {
            let model = with_names(&own.model, &other.model);
            again.set_model(at, model);
        }
    }
    again
}

/// The network with the padding of the thesis in its own drawing; `None` where it is of another form.
pub(super) fn drawn_as_burgers(network: &Network) -> Option<Network> {
    let impact = FourParameterImpact::of(network).ok()?;
    let at =
        network.connections().iter().position(|connection| connection.name == impact.names[1])?;
    let mut again = network.clone();
    again.set_model(at, impact.padding().model());
    Some(again)
}

/// What a model is compared by: its shape, and its values.
type Key = (String, Vec<f64>);

fn sorted_model(model: &Model) -> Model {
    let (_, sorted) = model.fold(
        |element| {
            let numbers = element.values().into_iter().filter_map(|own| match own {
                Value::Number(own) => Some(own),
                _ => None,
            });
            let key: Key = (element.kind().to_owned(), numbers.collect());
            (key, Tree::Part(Arc::clone(element)))
        },
        |node, parts: Vec<(Key, Model)>| {
            let names = node.branches().iter().map(|branch| branch.name.as_str());
            let mut all: Vec<(Key, Branch<_>)> = names
                .zip(parts)
                .map(|(name, (key, tree))| (key, Branch::new(name, tree)))
                .collect();
            all.sort_by(|one, other| order(&one.0, &other.0));
            let word = if node.is_series() { "series" } else { "parallel" };
            let shapes: Vec<&str> = all.iter().map(|own| own.0.0.as_str()).collect();
            let shape = format!("{word}({})", shapes.join(","));
            let values = all.iter().flat_map(|own| own.0.1.clone()).collect();
            let branches = all.into_iter().map(|own| own.1).collect();
            let tree =
                if node.is_series() { Tree::Series(branches) } else { Tree::Parallel(branches) };
            ((shape, values), tree)
        },
    );
    sorted
}

fn order(one: &Key, other: &Key) -> Ordering {
    let by_value = || {
        let pairs = one.1.iter().zip(&other.1);
        pairs.map(|(one, other)| one.total_cmp(other)).find(|own| own.is_ne())
    };
    one.0.cmp(&other.0).then_with(|| by_value().unwrap_or(Ordering::Equal))
}

/// The effect with nothing in it, where it is one of those that then do nothing.
fn vanishing(effect: &Arc<dyn Effect>) -> Option<Arc<dyn Effect>> {
    if let Some(own) = effect.of_kind::<Gravity>() {
        return Some(Arc::new(Gravity { acceleration: 0.0, ..*own }));
    }
    let face = effect.of_kind::<Face>()?;
    Some(Arc::new(Face { mass: 0.0, ..face.clone() }))
}

/// A network of other nodes at the same places, with nothing between them.
fn with_nodes(network: &Network, change: impl Fn(&Node) -> Node) -> Network {
    let mut again = Network::new();
    for (id, node) in network.nodes() {
        if id != network.ground() {
            again.add_node(change(node));
        }
    }
    again
}

fn copy_connections(network: &Network, again: &mut Network, turned: bool) {
    for own in network.connections() {
        let [from, to] = own.between;
        let [from, to] = if turned { [to, from] } else { [from, to] };
        if let Some(layers) = &own.layers {
            let mut layers = layers.clone();
            if turned {
                layers.all.reverse();
            }
            again.connect_layers(&*own.name, from, to, layers).area = own.area;
        } else {
            connect_as(again, own, (&own.name, [from, to]), own.model.clone());
        }
    }
}

fn copy_rest(network: &Network, again: &mut Network) {
    for load in network.loads() {
        again.add_load(&*load.name, load.node, load.force.clone());
    }
    for effect in network.effects() {
        again.add_shared_effect(Arc::clone(effect));
    }
}

#[cfg(test)]
mod tests;
