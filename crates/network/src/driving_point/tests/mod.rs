mod agreement;
mod judge;
mod massive;
mod massless;
mod reference;

use super::{Massless, Receptance, Response};
use crate::{Model, Network, Node, NodeId, dashpot, spring};
use dashpot_numerics::Stream;
use dashpot_rheology::{LinearModel, Tree};

fn kelvin(stiffness: f64, damping: f64) -> Model {
    Tree::parallel([spring(stiffness), dashpot(damping)])
}

fn maxwell(stiffness: f64, damping: f64) -> Model {
    Tree::series([spring(stiffness), dashpot(damping)])
}

fn massless(network: &Network, a: NodeId, b: NodeId) -> Massless {
    match network.driving_point(a, b).unwrap() {
        Response::Massless(found) => found,
        Response::Massive(_) => panic!("a mass moves"),
    }
}

fn massive(network: &Network, a: NodeId, b: NodeId) -> Receptance {
    match network.driving_point(a, b).unwrap() {
        Response::Massive(found) => found,
        Response::Massless(_) => panic!("no mass moves"),
    }
}

/// A network of nodes `1..` with the given masses, node 0 being the ground.
fn network(masses: &[f64], links: &[(usize, usize, Model)]) -> (Network, Vec<NodeId>) {
    let mut network = Network::new();
    let mut nodes = vec![network.ground()];
    for (at, &mass) in masses.iter().enumerate() {
        nodes.push(network.add_node(Node::mass(format!("n{}", at + 1), mass)));
    }
    for (at, (p, q, model)) in links.iter().enumerate() {
        network.connect(format!("e{at}"), nodes[*p], nodes[*q], model.clone());
    }
    (network, nodes)
}

fn near(a: f64, b: f64, tolerance: f64) -> bool {
    (a - b).abs() <= tolerance * a.abs().max(b.abs())
}

/// Kelvin forms that agree in every constant.
fn assert_same(a: &LinearModel, b: &LinearModel, tolerance: f64) {
    let (a, b) = (a.kelvin().unwrap(), b.kelvin().unwrap());
    assert!(near(a.spring_compliance(), b.spring_compliance(), tolerance));
    assert!(near(a.fluidity(), b.fluidity(), tolerance));
    let (a, b) = (a.elements(), b.elements());
    assert_eq!(a.len(), b.len(), "{a:?} {b:?}");
    for (a, b) in a.iter().zip(&b) {
        assert!(near(a.rate.high(), b.rate.high(), tolerance), "{a:?} {b:?}");
        assert!(near(a.compliance, b.compliance, tolerance), "{a:?} {b:?}");
    }
}

/// A factor within so many decades around 1.
fn around(stream: &mut Stream, count: f64) -> f64 {
    10_f64.powf(count * (stream.share() - 0.5))
}
