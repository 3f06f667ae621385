//! The whole chain against closed forms, by every method.
//!
//! `exact` must stay within the bound that it states; the others within ten times the error bar
//! that three solutions at tolerances a factor 10 apart give (largest difference over time): the bar
//! itself is made to hold in 99 of 100 scenes.

use std::f64::consts::TAU;

use dashpot::{
    dae::Waveform,
    network::{
        Network, Node,
        effects::{Gravity, GravityStart},
        waveforms::{Sine, WaveformKind},
    },
    rheology::Tree,
};

use crate::thesis::{Solved, burgers, dashpot, kelvin, solve, spring};

/// Compares an output with a closed form at 400 times, by every method.
fn check(name: &str, network: &Network, duration: f64, output: &str, closed: impl Fn(f64) -> f64) {
    check_by(
        &["exact", "bdf", "tr-bdf2", "esdirk34", "tsit45"],
        name,
        network,
        duration,
        output,
        closed,
    );
}

fn check_by(
    methods: &[&str],
    name: &str,
    network: &Network,
    duration: f64,
    output: &str,
    closed: impl Fn(f64) -> f64,
) {
    let times: Vec<f64> = (1..=400).map(|at| duration * f64::from(at) / 400.0).collect();
    let scale = times.iter().map(|&t| closed(t).abs()).fold(0.0, f64::max);
    let gap = |one: &[f64], other: &[f64]| {
        one.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    let truth: Vec<f64> = times.iter().map(|&t| closed(t)).collect();
    for method in methods {
        let by = |rtol: f64| -> (Solved, Vec<f64>) {
            let solved = solve(network, method, duration, rtol);
            let values = solved.signal(output).sample(&times);
            (solved, values)
        };
        let (finest, values) = by(1e-8);
        let bar = if *method == "exact" {
            let bound = finest.signal(output).error.expect("exact states a bound");
            assert!(bound <= 1e-9 * scale, "{name}: the bound {bound:e} is useless at {scale:e}");
            bound
        } else {
            let [coarse, middle] = [1e-6, 1e-7].map(|rtol| by(rtol).1);
            gap(&middle, &values).max(gap(&coarse, &middle) / 8.0)
        };
        let error = gap(&values, &truth);
        let rounding = 1e-14 * scale;
        let bars = if *method == "exact" { 1.0 } else { 10.0 };
        assert!(error <= bars * bar + rounding, "{name} by {method}: error {error:e}, bar {bar:e}");
        assert!(error <= 1e-3 * scale, "{name} by {method}: error {error:e} of {scale:e}");
    }
}

fn one_mass(mass: f64, speed: f64, pad: dashpot::network::Model) -> Network {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", mass).moving(speed));
    network.connect("pad", head, network.ground(), pad);
    network
}

#[test]
fn kelvin_voigt_oscillator_in_three_regimes() {
    let (m, k, v) = (2.0, 50.0, 3.0);
    let natural = 5.0;
    for zeta in [0.2, 1.0, 3.0] {
        let network = one_mass(m, v, kelvin(k, 2.0 * zeta * f64::sqrt(k * m)));
        let way = |t: f64| {
            let (decay, root) = (zeta * natural, natural * f64::abs(1.0 - zeta * zeta).sqrt());
            let shape = if zeta < 1.0 {
                (root * t).sin() / root
            } else if zeta > 1.0 {
                (root * t).sinh() / root
            } else {
                t
            };
            v * (-decay * t).exp() * shape
        };
        check(&format!("Kelvin-Voigt, zeta = {zeta}"), &network, 2.0, "head.position", way);
    }
}

#[test]
fn maxwell_impact_with_and_without_oscillation() {
    let (m, k, v) = (2.0, 50.0, 3.0);
    for c in [2.0, 40.0] {
        let network = one_mass(m, v, Tree::series([spring(k), dashpot(c)]));
        let (half, square) = (0.5 * k / c, k / m - 0.25 * (k / c) * (k / c));
        let force = |t: f64| {
            let root = f64::abs(square).sqrt();
            let shape = if square > 0.0 { (root * t).sin() } else { (root * t).sinh() };
            k * v / root * (-half * t).exp() * shape
        };
        check(&format!("Maxwell, C = {c}"), &network, 3.0, "pad.force", force);
    }
}

#[test]
fn zener_with_a_triple_root() {
    let maxwell = Tree::series([spring(8.0 / 3.0), dashpot(8.0 / 9.0)]);
    let network = one_mass(1.0, 1.0, Tree::parallel([spring(1.0 / 3.0), maxwell]));
    check("Zener, triple root", &network, 8.0, "head.position", |t| (t + t * t) * (-t).exp());
}

#[test]
fn two_masses_move_in_their_two_modes() {
    let (m, k, coupling, v) = (1.5, 30.0, 20.0, 2.0);
    let mut network = Network::new();
    let left = network.add_node(Node::mass("left", m).moving(v));
    let right = network.add_node(Node::mass("right", m));
    network.connect("coupling", left, right, spring(coupling));
    network.connect("wall-left", left, network.ground(), spring(k));
    network.connect("wall-right", right, network.ground(), spring(k));
    let slow = f64::sqrt(k / m);
    let fast = f64::sqrt((k + 2.0 * coupling) / m);
    check("two modes", &network, 2.0, "right.position", |t| {
        0.5 * v * ((slow * t).sin() / slow - (fast * t).sin() / fast)
    });
}

#[test]
fn burgers_creeps_under_a_constant_force() {
    let (k1, c1, k2, c2, load) = (2e7, 4e3, 1e7, 6e3, 500.0);
    let mut network = Network::new();
    let plate = network.add_node(Node::massless("plate"));
    network.connect("pad", plate, network.ground(), burgers(k1, c1, k2, c2));
    network.add_load("weight", plate, Waveform::constant(load));
    check("creep", &network, 1e-3, "pad.deformation", |t| {
        load * (1.0 / k2 + t / c2 - (-t * k1 / c1).exp_m1() / k1)
    });
}

#[test]
fn burgers_relaxes_under_a_constant_deformation() {
    let (k1, c1, k2, c2, step) = (2e7, 4e3, 1e7, 6e3, 1e-3);
    let mut network = Network::new();
    let plate = network.add_node(Node::prescribed("plate", Waveform::constant(step)));
    network.connect("pad", plate, network.ground(), burgers(k1, c1, k2, c2));
    // Equation 2.12 with y' = 0: F'' + p F' + q F = q2 with F(0) = K2 y, F'(0) = -K2 (1/C1 + 1/C2) F(0).
    let p = k1 / c1 + k2 / c1 + k2 / c2;
    let q = k1 * k2 / (c1 * c2);
    let root = f64::sqrt(0.25 * p * p - q);
    let (slow, fast) = (q / (0.5 * p + root), 0.5 * p + root);
    let (f0, f1) = (k2 * step, -k2 * step * k2 * (1.0 / c1 + 1.0 / c2));
    let slow_part = (f1 + fast * f0) / (fast - slow);
    check("relaxation", &network, 2e-3, "pad.force", |t| {
        slow_part * (-slow * t).exp() + (f0 - slow_part) * (-fast * t).exp()
    });
}

#[test]
fn a_base_that_shakes_a_mass_on_a_spring() {
    let (m, k, way, hertz) = (2.0, 50.0, 0.01, 1.3);
    let mut network = Network::new();
    let shake = Sine { amplitude: way, frequency: hertz, phase: 0.0 }.waveform().unwrap();
    let base = network.add_node(Node::prescribed("base", shake));
    let parcel = network.add_node(Node::mass("parcel", m));
    network.connect("cushion", parcel, base, spring(k));
    let (natural, omega) = (f64::sqrt(k / m), TAU * hertz);
    let ratio = omega / natural;
    check("base excitation", &network, 3.0, "parcel.position", |t| {
        way / (1.0 - ratio * ratio) * ((omega * t).sin() - ratio * (natural * t).sin())
    });
}

#[test]
fn gravity_from_unloaded_and_from_equilibrium() {
    let (m, k, g) = (2.0, 50.0, 9.806_65);
    let natural = f64::sqrt(k / m);
    let mut network = Network::new();
    let parcel = network.add_node(Node::mass("parcel", m));
    network.connect("cushion", parcel, network.ground(), spring(k));
    let with = |start| {
        let mut network = network.clone();
        network.add_effect(Gravity { acceleration: g, start });
        network
    };
    check("unloaded", &with(GravityStart::Unloaded), 3.0, "parcel.position", |t| {
        m * g / k * (1.0 - (natural * t).cos())
    });
    check("equilibrium", &with(GravityStart::Equilibrium), 3.0, "cushion.force", |_| m * g);
    check(
        "weight on a scale",
        &with(GravityStart::Equilibrium),
        3.0,
        "parcel.acceleration",
        |_| -g,
    );
}

#[test]
fn free_fall_reads_zero_and_moves_by_half_g_t_squared() {
    let mut network = Network::new();
    network.add_node(Node::mass("stone", 3.0).moving(1.0));
    network.add_effect(Gravity { acceleration: 9.806_65, start: GravityStart::Unloaded });
    check("free fall", &network, 2.0, "stone.position", |t| t + 0.5 * 9.806_65 * t * t);
    let solved = solve(&network, "exact", 2.0, 1e-6);
    assert!(solved.signal("stone.acceleration").bound() <= 0.0);
}

#[test]
fn a_dashpot_stops_a_mass_exponentially() {
    let (m, c, v) = (2.0, 5.0, 3.0);
    let network = one_mass(m, v, dashpot(c));
    check("dashpot", &network, 2.0, "head.velocity", |t| v * (-c / m * t).exp());
}

#[test]
fn a_massless_node_between_two_dashpots_and_a_spring() {
    // The node moves at ẋ = (c1 v − k x)/(c1 + c2) with the prescribed v = U of a ramp.
    let (c1, c2, k, speed) = (3.0, 2.0, 10.0, 0.5);
    let ramp = dashpot::network::waveforms::Ramp { height: speed * 10.0, rise: 10.0, start: 0.0 };
    let mut network = Network::new();
    let driver = network.add_node(Node::prescribed("driver", ramp.waveform().unwrap()));
    let node = network.add_node(Node::massless("node"));
    network.connect("in", driver, node, dashpot(c1));
    network.connect("out", node, network.ground(), dashpot(c2));
    network.connect("back", node, network.ground(), spring(k));
    check("two dashpots", &network, 2.0, "node.position", |t| {
        -c1 * speed / k * (-k * t / (c1 + c2)).exp_m1()
    });
}

#[test]
fn a_series_of_springs_and_dashpots_in_any_order_is_one_maxwell_element() {
    let springs = [1154.7, 7011.0];
    let dashpots = [284.2, 42.6, 3.79, 6347.0, 1888.0, 4875.0, 23.7];
    let sum = |constants: &[f64]| 1.0 / constants.iter().map(|c| 1.0 / c).sum::<f64>();
    let (m, v, k, c) = (2.565, 22.98, sum(&springs), sum(&dashpots));
    let half = 0.5 * k / c;
    let root = f64::sqrt(half * half - k / m);
    let force = |t: f64| k * v / root * (-half * t).exp() * (root * t).sinh();
    let mut parts: Vec<_> =
        springs.iter().map(|&k| spring(k)).chain(dashpots.iter().map(|&c| dashpot(c))).collect();
    for turn in 0..4 {
        parts.rotate_left(2 + turn);
        let network = one_mass(m, v, Tree::series(parts.clone()));
        check(&format!("nine in series, turn {turn}"), &network, 0.135, "pad.force", force);
    }
}
