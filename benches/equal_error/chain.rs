//! An impact on a chain of masses.

use dashpot::{
    network::{
        Network, Node,
        elements::{Dashpot, Spring},
        part,
    },
    rheology::Tree,
};

use super::by_hand::ByHand;

/// An impactor of 10 kg at 10 m/s, then n masses of 1/n kg; n + 1 Kelvin links of n MN/m, their
/// damping 10⁻⁴ s of that, in a row to the ground.
///
/// Units by hand: 1 cm, 10 m/s, 1 ms and 10 kN; the states are positions and speeds in turns.
pub(crate) struct Chain {
    /// n.
    pub(crate) nodes: usize,
}

impl Chain {
    /// The chain as a network.
    pub(crate) fn network(&self) -> Network {
        let stiffness = self.nodes as f64 * 1e6;
        let mut network = Network::new();
        let mut last = network.add_node(Node::mass("impactor", 10.0).moving(10.0));
        for at in 0..=self.nodes {
            let next = if at == self.nodes {
                network.ground()
            } else {
                network.add_node(Node::mass(format!("node-{at}"), 1.0 / self.nodes as f64))
            };
            let parts = [part(Spring { stiffness }), part(Dashpot { damping: 1e-4 * stiffness })];
            network.connect(format!("link-{at}"), last, next, Tree::parallel(parts));
            last = next;
        }
        network
    }

    /// Force of the link behind a mass.
    fn force(&self, at: usize, state: &impl Fn(usize) -> f64) -> f64 {
        let beyond = |own: usize| if at == self.nodes { 0.0 } else { state(own) };
        let deformation = state(2 * at) - beyond(2 * at + 2);
        let rate = state(2 * at + 1) - beyond(2 * at + 3);
        self.nodes as f64 * (deformation + 0.1 * rate)
    }
}

impl ByHand for Chain {
    fn start(&self) -> Vec<f64> {
        let mut state = vec![0.0; 2 * self.nodes + 2];
        state[1] = 1.0;
        state
    }

    fn end(&self) -> f64 {
        20.0
    }

    fn rates(&self, state: &[f64], rates: &mut [f64]) {
        let mut before = 0.0;
        for at in 0..=self.nodes {
            let behind = self.force(at, &|own| state[own]);
            rates[2 * at] = state[2 * at + 1];
            let inverse = if at == 0 { 0.1 } else { self.nodes as f64 };
            rates[2 * at + 1] = inverse * (before - behind);
            before = behind;
        }
    }

    fn slopes(&self, _state: &[f64], change: &[f64], rates: &mut [f64]) {
        self.rates(change, rates);
    }

    fn observed(&self, state: &dyn Fn(usize) -> f64) -> f64 {
        1e4 * self.force(0, &state)
    }
}
