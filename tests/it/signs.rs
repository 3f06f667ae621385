//! What does not depend on how a network is written down: the order of the names of an element's
//! ends, and rigid links.

use dashpot::{
    analysis::{RunReport, Solve, SolveSettings},
    network::{Model, Network, Node, NodeId, elements::Rigid, part},
};

use crate::thesis::{dashpot, kelvin, spring};

fn run(network: &Network, method: &str) -> RunReport {
    network.solve_with(&SolveSettings::lasting(0.3).by_name(method).unwrap()).unwrap()
}

fn value(report: &RunReport, key: &str) -> f64 {
    let measure = report.measure(key).unwrap_or_else(|| panic!("no {key}"));
    measure.value.unwrap_or_else(|| panic!("{measure:?}"))
}

fn is_same(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * a.abs()
}

#[test]
fn swapping_the_ends_of_an_element_changes_no_measure_of_a_node() {
    let tethered = |swapped: [bool; 2], velocity: f64| {
        let mut network = Network::new();
        let head = network.add_node(Node::mass("head", 1.0).moving(velocity));
        let ground = network.ground();
        let tether = Model::series([spring(1.9e4), dashpot(100.0)]);
        let models = [("pad", spring(2e4)), ("tether", tether)];
        for ((name, model), swapped) in models.into_iter().zip(swapped) {
            let ends: [NodeId; 2] = if swapped { [ground, head] } else { [head, ground] };
            network.connect(name, ends[0], ends[1], model);
        }
        run(&network, "exact")
    };
    for velocity in [2.0, -2.0] {
        let plain = tethered([false, false], velocity);
        for swapped in [[false, true], [true, false], [true, true]] {
            let other = tethered(swapped, velocity);
            for key in ["head.peak-acceleration", "head.severity-index"] {
                let (a, b) = (value(&plain, key), value(&other, key));
                assert!(is_same(a, b), "{key} {swapped:?} at {velocity} m/s: {a} against {b}");
            }
        }
    }
}

/// A head on a pad, with a massless plate and a further mass that are rigidly linked to it or left
/// out.
fn plated(linked: bool) -> Network {
    let mut network = Network::new();
    let ground = network.ground();
    let mass = if linked { 1.0 } else { 1.5 };
    let head = network.add_node(Node::mass("head", mass).moving(2.0));
    let mut face = head;
    if linked {
        face = network.add_node(Node::mass("plate", 0.0));
        let tail = network.add_node(Node::mass("tail", 0.5).moving(2.0));
        network.connect("bolt", head, face, part(Rigid));
        network.connect("rod", tail, face, part(Rigid));
    }
    network.connect("pad", face, ground, kelvin(1e4, 30.0));
    network
}

#[test]
fn pad_behind_rigid_links_is_reported_as_if_there_were_none() {
    for (method, tolerance) in [("exact", 1e-9), ("bdf", 1e-3)] {
        let (plain, linked) = (run(&plated(false), method), run(&plated(true), method));
        for key in ["peak-force", "peak-deformation", "contact-time", "impulse", "energy"] {
            let key = format!("pad.{key}");
            let (a, b) = (value(&plain, &key), value(&linked, &key));
            assert!((a - b).abs() <= tolerance * a, "{method} {key}: {a} against {b}");
        }
        let severity = |report: &RunReport| value(report, "head.severity-index");
        let (a, b) = (severity(&plain), severity(&linked));
        assert!((a - b).abs() <= tolerance * a, "{method}: {a} against {b}");
        let hidden = |name: &str| linked.measures.iter().all(|measure| measure.target != name);
        assert!(hidden("bolt") && hidden("rod"));
        assert_eq!(linked.contacts.len(), 1);
    }
}
