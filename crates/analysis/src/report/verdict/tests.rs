use dashpot_network::{
    Model, Network, Node,
    effects::{Gravity, GravityStart, Separation},
    elements::{Dashpot, Foam, Spring},
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

/// A mass that is let fall on foam, or strikes it without weight.
fn on_foam(height: Option<f64>) -> RunReport {
    let mut network = Network::new();
    let head = Node::mass("head", 8.0);
    let head = height.map_or(head.clone().moving(4.0), |height| head.dropped(height));
    let head = network.add_node(head);
    let foam = Foam {
        modulus: 1.2e6,
        plateau: 1.2e5,
        densification: 3e4,
        exponent: 2.0,
        thickness: 0.05,
        area: 0.0144,
    };
    let pad = Model::parallel([part(foam), part(Dashpot { damping: 40.0 })]);
    network.connect("pad", head, network.ground(), pad).thickness = Some(0.05);
    if height.is_some() {
        network.add_effect(Gravity { acceleration: 9.80665, start: GravityStart::Equilibrium });
    }
    network.add_effect(Separation { element: "pad".to_owned(), at: None, restitution: 0.0 });
    network.solve(0.6).unwrap()
}

#[test]
fn the_verdict_of_a_plain_impact_takes_no_curves_and_is_what_they_say() {
    for height in [Some(0.8), None] {
        let report = on_foam(height);
        let own = Verdict::of(&report);
        assert!(report.trajectory.to_come().is_some(), "{height:?}");
        // What is saved is more than the run has taken.
        let (run, curves) = (report.solver.statistics, report.trajectory.statistics);
        assert!(curves.rhs_calls > run.rhs_calls, "{curves:?} and {run:?}");
        assert!(report.trajectory.to_come().is_none());
        let other = Verdict::of(&report);
        let near =
            |one: f64, other: f64| assert!((one / other - 1.0).abs() < 1e-4, "{one} {other}");
        assert!(own.whole_force.is_none() && other.whole_force.is_none());
        assert!(own.elsewhere.is_none() && other.elsewhere.is_none());
        let [one, two] = [&own, &other].map(|own| own.depth.unwrap().compression.unwrap());
        near(one.deepest, two.deepest);
        near(one.thickness, two.thickness);
        let leaving = |own: &Verdict<'_>| match &own.ending {
            Some(Ending::Ended { leaving: Some(leaving), .. }) => {
                (leaving.impactor.to_owned(), leaving.speed, leaving.returns)
            }
            ending => panic!("{ending:?}"),
        };
        let [one, two] = [&own, &other].map(leaving);
        assert_eq!((&one.0, one.2), (&two.0, two.2));
        near(one.1, two.1);
        let [one, two] = [&own, &other].map(|own| own.energy.clone().unwrap().supply.unwrap());
        assert_eq!(one, two);
    }
}
