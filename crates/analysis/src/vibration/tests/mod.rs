mod contacts;
mod modes;
mod near_pole;
mod quantities;

use std::f64::consts::TAU;

use dashpot_dae::{Piece, Waveform};
use dashpot_network::{
    Model, Network, Node, NodeId, dashpot,
    effects::{Gravity, GravityStart},
    spring,
};
use nalgebra::Complex;

use super::*;

type C = Complex<f64>;

const MASS: f64 = 2.0;
const STIFFNESS: f64 = 8e4;

/// A mass on a model on the ground.
fn mount(model: Model) -> Network {
    let mut network = Network::new();
    let device = network.add_node(Node::mass("device", MASS));
    network.connect("mount", device, network.ground(), model);
    network
}

fn natural() -> f64 {
    (STIFFNESS / MASS).sqrt()
}

fn kelvin_voigt(zeta: f64) -> Model {
    Model::parallel([spring(STIFFNESS), dashpot(2.0 * zeta * (STIFFNESS * MASS).sqrt())])
}

/// The transmissibility of the mount of one mass on a Kelvin–Voigt element.
fn closed(zeta: f64, r: f64) -> C {
    let loss = C::new(0.0, 2.0 * zeta * r);
    (loss + 1.0) / (loss + (1.0 - r) * (1.0 + r))
}

fn shaken(network: &Network) -> Vibration {
    Vibration::new(network, 1.0, Some("ground")).unwrap()
}

fn range(from: f64, to: f64, points: usize) -> SweepSettings {
    SweepSettings { from: Some(from), to: Some(to), points, ..SweepSettings::default() }
}

/// The ratio of the only receiver at `omega` \[rad/s\], with its error.
fn ratio(vibration: &Vibration, omega: f64) -> (C, f64) {
    let sweep = vibration.sweep(&range(omega / TAU, omega, 2)).unwrap();
    let own = sweep.transmissions[0].swings[0].unwrap();
    (C::from_polar(own.amplitude, own.phase), own.error)
}

#[track_caller]
fn close(own: C, exact: C, relative: f64) {
    let off = (own - exact).norm() / exact.norm();
    assert!(off <= relative, "{own} {exact}: {off:e}");
}

#[test]
fn a_kelvin_voigt_mount_is_that_of_the_textbooks() {
    for zeta in [1e-4_f64, 1e-3, 0.05, 0.3, 1.0, 5.0] {
        let vibration = shaken(&mount(kelvin_voigt(zeta)));
        for r in [1e-3, 0.5, 1.0 - zeta.min(0.5), 1.0, 1.0 + zeta, 1.5, 30.0, 1e4] {
            let (own, error) = ratio(&vibration, r * natural());
            let omega = TAU * (r * natural() / TAU);
            let exact = closed(zeta, omega / natural());
            // Near a sharp resonance a rounding of the frequency weighs 1/(2 zeta).
            let amplified = f64::EPSILON / zeta;
            let off = (own.norm() - exact.norm()).abs() / exact.norm();
            assert!(off <= 1e-12_f64.max(amplified), "{zeta} {r}: {off:e}");
            assert!((own - exact).norm() <= error.max(2.0 * amplified * exact.norm()));
            if (r - 1.0).abs() < 1e-15 {
                assert!(off <= 1e-12, "{zeta}: {off:e}");
            }
        }
    }
}

#[test]
fn zener_and_maxwell_mounts_follow_their_complex_stiffness() {
    let (k, c) = (3e5, 400.0);
    let maxwell = || Model::series([spring(k), dashpot(c)]);
    let maxwell_stiffness = |s: C| s * k * c / (s * c + k);
    let zener = Model::parallel([spring(STIFFNESS), maxwell()]);
    let cases: [(Model, &dyn Fn(C) -> C); 2] =
        [(maxwell(), &maxwell_stiffness), (zener, &|s| maxwell_stiffness(s) + STIFFNESS)];
    for (model, stiffness) in cases {
        let vibration = shaken(&mount(model));
        for omega in [1.0, 20.0, 150.0, 200.0, 400.0, 750.0, 3e4] {
            let s = C::new(0.0, TAU * (omega / TAU));
            let own = stiffness(s);
            close(ratio(&vibration, omega).0, own / (own + s * s * MASS), 1e-12);
        }
    }
}

