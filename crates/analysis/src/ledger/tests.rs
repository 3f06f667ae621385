//! The balance through switches.

use dashpot_dae::{Piece, Silent, Waveform};
use dashpot_network::{
    Model, Network, Node,
    effects::{Face, Gravity, GravityStart, Separation, Stop, Touch},
    elements::{Contact, Dashpot, Friction, Spring},
    part,
};

use crate::{RunReport, SolveSettings, solve};

fn spring(stiffness: f64) -> Model {
    part(Spring { stiffness })
}

fn kelvin(stiffness: f64, damping: f64) -> Model {
    Model::parallel([spring(stiffness), part(Dashpot { damping })])
}

fn contact(gap: f64, restitution: f64) -> Model {
    part(Contact { gap, restitution })
}

/// A ball that falls by 1 m on rigid ground.
fn ball(restitution: f64) -> Network {
    let mut network = Network::new();
    let ball = network.add_node(Node::mass("ball", 2.0).moving(0.0));
    let ground = network.ground();
    network.connect("floor", ball, ground, contact(1.0, restitution));
    network.add_effect(Gravity { acceleration: 10.0, start: GravityStart::Unloaded });
    network
}

/// A head on a pad from which it can part, whose face has mass.
fn faced(mass: f64, restitution: f64, touch: Touch) -> Network {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 10.0).moving(10.0));
    let panel = network.add_node(Node::mass("panel", 100.0));
    let ground = network.ground();
    let padding =
        Model::series([spring(20e6), part(Dashpot { damping: 6e3 }), kelvin(20e6, 4e3)]);
    network.connect("padding", head, panel, padding);
    network.connect("mount", panel, ground, kelvin(50e6, 10e3));
    network.add_effect(Separation { element: "padding".to_owned(), at: None, restitution });
    network.add_effect(Face { element: "padding".to_owned(), mass, at: None, touch });
    network
}

/// The same face without mass, and a rigid stop at 15 mm.
fn stopped(restitution: f64) -> Network {
    let mut network = faced(0.0, 0.0, Touch::Impact);
    network.add_effect(Stop {
        element: "padding".to_owned(),
        at: Some(0.015),
        restitution,
        stiffness: None,
        damping: 0.0,
    });
    network
}

/// A block on a belt that runs at 0.5 m/s, tied by a spring.
fn belt() -> Network {
    let mut network = Network::new();
    let block = network.add_node(Node::mass("block", 2.0).moving(0.0));
    let run = Waveform::new(vec![Piece { slope: 0.5, ..Piece::default() }]).unwrap();
    let belt = network.add_node(Node::prescribed("belt", run));
    let ground = network.ground();
    network.connect("grip", block, belt, part(Friction { force: 5.0 }));
    network.connect("tie", block, ground, spring(100.0));
    network
}

/// A racket that is moved to and fro and meets a ball.
fn racket(restitution: f64) -> Network {
    let mut network = Network::new();
    let ball = network.add_node(Node::mass("ball", 0.5).moving(2.0));
    let swing = Piece { sine: 0.02, omega: 30.0, ..Piece::default() };
    let racket = network.add_node(Node::prescribed("racket", Waveform::new(vec![swing]).unwrap()));
    network.connect("strings", ball, racket, contact(0.1, restitution));
    network
}

/// A mass that slides between two walls.
fn between_walls() -> Network {
    let mut network = Network::new();
    let block = network.add_node(Node::mass("block", 1.0).moving(3.0));
    let ground = network.ground();
    network.connect("right", block, ground, contact(0.2, 0.8));
    network.connect("left", ground, block, contact(0.1, 0.6));
    network.connect("slide", block, ground, part(Friction { force: 2.0 }));
    network
}

/// Three balls in a row, the last one on a pad.
fn cradle(restitution: f64) -> Network {
    let mut network = Network::new();
    let one = network.add_node(Node::mass("one", 1.0).moving(1.0));
    let two = network.add_node(Node::mass("two", 2.0));
    let three = network.add_node(Node::mass("three", 3.0));
    let ground = network.ground();
    network.connect("first", one, two, contact(0.1, restitution));
    network.connect("second", two, three, contact(0.0, restitution));
    network.connect("pad", three, ground, kelvin(200.0, 3.0));
    network
}

fn run(network: &Network, duration: f64, method: &str) -> RunReport {
    let settings = SolveSettings::lasting(duration).by(method);
    solve(network, &settings, &mut Silent).unwrap()
}

#[test]
fn probe() {
    let cases: Vec<(&str, Network, f64)> = vec![
        ("ball 0.5", ball(0.5), 2.0),
        ("ball 0", ball(0.0), 2.0),
        ("ball 1", ball(1.0), 2.0),
        ("faced", faced(1.0, 0.0, Touch::Impact), 0.02),
        ("faced 0.5", faced(1.0, 0.5, Touch::Impact), 0.02),
        ("faced moving", faced(1.0, 0.5, Touch::Moving), 0.02),
        ("massless", faced(0.0, 0.0, Touch::Impact), 0.02),
        ("stopped", stopped(0.0), 0.02),
        ("stopped 0.3", stopped(0.3), 0.02),
        ("belt", belt(), 3.0),
        ("racket", racket(0.7), 0.3),
        ("racket 0", racket(0.0), 0.3),
        ("walls", between_walls(), 3.0),
        ("cradle", cradle(1.0), 3.0),
        ("cradle .4", cradle(0.4), 3.0),
    ];
    for (name, network, duration) in cases {
        for method in ["exact", "bdf"] {
            let settings = SolveSettings::lasting(duration).by(method);
            match solve(&network, &settings, &mut Silent) {
                Err(error) => println!("{name} {method}: {error}"),
                Ok(report) => {
                    println!(
                        "{name} {method}: closure {:e} error {:?} switches {} turned {}",
                        report.energy.closure(),
                        report.energy.error,
                        report.trajectory.switches.len(),
                        report.energy.turned_over
                    );
                    for m in &report.measures {
                        println!("    {} {:?} {:?} {:?} {:?} {:?}", m.key, m.value, m.time, m.window, m.error, m.note);
                    }
                    for e in report.events.iter().take(8) {
                        println!("    {} {}", e.time, e.what);
                    }
                    for w in &report.warnings {
                        println!("    ! {w}");
                    }
                }
            }
        }
    }
}
