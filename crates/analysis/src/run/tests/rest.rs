//! What begins in balance stays at rest, on springs that are linear and on those that are not.

use std::sync::Arc;

use dashpot_network::{
    Element, Model, Network, Node,
    effects::{Gravity, GravityStart, Separation},
    elements::{
        CubicSpring, Foam, HuntCrossley, HystereticFoam, PowerDashpot, PowerSpring, Spring,
        StiffeningSpring, TableSpring,
    },
    parameters::Kind as _,
    part,
};
use dashpot_rheology::Tree;

use crate::Solve;

const G: f64 = 9.81;

fn leaf(element: &Arc<dyn Element>) -> Model {
    Tree::Part(Arc::clone(element))
}

/// A parcel of this mass \[kg\] on a pad from which it can part.
fn parcel(mass: f64, pad: Model) -> Network {
    let mut network = Network::new();
    let parcel = network.add_node(Node::mass("parcel", mass));
    let ground = network.ground();
    network.connect("pad", parcel, ground, pad);
    network.add_effect(Separation { element: "pad".to_owned(), at: None, restitution: 0.0 });
    network.add_effect(Gravity { acceleration: G, start: GravityStart::Equilibrium });
    network
}

fn laws() -> Vec<Arc<dyn Element>> {
    vec![
        Arc::new(Spring { stiffness: 2e4 }),
        Arc::new(PowerSpring::sample()),
        Arc::new(PowerSpring { force: 10.0, at: 0.001, exponent: 4.0 }),
        Arc::new(CubicSpring::sample()),
        Arc::new(CubicSpring { stiffness: 0.0, cubic: 1e9 }),
        Arc::new(StiffeningSpring { stiffness: 10.0, limit: 0.02 }),
        Arc::new(TableSpring::sample()),
        Arc::new(Foam::sample()),
        Arc::new(Foam { plateau: 20.0, ..Foam::sample() }),
    ]
}

/// A speed \[m/s\] that is rounding: some hundred steps, each of them exact to 2e-16 of the 5 m/s that free fall would give.
const AT_REST: f64 = 1e-12;

/// Largest speed of a node over half a second \[m/s\], and the force of its pad at the start \[N\].
fn unrest(network: &Network, node: &str) -> (f64, f64, usize) {
    let report = network.solve(0.5).unwrap();
    let solution = report.solution();
    let output = |name: &str| solution.signal(report.assembly.output(name).unwrap());
    let speed = output(&format!("{node}.velocity")).bound();
    (speed, output("pad.force").value(0.0), report.trajectory.switches.len())
}

#[test]
fn parcel_rests_on_any_spring_from_the_start() {
    for law in laws() {
        for pad in [leaf(&law), Tree::parallel([leaf(&law), part(PowerDashpot::sample())])] {
            let (speed, force, switches) = unrest(&parcel(5.0, pad), "parcel");
            assert!(speed <= AT_REST, "{}: {speed:e}", law.kind());
            assert!((force / (5.0 * G) - 1.0).abs() <= 1e-12, "{}: {force}", law.kind());
            assert_eq!(switches, 0, "{}", law.kind());
        }
    }
}

#[test]
fn laws_that_push_only_carry_beside_a_dashpot() {
    let laws: [Arc<dyn Element>; 2] =
        [Arc::new(HuntCrossley::sample()), Arc::new(HystereticFoam::sample())];
    for law in laws {
        let pad = Tree::parallel([leaf(&law), part(PowerDashpot::sample())]);
        let (speed, force, _) = unrest(&parcel(5.0, pad), "parcel");
        assert!(speed <= AT_REST, "{}: {speed:e}", law.kind());
        assert!((force / (5.0 * G) - 1.0).abs() <= 1e-12, "{}: {force}", law.kind());
    }
}

#[test]
fn springs_in_series_each_carry_what_lies_above() {
    // 3 kg on a cubic spring on 2 kg on a foam and a linear spring side by side.
    let mut network = Network::new();
    let upper = network.add_node(Node::mass("upper", 3.0));
    let lower = network.add_node(Node::mass("lower", 2.0));
    let ground = network.ground();
    network.connect("top", upper, lower, part(CubicSpring { stiffness: 0.0, cubic: 1e9 }));
    let pad = [part(Foam { plateau: 20.0, ..Foam::sample() }), part(Spring { stiffness: 1e3 })];
    network.connect("pad", lower, ground, Tree::parallel(pad));
    network.add_effect(Gravity { acceleration: G, start: GravityStart::Equilibrium });
    let report = network.solve(0.1).unwrap();
    let solution = report.solution();
    let at_start = |name: &str| solution.signal(report.assembly.output(name).unwrap()).value(0.0);
    let closed = (3.0 * G / 1e9).cbrt();
    assert!((at_start("top.deformation") / closed - 1.0).abs() < 1e-12);
    assert!((at_start("pad.force") / (5.0 * G) - 1.0).abs() < 1e-12);
    for node in ["upper", "lower"] {
        let speed = solution.signal(report.assembly.output(&format!("{node}.velocity")).unwrap());
        assert!(speed.bound() <= AT_REST, "{node}: {:e}", speed.bound());
    }
}

#[test]
fn weight_that_a_law_cannot_carry_is_refused_by_name() {
    // It pushes only, and the parcel hangs on it; a dashpot carries nothing at rest.
    let hanging = Tree::parallel([part(HuntCrossley::sample()), part(PowerDashpot::sample())]);
    for (pad, is_reversed) in [(hanging, true), (part(PowerDashpot::sample()), false)] {
        let mut network = Network::new();
        let parcel = network.add_node(Node::mass("parcel", 5.0));
        let ground = network.ground();
        let [a, b] = if is_reversed { [ground, parcel] } else { [parcel, ground] };
        network.connect("pad", a, b, pad);
        network.add_effect(Gravity { acceleration: G, start: GravityStart::Equilibrium });
        let errors = network.compile(0.1).unwrap_err().to_string();
        assert!(errors.contains("`parcel` cannot start in balance"), "{errors}");
    }
}
