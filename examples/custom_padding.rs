//! A padding of one's own: a stiff shell in front of a foam that is a Zener element beside a slow
//! Maxwell branch, nested as deep as the material asks for.
//!
//! `cargo run --example custom_padding`
#![allow(
    clippy::print_stdout,
    missing_docs,
    unreachable_pub,
    reason = "an example shows its result"
)]

use std::error::Error;

use dashpot::{
    analysis::Solve,
    network::{Model, Network, Node, dashpot, spring},
    rheology::Branch,
};

pub fn main() -> Result<(), Box<dyn Error>> {
    let shell = spring(2e6) | dashpot(200.0);
    // Names instead of numbers, for the parts to be found by in the report.
    let foam = Model::Parallel(vec![
        Branch::new("skeleton", spring(60e3)),
        Branch::new("fast", spring(150e3) + dashpot(300.0)),
        Branch::new("slow", spring(40e3) + dashpot(4e3)),
    ]);
    let pad = Model::Series(vec![Branch::new("shell", shell), Branch::new("foam", foam)]);

    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 5.0).dropped(1.5));
    network.connect("helmet", head, network.ground(), pad).thickness = Some(0.08);
    let report = network.solve(0.05)?;

    println!("peak          {:6.1} g", report.value("head.peak-acceleration")? / 9.806_65);
    println!("deepest       {:6.1} mm of 80 mm", 1e3 * report.value("helmet.peak-deformation")?);
    println!("severity      {:6.0} s", report.value("head.severity-index")?);
    for (name, energy) in &report.energy.dissipated {
        println!("{name:<28} {energy:6.2} J");
    }
    let lost: f64 = report.energy.dissipated.iter().map(|(_, energy)| energy).sum();
    let start = 5.0 * 9.806_65 * 1.5;
    assert!(lost > 0.3 * start && lost < start, "the foam takes up {lost} J of {start} J");
    assert!(report.energy.closure().abs() < 1e-9);
    Ok(())
}
