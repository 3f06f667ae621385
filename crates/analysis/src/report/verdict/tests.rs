use dashpot_network::{
    Model, Network, Node,
    elements::{Dashpot, Spring},
    part,
};

use super::*;
use crate::Solve;

/// Heads on pads of their own: names, masses \[kg\], speeds \[m/s\], stiffnesses \[N/m\].
fn side_by_side(all: &[(&str, f64, f64, f64)]) -> RunReport {
    let mut network = Network::new();
    for (name, mass, speed, stiffness) in all {
        let node = Node::mass(format!("head-{name}"), *mass).moving(*speed);
        let (head, ground) = (network.add_node(node), network.ground());
        let damping = 0.2 * (stiffness * mass).sqrt();
        let parts = [part(Spring { stiffness: *stiffness }), part(Dashpot { damping })];
        network.connect(*name, head, ground, Model::parallel(parts));
    }
    network.solve(0.2).unwrap()
}

#[test]
fn the_impactor_that_leaves_is_that_of_the_longest_contact() {
    let report =
        side_by_side(&[("vn", 4.0, 2.0, 1e4), ("epp", 1.0, 9.0, 5e4), ("pu", 2.0, 5.0, 4e4)]);
    let found = Verdict::of(&report);
    let Some(Ending::Ended { measure, leaving: Some(leaving), .. }) = found.ending else {
        panic!("{:?}", found.ending)
    };
    assert_eq!((measure.target.as_str(), leaving.impactor), ("vn", "head-vn"));
    assert!(leaving.returns && leaving.speed < 2.0, "{leaving:?}");
}

#[test]
fn an_element_takes_up_the_energy_of_those_that_strike_it() {
    let report =
        side_by_side(&[("vn", 4.0, 2.0, 1e4), ("epp", 1.0, 9.0, 5e4), ("pu", 2.0, 5.0, 4e4)]);
    let energy = Verdict::of(&report).energy.unwrap();
    let supply = energy.supply.unwrap();
    assert_eq!((energy.measure.target.as_str(), &supply.impactors[..]), ("epp", &["head-epp"][..]));
    assert!((supply.kinetic - 40.5).abs() < 1e-12 && supply.work.abs() < 1e-12, "{supply:?}");
    assert!(energy.value < supply.kinetic);
    // One impactor alone is not named.
    let report = side_by_side(&[("pu", 2.0, 5.0, 4e4)]);
    let supply = Verdict::of(&report).energy.unwrap().supply.unwrap();
    assert!(supply.impactors.is_empty() && (supply.kinetic - 25.0).abs() < 1e-12, "{supply:?}");
}
