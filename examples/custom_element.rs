//! An element of one's own from its force law alone: the built-in power-law spring, written as a
//! function, and a foam that stiffens with the rate.
//!
//! `cargo run --example custom_element`
#![allow(
    clippy::print_stdout,
    missing_docs,
    unreachable_pub,
    reason = "an example shows its result"
)]

use std::error::Error;

use dashpot::{
    analysis::{RunReport, Solve},
    network::{
        Model, Network, Node,
        elements::{Custom, PowerSpring},
    },
};

/// 5 kg at 4 m/s.
fn struck(pad: impl Into<Model>) -> Result<RunReport, Box<dyn Error>> {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 5.0).moving(4.0));
    network.connect("pad", head, network.ground(), pad);
    Ok(network.solve(0.05)?)
}

pub fn main() -> Result<(), Box<dyn Error>> {
    let built_in = struck(PowerSpring { force: 2000.0, at: 0.01, exponent: 1.5 })?;
    let own =
        struck(Custom::new("hertz", |y, _| 2000.0 * (100.0 * y.abs()).powf(1.5) * y.signum()))?;
    for key in ["pad.peak-force", "pad.peak-deformation", "pad.contact-time"] {
        let of = |report: &RunReport| report.measure(key).and_then(|own| own.error).unwrap_or(0.0);
        let (one, other, error) = (own.value(key)?, built_in.value(key)?, of(&own) + of(&built_in));
        println!("{key:<22} {one:.6}, built in {other:.6}, errors {error:.1e}");
        assert!((one - other).abs() <= error, "{key}: {one} is not {other} ± {error}");
    }

    // What it takes up beyond its force at rest is dissipated, and the energy closes.
    let foam = |y: f64, v: f64| 3e4 * y + 2e7 * y.powi(3) + 60.0 * v + 20.0 * v.powi(3);
    let report = struck(Custom::new("my-foam", foam))?;
    let lost: f64 = report.energy.dissipated.iter().map(|(_, energy)| energy).sum();
    println!("peak {:.1} N, {lost:.2} J of 40 J lost", report.value("pad.peak-force")?);
    assert!(lost > 1.0 && lost < 39.0, "{lost} J");
    assert!(report.energy.closure().abs() < 1e-3);
    Ok(())
}
