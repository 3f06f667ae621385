//! Two masses and three springs: the energy of an impact wanders from one to the other and back.
//!
//! `cargo run --example two_mass_chain`
#![allow(
    clippy::print_stdout,
    missing_docs,
    unreachable_pub,
    reason = "an example shows its result"
)]

use std::error::Error;

use dashpot::{
    dae::{Run, Silent, methods},
    network::{Network, Node, spring},
};

pub fn main() -> Result<(), Box<dyn Error>> {
    let (mass, wall, coupling) = (1.0, 100.0, 5.0);
    let mut network = Network::new();
    let left = network.add_node(Node::mass("left", mass).moving(1.0));
    let right = network.add_node(Node::mass("right", mass));
    network.connect("left-wall", left, network.ground(), spring(wall));
    network.connect("coupling", left, right, spring(coupling));
    network.connect("right-wall", right, network.ground(), spring(wall));

    let duration = 20.0;
    let assembly = network.compile(duration)?;
    let run = Run::to(duration);
    let (method, why) = methods::Auto::choose(&assembly.system, &run);
    let trajectory = method.integrate(&assembly.system, &run, &mut Silent)?;
    println!("solved by {}: {why}", trajectory.method);

    let output = assembly.output("right.position").ok_or("no such output")?;
    let position = trajectory.signal(&assembly.system, output);
    let farthest = position.absolute_maximum((0.0, duration));
    let slow = f64::sqrt(wall / mass);
    let fast = f64::sqrt((wall + 2.0 * coupling) / mass);
    println!("the right mass swings out by {:.4} m at {:.3} s", farthest.value, farthest.time);
    println!("beats every {:.3} s", std::f64::consts::TAU / (fast - slow));
    let closed = |t: f64| 0.5 * ((slow * t).sin() / slow - (fast * t).sin() / fast);
    assert!((position.value(7.0) - closed(7.0)).abs() < 1e-12);
    assert!((farthest.value - closed(farthest.time).abs()).abs() < 1e-12);
    Ok(())
}