fn two_masses() -> (Network, NodeId) {
    let mut network = Network::new();
    let panel = network.add_node(Node::mass("panel", 5.0));
    let device = network.add_node(Node::mass("device", MASS));
    network.connect("pad", device, panel, Model::parallel([spring(2e4), dashpot(30.0)]));
    network.connect(
        "mount",
        panel,
        network.ground(),
        Model::parallel([spring(9e4), dashpot(80.0)]),
    );
    (network, device)
}

#[test]
fn two_masses_follow_their_two_equations() {
    let vibration = shaken(&two_masses().0);
    for omega in [10.0, 80.0, 130.0, 250.0, 5e3] {
        let s = C::new(0.0, TAU * (omega / TAU));
        let (pad, base) = (s * 30.0 + 2e4, s * 80.0 + 9e4);
        let [a, d] = [s * s * 5.0 + pad + base, s * s * MASS + pad];
        let below = a * d - pad * pad;
        let sweep = vibration.sweep(&range(omega / TAU, omega, 2)).unwrap();
        let [panel, device] = &sweep.transmissions[..] else { panic!() };
        let value = |own: &Transmission| {
            let own = own.swings[0].unwrap();
            C::from_polar(own.amplitude, own.phase)
        };
        close(value(panel), base * d / below, 1e-12);
        close(value(device), base * pad / below, 1e-12);
    }
}

#[test]
fn a_force_arrives_at_the_support_as_a_motion_of_the_support_arrives_at_the_mass() {
    let (mut network, device) = two_masses();
    network.add_load("ram", device, Waveform::constant(7.0));
    let pushed = Vibration::new(&network, 1.0, None).unwrap();
    assert_eq!((pushed.drive().kind, pushed.drive().name.as_str()), (DriveKind::Load, "ram"));
    let moved = shaken(&network);
    let settings = range(0.1, 1e4, 60);
    let force = pushed.sweep(&settings).unwrap();
    let motion = moved.sweep(&SweepSettings { of: vec!["device".into()], ..settings }).unwrap();
    assert_eq!(force.transmissions[0].name, "ground");
    let pairs = force.transmissions[0].swings.iter().zip(&motion.transmissions[0].swings);
    for (force, motion) in pairs {
        let [force, motion] = [force.unwrap(), motion.unwrap()];
        let [one, other] = [force, motion].map(|own| C::from_polar(own.amplitude, own.phase));
        close(one, other, 1e-12);
    }
    let [force, motion] = [&force, &motion].map(|own| &own.transmissions[0].resonances);
    assert_eq!(force.len(), 2);
    for (force, motion) in force.iter().zip(motion) {
        let off = (force.frequency - motion.frequency).abs();
        assert!(off <= force.frequency_error + motion.frequency_error);
    }
}

#[test]
fn the_resonance_and_its_width_are_those_of_the_closed_form() {
    for zeta in [1e-5_f64, 1e-4, 0.01, 0.1, 0.3, 0.7] {
        let vibration = shaken(&mount(kelvin_voigt(zeta)));
        let sweep = vibration.sweep(&SweepSettings::default()).unwrap();
        let [found] = &sweep.transmissions[0].resonances[..] else { panic!("{zeta}") };
        let root = (1.0 + 8.0 * zeta * zeta).sqrt();
        // sqrt(sqrt(1 + 8 zeta^2) - 1)/(2 zeta) without cancellation.
        let peak = (2.0 / (1.0 + root)).sqrt();
        let frequency = peak * natural() / TAU;
        let off = (found.frequency - frequency).abs();
        assert!(off <= found.frequency_error + 4.0 * f64::EPSILON * frequency, "{zeta}: {off:e}");
        assert!(found.frequency_error <= 1e-12 * frequency, "{zeta}: {:e}", found.frequency_error);
        let height = closed(zeta, peak).norm();
        let swing = found.swing.unwrap();
        assert!((swing.amplitude - height).abs() <= 1e-11 * height, "{zeta}");
        // (1 + q x)/((1 − x)² + q x) = H, q = 4 zeta², x = r²: a quadratic equation for x − 1.
        let (q, level) = (4.0 * zeta * zeta, 0.5 * height * height);
        let (a, b, c) = (level, level * q - q, level * q - 1.0 - q);
        let discriminant = b * b - 4.0 * a * c;
        let x = [-1.0, 1.0].map(|sign| (-b + sign * discriminant.sqrt()) / (2.0 * a));
        let exists = x[0] > -1.0;
        assert_eq!(found.band.is_some(), exists, "{zeta}");
        if let Some(band) = found.band {
            for (own, x) in band.iter().zip(x) {
                let exact = (1.0 + x).sqrt() * natural() / TAU;
                assert!((own - exact).abs() <= 1e-12 * exact, "{zeta}: {own} {exact}");
            }
            if zeta < 0.02 {
                let quality = found.quality().unwrap();
                assert!((quality * 2.0 * zeta - 1.0).abs() < 10.0 * zeta, "{quality}");
            }
        }
    }
}

