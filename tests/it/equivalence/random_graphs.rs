//! Random networks without masses, bridges among them, against elimination node by node.

use dashpot::{
    network::{Network, Node, model_of},
    rheology::{Canonical, Primitive, equivalence::compare},
};

use Primitive::{Dashpot, Spring};

use super::{canonical, linear, massless};
use crate::random_networks::Dice;

/// Springs and dashpots between nodes, of which 0 is the ground and 1 is `top`.
struct Graph {
    nodes: usize,
    parts: Vec<(usize, usize, Primitive)>,
}

impl Graph {
    /// A tree of random parts on all nodes, and some more between any two.
    fn draw(dice: &mut Dice, decades: f64) -> Self {
        let nodes = 3 + dice.below(6);
        let constant = |dice: &mut Dice| {
            let value = dice.decades(decades);
            if dice.below(2) == 0 { Spring(value) } else { Dashpot(value) }
        };
        let mut parts = Vec::new();
        for node in 1..nodes {
            parts.push((node, dice.below(node), constant(dice)));
        }
        for _ in 0..=dice.below(2 * nodes) {
            let (a, b) = (dice.below(nodes), dice.below(nodes));
            if a != b {
                parts.push((a, b, constant(dice)));
            }
        }
        Self { nodes, parts }
    }

    fn network(&self) -> Network {
        let mut network = Network::new();
        let mut ids = vec![network.ground()];
        for node in 1..self.nodes {
            let name = if node == 1 { "top".to_owned() } else { format!("n{node}") };
            ids.push(network.add_node(Node::massless(name)));
        }
        for (at, (a, b, part)) in self.parts.iter().enumerate() {
            network.connect(format!("e{at}"), ids[*a], ids[*b], model_of(&(*part).into()));
        }
        network
    }

    /// The relaxance at real `s`: stars become meshes, node by node, without a subtraction.
    fn relaxance(&self, s: f64) -> f64 {
        let mut links = vec![vec![0.0; self.nodes]; self.nodes];
        for (a, b, part) in &self.parts {
            let own = match part {
                Spring(stiffness) => *stiffness,
                Dashpot(damping) => damping * s,
                Primitive::Rigid => f64::INFINITY,
            };
            links[*a][*b] += own;
            links[*b][*a] += own;
        }
        for last in (2..self.nodes).rev() {
            let star = links.pop().unwrap_or_default();
            let sum: f64 = star[..last].iter().sum();
            for (a, row) in links.iter_mut().enumerate() {
                for (b, link) in row.iter_mut().enumerate().take(last).filter(|own| own.0 != a) {
                    *link += star[a] * (star[b] / sum);
                }
            }
        }
        links[1][0]
    }
}

#[test]
fn the_driving_point_of_a_random_network_is_what_elimination_gives() {
    let mut dice = Dice(21);
    let mut most = 0;
    for case in 0..250 {
        let graph = Graph::draw(&mut dice, 12.0);
        let found = massless(&graph.network());
        most = most.max(found.model.least_elements());
        for power in -30..=30 {
            let s = 10f64.powf(0.5 * f64::from(power));
            let (value, exact) = (found.model.relaxance(s), graph.relaxance(s));
            // Seven eliminations with a few roundings each, all of positive numbers.
            assert!(
                (value / exact - 1.0).abs() < 200.0 * f64::EPSILON,
                "case {case} at {s:e}: {value:e}, not {exact:e}, {:?}",
                graph.parts
            );
        }
        for form in [Canonical::Maxwell, Canonical::Kelvin] {
            let tree = canonical(&found.model, form);
            assert!(compare(&found.model, &linear(&tree)).is_same, "case {case}");
        }
    }
    assert!(most > 8, "{most}");
}
