//! Measures where speeds jump, and where contacts part.

use dashpot_network::{
    Model, Network, Node,
    effects::{Face, Gravity, GravityStart, Separation, Touch},
    elements::{Contact, Dashpot, Friction, Spring},
    part,
};

use super::*;
use crate::{MeasureReport, MeasureWish, RunReport, Solve, SolveSettings};

const RUN: WindowWish = WindowWish::Run;

fn kelvin(stiffness: f64, damping: f64) -> Model {
    Model::parallel([part(Spring { stiffness }), part(Dashpot { damping })])
}

/// Solves with all measures of these elements and nodes.
fn solved(network: &Network, duration: f64, elements: &[&str], nodes: &[&str]) -> RunReport {
    let mut settings = SolveSettings::lasting(duration).by_name("exact").unwrap();
    for &element in elements {
        settings.measures.push(MeasureWish::new(element, CoefficientOfRestitution {}));
        settings.measures.push(MeasureWish::new(element, PeakRate::default()));
    }
    for &node in nodes {
        settings.measures.push(MeasureWish::new(node, EndVelocity::default()));
        settings.measures.push(MeasureWish::new(node, AverageDeceleration::default()));
        settings.measures.push(MeasureWish::new(node, Hic15::default()));
    }
    network.solve_with(&settings).unwrap()
}

fn measure<'r>(report: &'r RunReport, key: &str) -> &'r MeasureReport {
    report.measure(key).expect(key)
}

/// A value that is right to twelve digits and within its bound.
fn is(report: &RunReport, key: &str, expected: f64) {
    let found = measure(report, key);
    close(found.value, expected, 1e-12);
    let error = found.error.expect(key);
    let off = (found.value.expect(key) - expected).abs();
    assert!(off <= error, "{key} is {off:e} off, its bound {error:e}");
}

fn is_infinite(report: &RunReport, key: &str, when: &str) {
    let found = measure(report, key);
    assert_eq!(found.value, None, "{key}");
    let note = found.note().unwrap_or_default();
    assert!(note.contains(&format!("infinite (speed jumps at {when})")), "{key}: {note}");
}

/// 2 kg that fall by 1 m under 10 m/s² on rigid ground.
fn ball(restitution: f64) -> Network {
    let mut network = Network::new();
    let ball = network.add_node(Node::mass("ball", 2.0).moving(0.0));
    let ground = network.ground();
    network.connect("floor", ball, ground, part(Contact { gap: 1.0, restitution }));
    network.add_effect(Gravity { acceleration: 10.0, start: GravityStart::Unloaded });
    network
}

#[test]
fn energy_lost_on_rigid_ground_is_known_to_what_its_impacts_are() {
    // All impulses of a fall with 2√5 m/s that ends in rest; the weight is carried for far longer.
    let (e, speed) = (0.5, 20.0_f64.sqrt());
    let impulses = 2.0 * speed * (1.0 + e) / (1.0 - e);
    let report = solved(&ball(e), 200.0, &["floor"], &["ball"]);
    let of_velocity = report.solution().velocity_error(1).unwrap();
    let found = measure(&report, "floor.energy-at-end");
    let (off, error) = ((found.value.unwrap() - 20.0).abs(), found.error.unwrap());
    assert!(off <= error && error <= 2.0 * impulses * of_velocity, "{off:e}, {error:e}");
}

#[test]
fn bounce_on_rigid_ground_has_finite_and_infinite_measures() {
    let (e, speed) = (0.5, 20.0_f64.sqrt());
    let report = solved(&ball(e), 0.8, &["floor"], &["ball"]);
    for key in ["floor.peak-force", "ball.peak-acceleration", "ball.severity-index", "ball.hic15"] {
        is_infinite(&report, key, "447 ms");
    }
    is_infinite(&report, "ball.average-deceleration", "447 ms");
    is(&report, "floor.contact-time", 0.0);
    is(&report, "floor.impulse", 2.0 * (1.0 + e) * speed);
    is(&report, "floor.energy", 20.0 * (1.0 - e * e));
    is(&report, "floor.coefficient-of-restitution", e);
    is(&report, "floor.peak-rate", speed);
    is(&report, "ball.end-velocity", -e * speed);
    assert_eq!(report.contacts[0].impact.contact, crate::Contact::Parted);
    assert!((report.contacts[0].impact.end - 0.2_f64.sqrt()).abs() < 1e-15);
}

