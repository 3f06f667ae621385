//! What a padding passes on, beside what it carries itself.

use dashpot_network::{
    Network, Node,
    effects::{Face, Gravity, GravityStart, Separation, Stop, Touch},
    elements::Spring,
    part,
};

use super::*;
use crate::{MeasureWish, RunReport, Solve, SolveSettings};

const MASS: f64 = 2.0;
const STIFFNESS: f64 = 5e4;

/// A mass on a spring against the ground.
fn padded(speed: f64) -> Network {
    let mut network = Network::new();
    let start = Node::mass("head", MASS);
    let head = network.add_node(if speed == 0.0 { start } else { start.moving(speed) });
    let ground = network.ground();
    network.connect("pad", head, ground, part(Spring { stiffness: STIFFNESS }));
    network
}

fn stop(at: f64, stiffness: Option<f64>) -> Stop {
    Stop { element: "pad".to_owned(), at: Some(at), restitution: 0.0, stiffness, damping: 0.0 }
}

fn separation(at: &str) -> Separation {
    Separation { element: "pad".to_owned(), at: Some(at.to_owned()), restitution: 0.0 }
}

fn face(at: &str, mass: f64, touch: Touch) -> Face {
    Face { element: "pad".to_owned(), mass, at: Some(at.to_owned()), touch }
}

fn solved(network: &Network, duration: f64, method: &str) -> RunReport {
    let mut settings = SolveSettings::lasting(duration).by_name(method).unwrap();
    settings.measures.push(MeasureWish::new("pad", TransmittedForce::default()));
    network.solve_with(&settings).unwrap()
}

fn is(report: &RunReport, key: &str, expected: f64) {
    let found = report.measure(key).unwrap();
    let (value, error) = (found.value.unwrap(), found.error.unwrap());
    assert!((value - expected).abs() <= error, "{key} is {value} ± {error}, not {expected}");
    assert!(error < 2e-3 * expected, "{key}: {error}");
}

#[test]
fn transmitted_force_includes_the_stop_that_bypasses_the_padding() {
    // Springs alone: the energy tells the depth, ½ m v² = ½ k x² + ½ k_s (x − d)².
    let (speed, at, stiffness) = (3.0_f64, 0.01_f64, 4e5_f64);
    let both = STIFFNESS + stiffness;
    let middle = stiffness * at / both;
    let rest = (MASS * speed * speed - stiffness * at * at) / both;
    let depth = middle + (middle * middle + rest).sqrt();
    for method in ["exact", "bdf"] {
        let mut network = padded(speed);
        network.add_effect(stop(at, Some(stiffness)));
        let report = solved(&network, 0.03, method);
        is(&report, "pad.peak-deformation", depth);
        is(&report, "pad.peak-force", STIFFNESS * depth);
        is(&report, "pad.transmitted-force", STIFFNESS * depth + stiffness * (depth - at));
    }
}

#[test]
fn transmitted_force_is_the_peak_force_without_a_bypass() {
    let mut network = padded(3.0);
    network.add_effect(separation("head"));
    let report = solved(&network, 0.03, "exact");
    let expected = 3.0 * (STIFFNESS * MASS).sqrt();
    is(&report, "pad.peak-force", expected);
    is(&report, "pad.transmitted-force", expected);
}

#[test]
fn transmitted_force_bears_all_weights_whatever_carries_them() {
    let g = 10.0;
    // Sags by 0.4 mm without the stop, which takes what is beyond 0.3 mm, and by 0.5 mm with a face.
    for (at, has_face) in [(1.0, false), (3e-4, false), (3e-4, true), (1.0, true)] {
        let mut network = padded(0.0);
        network.add_effect(Gravity { acceleration: g, start: GravityStart::Equilibrium });
        network.add_effect(separation("head"));
        network.add_effect(stop(at, None));
        let mut weight = MASS * g;
        if has_face {
            network.add_effect(face("head", 0.5, Touch::Impact));
            weight += 0.5 * g;
        }
        let report = solved(&network, 0.03, "exact");
        is(&report, "pad.transmitted-force", weight);
        is(&report, "pad.peak-force", weight.min(STIFFNESS * at));
    }
}

#[test]
fn transmitted_force_of_a_face_on_the_support_is_that_of_its_contact() {
    let g = 10.0;
    for separates in [false, true] {
        let mut network = padded(0.0);
        network.add_effect(Gravity { acceleration: g, start: GravityStart::Equilibrium });
        if separates {
            network.add_effect(separation("ground"));
        }
        network.add_effect(face("ground", 0.5, Touch::Impact));
        let report = solved(&network, 0.03, "exact");
        is(&report, "pad.peak-force", MASS * g);
        is(&report, "pad.transmitted-force", (MASS + 0.5) * g);
    }
}

#[test]
fn transmitted_force_is_infinite_where_a_rigid_stop_is_hit() {
    let mut network = padded(3.0);
    network.add_effect(stop(0.01, None));
    let report = solved(&network, 0.03, "exact");
    let found = report.measure("pad.transmitted-force").unwrap();
    assert_eq!(found.value, None);
    assert!(found.note().unwrap().starts_with("infinite (speed jumps at "));
    assert!(report.measure("pad.peak-force").unwrap().value.is_some());
}
