//! Units for amplitudes of any size, and unknowns that carry no offsets.

use dashpot_dae::{IntervalEnd, Piece, Switching, System};

use super::*;
use crate::elements::Contact;

fn struck(speed: f64) -> System {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 3.0).moving(speed));
    network.connect("pad", head, network.ground(), Tree::parallel([spring(100.0), dashpot(7.0)]));
    network.compile(1.0).unwrap().system
}

#[test]
fn the_smallest_amplitudes_have_the_equations_of_all_others() {
    let usual = struck(1.0);
    for speed in [1e-270, 1e-300, 1e-310, 1e-320] {
        let small = struck(speed);
        // What does not depend on the units of lengths and velocities.
        let own = |system: &System| {
            let at = |i, j| {
                *system.jacobian.triplet_iter().find(|own| (own.0, own.1) == (i, j)).unwrap().2
            };
            [at(1, 1), at(0, 1) * at(1, 0)].map(f64::to_bits)
        };
        assert_eq!(own(&small), own(&usual), "{speed:e}");
        let start = small.initial.iter().fold(0.0_f64, |most, own| most.max(own.abs()));
        assert!((0.1..10.0).contains(&start), "{speed:e}: {start}");
        let output = small.outputs.iter().find(|output| output.name == "head.velocity").unwrap();
        let found = output.scale * output.unknowns.at(&small.initial);
        // The scale may have lost digits; the speed itself has hardly any.
        assert!((found / speed - 1.0).abs() < 1e-3, "{speed:e}: {found:e}");
    }
}

#[test]
fn a_force_is_as_large_as_its_impulse_makes_it() {
    let scale = |length: f64| {
        let mut network = Network::new();
        let head = network.add_node(Node::mass("head", 1.0));
        network.connect("pad", head, network.ground(), spring(1.0));
        let rest = |start| Piece { start, ..Piece::default() };
        let pulse = Piece { start: 0.25, value: 1.0 / length, ..Piece::default() };
        let force = Waveform::new(vec![rest(0.0), pulse, rest(0.25 + length)]).unwrap();
        network.add_load("ram", head, force);
        let system = network.compile(1.0).unwrap().system;
        system.unknowns.iter().find(|unknown| unknown.name == "velocity of head").unwrap().scale
    };
    for length in [1e-3, 1e-6, 1e-9] {
        assert!((scale(length) - 1.0).abs() < 1e-12, "1 N s on 1 kg, in {length:e} s");
    }
}

/// Behind a contact that closes at 0.1 m a spring is compressed by what the contact lets through, which is
/// not known from the difference of two places: forces balance to the last digit.
#[test]
fn the_spring_behind_a_closed_contact_is_an_unknown_without_offset() {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 1.0).moving(1.0));
    let body = network.add_node(Node::mass("body", 3.0));
    let gap = part(Contact { gap: 0.1, restitution: 0.0 });
    network.connect("gap", head, body, Tree::series([gap, spring(1e13)]));
    let assembly = network.compile(1.0).unwrap();
    let switching = assembly.switching.unwrap();
    let interval = switching.first(1e-12).unwrap();
    let state: Vec<f64> = interval
        .system
        .unknowns
        .iter()
        .zip(&interval.system.initial)
        .map(|(own, &value)| if own.name == "position of head" { 0.1 / own.scale } else { value })
        .collect();
    let length = 0.1 / interval.system.time_scale;
    let end = IntervalEnd {
        interval: &interval,
        time: 0.1,
        length,
        state: &state,
        fired: &[0],
        threshold: 1e-12,
    };
    let closed = switching.next(&end).unwrap().system;
    assert_eq!(closed.input_matrix.nnz(), 0, "no constant pushes");
    let at = |name: &str| closed.unknowns.iter().position(|unknown| unknown.name == name).unwrap();
    let between = at("position of body relative to head");
    assert_eq!(closed.initial[between].abs().to_bits(), 0, "nothing is compressed yet");
    let force = |name: &str, mass: f64| {
        let row = at(name);
        let entry = closed.jacobian.triplet_iter().find(|own| (own.0, own.1) == (row, between));
        mass * closed.unknowns[row].scale * entry.unwrap().2
    };
    let sum = force("velocity of head", 1.0) + force("velocity of body", 3.0);
    assert!(sum.abs() <= 2.0 * f64::EPSILON * force("velocity of head", 1.0).abs());
}

#[test]
fn amplitudes_too_small_for_switching_are_refused_in_so_many_words() {
    let compiled = |speed: f64| {
        let mut network = Network::new();
        let head = network.add_node(Node::mass("head", 1.0).moving(speed));
        let face = part(Contact { gap: 0.0, restitution: 0.0 });
        let pad = Tree::series([face, spring(100.0)]);
        network.connect("pad", head, network.ground(), pad);
        network.compile(1.0).map(drop)
    };
    assert!(compiled(1e-300).is_ok());
    for speed in [1e-310, 1e-322] {
        let words = compiled(speed).unwrap_err().to_string();
        assert!(words.contains("as small as this"), "{words}");
        assert!(words.contains("m/s"), "{words}");
    }
}
