//! Steady oscillation: against runs in time, against poles and strengths with twice the digits, and
//! as users of the command meet it.

use std::f64::consts::TAU;

use dashpot::{
    analysis::{
        MeasureWish, Solve, SolveSettings,
        measures::{PeakAcceleration, PeakDeformation, PeakForce},
        vibration::{QUANTITIES, SweepSettings, Vibration, VibrationError},
    },
    dae::{Piece, Waveform, methods::Exact},
    network::{
        Network, Node,
        driving_point::{Receptance, Response},
        elements::CubicSpring,
        layers::{Layer, Layers, Resolution},
        parameters::{Kind as _, WindowWish},
        part,
    },
    rheology::Tree,
};
use serde_json::Value;
use tempfile::TempDir;

use crate::{
    cli::{code, err, file, json, out, run, said, text},
    random_networks::{Dice, Recipe},
    thesis::{dashpot, spring},
};

const SCENE: &str = r#"
title = "Instrument on isolators"
[nodes]
floor = { motion = { ramp = { height = "1 mm", rise = "3 ms" } } }
case  = { mass = "8 kg" }
board = { mass = "300 g" }
[elements]
isolator = { between = ["case", "floor"], zener = { spring = "60 kN/m", maxwell = { spring = "90 kN/m", dashpot = "500 N s/m" } }, thickness = "15 mm" }
standoff = { between = ["board", "case"], kelvin-voigt = { spring = "400 kN/m", dashpot = "15 N s/m" } }
[run]
duration = "1 s"
"#;

fn instrument(motion: Waveform) -> Network {
    let mut network = Network::new();
    let floor = network.add_node(Node::prescribed("floor", motion));
    let case = network.add_node(Node::mass("case", 8.0));
    let board = network.add_node(Node::mass("board", 0.3));
    let zener = Tree::parallel([spring(6e4), Tree::series([spring(9e4), dashpot(500.0)])]);
    network.connect("isolator", case, floor, zener);
    network.connect("standoff", board, case, Tree::parallel([spring(4e5), dashpot(15.0)]));
    network
}

#[test]
fn a_run_over_many_periods_ends_in_the_steady_state() {
    for frequency in [6.0, 15.5, 120.0] {
        let (amplitude, omega) = (1e-3, TAU * frequency);
        let wave = Piece { sine: amplitude, omega, ..Piece::default() };
        let network = instrument(Waveform::new(vec![wave]).unwrap());
        // The slowest transient, that of the isolator, decays with about 20/s.
        let (begin, end) = (3.0, 3.0 + 2.0 / frequency);
        let window = WindowWish::Times(begin, end);
        let settings = SolveSettings {
            method: Exact.into(),
            measures: vec![
                MeasureWish::new("case", PeakAcceleration { window }),
                MeasureWish::new("board", PeakAcceleration { window }),
                MeasureWish::new("isolator", PeakForce { window }),
                MeasureWish::new("isolator", PeakDeformation { window }),
                MeasureWish::new("standoff", PeakForce { window }),
            ],
            ..SolveSettings::lasting(end)
        };
        let report = network.solve_with(&settings).unwrap();
        let vibration = Vibration::new(&network, 1.0, None).unwrap();
        let steady = vibration.steady(frequency, amplitude).unwrap();
        let node = |name: &str| {
            steady.nodes.iter().find(|node| node.name == name).unwrap().acceleration.amplitude
        };
        let element =
            |name: &str| steady.elements.iter().find(|element| element.name == name).unwrap();
        let isolator = element("isolator");
        let expected = [
            ("case", "peak-acceleration", node("case")),
            ("board", "peak-acceleration", node("board")),
            ("isolator", "peak-force", isolator.force.unwrap().amplitude),
            ("isolator", "peak-deformation", isolator.deformation.amplitude),
            ("standoff", "peak-force", element("standoff").force.unwrap().amplitude),
        ];
        for (target, kind, exact) in expected {
            let in_window = |own: &&dashpot::analysis::MeasureReport| {
                own.target == target
                    && own.kind == kind
                    && own.window.is_some_and(|window| (window.0 - begin).abs() < 1e-9)
            };
            let own = report.measures.iter().find(in_window).unwrap();
            let (value, error) = (own.value.unwrap(), own.error.unwrap());
            let off = (value - exact).abs();
            assert!(off <= error + 1e-11 * exact, "{frequency} {target}.{kind}: {value} {exact}");
        }
    }
}