#[test]
fn ball_that_stays_is_in_contact_until_the_end() {
    let report = solved(&ball(0.0), 1.0, &["floor"], &["ball"]);
    assert_eq!(report.contacts[0].impact.contact, crate::Contact::Lasting);
    assert!((report.contacts[0].impact.start - 0.2_f64.sqrt()).abs() < 1e-15);
    // What gravity has given in 1 s is all taken back.
    is(&report, "floor.impulse", 20.0);
    is(&report, "floor.energy", 20.0);
    assert_eq!(measure(&report, "floor.contact-time").value, None);
    let mean = 20.0 / 2.0 / (1.0 - 0.2_f64.sqrt());
    is(&report, "ball.average-deceleration", mean);
}

#[test]
fn window_without_a_jump_has_finite_measures() {
    let mut settings = SolveSettings::lasting(1.0).by_name("exact").unwrap();
    let window = WindowWish::Times(0.5, 1.0);
    settings.measures.push(MeasureWish::new("floor", PeakForce { window }));
    settings.measures.push(MeasureWish::new("floor", Impulse { window }));
    settings.measures.push(MeasureWish::new("ball", SeverityIndex { exponent: 1.0, window: RUN }));
    let report = ball(0.0).solve_with(&settings).unwrap();
    is(&report, "floor.peak-force-2", 20.0);
    is(&report, "floor.impulse-2", 10.0);
    // The jump of speed, and then 10 m/s² at rest.
    let still = 1.0 - 0.2_f64.sqrt();
    let index = report.measures.iter().rfind(|measure| measure.kind == "severity-index").unwrap();
    close(index.value, (20.0_f64.sqrt() + 10.0 * still) / STANDARD_GRAVITY, 1e-12);
}

#[test]
fn springs_in_a_row_have_a_restitution_with_a_bound() {
    // No mass stands between tip and foot: the rate of the tip follows from that of the head, of which it is a
    // third. m = 1 kg on 10 kN/m and 60 N s/m is let go by the springs after half a period, with e^(−δt) of
    // its speed.
    for is_let_go in [false, true] {
        let mut network = Network::new();
        let head = network.add_node(Node::mass("head", 1.0).moving(10.0));
        let middle = network.add_node(Node::massless("middle"));
        let ground = network.ground();
        network.connect("tip", head, middle, part(Spring { stiffness: 3e4 }));
        network.connect("foot", middle, ground, part(Spring { stiffness: 1.5e4 }));
        network.connect("brake", head, ground, part(Dashpot { damping: 60.0 }));
        if is_let_go {
            let (element, at) = ("tip".to_owned(), Some("head".to_owned()));
            network.add_effect(Separation { element, at, restitution: 0.0 });
        }
        let report = solved(&network, 0.1, &["tip"], &[]);
        let e = (-30.0 * PI / 9100.0_f64.sqrt()).exp();
        is(&report, "tip.coefficient-of-restitution", e);
        is(&report, "tip.peak-rate", 10.0 / 3.0);
    }
}

#[test]
fn kelvin_voigt_pad_lets_go_with_the_closed_restitution_after_a_flight() {
    // m = 1 kg, ω₀ = 100/s, ζ = 0.3; 0.5 m of free flight at 10 m/s. The force falls to zero where
    // tan(ω t) = 2δω/(δ² − ω²), and the speed is then e^(−δt) of that before.
    let (delta, omega) = (30.0_f64, 9100.0_f64.sqrt());
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 1.0).moving(10.0));
    let face = network.add_node(Node::massless("face"));
    let ground = network.ground();
    network.connect("touch", head, face, part(Contact { gap: 0.5, restitution: 0.0 }));
    network.connect("pad", face, ground, kelvin(1e4, 60.0));
    let report = solved(&network, 0.2, &["pad"], &["head"]);
    let contact = (PI - (2.0 * delta * omega).atan2(omega * omega - delta * delta)) / omega;
    let e = (-delta * contact).exp();
    assert!((report.contacts[0].impact.start - 0.05).abs() < 1e-15);
    is(&report, "pad.contact-time", contact);
    is(&report, "pad.coefficient-of-restitution", e);
    is(&report, "pad.impulse", 10.0 * (1.0 + e));
    is(&report, "pad.energy", 50.0 * (1.0 - e * e));
    // Each derivative of e^(−δt) sin(ωt + θ) has ω₀ times the size and a phase greater by φ.
    let phase = f64::acos(-0.3);
    let angle = 2.0 * PI - 3.0 * phase;
    let force = -1e5 / omega * (-delta * angle / omega).exp() * (angle + 2.0 * phase).sin();
    is(&report, "pad.peak-force", force);
    close(measure(&report, "pad.peak-rate").value, 10.0, 1e-12);
    is(&report, "head.end-velocity", -10.0 * e);
    is(&report, "head.peak-acceleration", force);
    is(&report, "head.average-deceleration", 10.0 * (1.0 + e) / contact);
    assert!(report.warnings.is_empty(), "{:?}", report.warnings);
    assert_eq!(report.contacts[0].impact.contact, crate::Contact::Parted);
    let told: Vec<String> = report.events.iter().map(|event| event.what.to_string()).collect();
    assert_eq!(told, ["touch closes", "touch opens"]);
}

