//! Models composed by `+` in series and `|` in parallel: a Zener element in its two forms, which are
//! the same seen from outside.
//!
//! `cargo run --example composition`
#![allow(
    clippy::print_stdout,
    missing_docs,
    unreachable_pub,
    reason = "an example shows its result"
)]

use std::error::Error;

use dashpot::{
    analysis::{RunReport, Solve, differences},
    network::{Model, Network, Node, dashpot, linear_model, spring},
    rheology::equivalence::compare,
};

fn impact(padding: Model) -> Result<RunReport, Box<dyn Error>> {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 4.0).moving(5.0));
    network.connect("padding", head, network.ground(), padding);
    Ok(network.solve(0.05)?)
}

pub fn main() -> Result<(), Box<dyn Error>> {
    // A spring beside a Maxwell element; `+` binds closer than `|`.
    let (k, stiffer, c) = (60e3, 180e3, 300.0);
    let maxwell_form = spring(k) | (spring(stiffer) + dashpot(c));

    // A spring in series with a Kelvin–Voigt element.
    let glassy = k + stiffer;
    let part = glassy / stiffer;
    let kelvin_form = spring(glassy) + (spring(part * k) | dashpot(part * part * c));

    let [one, other] = [&maxwell_form, &kelvin_form].map(linear_model);
    println!("the same: {}", compare(&one, &other).is_same);
    assert!(compare(&one, &other).is_same);

    let (one, other) = (impact(maxwell_form)?, impact(kelvin_form)?);
    println!("peak force {:.3} N", one.value("padding.peak-force")?);
    for difference in differences(&one, &other) {
        println!("{:<28} differs by {:.1e}", difference.key, difference.relative);
        assert!(difference.relative < 1e-10, "{}", difference.key);
    }
    Ok(())
}