/// What the poles and strengths give at `omega`, with the error that they state.
fn by_poles(receptance: &Receptance, omega: f64) -> ([f64; 2], f64) {
    let mut size = receptance.instantaneous_compliance();
    let mut least = f64::INFINITY;
    for pole in receptance.poles() {
        let far = pole.at[0].hypot(omega - pole.at[1]);
        least = least.min(far / pole.at[0].hypot(pole.at[1]).max(f64::MIN_POSITIVE));
        for (at, strength) in pole.residues.iter().enumerate() {
            size += strength[0].hypot(strength[1]) / far.powi(i32::try_from(at).unwrap() + 1);
        }
    }
    (receptance.at([0.0, omega]), receptance.error() * size * (1.0 + 1.0 / least))
}

#[test]
fn amplitudes_are_within_their_errors_of_what_poles_and_strengths_give() {
    let mut dice = Dice(0x5eed_0021);
    let mut count = 0;
    for _ in 0..300 {
        let mut network = Recipe::draw(&mut dice, 8.0).build();
        let head =
            network.nodes().map(|node| node.0).find(|id| network.node(*id).mass > 0.0).unwrap();
        let ground = network.ground();
        let Ok(Response::Massive(receptance)) = network.driving_point(head, ground) else {
            continue;
        };
        network.add_load("ram", head, Waveform::constant(1.0));
        let Ok(vibration) = Vibration::new(&network, 1.0, Some("ram")) else { continue };
        let name = network.node(head).name.clone();
        for _ in 0..6 {
            let omega = dice.decades(8.0);
            let Ok(steady) = vibration.steady(omega / TAU, 1.0) else { continue };
            let own = steady.nodes.iter().find(|node| node.name == name).unwrap().displacement;
            let ([re, im], threshold) = by_poles(&receptance, TAU * (omega / TAU));
            let (x, y) = (own.amplitude * own.phase.cos(), own.amplitude * own.phase.sin());
            let off = (x - re).hypot(y - im);
            // The angle of a swing is rounded on its own.
            let allowed = own.error + threshold + 4.0 * f64::EPSILON * own.amplitude;
            assert!(off <= allowed, "{network:?} {omega}: {off:e} > {allowed:e}");
            count += 1;
        }
    }
    assert!(count > 500, "{count}");
}

/// The force over the displacement of the node that it pushes is one over the receptance of the network there.
#[test]
fn dynamic_stiffness_is_that_of_poles_and_strengths() {
    let mut dice = Dice(0x5eed_0051);
    let mut count = 0;
    for _ in 0..60 {
        let mut network = Recipe::draw(&mut dice, 6.0).build();
        let head =
            network.nodes().map(|node| node.0).find(|id| network.node(*id).mass > 0.0).unwrap();
        let ground = network.ground();
        let Ok(Response::Massive(receptance)) = network.driving_point(head, ground) else {
            continue;
        };
        network.add_load("ram", head, Waveform::constant(1.0));
        let Ok(vibration) = Vibration::new(&network, 1.0, Some("ram")) else { continue };
        let of = ["dynamic-stiffness", "apparent-mass"]
            .map(|word| format!("{}.{word}", network.node(head).name))
            .to_vec();
        let from = dice.decades(4.0);
        let settings =
            SweepSettings { from: Some(from), to: Some(9.0 * from), points: 5, of, at: None };
        let sweep = vibration.sweep(&settings).unwrap();
        for (at, frequency) in sweep.frequencies.iter().enumerate() {
            let omega = TAU * frequency;
            let ([re, im], threshold) = by_poles(&receptance, omega);
            let size = re * re + im * im;
            for (order, own) in [(0, &sweep.transmissions[0]), (2, &sweep.transmissions[1])] {
                let Some(own) = own.swings[at] else { continue };
                // F/A is −1/ω² times F/X.
                let (scale, turn) = if order == 0 { (1.0, 1.0) } else { (omega.powi(-2), -1.0) };
                let (x, y) = (own.amplitude * own.phase.cos(), own.amplitude * own.phase.sin());
                let off = (x - scale * turn * re / size).hypot(y + scale * turn * im / size);
                let allowed =
                    own.error + scale * threshold / size + 8.0 * f64::EPSILON * own.amplitude;
                assert!(off <= allowed, "{network:?} {frequency} {order}: {off:e} > {allowed:e}");
                count += 1;
            }
        }
    }
    assert!(count > 200, "{count}");
}