#[test]
fn a_resonance_far_narrower_than_the_spacing_is_found() {
    let mut network = mount(kelvin_voigt(0.2));
    let device = network.node_named("device").unwrap();
    let whisker = network.add_node(Node::mass("whisker", 1e-7));
    let rate: f64 = 777.0;
    let own = Model::parallel([spring(1e-7 * rate * rate), dashpot(2e-5 * 1e-7 * rate)]);
    network.connect("whisker-root", whisker, device, own);
    let vibration = shaken(&network);
    let sweep = vibration.sweep(&range(1.0, 1000.0, 5)).unwrap();
    for name in ["device", "whisker"] {
        let of = sweep.transmissions.iter().find(|transmission| transmission.name == name).unwrap();
        let near = |resonance: &&Resonance| (resonance.frequency * TAU / rate - 1.0).abs() < 0.01;
        assert!(
            of.resonances.iter().any(|resonance| near(&resonance)),
            "{name}: {:?}",
            of.resonances
        );
    }
}

#[test]
fn without_damping_a_resonance_has_no_height() {
    let sweep = shaken(&mount(spring(STIFFNESS))).sweep(&SweepSettings::default()).unwrap();
    let [found] = &sweep.transmissions[0].resonances[..] else { panic!() };
    assert!((found.frequency * TAU / natural() - 1.0).abs() < 1e-14);
    assert_eq!((found.swing, found.band, found.quality()), (None, None, None));
}

#[test]
fn slow_motion_is_followed_and_shared_between_springs() {
    let at_rest = |network: &Network| {
        let sweep = shaken(network).sweep(&SweepSettings::default()).unwrap();
        sweep.transmissions[0].at_rest.unwrap()
    };
    let followed = at_rest(&mount(kelvin_voigt(0.1)));
    assert!((followed.amplitude - 1.0).abs() <= followed.error && followed.error < 1e-12);
    // Nothing holds the mass at rest, yet it follows a slow motion.
    let maxwell = at_rest(&mount(Model::series([spring(2e5), dashpot(4e3)])));
    assert!((maxwell.amplitude - 1.0).abs() < 1e-9, "{maxwell:?}");
    let mut between = mount(kelvin_voigt(0.1));
    let wall = between.add_node(Node::fixed("wall"));
    let device = between.node_named("device").unwrap();
    between.connect("tie", wall, device, spring(3.0 * STIFFNESS));
    let shared = at_rest(&between);
    assert!((shared.amplitude - 0.25).abs() < 1e-15);
    // A dashpot from the ground, a spring from the wall: what is slow does not arrive.
    let mut viscous = mount(dashpot(50.0));
    let wall = viscous.add_node(Node::fixed("wall"));
    let device = viscous.node_named("device").unwrap();
    viscous.connect("tie", wall, device, spring(STIFFNESS));
    assert!(at_rest(&viscous).amplitude == 0.0);
}

#[test]
fn what_the_drive_puts_in_is_what_the_dashpots_turn_into_heat() {
    let (mut network, device) = two_masses();
    network.add_load("ram", device, Waveform::constant(1.0));
    for drive in ["ram", "ground"] {
        let vibration = Vibration::new(&network, 1.0, Some(drive)).unwrap();
        for frequency in [3.0, 12.0, 40.0] {
            let amplitude = 0.003;
            let steady = vibration.steady(frequency, amplitude).unwrap();
            let lost = |name: &str, damping: f64| {
                let own = steady.elements.iter().find(|element| element.name == name).unwrap();
                0.5 * damping * (TAU * frequency * own.deformation.amplitude).powi(2)
            };
            let heat = lost("pad", 30.0) + lost("mount", 80.0);
            let power = steady.power.unwrap();
            assert!((power - heat).abs() <= 1e-12 * heat, "{drive} {frequency}: {power} {heat}");
        }
    }
}

