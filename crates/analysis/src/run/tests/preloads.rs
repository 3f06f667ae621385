//! Preloads, and the energy of springs whose straight lines are phases.

use dashpot_network::{
    Model, Network, Node, dashpot,
    effects::{Gravity, GravityStart},
    elements::{PiecewiseSpring, PreloadedSpring},
    part,
};

use crate::{RunReport, Solve, SolveSettings, Warning};

const G: f64 = 9.81;

fn bent() -> PiecewiseSpring {
    PiecewiseSpring::new(vec![(0.0, 0.0), (0.002, 40.0), (0.02, 4e3)]).unwrap()
}

fn preloaded(preload: f64) -> Model {
    part(PreloadedSpring { stiffness: 2e4, preload })
}

/// A body of 2 kg on these pads, all towards the ground.
fn body(node: Node, pads: Vec<Model>) -> Network {
    let mut network = Network::new();
    let body = network.add_node(node);
    let ground = network.ground();
    for (at, pad) in pads.into_iter().enumerate() {
        network.connect(format!("pad-{at}"), body, ground, pad);
    }
    network
}

fn solved(network: &Network, method: &str) -> RunReport {
    let settings = SolveSettings::lasting(0.03).by_name(method).unwrap();
    network.solve_with(&settings).unwrap()
}

#[test]
fn what_straight_lines_store_is_told_with_its_error() {
    let head = || Node::mass("head", 2.0).moving(3.0);
    let lost = Model::parallel([part(bent()), dashpot(100.0)]);
    for (pad, is_elastic) in [(part(bent()), true), (lost, false)] {
        let report = solved(&body(head(), vec![pad]), "exact");
        let measure = report.measure("pad-0.energy").unwrap();
        let (value, error) = (measure.value.unwrap(), measure.error.unwrap());
        assert!(error < 1e-9, "{measure:?}");
        let solution = report.solution();
        let end = measure.time.unwrap_or_else(|| measure.window.unwrap().1);
        let speed = solution.signal(report.assembly.nodes[1].velocity.unwrap()).left_value(end);
        // What the head has lost, as the pad holds nothing where its force is zero.
        let kinetic = 9.0 - speed * speed;
        assert!((value - kinetic).abs() <= error + 1e-9, "{value} {kinetic} {error}");
        assert!(!is_elastic || value.abs() <= error, "{measure:?}");
        let dissipated = report.energy.dissipated.iter().map(|own| own.0.as_str());
        assert_eq!(dissipated.count(), usize::from(!is_elastic));
    }
}

/// The elements whose preload nothing holds.
fn loose(report: &RunReport) -> Vec<(&str, f64)> {
    let loose = report.warnings.iter().filter_map(|own| match own {
        Warning::LoosePreload { element, preload, .. } => Some((element.as_str(), *preload)),
        _ => None,
    });
    loose.collect()
}

#[test]
fn a_preload_that_nothing_holds_is_told() {
    let rest = || Node::mass("body", 2.0);
    let alone = solved(&body(rest(), vec![preloaded(200.0)]), "exact");
    assert_eq!(loose(&alone), [("pad-0", 200.0)]);
    let struck = body(rest().moving(1.0), vec![preloaded(200.0)]);
    assert_eq!(loose(&solved(&struck, "exact")), [("pad-0", 200.0)]);
    // Two that hold each other.
    let both = body(rest(), vec![preloaded(200.0), preloaded(-200.0)]);
    assert_eq!(loose(&solved(&both, "exact")), []);
    // One that bears the weight, from where it is in balance or because it is as large.
    for (preload, start) in [(200.0, GravityStart::Equilibrium), (2.0 * G, GravityStart::Unloaded)]
    {
        let mut borne = body(rest(), vec![preloaded(preload)]);
        borne.add_effect(Gravity { acceleration: G, start });
        assert_eq!(loose(&solved(&borne, "exact")), [], "{preload}");
    }
    // A spring that begins at its rest has none.
    assert_eq!(loose(&solved(&body(rest().moving(1.0), vec![part(bent())]), "exact")), []);
}
