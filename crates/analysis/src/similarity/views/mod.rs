//! Ways of drawing one and the same network.

use std::{cmp::Ordering, sync::Arc};

use dashpot_network::{
    Effect, Model, Network, Start, Support,
    effects::{Face, Gravity},
    parameters::{InvalidParameter, Value},
};
use dashpot_rheology::{Branch, Tree};

use super::{
    FourParameterImpact,
    names::{gravity, opposite, retargeted, speed_of_fall, with_names},
};

/// The network with the effects of another that it has not, with nothing in them: no gravity is gravity of 0, and no
/// mass on a face one of 0. The same network where both have not as many nodes and elements.
pub(super) fn completed(network: &Network, like: &Network) -> Result<Network, InvalidParameter> {
    let counts = |network: &Network| (network.nodes().count(), network.connections().len());
    if counts(network) != counts(like) {
        return Ok(network.clone());
    }
    let names = opposite(like, network);
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
    let mut again = network.clone();
    // A fall without gravity has the speed that it has under the standard one.
    if !missing.is_empty() && gravity(network).is_none() {
        for node in again.nodes_mut() {
            if let Start::Drop(height) = node.start {
                node.start = Start::Velocity(speed_of_fall(network, height));
            }
        }
    }
    again.effects_mut().extend(missing);
    Ok(again)
}

/// The network seen from the other side: what was positive is negative.
pub(super) fn mirrored(network: &Network) -> Network {
    let mut again = network.clone();
    for node in again.nodes_mut() {
        node.start = match node.start {
            Start::Rest => Start::Rest,
            Start::Velocity(own) => Start::Velocity(-own),
            Start::Drop(height) => Start::Velocity(-speed_of_fall(network, height)),
        };
        if let Support::Prescribed(motion) = &mut node.support {
            *motion = motion.in_units(1.0, -1.0);
        }
    }
    for own in again.connections_mut() {
        own.between.reverse();
        if let Some(layers) = &mut own.layers {
            layers.all.reverse();
            own.model = layers.model();
        }
    }
    for load in again.loads_mut() {
        load.force = load.force.in_units(1.0, -1.0);
    }
    for effect in again.effects_mut() {
        if let Some(own) = effect.of_kind::<Gravity>() {
            *effect = Arc::new(Gravity { acceleration: -own.acceleration, ..*own });
        }
    }
    again
}

/// The network with the branches of each model in one order, that of their kinds and values: within a model no order
/// matters. They have the names of those at the same places in another network that is sorted, where one is given.
pub(super) fn sorted(network: &Network, like: Option<&Network>) -> Network {
    let mut again = network.clone();
    for (at, own) in again.connections_mut().iter_mut().enumerate() {
        // Pads within a model are told by the place of their branch.
        if own.layers.is_some() || !own.pads.is_empty() {
            continue;
        }
        own.model = sorted_model(&own.model);
        let others = like.map_or(&[][..], Network::connections);
        let other = others.iter().find(|other| other.name == own.name).or(others.get(at));
        if let Some(other) = other {
            own.model = with_names(&own.model, &other.model);
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
    again.set_model(at, impact.padding.model());
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
            let names = node.branches().iter().map(|branch| branch.name.clone());
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

#[cfg(test)]
mod tests;
