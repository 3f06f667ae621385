//! Tests of what is left out.

use dashpot_dae::Silent;
use dashpot_network::{
    Network, Node,
    effects::{Gravity, GravityStart},
    elements::{Dashpot, Spring},
    part,
};
use dashpot_rheology::Tree;

use super::*;
use crate::{Accuracy, solve};

/// The reference impact with gravity.
fn reference() -> Network {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 10.0).moving(10.0));
    let panel = network.add_node(Node::mass("panel", 100.0));
    let spring = || part(Spring { stiffness: 2e7 });
    let dashpot = |damping: f64| part(Dashpot { damping });
    let kelvin = Tree::parallel([spring(), dashpot(4e3)]);
    let pad = Tree::series([spring(), dashpot(6e3), kelvin]);
    network.connect("padding", head, panel, pad).thickness = Some(0.02);
    let mount = Tree::parallel([part(Spring { stiffness: 5e7 }), dashpot(1e4)]);
    network.connect("mount", panel, network.ground(), mount);
    network.add_effect(Gravity { acceleration: 9.806_65, start: GravityStart::Equilibrium });
    network
}

#[test]
fn probe() {
    for (bound) in [0.005, 0.02, 0.1] {
    let mut settings = SolveSettings::lasting(0.02).by("exact");
    settings.accuracy = Accuracy { neglect_below: Some(bound), ..Accuracy::default() };
    let report = solve(&reference(), &settings, &mut Silent).unwrap();
    println!("{:#?}", report.partial);
    }
}
