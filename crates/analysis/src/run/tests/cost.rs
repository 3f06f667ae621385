//! What a run may take where a method does not come to an end, or not to the accuracy that is wanted.

use dashpot_dae::SolveError;
use dashpot_network::{Model, Network, Node, dashpot, effects::Stop, spring};

use crate::{RunError, RunReport, Solve, SolveSettings};

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
    let settings = SolveSettings::lasting(0.5).by_name(method).unwrap();
    network.solve_with(&settings).unwrap()
}

#[test]
fn further_methods_take_a_few_times_the_work_of_the_first() {
    let [auto, exact] = ["auto", "exact"].map(|method| by(&ringing(), method));
    let is_missed =
        |report: &RunReport| report.warnings.iter().any(|own| own.code() == "accuracy-not-reached");
    assert!(is_missed(&exact) && is_missed(&auto));
    assert_eq!(auto.solver.method, "exact");
    // Two others, each up to four times as much; the second was granted four times that of all before it.
    let parts = auto.solver.work as f64 / exact.solver.work as f64;
    assert!(parts > 2.0 && parts < 12.0, "{parts}");
}

#[test]
fn first_of_four_solutions_may_take_a_quarter_of_the_budget() {
    let mut network = Network::new();
    let mass = network.add_node(Node::mass("m", 0.1).moving(1.0));
    let ground = network.ground();
    network.connect("s", mass, ground, spring(7.9e13));
    let settings = SolveSettings::lasting(10.0).by_name("bdf").unwrap();
    let settings = SolveSettings { budget: 60_000_000, ..settings };
    let error = network.solve_with(&settings).unwrap_err();
    let RunError::Solve(SolveError::BudgetSpent { work, .. }) = error else { panic!("{error}") };
    assert!((15_000_000..16_000_000).contains(&work), "{work}");
}
