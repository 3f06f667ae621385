//! Loads and motions: files of numbers, accelerations, and what they do to an oscillator.

use std::f64::consts::{PI, TAU};

use dashpot_analysis::{Solve, SolveSettings};
use dashpot_dae::{Signal, Waveform};
use dashpot_network::Support;

use crate::{Checked, Diagnostics, ReadOptions, Scene, read};

/// A mass of 2 kg on a spring of 800 N/m, ω = 20 rad/s, with `node` and `load` reader.
fn text(node: &str, load: &str) -> String {
    format!(
        "[nodes]\nhead = {{ mass = 2 }}\n{node}\n\
         [elements]\npad = {{ between = [\"head\", \"{}\"], spring = 800 }}\n\
         [loads]\n{load}\n[run]\nduration = \"0.5 s\"\n",
        if node.is_empty() { "ground" } else { "base" }
    )
}

fn pushed(force: &str) -> String {
    text("", &format!("push = {{ on = \"head\", force = {{ {force} }} }}"))
}

fn shaken(key: &str, function: &str) -> String {
    text(&format!("base = {{ {key} = {{ {function} }} }}"), "")
}

/// Reads `text` as `lib/scene.toml` beside the file `pulse.csv`.
fn beside(text: &str, csv: &str) -> Result<Checked<Scene>, Diagnostics> {
    let loader = |path: &str| match path {
        "lib/pulse.csv" => Ok(csv.into()),
        other => Err(format!("no {other}")),
    };
    let file = Some("lib/scene.toml");
    read(text, &ReadOptions { file, loader: Some(&loader), ..ReadOptions::default() })
}

fn scene(text: &str, csv: &str) -> Scene {
    let checked = beside(text, csv).unwrap_or_else(|errors| panic!("{errors}"));
    assert!(checked.warnings.is_empty(), "{}", checked.warnings);
    checked.value
}

fn force(text: &str, csv: &str) -> Waveform {
    scene(text, csv).network.loads()[0].force.clone()
}

fn motion(text: &str, csv: &str) -> Waveform {
    let scene = scene(text, csv);
    let base = scene.network.nodes().find(|(_, node)| node.name == "base");
    match base.map(|(_, node)| node.support.clone()) {
        Some(Support::Prescribed(motion)) => motion,
        other => panic!("{other:?}"),
    }
}

/// What is told of a scene whose load is the file.
fn told(table: &str, csv: &str) -> String {
    beside(&pushed(&format!("table = {table}")), csv).unwrap_err().render(false)
}

fn has(shown: &str, parts: &[&str]) {
    for part in parts {
        assert!(shown.contains(part), "`{part}` is not in\n{shown}");
    }
}

/// The output by one method, over the run.
fn signal(text: &str, csv: &str, method: &str, output: &str) -> (Signal, f64) {
    let scene = scene(text, csv);
    let settings = scene.settings(method).unwrap();
    let report = scene.network.solve_with(&settings).unwrap();
    let at = report.assembly.system.outputs.iter().position(|own| own.name == output).unwrap();
    let signal = report.trajectory.signal(&report.assembly.system, at);
    // Steps are as accurate as the scene wants its measures.
    let error = signal.error.unwrap_or(1e-3 * signal.bound());
    (signal, error)
}

/// Checks the deformation \[m\] of the pad by three methods.
fn judge(text: &str, csv: &str, exact: impl Fn(f64) -> f64) {
    for method in ["exact", "bdf", "esdirk34"] {
        let (signal, error) = signal(text, csv, method, "pad.deformation");
        for k in 0..=500 {
            let t = 1e-3 * f64::from(k);
            let (found, expected) = (signal.value(t), exact(t));
            let allowed = error + 1e-15;
            assert!((found - expected).abs() <= allowed, "{method} at {t}: {found} {expected}");
        }
    }
}

/// The frequency of the oscillator.
const OMEGA: f64 = 20.0;

/// What `u = 1`, `u = t` from 0 on does to `x'' = −ω² x + u`.
fn step(t: f64) -> f64 {
    if t < 0.0 { 0.0 } else { 2.0 * (0.5 * OMEGA * t).sin().powi(2) / (OMEGA * OMEGA) }
}

fn ramp(t: f64) -> f64 {
    if t < 0.0 { 0.0 } else { (t - (OMEGA * t).sin() / OMEGA) / (OMEGA * OMEGA) }
}