/// 10 kg at 10 m/s on a pad that lets go, with a face of 1 kg at rest.
fn faced(restitution: f64) -> Network {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 10.0).moving(10.0));
    let ground = network.ground();
    network.connect("pad", head, ground, kelvin(2e6, 2e3));
    let element = || "pad".to_owned();
    network.add_effect(Separation { element: element(), at: None, restitution });
    network.add_effect(Face { element: element(), mass: 1.0, at: None, touch: Touch::Impact });
    network
}

/// How long head and face press the pad \[s\] if they meet it as one: until its force is zero.
fn pressed_for() -> f64 {
    let (delta, square) = (2e3 / 22.0, 2e6 / 11.0);
    let omega = f64::sqrt(square - delta * delta);
    (PI - (2.0 * delta * omega).atan2(omega * omega - delta * delta)) / omega
}

#[test]
fn plastic_touch_of_a_face_with_mass_keeps_momentum() {
    let report = solved(&faced(0.0), 0.03, &["pad.contact"], &["head"]);
    is_infinite(&report, "pad.contact.peak-force", "0 s");
    is_infinite(&report, "head.peak-acceleration", "0 s");
    // Half of the reduced mass times the square of the speed is lost.
    is(&report, "pad.contact.energy", 0.5 * (10.0 / 11.0) * 100.0);
    // Both together are a Kelvin–Voigt oscillator; they part without speed where it has no force.
    let time = pressed_for();
    let speed = 100.0 / 11.0 * (-2e3 / 22.0 * time).exp();
    is(&report, "pad.contact.contact-time", time);
    is(&report, "head.end-velocity", -speed);
    is(&report, "pad.contact.impulse", 10.0 * (10.0 + speed));
    is(&report, "pad.contact.coefficient-of-restitution", 0.0);
    let told: Vec<String> = report.events.iter().map(|event| event.what.to_string()).collect();
    assert_eq!(told[0], "head meets the pad: impact of 9.09 N s, which loses 45.5 J");
    assert_eq!(told[1], "head leaves the pad");
    assert!(
        report
            .warnings
            .iter()
            .all(|warning| !warning.code().contains("pulls")
                && !warning.to_string().contains("pulls")),
        "{:?}",
        report.warnings
    );
}

#[test]
fn impulse_is_what_the_head_loses_of_its_momentum() {
    // Through all bounces on the face and through the contact that follows.
    let mut settings = SolveSettings::lasting(0.03).by_name("exact").unwrap();
    settings.measures.push(MeasureWish::new("pad.contact", Impulse { window: RUN }));
    settings.measures.push(MeasureWish::new("head", EndVelocity { window: RUN }));
    let report = faced(0.5).solve_with(&settings).unwrap();
    assert!(report.contacts[0].again > 5, "{}", report.contacts[0].again);
    let value = |key: &str| measure(&report, key).value.unwrap();
    let sum = value("pad.contact.impulse-2");
    let lost = 10.0 * (10.0 - value("head.end-velocity"));
    assert!((sum / lost - 1.0).abs() < 1e-10, "{sum} {lost}");
}

#[test]
fn padding_is_pressed_through_all_bounces_of_its_face() {
    let mut settings = SolveSettings::lasting(0.03).by_name("exact").unwrap();
    settings.measures.push(MeasureWish::new("pad", CoefficientOfRestitution {}));
    settings.measures.push(MeasureWish::new("pad", PeakForce { window: RUN }));
    settings.measures.push(MeasureWish::new("pad.contact", Impulse { window: RUN }));
    settings.measures.push(MeasureWish::new("head", EndVelocity::default()));
    let report = faced(0.3).solve_with(&settings).unwrap();
    let value = |key: &str| measure(&report, key).value.unwrap();
    let speed = value("head.end-velocity");
    // What the pad has taken is what both have lost of their momentum; they part with one speed.
    let lost = 10.0 * 10.0 - 11.0 * speed;
    assert!((value("pad.impulse") / lost - 1.0).abs() < 1e-10, "{} {lost}", value("pad.impulse"));
    let sum = 10.0 * (10.0 - speed);
    assert!((value("pad.contact.impulse-2") / sum - 1.0).abs() < 1e-10, "{sum}");
    assert!((value("pad.coefficient-of-restitution") + speed / 10.0).abs() < 1e-12, "{speed}");
    close(measure(&report, "pad.peak-force").value, value("pad.peak-force-2"), 1e-12);
    // The bounces take little of the time of a plastic touch.
    let time = value("pad.contact-time");
    assert!((time / pressed_for() - 1.0).abs() < 0.01, "{time}");
    let after =
        report.energy_after_impact.as_ref().map(|energy_after_impact| energy_after_impact.time);
    assert_eq!(after, measure(&report, "pad.contact-time").time);
}

