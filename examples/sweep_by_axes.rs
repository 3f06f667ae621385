//! A sweep by axes: the peak force of a padding over its stiffness and its damping.
//!
//! `cargo run --example sweep_by_axes`
#![allow(
    clippy::print_stdout,
    missing_docs,
    unreachable_pub,
    reason = "an example shows its result"
)]

use std::error::Error;

use dashpot::{
    analysis::{
        SolveSettings,
        sweep::{ScenePoint, Sweep, axis},
    },
    network::{Network, Node, dashpot, spring},
};

/// 4 kg at 5 m/s on a spring beside a dashpot.
fn scene(values: &[f64]) -> Result<ScenePoint, String> {
    let &[stiffness, damping] = values else { return Err("two axes are wanted".to_owned()) };
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 4.0).moving(5.0));
    network.connect("pad", head, network.ground(), spring(stiffness) | dashpot(damping));
    Ok(ScenePoint { network, settings: SolveSettings::lasting(0.1) })
}

pub fn main() -> Result<(), Box<dyn Error>> {
    let stiffness = axis("K", (1..=4).map(|at| 1e4 * f64::from(at)));
    let damping = axis("C", [0.0, 50.0, 100.0]);
    let swept = Sweep::over(stiffness).and(damping).solve(&["pad.peak-force"], scene)?;

    println!("{:>10} {:>8} {:>10}", "K [N/m]", "C [N s/m]", "peak [N]");
    for row in swept.rows() {
        let peak = row.value("pad.peak-force").ok_or("no value")?;
        println!("{:10.0} {:9.0} {peak:10.2}", row.parameters[0], row.parameters[1]);
    }

    // Without damping it is V √(K m).
    for (at, stiffness) in swept.axes()[0].values.iter().enumerate() {
        let row = swept.at(&[at, 0]).ok_or("no such point")?;
        let (peak, error) =
            row.value("pad.peak-force").zip(row.error("pad.peak-force")).ok_or("")?;
        let closed = 5.0 * (stiffness * 4.0).sqrt();
        assert!((peak - closed).abs() <= error + 1e-9 * closed, "{peak} is not {closed}");
    }
    assert_eq!(swept.rows().count(), 12);
    assert!(swept.at(&[0, 3]).is_none());
    Ok(())
}
