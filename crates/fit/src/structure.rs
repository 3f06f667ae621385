//! Which numbers no test can tell apart, known from the structure of the network before anything is fitted.

use std::collections::BTreeSet;

use dashpot_network::{Network, Node, primitive};
use dashpot_rheology::{
    Primitive,
    identifiability::{Entangled, entangled},
};

/// Elements of more parts than this are not looked at.
const MOST_PARTS: usize = 300;

/// Numbers of which an element shows fewer than there are.
#[derive(Debug, Clone, PartialEq)]
pub struct Undetermined {
    /// The element.
    pub element: String,
    /// Positions of the numbers, rising.
    pub numbers: Vec<usize>,
    /// Names of the constants that it does show.
    pub shown: Vec<String>,
    connection: usize,
    group: usize,
}

/// The groups of numbers that cannot all be told: `network` is the scene, and `moved` the same with one number after
/// the other changed a little.
pub fn undetermined(network: &Network, moved: &[Network]) -> Vec<Undetermined> {
    let mut found = Vec::new();
    for (at, connection) in network.connections().iter().enumerate() {
        for (group, own) in groups(network, at).iter().enumerate() {
            let paths: BTreeSet<&String> = own.parameters.iter().collect();
            let is_within = |other: &&Network| {
                let changed = changed(network, other, at);
                let is_in = changed.iter().all(|path| paths.contains(path));
                !changed.is_empty() && is_in && is_same_besides(network, other, at)
            };
            let numbers = moved.iter().enumerate().filter(|other| is_within(&other.1));
            let numbers: Vec<usize> = numbers.map(|other| other.0).collect();
            if numbers.len() > own.combinations.len() {
                let element = connection.name.clone();
                let shown = own.combinations.iter().map(|own| own.0.clone()).collect();
                found.push(Undetermined { element, numbers, shown, connection: at, group });
            }
        }
    }
    found
}

impl Undetermined {
    /// What a network shows of them: constants \[N/m or N s/m\] in the order of `shown`.
    pub fn constants(&self, network: &Network) -> Vec<f64> {
        let all = groups(network, self.connection);
        let own = all.get(self.group).map(|own| &own.combinations[..]).unwrap_or_default();
        own.iter().map(|own| constant(own.1)).collect()
    }

    /// Whether the constant at this position is that of a spring.
    pub fn is_spring(&self, network: &Network, at: usize) -> bool {
        let all = groups(network, self.connection);
        let own = all.get(self.group).and_then(|own| own.combinations.get(at));
        own.is_some_and(|own| matches!(own.1, Primitive::Spring(_)))
    }
}

fn groups(network: &Network, connection: usize) -> Vec<Entangled> {
    let Some(own) = network.connections().get(connection) else { return Vec::new() };
    let is_large = own.model.leaves().nth(MOST_PARTS).is_some();
    if is_large || !dashpot_network::is_linear(&own.model) {
        return Vec::new();
    }
    entangled(&own.model, |element| primitive(element.as_ref()))
}

fn constant(own: Primitive) -> f64 {
    match own {
        Primitive::Spring(own) | Primitive::Dashpot(own) => own,
        Primitive::Rigid => f64::INFINITY,
    }
}

/// The paths of the constants of an element that differ.
fn changed(one: &Network, other: &Network, connection: usize) -> Vec<String> {
    let parts = |own: &Network| -> Vec<(String, f64)> {
        let model = own.connections().get(connection).map(|own| &own.model);
        let parts = model.map(dashpot_rheology::Tree::parts).unwrap_or_default();
        parts.into_iter().map(|(path, own)| (path, constant(primitive(own.as_ref())))).collect()
    };
    let pairs = parts(one).into_iter().zip(parts(other));
    let differs = |own: &((String, f64), (String, f64))| own.0.1.to_bits() != own.1.1.to_bits();
    pairs.filter(differs).map(|own| own.0.0).collect()
}

/// Whether all but one element is the same in both.
fn is_same_besides(one: &Network, other: &Network, connection: usize) -> bool {
    let nodes = |own: &Network| {
        own.nodes().map(|own: (_, &Node)| format!("{:?}", own.1)).collect::<Vec<_>>()
    };
    let elements = |own: &Network| {
        let all = own.connections().iter().enumerate().filter(|own| own.0 != connection);
        all.map(|own| format!("{:?}", own.1)).collect::<Vec<_>>()
    };
    nodes(one) == nodes(other)
        && elements(one) == elements(other)
        && format!("{:?}", one.effects()) == format!("{:?}", other.effects())
}

#[cfg(test)]
mod tests {
    use dashpot_network::{dashpot, spring};

    use super::*;

    /// A head on a pad of two springs and a dashpot in series, and a mount.
    fn network(values: &[f64]) -> Network {
        let mut network = Network::new();
        let head = network.add_node(Node::mass("head", values[4]).moving(3.0));
        let plate = network.add_node(Node::mass("plate", 50.0));
        let pad = spring(values[0]) + spring(values[1]) + dashpot(values[2]);
        network.connect("pad", head, plate, pad);
        network.connect("mount", plate, network.ground(), spring(values[3]));
        network
    }

    #[test]
    fn springs_in_series_are_one_and_what_acts_elsewhere_is_told() {
        let values = [2e5, 6e5, 400.0, 1e6, 4.0];
        let moved: Vec<Network> = (0..values.len())
            .map(|at| {
                let mut own = values;
                own[at] *= 1.001;
                network(&own)
            })
            .collect();
        let base = network(&values);
        let [own] = &undetermined(&base, &moved)[..] else { panic!() };
        assert_eq!((own.element.as_str(), &own.numbers[..]), ("pad", &[0, 1][..]));
        assert!((own.constants(&base)[0] - 1.5e5).abs() < 1e-6 && own.is_spring(&base, 0));
        // One of them alone is determined.
        assert!(undetermined(&base, &moved[1..]).is_empty());
        // A number that moves the mount as well can be told by it.
        let mut both = values;
        (both[0], both[3]) = (2.1e5, 1.1e6);
        assert!(undetermined(&base, &[network(&both), moved[1].clone()]).is_empty());
    }
}
