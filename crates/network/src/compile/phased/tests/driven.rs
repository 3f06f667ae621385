//! Contacts and sliders that given motions drive.

use dashpot_dae::{Switch, Waveform};
use dashpot_rheology::Tree;

use super::{contact, gravity, solve, solve_by};
use crate::{
    Network, Node,
    elements::{Dashpot, Friction},
    part,
    waveforms::{Sine, Trapezoid, WaveformKind},
};

const SHAKING: f64 = 10.0 * std::f64::consts::TAU;

/// A ball of 1 kg on a bed that moves by `amplitude sin(SHAKING t + phase)`, downwards positive.
fn on_a_bed(amplitude: f64, phase: f64, restitution: f64) -> Network {
    let motion = Sine { amplitude, frequency: 10.0, phase }.waveform().unwrap();
    let mut network = Network::new();
    let ball = network.add_node(Node::mass("ball", 1.0));
    let bed = network.add_node(Node::prescribed("bed", motion));
    network.connect("touch", ball, bed, contact(0.0, restitution));
    network.add_effect(gravity(9.81));
    network
}

#[test]
fn what_lies_on_a_shaken_bed_lifts_off_where_the_bed_falls_faster() {
    // The bed is accelerated downwards by g where −A ω² sin(ω t + φ) = g.
    let amplitude = 0.005;
    let angle = (9.81 / (amplitude * SHAKING * SHAKING)).asin() + std::f64::consts::PI;
    for phase in [0.0_f64, 0.5, 1.5, std::f64::consts::PI] {
        let network = on_a_bed(amplitude, phase, 0.0);
        let mut landings = Vec::new();
        for (method, tolerance) in
            [("exact", 1e-13), ("bdf", 1e-9), ("esdirk34", 1e-9), ("tr-bdf2", 1e-9)]
        {
            let solved = solve_by(method, &network, 0.4);
            let is_open = |switch: &&Switch| switch.what == "open";
            let opened: Vec<&Switch> = solved.switches().iter().filter(is_open).collect();
            assert!(opened.len() >= 3, "{method}: {:?}", solved.switches());
            for own in opened {
                let turn = (SHAKING * own.time + phase - angle).rem_euclid(std::f64::consts::TAU);
                let off = turn.min(std::f64::consts::TAU - turn) / SHAKING;
                assert!(off < tolerance, "{method}, phase {phase}: {off:e}");
            }
            landings.push(solved.switches().iter().map(|switch| switch.time).collect::<Vec<_>>());
            let words: Vec<&str> = solved.what();
            assert!(words.windows(2).all(|pair| pair[0] != pair[1]), "{method}: {words:?}");
        }
        for other in &landings[1..] {
            assert_eq!(landings[0].len(), other.len());
            for (a, b) in landings[0].iter().zip(other) {
                assert!((a - b).abs() < 1e-6, "phase {phase}: {a} {b}");
            }
        }
    }
}

#[test]
fn what_lies_on_a_bed_that_is_shaken_gently_never_parts() {
    // A ω² = 0.99 g.
    let amplitude = 0.99 * 9.81 / (SHAKING * SHAKING);
    for method in ["exact", "bdf", "esdirk34", "tr-bdf2"] {
        let solved = solve_by(method, &on_a_bed(amplitude, 0.0, 0.0), 0.5);
        assert!(solved.what().iter().all(|what| *what != "open"), "{method}: {:?}", solved.what());
    }
}

/// A slider, with a dashpot beside it, between the ground and a node that is shaken.
fn driven_slider(phase: f64) -> Network {
    let motion = Sine { amplitude: 0.005, frequency: 10.0, phase }.waveform().unwrap();
    let mut network = Network::new();
    let node = network.add_node(Node::prescribed("node", motion));
    let model = Tree::parallel([
        part(Friction { force: 50.0, ratio: 1.0 }),
        part(Dashpot { damping: 20.0 }),
    ]);
    network.connect("slider", node, network.ground(), model);
    network
}

#[test]
fn a_slider_between_given_motions_slides_the_way_that_they_go() {
    for phase in [0.0_f64, 1.0, std::f64::consts::FRAC_PI_2, 4.0] {
        for method in ["exact", "bdf"] {
            let solved = solve_by(method, &driven_slider(phase), 0.4);
            let words = solved.what();
            assert!((7..=8).contains(&words.len()), "{method}, phase {phase}: {words:?}");
            assert!(words.windows(2).all(|pair| pair[0] != pair[1]), "{words:?}");
            for at in 1..40 {
                let time = 0.01 * f64::from(at) + 0.0013;
                let rate = 0.005 * SHAKING * (SHAKING * time + phase).cos();
                let force = solved.at("slider.force", time);
                let expected = 50.0_f64.copysign(rate) + 20.0 * rate;
                assert!((force - expected).abs() < 1e-9, "{method} {phase} {time}: {force}");
            }
        }
    }
}

#[test]
fn a_driven_slider_keeps_its_force_while_the_motion_pauses_and_turns_with_it() {
    // 5 mm forth in 50 ms, a pause of 100 ms, and back in 50 ms.
    let motion = Trapezoid { peak: 0.005, rise: 0.05, hold: 0.1, fall: 0.05, start: 0.0 };
    let mut network = Network::new();
    let node = network.add_node(Node::prescribed("node", motion.waveform().unwrap()));
    network.connect("slider", node, network.ground(), part(Friction { force: 50.0, ratio: 1.0 }));
    for method in ["exact", "bdf"] {
        let solved = solve_by(method, &network, 0.4);
        assert_eq!(solved.what(), ["sliding backward"], "{method}");
        for (time, force) in [(0.03, 50.0), (0.1, 50.0), (0.18, -50.0), (0.3, -50.0)] {
            assert!((solved.at("slider.force", time) - force).abs() < 1e-12, "{method}: {time}");
        }
    }
}

#[test]
fn a_slider_whose_ends_are_at_rest_by_given_motions_is_refused_with_what_to_do() {
    let mut network = Network::new();
    let node = network.add_node(Node::prescribed("node", Waveform::constant(0.0)));
    network.connect("slider", node, network.ground(), part(Friction { force: 50.0, ratio: 1.0 }));
    let refusal = network.compile(1.0).unwrap_err().to_string();
    assert!(refusal.contains("`slider"), "{refusal}");
    assert!(refusal.contains("give one of the parts a stiffness"), "{refusal}");
}

#[test]
fn of_two_sliders_in_a_row_that_are_driven_the_weaker_one_slides() {
    let motion = Sine { amplitude: 0.005, frequency: 10.0, phase: 0.3 }.waveform().unwrap();
    for (first, second) in [(20.0, 30.0), (30.0, 20.0)] {
        let mut network = Network::new();
        let node = network.add_node(Node::prescribed("node", motion.clone()));
        let pad = Tree::series([
            part(Friction { force: first, ratio: 1.0 }),
            part(Friction { force: second, ratio: 1.0 }),
        ]);
        network.connect("pad", node, network.ground(), pad);
        let solved = solve(&network, 0.02);
        assert!((solved.at("pad.force", 0.01) - 20.0).abs() < 1e-12);
    }
}
