//! Many contacts at once.

use dashpot_dae::{Switch, Waveform};

use super::{contact, gravity, solve, solve_by};
use crate::{Network, Node};

/// A row of balls of 1 kg, 1 cm apart, of which the first moves at 1 m/s.
fn cradle(balls: usize, restitution: f64) -> Network {
    let mut network = Network::new();
    let speed = |ball: usize| if ball == 0 { 1.0 } else { 0.0 };
    let balls: Vec<_> = (0..balls)
        .map(|at| network.add_node(Node::mass(format!("b{at}"), 1.0).moving(speed(at))))
        .collect();
    for (at, pair) in balls.windows(2).enumerate() {
        network.connect(format!("c{at}"), pair[0], pair[1], contact(0.01, restitution));
    }
    network
}

#[test]
fn equal_balls_pass_their_speed_on_and_keep_momentum_and_energy() {
    for (method, balls, tolerance) in
        [("exact", 4, 1e-12), ("bdf", 10, 1e-12), ("esdirk34", 10, 1e-12)]
    {
        let solved = solve_by(method, &cradle(balls, 1.0), 0.2);
        assert_eq!(solved.switches().len(), balls - 1, "{method}: {:?}", solved.switches());
        for (at, switch) in solved.switches().iter().enumerate() {
            let expected = 0.01 * (at + 1) as f64;
            assert!((switch.time - expected).abs() < tolerance, "{method}: {switch:?}");
            assert!(switch.lost.abs() < tolerance, "{method}: {switch:?}");
        }
        let last = solved.at(&format!("b{}.velocity", balls - 1), 0.2);
        assert!((last - 1.0).abs() < tolerance, "{method}: {last}");
        let dull = solve_by(method, &cradle(balls, 0.9), 0.5);
        let speeds: Vec<f64> =
            (0..balls).map(|at| dull.at(&format!("b{at}.velocity"), 0.5)).collect();
        let momentum: f64 = speeds.iter().sum();
        let energy: f64 = speeds.iter().map(|v| 0.5 * v * v).sum();
        let lost: f64 = dull.switches().iter().map(|switch| switch.lost).sum();
        // The first goes on with (1 − e)/2, and no other follows it fast enough to be slower.
        assert!((speeds[0] - 0.05).abs() < tolerance, "{method}: {speeds:?}");
        assert!((momentum - 1.0).abs() < tolerance, "{method}: {momentum}");
        assert!((energy + lost - 0.5).abs() < tolerance, "{method}: {energy} {lost}");
    }
}

/// Balls of 1 kg, 2 kg, … above the ground, each at a height of its own.
fn rain(heights: &[f64], restitution: f64) -> Network {
    let mut network = Network::new();
    for (at, &height) in heights.iter().enumerate() {
        let ball = network.add_node(Node::mass(format!("b{at}"), 1.0 + at as f64));
        let ground = network.ground();
        network.connect(format!("c{at}"), ball, ground, contact(height, restitution));
    }
    network.add_effect(gravity(9.81));
    network
}

#[test]
fn balls_that_have_nothing_to_do_with_each_other_bounce_as_each_does_alone() {
    let heights = [0.01, 0.0131, 0.0162];
    let together = solve(&rain(&heights, 0.5), 0.4);
    for (at, &height) in heights.iter().enumerate() {
        let alone = solve(&rain(&[height], 0.5), 0.4);
        let name = format!("c{at}.contact");
        let own: Vec<&Switch> =
            together.switches().iter().filter(|switch| switch.name == name).collect();
        // A rounding of its place moves the time of a landing the more, the slower it is.
        let seen = alone.switches().iter().filter(|switch| switch.impulse > 1e-3);
        for (alone, own) in seen.zip(own) {
            let mass = 1.0 + at as f64;
            assert!((alone.time / own.time - 1.0).abs() < 1e-12, "{alone:?} {own:?}");
            assert!((mass * alone.impulse - own.impulse).abs() < 1e-12, "{alone:?} {own:?}");
            assert!((mass * alone.lost - own.lost).abs() < 1e-12, "{alone:?} {own:?}");
        }
        let place = together.at(&format!("b{at}.position"), 0.4);
        assert!((place - height).abs() < 1e-12, "{place}");
    }
}

#[test]
fn fifty_balls_that_land_at_one_instant_or_one_after_the_other_come_to_rest() {
    let equal = [0.02; 50];
    let stairs: Vec<f64> = (0..50).map(|at| 0.01 + 2e-4 * f64::from(at)).collect();
    let landing = (2.0 * 0.02 / 9.81_f64).sqrt();
    let solved = solve_by("bdf", &rain(&equal, 0.9), 0.1);
    assert_eq!(solved.switches().len(), 50);
    for (at, switch) in solved.switches().iter().enumerate() {
        let energy = (1.0 + at as f64) * 9.81 * 0.02;
        assert!((switch.time / landing - 1.0).abs() < 1e-7, "{switch:?}");
        assert!((switch.lost / (0.19 * energy) - 1.0).abs() < 1e-6, "{switch:?}");
    }
    let solved = solve_by("bdf", &rain(&stairs, 0.3), 0.3);
    for (at, height) in stairs.iter().enumerate() {
        // PredictedEvent after flight: T (1 + e)/(1 − e) = 0.12 s at most.
        let place = solved.at(&format!("b{at}.position"), 0.3);
        assert!((place - height).abs() < 1e-6, "{at}: {place} {height}");
    }
}

#[test]
fn in_a_long_row_just_those_contacts_open_that_are_pulled() {
    // Two by two, balls are pressed together by 1 N, and each pair is faster than that behind it.
    let mut network = Network::new();
    let balls: Vec<_> =
        (0..24).map(|at| network.add_node(Node::mass(format!("b{at}"), 1.0))).collect();
    for (at, pair) in balls.windows(2).enumerate() {
        network.connect(format!("c{at}"), pair[0], pair[1], contact(0.0, 0.0));
    }
    let acceleration = |at: usize| (at / 2) as f64;
    for (at, &ball) in balls.iter().enumerate() {
        let press = if at % 2 == 0 { 1.0 } else { -1.0 };
        let force = Waveform::constant(acceleration(at) + press);
        network.add_load(format!("push {at}"), ball, force);
    }
    let solved = solve_by("bdf", &network, 1.0);
    assert!(solved.switches().is_empty(), "{:?}", solved.switches());
    for at in 0..24 {
        let place = solved.at(&format!("b{at}.position"), 1.0);
        assert!((place - 0.5 * acceleration(at)).abs() < 1e-7, "{at}: {place}");
    }
    for at in 0..23 {
        let force = solved.at(&format!("c{at}.force"), 0.5);
        let expected = if at % 2 == 0 { 1.0 } else { 0.0 };
        assert!((force - expected).abs() < 1e-9, "{at}: {force}");
    }
}
