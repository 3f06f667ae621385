//! A padding of fibres in the reference impact, in place of its Burgers element: a bell of
//! retardation times, in the fewest Kelvin–Voigt elements that keep its creep within 0.002 %.
//!
//! `cargo run --example fibre_padding`
#![allow(
    clippy::print_stdout,
    missing_docs,
    unreachable_pub,
    reason = "an example shows its result"
)]

use std::error::Error;

use dashpot::{
    analysis::{Solve, SolveSettings, differences},
    network::{
        Network, Node,
        composites::{CompositeKind, LogNormalFibre},
        dashpot, linear_model, spring,
    },
};

pub fn main() -> Result<(), Box<dyn Error>> {
    let (stiffness, damping, retardation_time) = (20e6, 6e3, 2e-4_f64);
    let fibre = LogNormalFibre {
        compliance: 1.0 / stiffness,
        time: retardation_time,
        width: 1.0,
        from: 1e-6,
        to: 0.1,
        error: 2e-5,
    };
    let fibre = fibre.compose()?;
    if let Some(note) = &fibre.note {
        println!("{note}");
    }
    let padding = spring(stiffness) + dashpot(damping) + fibre.model;
    let linear = linear_model(&padding);
    let kelvin = linear.kelvin().ok_or("the padding bears no force")?;
    assert_eq!(kelvin.elements().len(), 12);
    println!("   t/ms   creep of the fibres   creep of one Kelvin element [nm/N]");
    for time in [0.02e-3_f64, 0.2e-3, 2e-3, 20e-3] {
        let fibres = linear.creep(time) - 1.0 / stiffness - time / damping;
        let one = -(-time / retardation_time).exp_m1() / stiffness;
        println!("{:7.2}   {:19.2}   {:27.2}", 1e3 * time, 1e9 * fibres, 1e9 * one);
    }

    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 10.0).moving(10.0));
    let panel = network.add_node(Node::mass("panel", 100.0));
    network.connect("padding", head, panel, padding).thickness = Some(0.02);
    network.connect("mount", panel, network.ground(), spring(50e6) | dashpot(10e3));
    let settings = SolveSettings::lasting(0.02);
    let exact = network.solve_with(&settings.clone().by_name("exact")?)?;
    let bdf = network.solve_with(&settings.by_name("bdf")?)?;
    println!("peak force {:.3} kN", 1e-3 * exact.value("padding.peak-force")?);
    println!("deepest    {:.3} mm", 1e3 * exact.value("padding.peak-deformation")?);
    for difference in differences(&exact, &bdf) {
        println!("{:<28} {:.1e} between exact and bdf", difference.key, difference.relative);
        assert!(difference.relative < 1e-3, "{}", difference.key);
    }
    // At the peak, near 0.9 ms, more of the fibres' creep is still to come than of the one Kelvin
    // element's, so the padding is stiffer than that of the reference, which peaks at 38.36 kN.
    assert!(exact.value("padding.peak-force")? > 38.36e3);
    Ok(())
}