#[test]
fn a_pad_with_mass_passes_forces_on_as_it_passes_motions_on() {
    let layer = |name: &str, stiffness: f64, damping: f64| Layer {
        name: name.into(),
        thickness: 0.02,
        area: 0.01,
        density: 200.0,
        model: Tree::parallel([spring(stiffness), dashpot(damping)]),
    };
    let layers = Layers {
        all: vec![layer("soft", 5e4, 20.0), layer("hard", 2e5, 60.0)],
        resolution: Resolution::Segments(8),
    };
    let mut network = Network::new();
    let device = network.add_node(Node::mass("device", 1.5));
    network.connect_layers("pad", device, network.ground(), layers);
    network.add_load("ram", device, Waveform::constant(1.0));
    let swings = |drive: &str| {
        let vibration = Vibration::new(&network, 1.0, Some(drive)).unwrap();
        let settings = SweepSettings {
            from: Some(1.0),
            to: Some(2e3),
            points: 40,
            ..SweepSettings::default()
        };
        vibration.sweep(&settings).unwrap().transmissions.remove(0).swings
    };
    for (force, motion) in swings("ram").into_iter().zip(swings("ground")) {
        let (force, motion) = (force.unwrap(), motion.unwrap());
        let off = (force.amplitude - motion.amplitude).abs();
        assert!(off <= force.error + motion.error, "{off:e}");
        assert!((force.phase - motion.phase).abs() <= 1e-10);
        assert!(force.error <= 1e-11 * force.amplitude);
    }
}

#[test]
fn what_is_not_linear_is_refused_by_name() {
    let mut network = instrument(Waveform::constant(0.0));
    let case = network.node_named("case").unwrap();
    network.connect("snubber", case, network.ground(), part(CubicSpring::sample()));
    let refused = Vibration::new(&network, 1.0, None).unwrap_err();
    let VibrationError::NotLinear { part, .. } = &refused else { panic!("{refused}") };
    assert_eq!(part, "the element `snubber`");
    let folder = TempDir::new().unwrap();
    let slider = "snubber = { between = [\"board\", \"case\"], friction = \"5 N\" }\nstandoff =";
    let scene = file(&folder, "snubbed.toml", &SCENE.replace("standoff =", slider));
    let output = run(&["vibrate", text(&scene)]);
    assert_eq!(code(&output), 2);
    let told = err(&output);
    assert!(told.contains("the element `snubber` is not linear (friction)"), "{told}");
}