/// What `u = sin Ωt` from 0 on does.
fn sine(omega: f64, t: f64) -> f64 {
    let free = omega / OMEGA * (OMEGA * t).sin();
    if t < 0.0 { 0.0 } else { ((omega * t).sin() - free) / (OMEGA * OMEGA - omega * omega) }
}

/// What `u = cos Ωt` from 0 on does.
fn cosine(omega: f64, t: f64) -> f64 {
    let free = (OMEGA * t).cos();
    if t < 0.0 { 0.0 } else { ((omega * t).cos() - free) / (OMEGA * OMEGA - omega * omega) }
}

#[test]
fn pulses_on_an_oscillator_have_their_closed_forms() {
    let half = |t: f64| sine(PI / 0.05, t) + sine(PI / 0.05, t - 0.05);
    let haversine = |t: f64| {
        let one = |t: f64| 0.5 * (step(t) - cosine(TAU / 0.05, t));
        one(t) - one(t - 0.05)
    };
    let trapezoid =
        |t: f64| (ramp(t) - ramp(t - 0.02)) / 0.02 - (ramp(t - 0.05) - ramp(t - 0.06)) / 0.01;
    let block = |t: f64| step(t) - step(t - 0.03);
    // A force of 40 N is 20 m/s² of the mass; a base accelerated by as much compresses the pad the
    // other way, and x_head − x_base obeys y'' = −ω² y − u''.
    let all: [(&str, &dyn Fn(f64) -> f64); 4] = [
        ("half-sine = { peak = PEAK, duration = \"50 ms\", start = \"0.1 s\" }", &half),
        ("haversine = { peak = PEAK, duration = \"50 ms\", start = \"0.1 s\" }", &haversine),
        (
            "trapezoid = { peak = PEAK, rise = \"20 ms\", hold = \"30 ms\", fall = \"10 ms\", \
             start = \"0.1 s\" }",
            &trapezoid,
        ),
        (
            "trapezoid = { peak = PEAK, rise = 0, hold = \"30 ms\", fall = 0, start = \"0.1 s\" }",
            &block,
        ),
    ];
    for (function, response) in all {
        let of = |peak: &str| function.replace("PEAK", peak);
        judge(&pushed(&of("\"40 N\"")), "", |t| 20.0 * response(t - 0.1));
        judge(&shaken("acceleration", &of("\"20 m/s^2\"")), "", |t| -20.0 * response(t - 0.1));
    }
}

#[test]
fn a_base_that_drifts_far_away_leaves_the_deformation_right() {
    // After a second at 1000 m/s² the base is half a kilometre away, and the pad holds 2.5 m.
    let text = shaken("acceleration", "trapezoid = { peak = 1000, rise = 0, hold = 1, fall = 0 }");
    judge(&text.replace("0.5 s", "3 s"), "", |t| -1000.0 * (step(t) - step(t - 1.0)));
}

#[test]
fn an_acceleration_is_the_second_derivative_of_the_motion() {
    let csv = "time [ms]; a [g0]\n0; 0\n5; 30\n5; 10\n12; 0\n";
    let base = motion(&shaken("acceleration", "table = \"pulse.csv\""), csv);
    let g = 9.806_65;
    let expected = |t: f64| match t {
        _ if t < 0.005 => 30.0 * g * t / 0.005,
        _ if t < 0.012 => 10.0 * g * (0.012 - t) / 0.007,
        _ => 0.0,
    };
    for k in 0..150 {
        let t = 1e-4 * f64::from(k) + 3e-5;
        let found = base.piece_at(t).derivative(2, t);
        assert!((found - expected(t)).abs() < 1e-10, "{t}: {found}");
    }
    let velocity = 0.5 * (30.0 * 0.005 + 10.0 * 0.007) * g;
    assert!((base.piece_at(1.0).derivative(1, 1.0) - velocity).abs() < 1e-14);
    // A base with mass may have such a motion: only its acceleration jumps.
    let heavy = shaken("mass = 3, acceleration", "table = \"pulse.csv\"");
    motion(&heavy, csv);
}

