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
    analysis::{Solve, SolveSettings, differences},
    network::{Network, Node, dashpot, spring},
};

pub fn main() -> Result<(), Box<dyn Error>> {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 10.0).moving(10.0));
    let panel = network.add_node(Node::mass("panel", 100.0));
    let burgers = spring(20e6) + dashpot(6e3) + (spring(20e6) | dashpot(4e3));
    network.connect("padding", head, panel, burgers).thickness = Some(0.02);
    network.connect("mount", panel, network.ground(), spring(50e6) | dashpot(10e3));

    let settings = SolveSettings::lasting(0.02);
    let exact = network.solve_with(&settings.clone().by_name("exact")?)?;
    let bdf = network.solve_with(&settings.by_name("bdf")?)?;
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
    assert!((exact.value("padding.peak-force")? - 38_359.411_601).abs() < 1e-6);
    Ok(())
}