#[test]
fn a_parcel_that_only_stands_lifts_off_where_its_weight_is_exceeded() {
    let output = run(&["vibrate", "scenes/truck-parcel.toml"]);
    assert_eq!(code(&output), 0, "{}", err(&output));
    let shown = out(&output);
    assert!(shown.contains("`cushion.contact` parts first at 15.4 Hz"), "{shown}");
    let at = ["vibrate", "scenes/truck-parcel.toml", "--at", "9 Hz", "--amplitude"];
    let told = |amplitude: &str| err(&run(&[&at[..], &[amplitude]].concat()));
    let found = told("5 mm");
    assert!(found.contains("warning: `cushion.contact` parts at 9.00 Hz"), "{found}");
    // 12 kg · 1 g0 over the 274.4 N at 5 mm: up to 2.144 mm it stays.
    assert!(told("2.14 mm").is_empty() && !told("2.15 mm").is_empty());
}

#[test]
fn the_command_shows_resonances_and_a_table_and_writes_files() {
    let folder = TempDir::new().unwrap();
    let scene = file(&folder, "instrument.toml", SCENE);
    let target = folder.path().join("results");
    let arguments = ["vibrate", text(&scene), "--plot", "always", "--out", text(&target)];
    let output = run(&arguments);
    let shown = out(&output);
    assert_eq!(code(&output), 0, "{}", err(&output));
    assert!(shown.lines().all(|line| line.chars().count() <= 80), "{shown}");
    for fact in ["Resonances", "15.53 Hz", "25 of 200 frequencies", "`floor`"] {
        assert!(shown.contains(fact), "{fact}:\n{shown}");
    }
    let csv = std::fs::read_to_string(target.join("response.csv")).unwrap();
    assert_eq!(csv.lines().count(), 201);
    assert!(csv.starts_with("frequency [Hz],ratio of case [1],phase of case [deg],"), "{csv}");
    for name in ["result.json", "transmissibility.svg", "phase.svg"] {
        assert!(target.join(name).is_file(), "{name}");
    }
    let page = std::fs::read_to_string(target.join("report.html")).unwrap();
    assert!(page.contains("15.53 Hz") && page.matches("<svg").count() >= 5, "{page}");
    assert_eq!(code(&run(&arguments)), 0, "a second run writes over its own files");
    let foreign = TempDir::new().unwrap();
    file(&foreign, "response.csv", "mine");
    let arguments = ["vibrate", text(&scene), "--out", text(foreign.path())];
    assert_eq!(code(&run(&arguments)), 2);
}

#[test]
fn quantities_have_their_units_in_every_output() {
    let folder = TempDir::new().unwrap();
    let scene = file(&folder, "instrument.toml", SCENE);
    let target = folder.path().join("results");
    let of = "case,isolator.force,standoff.power,floor.apparent-mass";
    let arguments = ["vibrate", text(&scene), "--of", of, "--plot", "always"];
    let output = run(&[&arguments[..], &["--out", text(&target)]].concat());
    let shown = out(&output).split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(code(&output), 0, "{}", err(&output));
    // Nothing holds the instrument but the floor: at rest it is 8.3 kg.
    for fact in ["Apparent mass: force of the drive", "8.300 kg of floor.apparent-mass", "kN/m"] {
        assert!(shown.contains(fact), "{fact}:\n{shown}");
    }
    let csv = std::fs::read_to_string(target.join("response.csv")).unwrap();
    let header = csv.lines().next().unwrap();
    let units = ["case [1]", "isolator.force [N/m]", "standoff.power [W/m^2]"];
    for column in units.iter().chain(&["floor.apparent-mass [kg]"]) {
        assert!(header.contains(&format!("ratio of {column},")), "{header}");
    }
    for name in ["transmissibility", "force", "power", "apparent-mass", "phase"] {
        assert!(target.join(format!("{name}.svg")).is_file(), "{name}");
    }
    let result = std::fs::read_to_string(target.join("result.json")).unwrap();
    let responses = serde_json::from_str::<Value>(&result).unwrap()["responses"].clone();
    assert_eq!(responses[3]["quantity"], "apparent-mass");
    assert_eq!([&responses[2]["unit"], &responses[2]["phase"]], [&"W/m^2".into(), &Value::Null]);
    let output = run(&["vibrate", text(&scene), "--of", "isolator.power,case.impedance"]);
    let told = said(&output);
    assert_eq!(code(&output), 2);
    assert!(
        told.contains("`case` is no node that the drive moves; there is only `floor`"),
        "{told}"
    );
    let help = out(&run(&["vibrate", "--help"]));
    QUANTITIES.iter().for_each(|own| assert!(help.contains(own.word), "{}", own.word));
}

