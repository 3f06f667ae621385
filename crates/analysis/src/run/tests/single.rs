//! Runs of one solution, of whose errors nothing is known.

use dashpot_network::{Model, Network, Node, elements::PiecewiseSpring, part, spring};

use crate::{RunReport, Solve, SolveSettings, Warning};

fn once(pad: Model) -> RunReport {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 5.0).moving(3.0));
    let ground = network.ground();
    network.connect("pad", head, ground, pad);
    let settings = SolveSettings::lasting(0.04).by_name("bdf").unwrap();
    let settings = SolveSettings { estimate: false, rtol: Some(1e-5), ..settings };
    network.solve_with(&settings).unwrap()
}

#[test]
fn a_pull_that_may_be_an_error_is_told_with_the_measures_that_hang_on_it() {
    // On 5 N/m up to 2 mm and 100 kN/m beyond: it leaves after twice 2 mm at 3 m/s and half an oscillation, and pulls by
    // less than a thousandth of the largest force then.
    let toe = PiecewiseSpring::new(vec![(0.0, 0.0), (0.002, 0.01), (0.022, 2000.01)]).unwrap();
    let report = once(part(toe));
    let told = report.warnings.iter().find_map(|own| match own {
        Warning::OpenEnd { time, measures, is_covered: false } => Some((*time, measures)),
        _ => None,
    });
    let (time, measures) = told.expect("it is open where the impact ends");
    let release = 2.0 * 0.002 / 3.0 + std::f64::consts::PI * f64::sqrt(5.0 / 1e5);
    assert!((time / release - 1.0).abs() < 1e-3, "{time} {release}");
    assert!(measures.iter().any(|own| own == "pad.contact-time"), "{measures:?}");
    // What goes straight through zero is not open.
    let plain = once(spring(1e5));
    assert!(plain.warnings.iter().all(|own| own.code() != "open-end"), "{:?}", plain.warnings);
}
