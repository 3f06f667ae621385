//! Contacts and stops: the oscillation that parts or reaches them, in closed form.

use std::f64::consts::TAU;

use dashpot_dae::Waveform;
use dashpot_network::{
    Model, Network, Node,
    effects::{Face, Gravity, GravityStart, Separation, Stop, Touch},
    elements::{Dashpot, Spring},
    part,
};

use super::super::*;
use crate::{Solve, SolveSettings};

const MASS: f64 = 2.0;
const STIFFNESS: f64 = 8e4;
const ZETA: f64 = 0.2;
const G: f64 = 9.81;

fn natural() -> f64 {
    (STIFFNESS / MASS).sqrt()
}

/// A mass that stands on a pad on the floor.
fn standing(motion: Waveform) -> Network {
    let mut network = Network::new();
    let floor = network.add_node(Node::prescribed("floor", motion));
    let device = network.add_node(Node::mass("device", MASS));
    let damping = 2.0 * ZETA * (STIFFNESS * MASS).sqrt();
    let pad = Model::parallel([part(Spring { stiffness: STIFFNESS }), part(Dashpot { damping })]);
    network.connect("pad", device, floor, pad);
    network
}

fn heavy(mut network: Network, start: GravityStart) -> Network {
    network.add_effect(Gravity { acceleration: G, start });
    network
}

fn separation(at: &str) -> Separation {
    Separation { element: "pad".to_owned(), at: Some(at.to_owned()), restitution: 0.0 }
}

fn stop(at: f64) -> Stop {
    let (element, at, stiffness) = ("pad".to_owned(), Some(at), Some(1e7));
    Stop { element, at, restitution: 0.0, stiffness, damping: 0.0 }
}

/// The transmissibility of the pad at `r` times its natural frequency, and its highest value.
fn closed(r: f64) -> f64 {
    let loss = 2.0 * ZETA * r;
    ((1.0 + loss * loss) / ((1.0 - r * r).powi(2) + loss * loss)).sqrt()
}

/// Where that is the highest.
fn top() -> f64 {
    ((1.0 + 8.0 * ZETA * ZETA).sqrt() - 1.0).sqrt() / (2.0 * ZETA)
}

fn swept(vibration: &Vibration) -> Sweep {
    let settings =
        SweepSettings { from: Some(2.0), to: Some(300.0), points: 7, ..SweepSettings::default() };
    vibration.sweep(&settings).unwrap()
}

#[test]
fn a_mass_parts_where_it_is_shaken_with_more_than_its_weight() {
    // The force in the contact is m a of the mass, so it parts where T a_floor = g.
    for (at, start) in [("device", GravityStart::Equilibrium), ("floor", GravityStart::Unloaded)] {
        let mut network = heavy(standing(Waveform::constant(0.0)), start);
        network.add_effect(separation(at));
        let vibration = Vibration::new(&network, 1.0, None).unwrap();
        let [limit] = vibration.limits() else { panic!("{:?}", vibration.limits()) };
        assert_eq!((limit.kind, limit.name.as_str()), (LimitKind::Parting, "pad.contact"));
        assert!((limit.reserve / (MASS * G) - 1.0).abs() < 1e-12);
        let sweep = swept(&vibration);
        let [onset] = sweep.onsets.as_slice() else { panic!("{:?}", sweep.onsets) };
        assert!((onset.frequency * TAU / natural() / top() - 1.0).abs() < 1e-6);
        let acceleration = onset.amplitude * (onset.frequency * TAU).powi(2);
        assert!((acceleration * closed(top()) / G - 1.0).abs() < 1e-9, "{acceleration}");
        assert!(
            sweep
                .notes
                .iter()
                .any(|note| note.to_string().contains("`pad.contact` parts first at 30.7 Hz"))
        );
        // At any one frequency, just below and just above.
        for r in [0.4, 1.0, 2.5] {
            let omega = r * natural();
            let most = G / closed(r) / omega.powi(2);
            for (part, warned) in [(0.999_999, false), (1.000_001, true)] {
                let steady = vibration.steady(omega / TAU, part * most).unwrap();
                let said = steady
                    .warnings
                    .iter()
                    .any(|warning| warning.to_string().contains("`pad.contact` parts at"));
                assert_eq!(said, warned, "{r} {:?}", steady.warnings);
            }
        }
        // Closed, it answers as if it were glued.
        let glued = Vibration::new(&standing(Waveform::constant(0.0)), 1.0, None).unwrap();
        assert_eq!(swept(&glued).transmissions, sweep.transmissions);
    }
}

#[test]
fn a_load_parts_it_where_what_it_transmits_exceeds_the_weight() {
    let mut network = heavy(standing(Waveform::constant(0.0)), GravityStart::Equilibrium);
    network.add_effect(separation("device"));
    let device = network.node_named("device").unwrap();
    network.add_load("ram", device, Waveform::constant(0.0));
    let vibration = Vibration::new(&network, 1.0, Some("ram")).unwrap();
    let onset = swept(&vibration).onsets[0].clone();
    assert!((onset.amplitude * closed(top()) / (MASS * G) - 1.0).abs() < 1e-9, "{onset:?}");
}