#[test]
fn json_has_the_steady_state_in_si_units() {
    let folder = TempDir::new().unwrap();
    let scene = file(&folder, "instrument.toml", SCENE);
    let at = ["vibrate", text(&scene), "--at", "16 Hz", "--json", "--amplitude"];
    let by_way = json(&[&at[..], &["0.5 mm"]].concat());
    let steady = &by_way["steady"];
    assert_eq!(steady["amplitude"], 5e-4);
    assert_eq!(by_way["drive"]["unit"], "m");
    assert_eq!(by_way["frequencies"].as_array().unwrap().len(), 200);
    let floor = |answer: &Value| {
        let nodes = answer["steady"]["nodes"].as_array().unwrap().clone();
        let own = nodes.into_iter().find(|node| node["name"] == "floor").unwrap();
        own["acceleration"]["amplitude"].as_f64().unwrap()
    };
    let by_acceleration = json(&[&at[..], &["0.5 g0"]].concat());
    assert!((floor(&by_acceleration) / (0.5 * 9.806_65) - 1.0).abs() < 1e-14);
    assert!((floor(&by_way) / (5e-4 * (TAU * 16.0).powi(2)) - 1.0).abs() < 1e-14);
    // What is looked at is the ratio there.
    let of = json(&[&at[..], &["0.5 mm", "--of", "isolator.force,case"]].concat());
    let ratio = |at: usize| of["responses"][at]["at"]["amplitude"].as_f64().unwrap();
    let peak = |all: &str, at: usize, what: &str| {
        of["steady"][all][at][what]["amplitude"].as_f64().unwrap() / 5e-4
    };
    assert!((ratio(0) / peak("elements", 0, "force") - 1.0).abs() < 1e-12);
    assert!((ratio(1) / peak("nodes", 1, "displacement") - 1.0).abs() < 1e-12);
    let text = ["vibrate", text(&scene), "--at", "16 Hz", "--amplitude", "0.5 mm"];
    let shown = out(&run(&[&text[..], &["--of", "isolator.force"]].concat()));
    assert!(shown.contains("Responses at 16.00 Hz"), "{shown}");
}

#[test]
fn a_wrong_amplitude_and_a_missing_drive_are_refused() {
    let folder = TempDir::new().unwrap();
    let scene = file(&folder, "instrument.toml", SCENE);
    let refused = |more: &[&str], expected: &str| {
        let output = run(&[&["vibrate", text(&scene)][..], more].concat());
        assert_eq!(code(&output), 2, "{more:?}");
        assert!(said(&output).contains(expected), "{}", err(&output));
    };
    refused(
        &["--at", "5 Hz", "--amplitude", "3 N"],
        "a length (m) is expected here; for example \"2 cm\"; an acceleration",
    );
    refused(&["--at", "5 Hz", "--amplitude", "0 mm"], "it must be positive");
    refused(&["--at", "5 Hz"], "--amplitude");
    refused(&["--from", "3 rad/s"], "angular frequency");
    // Whether it is mm or m, or g or N, nobody can tell.
    refused(&["--at", "5 Hz", "--amplitude", "3"], "`3` has no unit");
    refused(&["--to", "300"], "`300` has no unit");
    refused(&["--drive", "wall"], "there is only");
    let output = run(&["vibrate", "reference"]);
    assert_eq!(code(&output), 2);
    assert!(err(&output).contains("name the drive: ground"), "{}", err(&output));
    assert_eq!(code(&run(&["vibrate", "reference", "--drive", "ground"])), 0);
}
