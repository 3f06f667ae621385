//! What a run may take where a method does not come to an end, or not to the accuracy that is wanted.

use dashpot_network::{Model, Network, Node, dashpot, effects::Stop, spring};

use crate::{RunReport, Solve, SolveSettings};

/// 28 kHz without damping, of which a stop with restitution leaves less known than is wanted.
fn ringing() -> Network {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 1.3).moving(1.0));
    let link = network.add_node(Node::mass("link", 0.0025).moving(1.0));
    let body = network.add_node(Node::mass("body", 3.1));
    let ground = network.ground();
    let soft = || Model::parallel([spring(1.01), dashpot(0.3861)]);
    network.connect("joint", head, link, spring(7.9486e7));
    network.connect("pad", link, body, soft());
    network.connect("mount", body, ground, soft());
    network.add_effect(Stop {
        element: "pad".to_owned(),
        at: Some(2e-3),
        restitution: 0.9,
        stiffness: None,
        damping: 0.0,
    });
    network
}

fn by(network: &Network, method: &str) -> RunReport {
    let settings = SolveSettings::lasting(1.0).by_name(method).unwrap();
    network.solve_with(&settings).unwrap()
}

#[test]
fn further_methods_take_a_few_times_the_work_before_them_and_some_seconds_at_most() {
    let [auto, exact] = ["auto", "exact"].map(|method| by(&ringing(), method));
    let is_missed =
        |report: &RunReport| report.warnings.iter().any(|own| own.code() == "accuracy-not-reached");
    assert!(is_missed(&exact) && is_missed(&auto));
    assert_eq!(auto.solver.method, "exact");
    // Four times the work before it for the first of three others, no more than 1e8 for those behind it, and the last
    // steps of each; without that most, the third alone would be granted a hundred times the work of `exact`.
    let (first, most) = (exact.solver.work, 100_000_000);
    let work = auto.solver.work;
    assert!(5 * first < work && work < 5 * first + 3 * most && 25 * first > most, "{work} {first}");
}
