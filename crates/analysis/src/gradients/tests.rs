//! Derivatives against closed forms.

use std::f64::consts::PI;

use dashpot_dae::methods;
use dashpot_network::{
    Model, Network, Node, dashpot,
    effects::{Gravity, GravityStart, Separation},
    elements::Contact,
    part, spring,
};

use super::*;

const G: f64 = 9.806_65;

fn numbers(all: &[(&str, &str, f64)]) -> Vec<Number> {
    all.iter().map(|(name, unit, value)| Number::new(*name, *unit, *value)).collect()
}

fn keys(all: &[&str]) -> Vec<String> {
    all.iter().map(|&own| own.to_owned()).collect()
}

fn struck(mass: f64, speed: f64, pad: Model) -> Network {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", mass).moving(speed));
    network.connect("pad", head, network.ground(), pad);
    network
}

/// The derivative is right within its own error, and within this part of itself.
fn assert_near(report: &GradientReport, pair: (&str, &str), right: f64, tolerance: f64) {
    let (key, number) = pair;
    let own = report.derivative(key, number).unwrap().clone().unwrap();
    let off = (own.value - right).abs();
    let allowed = tolerance * right.abs() + own.error * f64::from(u8::from(right == 0.0));
    assert!(off <= own.error, "{key} by {number}: {own:?} for {right}");
    assert!(off <= allowed, "{key} by {number}: {own:?} for {right}, off {:e}", off / right);
}

fn refusal(report: &GradientReport, key: &str, number: &str) -> NoDerivative {
    report.derivative(key, number).unwrap().clone().unwrap_err()
}

/// `F = v √(k m)`, which is let go after `π √(m/k)`; three solutions of two numbers take 1 + 2·2.
#[test]
fn the_peak_of_a_mass_on_a_spring() {
    let [m, v, k] = [4.0_f64, 3.0, 5e4];
    let numbers = numbers(&[("m", "kg", m), ("v", "m/s", v), ("k", "N/m", k), ("c", "N s/m", 0.0)]);
    let keys = keys(&["pad.peak-force", "pad.contact-time"]);
    let report = gradients(&numbers, &keys, 2, &|own| {
        let network = struck(own[0], own[1], spring(own[2]));
        Ok(ScenePoint { network, settings: SolveSettings::lasting(0.05) })
    })
    .unwrap();
    let (peak, time) = (v * (k * m).sqrt(), PI * (m / k).sqrt());
    for (number, value, of_time) in [("m", m, 0.5), ("v", v, 0.0), ("k", k, -0.5)] {
        let of_peak = if number == "v" { 1.0 } else { 0.5 };
        assert_near(&report, ("pad.peak-force", number), of_peak * peak / value, 1e-8);
        assert_near(&report, ("pad.contact-time", number), of_time * time / value, 1e-8);
    }
    assert_eq!(refusal(&report, "pad.peak-force", "c"), NoDerivative::NumberIsZero);
    assert_eq!(report.solutions, 1 + 2 * 3);
}

/// With `ζ = c/(2√(k m)) = cos β < 1/2` the peak is `v √(k m) exp(−ζ (3β − π)/√(1 − ζ²))`.
fn kelvin(choice: &Choice, tolerance: f64) -> GradientReport {
    let [m, v, k, c] = [5.0_f64, 4.0, 6e4, 300.0];
    let numbers = numbers(&[("m", "kg", m), ("v", "m/s", v), ("k", "N/m", k), ("c", "N s/m", c)]);
    let report = gradients(&numbers, &keys(&["pad.peak-force"]), 2, &|own| {
        let network = struck(own[0], own[1], spring(own[2]) | dashpot(own[3]));
        Ok(ScenePoint { network, settings: SolveSettings::lasting(0.05).by(choice.clone()) })
    })
    .unwrap();
    let ratio = c / (2.0 * (k * m).sqrt());
    let (angle, root) = (3.0 * ratio.acos() - PI, (1.0 - ratio * ratio).sqrt());
    let peak = v * (k * m).sqrt() * (-ratio * angle / root).exp();
    let of_ratio = ratio * (3.0 * ratio / root.powi(2) - angle / root.powi(3));
    let own = 0.5 - 0.5 * of_ratio;
    for (number, value, right) in [("m", m, own), ("v", v, 1.0), ("k", k, own), ("c", c, of_ratio)]
    {
        assert_near(&report, ("pad.peak-force", number), right * peak / value, tolerance);
    }
    report
}

#[test]
fn the_peak_of_a_kelvin_pad() {
    assert_eq!(kelvin(&Choice::Auto, 1e-7).solutions, 1 + 2 * 4);
}

/// Ten times the tolerance is what is asked for; an accuracy of 0.1 % is.
#[test]
fn stepping_methods_give_what_the_run_was_asked_for() {
    for method in ["bdf", "dop853", "tsit45"] {
        kelvin(&Choice::Method(methods::by_name(method).unwrap().into()), 1e-2);
    }
}

