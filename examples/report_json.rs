//! A report as JSON, as `dashpot run --json` prints it: SI units, and no number where one is infinite.
//!
//! `cargo run --example report_json`
#![allow(
    clippy::print_stdout,
    missing_docs,
    unreachable_pub,
    reason = "an example shows its result"
)]

use std::error::Error;

use dashpot::{analysis::Solve as _, network::Network, network::Node, network::spring};

pub fn main() -> Result<(), Box<dyn Error>> {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 4.0).moving(5.0));
    network.connect("pad", head, network.ground(), spring(25e3));
    let report = network.solve(0.1)?;
    println!("{}", serde_json::to_string_pretty(&report)?);

    let json = serde_json::to_value(&report)?;
    let peak = json["measures"]["pad.peak-force"]["value"].as_f64().ok_or("no peak force")?;
    // Unloaded, it has given all back: V √(K m) is the peak, and nothing is dissipated.
    assert!((peak - 5.0 * (25e3_f64 * 4.0).sqrt()).abs() < 1e-6);
    assert_eq!(json["energy"]["dissipated"], serde_json::json!({}));
    assert_eq!(json["warning_codes"][0], "pulls");
    Ok(())
}