#[test]
fn face_that_is_thrown_presses_the_padding_until_it_is_unloaded() {
    // 1 kg at 10 m/s leaves a face of 4 kg at −6 m/s, which goes on at 4 m/s on a spring alone.
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 1.0).moving(10.0));
    let ground = network.ground();
    network.connect("pad", head, ground, part(Spring { stiffness: 4e4 }));
    let element = || "pad".to_owned();
    network.add_effect(Separation { element: element(), at: None, restitution: 1.0 });
    network.add_effect(Face { element: element(), mass: 4.0, at: None, touch: Touch::Impact });
    let report = solved(&network, 0.05, &["pad"], &["head"]);
    is(&report, "pad.peak-force", 4.0 * f64::sqrt(4e4 * 4.0));
    is(&report, "pad.contact-time", PI / 100.0);
    is(&report, "pad.impulse", 2.0 * 4.0 * 4.0);
    is(&report, "pad.coefficient-of-restitution", 0.6);
    is(&report, "head.end-velocity", -6.0);
    let text = report.warnings.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
    assert!(
        !text.contains("in tension") && !text.contains("pulls") && !text.contains("in contact"),
        "{text}"
    );
}

#[test]
fn bodies_that_bounce_on_an_unloaded_padding_have_an_impact_of_each() {
    // Falls that come back: each is far longer than the time for which the padding is pressed.
    let mut network = faced(0.3);
    network.add_effect(Gravity { acceleration: 10.0, start: GravityStart::Equilibrium });
    let settings = SolveSettings::lasting(3.0).by_name("exact").unwrap();
    let report = network.solve_with(&settings).unwrap();
    let time = measure(&report, "pad.contact-time").value.unwrap();
    assert!((time / pressed_for() - 1.0).abs() < 0.01, "{time}");
}

#[test]
fn block_between_two_walls_has_an_impact_of_each() {
    // Friction takes 2·2 N·d off the square of the speed of 1 kg on each way d.
    let mut network = Network::new();
    let block = network.add_node(Node::mass("block", 1.0).moving(3.0));
    let ground = network.ground();
    network.connect("right", block, ground, part(Contact { gap: 0.2, restitution: 0.8 }));
    network.connect("left", ground, block, part(Contact { gap: 0.1, restitution: 0.6 }));
    network.connect("slide", block, ground, part(Friction { force: 2.0, ratio: 1.0 }));
    let report = solved(&network, 1.0, &["right", "left"], &["block"]);
    let first = f64::sqrt(9.0 - 4.0 * 0.2);
    let second = f64::sqrt(0.64 * first * first - 4.0 * 0.3);
    is(&report, "right.impulse", 1.8 * first);
    is(&report, "left.impulse", 1.6 * second);
    is(&report, "right.coefficient-of-restitution", 0.8);
    is(&report, "left.coefficient-of-restitution", 0.6);
    is(&report, "right.energy", 0.5 * 0.36 * first * first);
    is(&report, "left.energy", 0.5 * 0.64 * second * second);
    assert!(report.warnings.is_empty(), "{:?}", report.warnings);
}

#[test]
fn what_passes_an_impulse_on_has_no_jump() {
    // The middle one of three equal balls gets what it gives.
    let mut network = Network::new();
    let one = network.add_node(Node::mass("one", 1.0).moving(1.0));
    let two = network.add_node(Node::mass("two", 1.0));
    let three = network.add_node(Node::mass("three", 1.0));
    let contact = |gap: f64| part(Contact { gap, restitution: 0.0 });
    network.connect("first", one, two, contact(0.1));
    network.connect("second", two, three, contact(0.0));
    let report = solved(&network, 0.3, &["first", "second"], &["one", "three"]);
    is(&report, "first.impulse", 2.0 / 3.0);
    is_infinite(&report, "one.peak-acceleration", "100 ms");
    is_infinite(&report, "three.hic15", "100 ms");
    is(&report, "one.end-velocity", 1.0 / 3.0);
    is(&report, "three.end-velocity", 1.0 / 3.0);
}

#[test]
fn every_switching_is_an_event() {
    let report = solved(&ball(0.9), 9.0, &[], &[]);
    let count = report.trajectory.switches.len();
    assert!(count > 25, "{count}");
    let times = |own: &[crate::EventReport]| own.iter().map(|own| own.time).collect::<Vec<f64>>();
    let switched: Vec<f64> = report.trajectory.switches.iter().map(|own| own.time).collect();
    assert_eq!(times(&report.events), switched);
}