#[test]
fn accelerations_that_cannot_be_integrated_are_refused() {
    let chirp = "chirp = { amplitude = \"1 g0\", from = 1, to = 2, duration = 1 }";
    let shown = beside(&shaken("acceleration", chirp), "").unwrap_err().render(false);
    has(&shown, &["`acceleration` must be such that", "but it is a chirp", "give it as `motion`"]);
    let chirp = "chirp = { amplitude = \"1 mm\", from = 1, to = 20, duration = 0.4 }";
    assert!(motion(&shaken("motion", chirp), "").pieces().iter().any(dashpot_dae::Piece::is_swept));
    let shown = beside(&shaken("acceleration", "constant = \"2 mm\""), "").unwrap_err();
    has(&shown.render(false), &["an acceleration (m/s^2) is expected here"]);
    let both = shaken("motion = { constant = 0 }, acceleration", "constant = 1");
    let shown = beside(&both, "").unwrap_err().render(false);
    has(&shown, &["`motion` and `acceleration` exclude each other"]);
    let fixed = shaken("fixed = true, acceleration", "constant = 1");
    let shown = beside(&fixed, "").unwrap_err().render(false);
    has(&shown, &["`fixed` and `acceleration` exclude each other"]);
}

#[test]
fn a_chirp_is_solved_by_steps_and_the_methods_agree() {
    let chirp = "chirp = { amplitude = \"40 N\", from = \"1 Hz\", to = \"8 Hz\", duration = 0.4 }";
    let text = pushed(chirp);
    let drive = force(&text, "");
    // ∫ sin(ω(t − τ)) u(τ) dτ/(m ω) by Simpson's rule.
    let parts = 2000;
    let response = |t: f64| {
        let h = t / f64::from(parts);
        let sum: f64 = (0..=parts)
            .map(|k| {
                let weight = match k {
                    0 => 1.0,
                    _ if k == parts => 1.0,
                    _ if k % 2 == 1 => 4.0,
                    _ => 2.0,
                };
                let at = h * f64::from(k);
                weight * drive.value(at) * (OMEGA * (t - at)).sin()
            })
            .sum();
        sum * h / 3.0 / (2.0 * OMEGA)
    };
    for method in ["auto", "bdf", "tr-bdf2"] {
        let (signal, error) = signal(&text, "", method, "pad.deformation");
        for k in 1..=20 {
            let t = 0.02 * f64::from(k);
            let (found, expected) = (signal.value(t), response(t));
            assert!((found - expected).abs() <= error, "{method} at {t}: {found} {expected}");
        }
    }
    let scene = scene(&text, "");
    let declined = scene.network.solve_with(&SolveSettings::lasting(0.5).by_name("exact").unwrap());
    assert!(declined.unwrap_err().to_string().contains("chirp"));
}

#[test]
fn a_file_means_the_same_as_its_points() {
    let points = "table = [[\"0 ms\", \"0 N\"], [\"2 ms\", \"1.5 kN\"], [\"2 ms\", \"1 kN\"], \
                  [\"8 ms\", \"-250 N\"], [\"10 ms\", \"0 N\"]]";
    let expected = force(&pushed(points), "");
    let rows = "0,0\n2,1.5\n2,1\n8,-0.25\n10,0\n";
    let name = "table = \"pulse.csv\"";
    let header = format!("time [ms], force [kN]\n{rows}");
    assert_eq!(force(&pushed(name), &header), expected);
    let units = "table = { file = \"pulse.csv\", units = [\"ms\", \"kN\"] }";
    assert_eq!(force(&pushed(units), rows), expected);
    assert_eq!(force(&pushed(units), &header), expected);
    // A header's unit of another dimension is no contradiction: `g` is the gram here.
    assert_eq!(force(&pushed(units), &header.replace("kN", "g")), expected);
    let wide = "t (ms);x [mm];F [kN]\n0;7;0\n2;7;1.5\n2;7;1\n8;7;-0.25\n10;7;0\n";
    for columns in ["[1, 3]", "[\"t\", \"F\"]", "[1, \"F\"]"] {
        let table = format!("table = {{ file = \"pulse.csv\", columns = {columns} }}");
        assert_eq!(force(&pushed(&table), wide), expected, "{columns}");
    }
}

#[test]
fn a_file_without_units_is_read_in_si_and_that_is_said() {
    let checked = beside(&pushed("table = \"pulse.csv\""), "0,0\n0.002,1500\n").unwrap();
    let shown = checked.warnings.render(false);
    has(
        &shown,
        &[
            "warning",
            "the file does not say all its units: times are read in s, the largest is 2 ms; values are \
             read in N, the largest is 1.5 kN",
            "units = ",
        ],
    );
    assert!((checked.value.network.loads()[0].force.value(0.001) - 750.0).abs() < 1e-12);
    let checked = beside(&pushed("table = \"pulse.csv\""), "t [ms], F\n0,0\n2,1500\n").unwrap();
    has(
        &checked.warnings.render(false),
        &["not say all its units: values are read in N, the largest"],
    );
}