#[test]
fn the_steady_state_at_one_frequency_is_the_sweep_times_the_amplitude() {
    let (network, _) = two_masses();
    let vibration = shaken(&network);
    let (frequency, amplitude) = (14.0, 2e-3);
    let steady = vibration.steady(frequency, amplitude).unwrap();
    let sweep = vibration.sweep(&range(frequency, 100.0, 2)).unwrap();
    let ratio = sweep.transmissions[1].swings[0].unwrap();
    let device = steady.nodes.iter().find(|node| node.name == "device").unwrap();
    assert!((device.displacement.amplitude / (ratio.amplitude * amplitude) - 1.0).abs() < 1e-15);
    let omega = TAU * frequency;
    let expected = omega * omega * device.displacement.amplitude;
    assert!((device.acceleration.amplitude / expected - 1.0).abs() < 1e-15);
    // Newton's law: the only force on the device is that of the pad, which pushes it back.
    let pad = steady.elements.iter().find(|element| element.name == "pad").unwrap();
    let force = C::from_polar(pad.force.unwrap().amplitude, pad.force.unwrap().phase);
    let acceleration = C::from_polar(device.acceleration.amplitude, device.acceleration.phase);
    close(-force, acceleration * MASS, 1e-12);
    let moved = steady.nodes.iter().find(|node| node.name == "ground").unwrap();
    assert!((moved.displacement.amplitude - amplitude).abs() < 1e-15 * amplitude);
    assert_eq!(steady.supports[0].name, "ground");
    assert!(steady.warnings.is_empty());
}

#[test]
fn deformation_beyond_the_thickness_is_warned_of() {
    let mut network = Network::new();
    let device = network.add_node(Node::mass("device", MASS));
    let ground = network.ground();
    network.connect("mount", device, ground, kelvin_voigt(0.1)).thickness = Some(0.01);
    let vibration = shaken(&network);
    let frequency = natural() / TAU;
    assert!(vibration.steady(frequency, 1e-3).unwrap().warnings.is_empty());
    assert_eq!(vibration.steady(frequency, 3e-3).unwrap().warnings.len(), 1);
}

#[test]
fn only_the_place_of_the_drive_counts() {
    let wave = |piece: Piece| Waveform::new(vec![piece]).unwrap();
    let moved = |motion: Waveform, bells: bool| {
        let mut network = Network::new();
        let floor = network.add_node(Node::prescribed("floor", motion));
        let other = network
            .add_node(Node::prescribed("other", wave(Piece { slope: 1.0, ..Piece::default() })));
        let device =
            network.add_node(Node::mass("device", MASS).moving(if bells { 3.0 } else { 0.0 }));
        network.connect("mount", device, floor, kelvin_voigt(0.1));
        network.connect("tie", other, device, spring(1e3));
        if bells {
            network.add_load(
                "ram",
                device,
                wave(Piece { sine: 5.0, omega: 3.0, ..Piece::default() }),
            );
            network.add_effect(Gravity { acceleration: 9.81, start: GravityStart::Unloaded });
        }
        Vibration::new(&network, 1.0, Some("floor")).unwrap().sweep(&range(1.0, 100.0, 20)).unwrap()
    };
    let sine = wave(Piece { sine: 1e-3, omega: 90.0, ..Piece::default() });
    let ramp = wave(Piece { slope: 0.1, ..Piece::default() });
    let [plain, busy] = [moved(sine, false), moved(ramp, true)].map(|own| own.transmissions);
    for (one, other) in plain[0].swings.iter().zip(&busy[0].swings) {
        let (one, other) = (one.unwrap(), other.unwrap());
        assert!((one.amplitude - other.amplitude).abs() <= one.error + other.error);
    }
}

#[test]
fn a_long_chain_is_that_of_its_recursion() {
    let count = 300;
    let mut network = Network::new();
    let mut below = network.ground();
    for at in 0..count {
        let own = network.add_node(Node::mass(format!("mass-{at}"), 0.5));
        let link = Model::parallel([spring(1e6), dashpot(40.0)]);
        network.connect(format!("link-{at}"), own, below, link);
        below = own;
    }
    let vibration = shaken(&network);
    let settings = SweepSettings { of: vec!["mass-299".into()], ..range(0.5, 20.0, 4) };
    let sweep = vibration.sweep(&settings).unwrap();
    assert_eq!(sweep.notes.len(), 1);
    for (frequency, own) in sweep.frequencies.iter().zip(&sweep.transmissions[0].swings) {
        let s = C::new(0.0, TAU * frequency);
        let step = s * s * 0.5 / (s * 40.0 + 1e6);
        // From the free end down: x_{j−1} = x_j + link force over link stiffness.
        let (mut place, mut force) = (C::from(1.0), C::default());
        for _ in 0..count {
            force += step * place;
            place += force;
        }
        let own = own.unwrap();
        let off = (C::from_polar(own.amplitude, own.phase) - place.inv()).norm();
        // The recursion rounds once a link, at up to 300 times the smallest place.
        assert!(off <= own.error + 1e-11 * place.inv().norm(), "{frequency}: {off:e}");
    }
    // The fundamental of a chain with one free end: 2 sqrt(k/m) sin(π/(2 (2n + 1))).
    let lowest = 2.0 * (1e6_f64 / 0.5).sqrt() * (0.5 * std::f64::consts::PI / 601.0).sin() / TAU;
    let found = sweep.transmissions[0].resonances[0].frequency;
    assert!((found / lowest - 1.0).abs() < 1e-4, "{found} {lowest}");
}

