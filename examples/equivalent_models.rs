//! Appendix A of the thesis: a Burgers element is two Maxwell elements side by side. Shown without
//! solving anything, then by the same impact with both.
//!
//! `cargo run --example equivalent_models`
#![allow(
    clippy::print_stdout,
    missing_docs,
    unreachable_pub,
    reason = "an example shows its result"
)]

use std::error::Error;

use dashpot::{
    analysis::{RunReport, Solve, SolveSettings, differences},
    network::{Model, Network, Node, dashpot, linear_model, model_of, spring},
    rheology::{
        conversion::{Target, converted},
        equivalence::compare,
    },
};

fn impact(padding: Model) -> Result<RunReport, Box<dyn Error>> {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 10.0).moving(10.0));
    let panel = network.add_node(Node::mass("panel", 100.0));
    network.connect("padding", head, panel, padding);
    network.connect("mount", panel, network.ground(), spring(50e6) | dashpot(10e3));
    Ok(network.solve_with(&SolveSettings::lasting(0.02).by_name("exact")?)?)
}

pub fn main() -> Result<(), Box<dyn Error>> {
    let burgers = spring(20e6) + dashpot(6e3) + (spring(20e6) | dashpot(4e3));
    let linear = linear_model(&burgers);
    let form = linear.maxwell().ok_or("the padding is rigid")?;
    for element in form.elements() {
        let (time, stiffness) = (1e3 * element.relaxation_time, 1e-6 * element.stiffness);
        println!("Maxwell element {stiffness:9.6} MN/m, {time:.6} ms");
    }

    let target = Target::named("generalized-maxwell").ok_or("no such form")?;
    let two_maxwell = model_of(&converted(&linear, &target)?);
    let found = compare(&linear, &linear_model(&two_maxwell));
    println!("the same: {}", found.is_same);
    assert!(found.is_same);

    let [in_a_row, side_by_side] = [impact(burgers)?, impact(two_maxwell)?];
    for difference in differences(&in_a_row, &side_by_side) {
        println!("{:<28} differs by {:.1e}", difference.key, difference.relative);
        assert!(difference.relative < 1e-10, "{}", difference.key);
    }
    Ok(())
}
