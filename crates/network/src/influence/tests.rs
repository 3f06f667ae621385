//! Influences against the formulas by hand.

use dashpot_rheology::Tree;

use super::Detail;
use crate::{
    Network, Node, Situation, Start,
    effects::{EffectKind as _, Face, Gravity, GravityStart, Separation, Stop, Touch},
    elements::{Dashpot, Spring},
    layers::{Layer, Layers, Resolution},
    part,
};

/// 10 kg at 10 m/s on a spring of 4 MN/m, 2 cm thick, over 100 kg on 50 MN/m beside 10 kN s/m.
fn impact() -> Network {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 10.0).moving(10.0));
    let panel = network.add_node(Node::mass("panel", 100.0));
    let spring = part(Spring { stiffness: 4e6 });
    network.connect("padding", head, panel, spring).thickness = Some(0.02);
    let mount = Tree::parallel([part(Spring { stiffness: 5e7 }), part(Dashpot { damping: 1e4 })]);
    network.connect("mount", panel, network.ground(), mount);
    network
}

fn gravity() -> Gravity {
    Gravity { acceleration: 9.81, start: GravityStart::Equilibrium }
}

fn face(mass: f64) -> Face {
    Face { element: "padding".to_owned(), mass, at: None, touch: Touch::Moving }
}

fn separation() -> Separation {
    Separation { element: "padding".to_owned(), at: None, restitution: 0.0 }
}

fn stop(at: Option<f64>) -> Stop {
    let element = "padding".to_owned();
    Stop { element, at, restitution: 0.0, stiffness: None, damping: 0.0 }
}

/// The numbers of all details by name, in a run of 20 ms.
fn numbers(network: &Network) -> Vec<(String, f64)> {
    let situation = Situation::of(network, 0.02);
    let all = Detail::all(network).into_iter();
    let with_name = |detail: Detail| {
        let influences = detail.influences(&situation).into_iter();
        influences.map(move |influence| (detail.name(network), influence.value)).collect::<Vec<_>>()
    };
    all.flat_map(with_name).collect()
}

fn number(network: &Network, name: &str) -> f64 {
    let found = numbers(network);
    found.iter().find(|own| own.0 == name).unwrap_or_else(|| panic!("{name} in {found:?}")).1
}

fn assert_close(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-12 * expected.abs(), "{found}, not {expected}");
}

#[test]
fn gravity_is_the_group_a_of_the_thesis() {
    let mut network = impact();
    network.add_effect(gravity());
    assert_close(number(&network, "gravity"), 9.81 * 0.02 / 100.0);
    network.add_effect(face(2.5));
    // It acts on m2 as well, so that ζ″ = g δ/V0² − B φ.
    assert_close(number(&network, "gravity"), 9.81 * 0.02 / 100.0);
    assert_close(number(&network, "face.padding"), 0.25);
}

#[test]
fn without_thickness_the_depth_takes_its_place() {
    let mut network = impact();
    network.connections[0].thickness = None;
    network.add_effect(gravity());
    let depth = 10.0 * (10.0_f64 / 4e6).sqrt();
    assert_close(number(&network, "gravity"), 9.81 * depth / 100.0);
}

#[test]
fn a_stop_counts_by_what_is_beyond_it() {
    let depth = 10.0 * (10.0_f64 / 4e6).sqrt();
    let mut network = impact();
    network.add_effect(stop(Some(0.5 * depth)));
    assert_close(number(&network, "stop.padding"), 0.5);
    let mut network = impact();
    network.add_effect(stop(None));
    assert!(number(&network, "stop.padding").abs() < f64::EPSILON, "{depth} is less than 2 cm");
}

#[test]
fn separation_counts_by_what_is_left_of_the_run() {
    let mut network = impact();
    network.add_effect(separation());
    let contact = std::f64::consts::PI * (10.0_f64 / 4e6).sqrt();
    assert_close(number(&network, "separation.padding"), 1.0 - contact / 0.02);
}

#[test]
fn a_support_counts_by_the_groups_of_the_thesis() {
    // J = 2 ms: J² |K* + i C3/J|/m3 with β = 2 and α = 0.2.
    let held = 2.0_f64.hypot(0.2);
    assert_close(number(&impact(), "compliance of panel"), 0.1 / (1.0 + held));
}

#[test]
fn mass_of_layers_counts_by_the_passage_of_a_wave() {
    let mut network = impact();
    let model = part(Spring { stiffness: 4e6 });
    let layer =
        Layer { name: "felt".to_owned(), thickness: 0.02, area: 0.05, density: 100.0, model };
    let layers = Layers { all: vec![layer], resolution: Resolution::Segments(4) };
    network.connections[0].model = layers.model();
    network.connections[0].layers = Some(layers);
    // √(m/K) over √(m1/K).
    assert_close(number(&network, "inertia of padding"), (0.1_f64 / 10.0).sqrt());
    let network = network.without(&[Detail::Inertia(0)]);
    assert!(!Detail::all(&network).contains(&Detail::Inertia(0)));
    assert_eq!(network.compile(0.02).unwrap().system.states(), 4);
}

#[test]
fn a_fall_is_the_work_of_gravity() {
    let mut network = impact();
    network.nodes[1].start = Start::Drop(1.5);
    network.add_effect(gravity());
    assert_close(number(&network, "gravity"), 9.81 * 0.02 / (2.0 * 9.81 * 1.5));
    network.add_effect(separation());
    assert_close(number(&network, "gravity"), 1.0);
}

#[test]
fn a_dropped_mass_keeps_its_speed_without_gravity() {
    let mut network = impact();
    network.nodes[1].start = Start::Drop(1.5);
    network.add_effect(Gravity { acceleration: 1.62, ..gravity() });
    let without = network.without(&[Detail::Effect(0)]);
    assert!(without.effects().is_empty());
    assert_eq!(without.nodes[1].start, Start::Velocity((2.0 * 1.62 * 1.5_f64).sqrt()));
}

#[test]
fn numbers_of_effects_that_are_off_are_those_of_their_defaults() {
    let network = impact();
    let situation = Situation::of(&network, 0.02);
    assert_eq!(Gravity::would_be(&situation).len(), 1);
    assert_eq!(Separation::would_be(&situation), [separation()]);
    assert_eq!(Stop::would_be(&situation), [stop(None)]);
    assert_eq!(Face::would_be(&situation), []);
}

#[test]
fn without_a_scale_there_is_no_number() {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 10.0));
    network.connect("padding", head, network.ground(), part(Dashpot { damping: 1e3 }));
    network.add_effect(separation());
    network.add_effect(stop(Some(0.01)));
    assert_eq!(numbers(&network), []);
    network.add_effect(gravity());
    assert_close(number(&network, "gravity"), 1.0);
}
