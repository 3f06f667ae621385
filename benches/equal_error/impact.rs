//! The reference impact: a head on a padding over a panel on a mount.

use dashpot::{
    network::{
        Network, Node,
        elements::{Dashpot, Spring},
        part,
    },
    rheology::Tree,
};

use super::by_hand::ByHand;

/// Force \[N\] of one unit in the equations by hand: 1 kJ over 2 cm.
pub(crate) const UNIT: f64 = 1000.0 / 0.02;

/// The equations of the thesis in its dimensionless groups.
pub(crate) struct Impact {
    /// a, b, c, d, α, β, γ.
    pub(crate) groups: [f64; 7],
}

impl Impact {
    /// With this group α, the damping of the mount: 0.2 for 10 kN s/m.
    pub(crate) fn with_mount(alpha: f64) -> Self {
        Self { groups: [80.0 / 3.0, 200.0 / 3.0, 8.0, 80.0, alpha, 2.0, 0.1] }
    }
}

impl ByHand for Impact {
    fn start(&self) -> Vec<f64> {
        vec![0.0, 1.0, 0.0, 0.0, 0.0, self.groups[2]]
    }

    /// 20 ms.
    fn end(&self) -> f64 {
        10.0
    }

    fn rates(&self, z: &[f64], rates: &mut [f64]) {
        let [a, b, c, d, alpha, beta, gamma] = self.groups;
        let (zeta2, eta2) = (-z[4], -alpha * z[3] - beta * z[2] + gamma * z[4]);
        rates[0] = z[1];
        rates[1] = zeta2;
        rates[2] = z[3];
        rates[3] = eta2;
        rates[4] = z[5];
        rates[5] = -a * z[5] - b * z[4] + c * (zeta2 - eta2) + d * (z[1] - z[3]);
    }

    fn slopes(&self, _state: &[f64], change: &[f64], rates: &mut [f64]) {
        self.rates(change, rates);
    }

    fn observed(&self, state: &dyn Fn(usize) -> f64) -> f64 {
        state(4) * UNIT
    }
}

/// The impact with a pad of `links` Kelvin links behind a Maxwell element, of which the reference has
/// one; without links the pad is one Kelvin element. `mount` is the damping \[N s/m\] of the mount.
pub(crate) fn network(links: usize, mount: f64) -> Network {
    let kelvin =
        |k, c| Tree::parallel([part(Spring { stiffness: k }), part(Dashpot { damping: c })]);
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 10.0).moving(10.0));
    let panel = network.add_node(Node::mass("panel", 100.0));
    let maxwell = [part(Spring { stiffness: 2e7 }), part(Dashpot { damping: 6e3 })];
    let link = |at: usize| kelvin(2e7 * (at + links) as f64, 4e3 / (1 + at) as f64);
    let pad = match links {
        0 => kelvin(2e7, 4e3),
        1 => Tree::series(maxwell.into_iter().chain([kelvin(2e7, 4e3)])),
        _ => Tree::series(maxwell.into_iter().chain((0..links).map(link))),
    };
    network.connect("padding", head, panel, pad).thickness = Some(0.02);
    network.connect("mount", panel, network.ground(), kelvin(5e7, mount));
    network
}