#[test]
fn all_resonances_of_a_chain_are_found_down_to_the_faintest() {
    let count = 80;
    let mut network = Network::new();
    let mut below = network.ground();
    for at in 0..count {
        let own = network.add_node(Node::mass(format!("mass-{at}"), 0.5));
        let link = Model::parallel([spring(1e6), dashpot(2.0)]);
        network.connect(format!("link-{at}"), own, below, link);
        below = own;
    }
    let (from, to) = (1.0_f64, 1000.0_f64);
    let settings = SweepSettings { of: vec!["mass-79".into()], ..range(from, to, 2) };
    let sweep = shaken(&network).sweep(&settings).unwrap();
    let level = |frequency: f64| {
        let s = C::new(0.0, TAU * frequency);
        let step = s * s * 0.5 / (s * 2.0 + 1e6);
        let (mut place, mut force) = (C::from(1.0), C::default());
        for _ in 0..count {
            force += step * place;
            place += force;
        }
        -place.norm().ln()
    };
    // The faintest peak is 0.001 high and a thousandth of its frequency away from its valley.
    let places = 300_000;
    let ratio = (to / from).powf(1.0 / f64::from(places));
    let places: Vec<f64> = (0..=places).map(|at| from * ratio.powi(at)).collect();
    let levels: Vec<f64> = places.iter().map(|place| level(*place)).collect();
    let tops: Vec<f64> = (1..places.len() - 1)
        .filter(|&at| levels[at] > levels[at - 1] && levels[at] >= levels[at + 1])
        .map(|at| places[at])
        .collect();
    let found = &sweep.transmissions[0].resonances;
    assert_eq!(found.len(), tops.len());
    for (own, top) in found.iter().zip(tops) {
        assert!((own.frequency / top).ln().abs() <= ratio.ln(), "{} {top}", own.frequency);
    }
}

#[test]
fn what_cannot_be_is_refused_by_name() {
    let mut network = mount(kelvin_voigt(0.1));
    let refused = |network: &Network, drive| Vibration::new(network, 1.0, drive).unwrap_err();
    let text = refused(&network, None).to_string();
    assert_eq!(text, "neither a load nor a motion drives the network; name the drive: ground");
    let text = refused(&network, Some("floor")).to_string();
    assert_eq!(
        text,
        "`floor` is no load, and no node that is moved or fixed; there is only `ground`"
    );
    let vibration = shaken(&network);
    let wrong = |settings: SweepSettings| vibration.sweep(&settings).unwrap_err().to_string();
    let of = vec!["head".to_owned()];
    let text = wrong(SweepSettings { of, ..SweepSettings::default() });
    assert_eq!(text, "`head` is no node that can move; there is only `device`");
    assert_eq!(wrong(range(-1.0, 2.0, 5)), "`from` must be a positive frequency, but it is -1");
    assert_eq!(
        wrong(range(3.0, 2.0, 5)),
        "the highest frequency, 2 Hz, must be above the lowest, 3 Hz"
    );
    assert_eq!(wrong(range(1.0, 2.0, 1)), "`points` must be from 2 to 1000000, but it is 1");
    assert!(vibration.steady(0.0, 1.0).is_err() && vibration.steady(1.0, f64::NAN).is_err());
    let device = network.node_named("device").unwrap();
    network.add_load("ram", device, Waveform::constant(1.0));
    network.add_load("press", network.ground(), Waveform::constant(1.0));
    let text = refused(&network, None).to_string();
    assert!(text.starts_with("more than one load or motion drives the network"), "{text}");
    let text = refused(&network, Some("press")).to_string();
    assert_eq!(text, "`press` pushes against `ground`, which is held: nothing moves");
}
