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
    analysis::{SolveSettings, solve},
    dae::Silent,
    network::{
        Model, Network, Node,
        elements::{Dashpot, Spring},
        part,
    },
    rheology::{Branch, Tree},
};

fn maxwell(stiffness: f64, damping: f64) -> Model {
    Tree::Series(vec![
        Branch::new("spring", part(Spring { stiffness })),
        Branch::new("dashpot", part(Dashpot { damping })),
    ])
}

pub fn main() -> Result<(), Box<dyn Error>> {
    let shell = Tree::Parallel(vec![
        Branch::new("spring", part(Spring { stiffness: 2e6 })),
        Branch::new("dashpot", part(Dashpot { damping: 200.0 })),
    ]);
    let foam = Tree::Parallel(vec![
        Branch::new("skeleton", part(Spring { stiffness: 60e3 })),
        Branch::new("fast", maxwell(150e3, 300.0)),
        Branch::new("slow", maxwell(40e3, 4e3)),
    ]);
    let pad = Tree::Series(vec![Branch::new("shell", shell), Branch::new("foam", foam)]);

    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 5.0).dropped(1.5));
    network.connect("helmet", head, network.ground(), pad).thickness = Some(0.08);
    let report = solve(&network, &SolveSettings::lasting(0.05), &mut Silent)?;

    let value = |key: &str| report.measure(key).and_then(|m| m.value).ok_or(key.to_owned());
    println!("peak          {:6.1} g", value("head.peak-acceleration")? / 9.806_65);
    println!("deepest       {:6.1} mm of 80 mm", 1e3 * value("helmet.peak-deformation")?);
    println!("severity      {:6.0} s", value("head.severity-index")?);
    for (name, energy) in &report.energy.dissipated {
        println!("{name:<28} {energy:6.2} J");
    }
    let lost: f64 = report.energy.dissipated.iter().map(|(_, energy)| energy).sum();
    let start = 5.0 * 9.806_65 * 1.5;
    assert!(lost > 0.3 * start && lost < start, "the foam takes up {lost} J of {start} J");
    assert!(report.energy.closure().abs() < 1e-9);
    Ok(())
}
