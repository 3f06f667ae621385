//! A table of force against time, as from a test machine, on a plate that a padding holds.
//!
//! `cargo run --example force_table`
#![allow(
    clippy::print_stdout,
    missing_docs,
    unreachable_pub,
    reason = "an example shows its result"
)]

use std::error::Error;

use dashpot::{
    analysis::{Solve, SolveSettings},
    network::{
        Network, Node, dashpot, spring,
        waveforms::{Table, WaveformKind},
    },
};

pub fn main() -> Result<(), Box<dyn Error>> {
    // Time in s, force in N; two rows at one time are a jump.
    let points =
        vec![(0.0, 0.0), (2e-3, 900.0), (5e-3, 1400.0), (8e-3, 600.0), (8e-3, 200.0), (12e-3, 0.0)];
    let impulse: f64 = points.windows(2).map(|p| 0.5 * (p[0].1 + p[1].1) * (p[1].0 - p[0].0)).sum();

    let mut network = Network::new();
    let plate = network.add_node(Node::mass("plate", 2.0));
    let ground = network.ground();
    network.connect("pad", plate, ground, spring(40e3) | dashpot(120.0)).thickness = Some(0.03);
    network.add_load("ram", plate, Table::of(points).waveform()?);

    for method in ["exact", "bdf", "esdirk34"] {
        let report = network.solve_with(&SolveSettings::lasting(0.05).by_name(method)?)?;
        let deepest = report.value("pad.peak-deformation")?;
        println!(
            "{method:<9} deepest {:.4} mm, work in {:.4} J, {} steps",
            1e3 * deepest,
            report.energy.work_in.iter().map(|(_, work)| work).sum::<f64>(),
            report.solver.statistics.accepted,
        );
        assert!(deepest < 0.03);
    }
    println!("the table's impulse is {impulse:.3} N s");
    Ok(())
}
