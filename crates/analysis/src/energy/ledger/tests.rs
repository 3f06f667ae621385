//! The balance through switches.

use dashpot_dae::{Piece, Waveform};
use dashpot_network::{
    Model, Network, Node, dashpot,
    effects::{Face, Gravity, GravityStart, Separation, Stop, Touch},
    elements::{Contact, Friction},
    part, spring,
};

use super::energy_series;
use crate::{RunReport, Solve, SolveSettings, regular_times};

fn kelvin(stiffness: f64, damping: f64) -> Model {
    Model::parallel([spring(stiffness), dashpot(damping)])
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
    let padding = Model::series([spring(20e6), dashpot(6e3), kelvin(20e6, 4e3)]);
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
    network.connect("grip", block, belt, part(Friction { force: 5.0, ratio: 1.0 }));
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
    network.connect("slide", block, ground, part(Friction { force: 2.0, ratio: 1.0 }));
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

/// A load on the massless end of a spring that slides on the ground.
fn dragged() -> Network {
    let mut network = Network::new();
    let block = network.add_node(Node::mass("block", 1.0).moving(1.0));
    let shoe = network.add_node(Node::massless("shoe"));
    let ground = network.ground();
    network.connect("tie", block, shoe, spring(1.0));
    network.connect("slide", shoe, ground, part(Friction { force: 0.3, ratio: 1.0 }));
    let force = Waveform::new(vec![Piece { value: -0.2, ..Piece::default() }]).unwrap();
    network.add_load("drag", shoe, force);
    network
}

/// Networks in which something switches, by name, with how long they run \[s\].
pub(super) fn cases() -> Vec<(&'static str, Network, f64)> {
    vec![
        ("ball that bounces to rest", ball(0.5), 2.0),
        ("ball that stays", ball(0.0), 2.0),
        ("ball that never rests", ball(1.0), 2.0),
        ("face that is struck", faced(1.0, 0.0, Touch::Impact), 0.02),
        ("face that chatters", faced(1.0, 0.5, Touch::Impact), 0.02),
        ("face that moves along", faced(1.0, 0.5, Touch::Moving), 0.02),
        ("face without mass", faced(0.0, 0.0, Touch::Impact), 0.02),
        ("stop that holds", stopped(0.0), 0.02),
        ("stop that reflects", stopped(0.3), 0.02),
        ("belt", belt(), 3.0),
        ("shoe that is dragged", dragged(), 3.0),
        ("racket that reflects", racket(0.7), 0.3),
        ("racket that takes along", racket(0.0), 0.3),
        ("two walls and friction", between_walls(), 3.0),
        ("three elastic balls", cradle(1.0), 3.0),
        ("three balls", cradle(0.4), 3.0),
    ]
}

pub(super) fn run(network: &Network, duration: f64, method: &str) -> RunReport {
    let settings = SolveSettings::lasting(duration).by_name(method).unwrap();
    network.solve_with(&settings).unwrap()
}

#[test]
fn balance_closes_through_every_switch() {
    for (name, network, duration) in cases() {
        let exact = run(&network, duration, "exact");
        let closure = exact.energy.closure().abs();
        assert!(closure <= 1e-10, "{name}: {closure:e}");
        for method in ["bdf", "esdirk34"] {
            let other = run(&network, duration, method);
            let closure = other.energy.closure().abs();
            // The solutions go on until the balance closes as well as the measures are good.
            assert!(closure <= 1e-3, "{name} by {method}: {closure:e}");
        }
    }
}

#[test]
fn energies_add_up_at_all_times() {
    for (name, network, duration) in cases() {
        let report = run(&network, duration, "exact");
        let switches = report.trajectory.switches.iter().map(|switch| switch.time);
        let mut times: Vec<f64> =
            regular_times(duration, 101).into_iter().chain(switches).collect();
        times.sort_by(f64::total_cmp);
        let series = energy_series(&report.solution(), &times);
        for (at, time) in times.iter().enumerate() {
            let kept = series.kinetic[at] + series.stored[at] + series.dissipated[at];
            let missing = report.energy.start + series.work_in[at] - kept;
            let most = 1e-10 * report.energy.turned_over;
            assert!(missing.abs() <= most, "{name} at {time} s: {missing:e}");
        }
    }
}

#[test]
fn energy_of_a_ball_that_comes_to_rest_is_lost_in_its_impacts() {
    // 2 kg fall by 1 m under 10 m/s²; each impact takes 3/4 of what is left.
    let report = run(&ball(0.5), 2.0, "exact");
    let lost: Vec<f64> = report.trajectory.switches.iter().map(|switch| switch.lost).collect();
    for (at, lost) in lost.iter().enumerate().take(8) {
        let expected = 15.0 * 0.25_f64.powi(i32::try_from(at).unwrap());
        assert!((lost - expected).abs() <= 1e-9 * expected, "impact {at}: {lost}");
    }
    assert!((report.energy.total_dissipated() - 20.0).abs() < 1e-9);
    assert!(report.energy.kinetic < 1e-15, "{}", report.energy.kinetic);
}

#[test]
fn racket_that_takes_a_ball_along_does_the_work_of_the_impact() {
    // The racket is at −0.1 m + gap where the ball meets it, and moves on with its own speed w: the
    // impulse m (v − w) acts at w, and m (v − w)²/2 is lost.
    let report = run(&racket(0.0), 0.3, "exact");
    let met = &report.trajectory.switches[0];
    let speed = 0.6 * (30.0 * met.time).cos();
    let approach = 2.0 - speed;
    assert!((met.impulse - 0.5 * approach).abs() < 1e-12);
    assert!((met.lost - 0.25 * approach * approach).abs() < 1e-12);
    assert!((met.worked + 0.5 * approach * speed).abs() < 1e-12);
}