#[test]
fn faults_of_a_file_name_the_file_the_line_the_key_and_the_value() {
    let name = "\"pulse.csv\"";
    let shown = told(name, "time [ms], force [kN]\n0, 0\n1, x5\n2, 3\n1.5, 4\n");
    has(&shown, &["--> lib/pulse.csv:3:4", "`x5` is not a number", "in column `force`"]);
    let shown = told(name, "time [ms], force [kN]\n0, 0\n1, 5\n2, 3\n1.5, 4\n");
    has(&shown, &["--> lib/pulse.csv:5:1", "the time 1.5 stands after 2: times never fall"]);
    has(&shown, &["note: in column `time`; the file is named in line 7 of lib/scene.toml"]);
    has(&told(name, "0,0\n1;2\n"), &["--> lib/pulse.csv:2:1", "`1;2` is not a number"]);
    has(&told(name, "0;0.5\n1;2,5\n"), &["`2,5` has a comma", "help: write `2.5`"]);
    has(&told(name, "0\n1\n"), &["the file has one column", "semicolons, tabs, commas or spaces"]);
    has(&told(name, "# nothing\n"), &["`pulse.csv` has no row of numbers", "lib/scene.toml:7"]);
    has(&told(name, "t [s], F [N]\n"), &["`pulse.csv` has no row of numbers"]);
    has(
        &told(name, "t [ms], F [kg]\n0,1\n"),
        &["lib/pulse.csv:1:12", "a force (N) is expected here"],
    );
    has(&told(name, "t [mss], F [N]\n0,1\n"), &["`mss` is not a known unit", "did you mean `ms`?"]);
    has(&told(name, "t,F,x\n0,1,2\n"), &["the file has 3 columns", "columns = [1, 2]"]);
    has(&told("\"other.csv\"", ""), &["`lib/other.csv` cannot be read: no lib/other.csv"]);
    let alone = read(&pushed("table = \"pulse.csv\""), &ReadOptions::default()).unwrap_err();
    has(&alone.render(false), &["`pulse.csv` cannot be read: no other files can be read here"]);
    let shaken = shaken("acceleration", "table = \"pulse.csv\"");
    let shown = beside(&shaken, "t [ms], a [kg]\n0,1\n").unwrap_err().render(false);
    has(&shown, &["`1 kg` is a mass (kg); an acceleration (m/s^2) is expected here"]);
    // Of accelerations `g` is standard gravity.
    let [one, other] = ["g", "g0"].map(|unit| {
        let csv = format!("t [ms], a [{unit}]\n0,1\n1,3\n2,0\n");
        let network = beside(&shaken, &csv).unwrap().value.network;
        format!("{:?}", network.nodes().collect::<Vec<_>>())
    });
    assert_eq!(one, other);
}

#[test]
fn what_is_said_of_a_file_is_checked() {
    let csv = "t [ms], F [kN]\n0,1\n1,2\n";
    let file = |rest: &str| told(&format!("{{ file = \"pulse.csv\", {rest} }}"), csv);
    has(&file("columns = [1, 3]"), &["there is no column 3: the file has 2"]);
    has(&file("columns = [0, 1]"), &["there is no column 0"]);
    has(&file("columns = [\"t\", \"G\"]"), &["there is no column named `G`", "F"]);
    has(&file("columns = 2"), &["`columns` is a pair of numbers or names"]);
    has(
        &file("units = [\"ms\", \"mm\"]"),
        &["`1 mm` is a length (m); a force (N) is expected here"],
    );
    has(&file("units = [\"s\", \"kN\"]"), &["the header of the file says `ms`, but `s` is given"]);
    has(&file("unit = \"ms\""), &["unknown key `unit` in `table`", "did you mean `units`?"]);
    has(&told("{ units = [\"ms\", \"kN\"] }", csv), &["`table` has no `file`", "curve.csv"]);
}

#[test]
fn rows_after_the_end_of_the_run_are_told() {
    let checked = beside(&pushed("table = \"pulse.csv\""), "t [s], F [N]\n0,1\n20,2\n30,0\n");
    let shown = checked.unwrap().warnings.render(false);
    has(&shown, &["2 of 3 times lie after the end of the run", "check the unit of the times"]);
}