/// A ball falls from `h` and bounces off: it meets the ground after `√(2h/g) (1 + 2e + 2e² + …)`.
#[test]
fn the_bounces_of_a_ball() {
    let [h, g, e] = [0.8_f64, G, 0.7];
    let numbers = numbers(&[("h", "m", h), ("g", "m/s²", g), ("e", "1", e), ("m", "kg", 2.0)]);
    let report = gradients(&numbers, &[], 2, &|own| {
        let mut network = Network::new();
        let ball = network.add_node(Node::mass("ball", own[3]).moving(0.0));
        let floor = Contact { gap: own[0], restitution: own[2] };
        network.connect("floor", ball, network.ground(), part(floor));
        network.add_effect(Gravity { acceleration: own[1], start: GravityStart::Unloaded });
        Ok(ScenePoint { network, settings: SolveSettings::lasting(1.7) })
    })
    .unwrap();
    let fall = (2.0 * h / g).sqrt();
    let hits: Vec<&MeasureGradient> = report.events.iter().collect();
    assert!(hits.len() >= 3, "{:?}", report.events);
    let (mut time, mut slope) = (fall, 0.0);
    for (bounce, own) in hits.iter().enumerate().take(3) {
        let power = i32::try_from(bounce).unwrap();
        assert!((own.value.unwrap() - time).abs() < 1e-12, "{own:?} {time}");
        assert_near(&report, (&own.key, "h"), 0.5 * time / h, 1e-8);
        assert_near(&report, (&own.key, "g"), -0.5 * time / g, 1e-8);
        assert_near(&report, (&own.key, "m"), 0.0, 0.0);
        assert_near(&report, (&own.key, "e"), slope, 1e-8);
        time += 2.0 * fall * e.powi(power + 1);
        slope += 2.0 * fall * f64::from(power + 1) * e.powi(power);
    }
}

/// A mass bounces on a spring without loss: in contact for `T = 2/ω (π − atan(v ω/g))`, in flight for `2v/g`. What
/// does not follow where a contact ends is off from the second event on.
#[test]
fn releases_and_new_contacts_move_with_the_numbers() {
    let [m, v, k] = [3.0_f64, 2.0, 2e4];
    let all = numbers(&[("m", "kg", m), ("v", "m/s", v), ("k", "N/m", k), ("g", "m/s²", G)]);
    let pose = |own: &[f64]| {
        let mut network = struck(own[0], own[1], spring(own[2]));
        network.add_effect(Gravity { acceleration: own[3], start: GravityStart::Unloaded });
        network.add_effect(Separation {
            element: "pad".to_owned(),
            at: Some("head".to_owned()),
            restitution: 0.0,
        });
        Ok(ScenePoint { network, settings: SolveSettings::lasting(1.0) })
    };
    let report = gradients(&all, &keys(&["pad.peak-force"]), 2, &pose).unwrap();
    let rate = (k / m).sqrt();
    let part = v * rate / G;
    let contact = 2.0 / rate * (PI - part.atan());
    let flight = 2.0 * v / G;
    let bend = 2.0 / rate / (1.0 + part * part);
    // Of the time in contact with respect to ω, v and g.
    let of_rate = -contact / rate - bend * v / G;
    let (of_speed, of_gravity) = (-bend * rate / G, bend * part / G);
    let mut own = report.events.iter().filter(|own| own.value.unwrap() > 0.0);
    let (mut contacts, mut flights) = (0.0, 0.0);
    for event in 0..4 {
        if event % 2 == 0 {
            contacts += 1.0;
        } else {
            flights += 1.0;
        }
        let own = own.next().unwrap();
        let time = contacts * contact + flights * flight;
        assert!((own.value.unwrap() - time).abs() < 1e-11, "{own:?} {time}");
        let of_m = contacts * of_rate * -0.5 * rate / m;
        let of_k = contacts * of_rate * 0.5 * rate / k;
        let of_v = contacts * of_speed + flights * 2.0 / G;
        let of_g = contacts * of_gravity - flights * flight / G;
        for (number, right) in [("m", of_m), ("k", of_k), ("v", of_v), ("g", of_g)] {
            // Relative to the larger of the time and its change.
            let scale =
                own.value.unwrap() / all.iter().find(|own| own.name == number).unwrap().value;
            let tolerance = 1e-8 * (scale / right.abs()).max(1.0);
            assert_near(&report, (&own.key, number), right, tolerance);
        }
    }
}

/// A stop stands where the mass just comes to rest: beyond it the time in contact falls with the root of the speed.
#[test]
fn a_stop_that_is_just_touched_is_refused() {
    let [m, v, k] = [1.0_f64, 2.0, 1e4];
    let touch = v * (m / k).sqrt();
    let pose = |own: &[f64]| {
        let mut network = struck(m, own[0], spring(k));
        let head = network.node_named("head").unwrap();
        let stop = Contact { gap: touch, restitution: 1.0 };
        network.connect("stop", head, network.ground(), part(stop));
        Ok(ScenePoint { network, settings: SolveSettings::lasting(0.05) })
    };
    let report =
        gradients(&numbers(&[("v", "m/s", v)]), &keys(&["pad.contact-time"]), 2, &pose).unwrap();
    assert_eq!(refusal(&report, "pad.contact-time", "v"), NoDerivative::EventsChange);
    // Where it stands a little further nothing is in the way.
    let report =
        gradients(&numbers(&[("v", "m/s", 0.99 * v)]), &keys(&["pad.peak-force"]), 2, &pose)
            .unwrap();
    assert_near(&report, ("pad.peak-force", "v"), (k * m).sqrt(), 1e-8);
}

/// What a number cannot be is told as the scene tells it.
#[test]
fn scenes_that_cannot_be_posed_beside_say_so() {
    let report = gradients(&numbers(&[("n", "1", 3.0)]), &keys(&["pad.peak-force"]), 1, &|own| {
        if own[0].fract() != 0.0 {
            return Err("n is a whole number".to_owned());
        }
        let network = struck(1.0, 1.0, spring(own[0] * 1e3));
        Ok(ScenePoint { network, settings: SolveSettings::lasting(0.2) })
    })
    .unwrap();
    let reason = "n is a whole number".to_owned();
    assert_eq!(refusal(&report, "pad.peak-force", "n"), NoDerivative::NoNeighbour { reason });
}