#[test]
fn the_force_on_a_face_with_mass_is_that_in_front_of_it() {
    // The mass m2 of the face stands on the pad for good; the mass m1 on it feels m1 a only.
    let mut network = heavy(standing(Waveform::constant(0.0)), GravityStart::Equilibrium);
    network.add_effect(separation("device"));
    let (element, touch) = ("pad".to_owned(), Touch::Impact);
    network.add_effect(Face { element, mass: 0.5, at: None, touch });
    let vibration = Vibration::new(&network, 1.0, None).unwrap();
    assert!((vibration.limits()[0].reserve / (MASS * G) - 1.0).abs() < 1e-12);
    let omega = 0.3 * natural();
    let ratio = vibration.steady(omega / TAU, 1.0).unwrap();
    let device = ratio.nodes.iter().find(|node| node.name == "device").unwrap();
    let most = G / device.acceleration.amplitude;
    for (part, warned) in [(0.999_999, false), (1.000_001, true)] {
        let steady = vibration.steady(omega / TAU, part * most).unwrap();
        assert_eq!(!steady.warnings.is_empty(), warned, "{:?}", steady.warnings);
    }
}

#[test]
fn a_stop_has_left_what_the_weight_has_not_taken() {
    let static_equilibrium = MASS * G / STIFFNESS;
    let mut network = heavy(standing(Waveform::constant(0.0)), GravityStart::Equilibrium);
    network.add_effect(stop(0.004));
    let vibration = Vibration::new(&network, 1.0, None).unwrap();
    let [limit] = vibration.limits() else { panic!("{:?}", vibration.limits()) };
    assert_eq!((limit.kind, limit.name.as_str()), (LimitKind::Stop, "pad.stop"));
    assert!((limit.reserve / (0.004 - static_equilibrium) - 1.0).abs() < 1e-12);
    let steady = |amplitude: f64| vibration.steady(natural() / TAU, amplitude).unwrap();
    let pad = |steady: &Steady| steady.elements[0].deformation.amplitude;
    let most = limit.reserve / pad(&steady(1.0));
    assert!(steady(0.999_999 * most).warnings.is_empty());
    let warnings = steady(1.000_001 * most).warnings;
    assert!(warnings[0].to_string().contains("`pad.stop` is reached at 31.8 Hz"), "{warnings:?}");
}

#[test]
fn a_contact_that_nothing_closes_is_refused_by_name() {
    let mut network = standing(Waveform::constant(0.0));
    network.add_effect(separation("device"));
    let refused = |network: &Network| Vibration::new(network, 1.0, None).unwrap_err().to_string();
    assert!(refused(&network).starts_with("nothing presses `pad.contact` together at rest"));
    let hanging = Gravity { acceleration: -G, start: GravityStart::Equilibrium };
    network.add_effect(hanging);
    assert!(refused(&network).starts_with("nothing presses `pad.contact` together at rest"));
    let mut network = heavy(standing(Waveform::constant(0.0)), GravityStart::Equilibrium);
    network.add_effect(stop(1e-4));
    assert!(refused(&network).starts_with("`pad.stop` is reached at rest"));
}

/// Another method: the run in time, once the transients are gone.
#[test]
fn a_run_in_time_parts_above_the_onset_and_not_below() {
    let frequency = top() * natural() / TAU;
    let omega = TAU * frequency;
    let most = G / closed(top()) / omega.powi(2);
    let duration = 60.0 / frequency;
    for (part, parts) in [(0.98, false), (1.02, true)] {
        let wave = dashpot_dae::Piece { sine: part * most, omega, ..Default::default() };
        let motion = Waveform::new(vec![wave]).unwrap();
        let mut network = heavy(standing(motion), GravityStart::Equilibrium);
        network.add_effect(separation("device"));
        let settings = SolveSettings::lasting(duration).by_name("exact").unwrap();
        let report = network.solve_with(&settings).unwrap();
        let late = |own: &&dashpot_dae::Switch| own.time > 0.5 * duration;
        let count = report.trajectory.switches.iter().filter(late).count();
        assert_eq!(count > 0, parts, "{part}: {count} switches");
    }
}

#[test]
fn what_creeps_under_its_weight_has_no_rest_to_judge_by() {
    let mut network = heavy(standing(Waveform::constant(0.0)), GravityStart::Unloaded);
    let creeping =
        Model::series([part(Spring { stiffness: STIFFNESS }), part(Dashpot { damping: 3e3 })]);
    network.set_model(0, creeping);
    network.add_effect(stop(0.1));
    let refused = Vibration::new(&network, 1.0, None).unwrap_err();
    assert_eq!(refused, VibrationError::Rest);
}
