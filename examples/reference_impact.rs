//! The thesis' reference impact, built in Rust and solved by two methods.
//!
//! A head of 10 kg at 10 m/s on 2 cm of Valox 310 over a car panel of 100 kg.
//! `cargo run --example reference_impact`
#![allow(
    clippy::print_stdout,
    missing_docs,
    unreachable_pub,
    reason = "an example shows its result"
)]

use std::error::Error;

use dashpot::{
    analysis::{SolveSettings, differences, solve},
    dae::Silent,
    network::{
        Network, Node,
        elements::{Dashpot, Spring},
        part,
    },
    rheology::Tree,
};

pub fn main() -> Result<(), Box<dyn Error>> {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 10.0).moving(10.0));
    let panel = network.add_node(Node::mass("panel", 100.0));
    let burgers = Tree::series([
        part(Spring { stiffness: 20e6 }),
        part(Dashpot { damping: 6e3 }),
        Tree::parallel([part(Spring { stiffness: 20e6 }), part(Dashpot { damping: 4e3 })]),
    ]);
    network.connect("padding", head, panel, burgers).thickness = Some(0.02);
    let mount = Tree::parallel([part(Spring { stiffness: 50e6 }), part(Dashpot { damping: 10e3 })]);
    network.connect("mount", panel, network.ground(), mount);

    let settings = SolveSettings::lasting(0.02);
    let exact = solve(&network, &settings.clone().by_name("exact")?, &mut Silent)?;
    let bdf = solve(&network, &settings.by_name("bdf")?, &mut Silent)?;
    for measure in &exact.measures {
        if let Some(value) = measure.value {
            println!("{:<28} {value:>16.9} {}", measure.key, measure.unit);
        }
    }
    for difference in differences(&exact, &bdf) {
        println!(
            "{:<28} differs by {:.1e} between exact and bdf",
            difference.key, difference.relative
        );
    }
    let peak = exact.measure("padding.peak-force").and_then(|force| force.value);
    assert!((peak.unwrap_or(0.0) - 38_359.411_601).abs() < 1e-6);
    Ok(())
}
