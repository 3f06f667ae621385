//! Records that drive nodes and load them: closed forms, `signal` on the same file, what is refused.

use std::{
    f64::consts::{PI, TAU},
    fmt::Write as _,
    fs,
};

use serde_json::Value;
use tempfile::TempDir;

use crate::cli::{code, err, file, json, run};

/// Standard gravity \[m/s²\].
const GRAVITY: f64 = 9.806_65;
/// Folder with records from outside, which are no part of the project.
const DATA: &str = "DASHPOT_TEST_DATA";

fn number(own: &Value) -> f64 {
    own.as_f64().unwrap_or(f64::NAN)
}

fn write(folder: &TempDir, name: &str, text: &str) -> String {
    file(folder, name, text).to_str().unwrap().to_owned()
}

/// A half-sine of 200 g and 5 ms at 20 kHz that begins at 10 ms, on an offset \[g\] with a small tone.
fn half_sine(offset: f64, tone: f64) -> String {
    let mut text = "t [ms],acc [g]\n".to_owned();
    for at in 0..=800 {
        let time = f64::from(at) * 0.05;
        let place = (time - 10.0) / 5.0;
        let pulse = if (0.0..=1.0).contains(&place) { 200.0 * (PI * place).sin() } else { 0.0 };
        let value = pulse + offset + tone * (2.1 * f64::from(at)).sin();
        writeln!(text, "{time:.2},{value:.9}").unwrap();
    }
    text
}

/// A headform in three lines.
fn headform(folder: &TempDir, name: &str, file: &str) -> String {
    let scene = format!(
        "nodes.head = {{ mass = \"4.7 kg\", acceleration = {{ table = {{ file = {file} }} }} }}\n\
         measures.head = [\"hic15\", \"hic36\", \"severity-index\", \"clip-3ms\", \"peak-acceleration\"]\n\
         run.duration = \"38 ms\"\n"
    );
    write(folder, name, &scene)
}

/// A measure of the node and its error.
fn measure(scene: &str, word: &str) -> (f64, f64) {
    let own = json(&["run", scene, "--method", "exact", "--json"]);
    let found = &own["runs"][0]["measures"][format!("head.{word}")];
    (number(&found["value"]), number(&found["error"]))
}

/// What `signal` says of a file.
fn signal(path: &str, more: &[&str], word: &str) -> (f64, f64) {
    let own = json(&[&["signal", path, "--json"][..], more].concat());
    let name = own["channels"][0]["name"].as_str().unwrap().to_owned();
    let found = &own["channels"][0]["measures"][format!("{name}.{word}")];
    (number(&found["value"]), number(&found["error"]))
}

#[test]
fn the_measures_of_a_driven_headform_are_those_of_its_record() {
    let folder = TempDir::new().unwrap();
    for (name, text, keys, options) in [
        ("clean", half_sine(0.0, 0.0), "", &[][..]),
        (
            "raw",
            half_sine(3.0, 0.4),
            ", offset = \"auto\", cfc = 180",
            &["--offset", "auto", "--cfc", "180"][..],
        ),
        ("given", half_sine(-2.0, 0.1), ", offset = \"-2 g\"", &["--offset", "-2 g"][..]),
    ] {
        let path = write(&folder, &format!("{name}.csv"), &text);
        let file = format!("\"{name}.csv\"{keys}");
        let scene = headform(&folder, &format!("{name}.toml"), &file);
        for word in ["hic15", "hic36", "severity-index", "clip-3ms", "peak-acceleration"] {
            let of_signal = word.strip_suffix("-acceleration").unwrap_or(word);
            let (expected, error) = signal(&path, options, of_signal);
            let (found, own) = measure(&scene, word);
            let off = (found - expected).abs();
            assert!(off <= error + own, "{name}, {word}: {found}, not {expected} ± {error}");
            // Both take the line between samples, so that they differ by rounding and small swings alone.
            assert!(off <= 1e-6 * expected, "{name}, {word}: {found}, not {expected}");
        }
    }
    let exact = 0.414_645_65 * 200.0_f64.powf(2.5) * 0.005;
    let (found, _) = measure(folder.path().join("clean.toml").to_str().unwrap(), "hic15");
    assert!((found / exact - 1.0).abs() < 5e-4, "{found}");
}

#[test]
fn lines_of_acceleration_are_cubics_of_displacement() {
    let folder = TempDir::new().unwrap();
    let points = "table = { points = [[\"0 s\", \"0 m/s^2\"], [\"1 s\", \"6 m/s^2\"], [\"2 s\", \"0 m/s^2\"]] }";
    // From 1 s on the acceleration falls: v = 3 + 6 s − 3 s², x = 1 + 3 s + 3 s² − s³ with s = t − 1.
    for (motion, velocity, position) in [
        (format!("acceleration = {{ {points} }}"), 6.0, 6.0),
        (format!("acceleration = {{ {points} }}, velocity = \"-5 m/s\""), 1.0, -4.0),
        // The same lines as a velocity: x = 3 t² up to 1 s, then 6 s − 3 s² more.
        (format!("velocity = {{ {} }}", points.replace("m/s^2", "m/s")), 0.0, 6.0),
    ] {
        let mass = if motion.starts_with("velocity") { "" } else { "mass = \"2 kg\", " };
        let scene = format!(
            "nodes.head = {{ {mass}{motion} }}\nmeasures.head = [\"end-velocity\", \"end-position\"]\n\
             run.duration = \"2 s\"\n"
        );
        let scene = write(&folder, "cubic.toml", &scene);
        for (word, expected) in [("end-velocity", velocity), ("end-position", position)] {
            let (found, error) = measure(&scene, word);
            let off = (found - expected).abs();
            assert!(off <= error + 1e-12 && error < 1e-9, "{motion}, {word}: {found} ± {error}");
        }
    }
}

#[test]
fn a_record_as_a_load_gives_its_impulse() {
    let folder = TempDir::new().unwrap();
    write(&folder, "force.csv", &half_sine(5.0, 0.0).replace("acc [g]", "F [N]"));
    let text = "[nodes]\nhead = { mass = \"2 kg\" }\n[elements]\n\
         tie = { between = [\"head\", \"ground\"], spring = \"0.01 N/m\" }\n[loads.blow]\non = \"head\"\n\
         force = { table = { file = \"force.csv\", offset = \"5 N\", shift = \"-10 ms\", outside = \"zero\" } }\n\
         [measures]\nhead = [\"end-velocity\"]\n[run]\nduration = \"20 ms\"\n";
    let (found, error) = measure(&write(&folder, "load.toml", text), "end-velocity");
    // Trapezoids of 100 steps: (2/π) (1 − (π/100)²/12) of the height times the length.
    let impulse: f64 = (0..100).map(|at| (PI * f64::from(at) / 100.0).sin() * 200.0 * 5e-5).sum();
    assert!(
        (found - impulse / 2.0).abs() <= error + 1e-6,
        "{found} ± {error}, not {}",
        impulse / 2.0
    );
}

#[test]
fn a_record_that_cannot_be_treated_is_refused() {
    let folder = TempDir::new().unwrap();
    let lines = half_sine(0.0, 0.0);
    let lines: Vec<&str> = lines.lines().collect();
    write(&folder, "whole.csv", &lines.join("\n"));
    write(&folder, "cut.csv", &[&lines[..1], &lines[220..]].concat().join("\n"));
    write(&folder, "uneven.csv", &[&lines[..240], &lines[260..]].concat().join("\n"));
    for (keys, told) in [
        ("\"uneven.csv\", cfc = 180", "a CFC filter wants even ones"),
        ("\"cut.csv\", offset = \"auto\"", "no offset can be found"),
        ("\"whole.csv\", cfc = 6000", "CFC 6000 has its design frequency at"),
        ("\"whole.csv\", cfc = 0", "cfc"),
        ("\"whole.csv\", offset = \"3 mm\"", "is a length"),
    ] {
        let output = run(&["run", &headform(&folder, "scene.toml", keys)]);
        let found = err(&output).split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(code(&output), 2, "{keys}: {found}");
        assert!(found.contains(told), "{keys}: no {told:?} in {found}");
    }
    // Points of a law have no clock.
    let text = "[nodes]\nhead = { mass = \"2 kg\", velocity = \"1 m/s\" }\n[elements]\n\
         pad = { between = [\"head\", \"ground\"], table-spring = { file = \"law.csv\", cfc = 180 } }\n\
         [run]\nduration = \"20 ms\"\n";
    write(&folder, "law.csv", "w [mm],F [kN]\n0,0\n1,2\n");
    let output = run(&["run", &write(&folder, "law.toml", text)]);
    assert!(code(&output) == 2 && err(&output).contains("unknown key `cfc`"), "{}", err(&output));
}

#[test]
fn what_a_record_reads_at_rest_is_told() {
    let folder = TempDir::new().unwrap();
    write(&folder, "raw.csv", &half_sine(3.0, 0.0));
    let scene = headform(&folder, "raw.toml", "\"raw.csv\", offset = \"auto\"");
    let text = json(&["run", &scene, "--json"])["scene"]["notes"].to_string();
    assert!(text.contains("rest-removed") && text.contains("it reads 29.4 m/s^2"), "{text}");
}

#[test]
fn a_helmet_drop_drives_a_headform() {
    let Some(data) = std::env::var_os(DATA) else {
        eprintln!("skipped: {DATA} names no folder");
        return;
    };
    let path = std::path::Path::new(&data).join("sibl-helmet-drop/helmet_crown_velocity_g_s.csv");
    let text = fs::read_to_string(path).unwrap();
    let rows: Vec<(f64, f64)> = text
        .lines()
        .map(|line| {
            let (time, velocity) = line.split_once(',').unwrap();
            (time.trim().parse().unwrap(), velocity.trim().parse().unwrap())
        })
        .collect();
    let mut record = "time [s],crown [g]\n".to_owned();
    for own in rows.windows(3) {
        let slope = (own[2].1 - own[0].1) / (own[2].0 - own[0].0);
        writeln!(record, "{:e},{slope:e}", own[1].0).unwrap();
    }
    let folder = TempDir::new().unwrap();
    let path = write(&folder, "crown.csv", &record);
    let scene = headform(&folder, "crown.toml", "\"crown.csv\", cfc = 180");
    for (word, of_signal) in [
        ("severity-index", "severity-index"),
        ("clip-3ms", "clip-3ms"),
        ("peak-acceleration", "peak"),
    ] {
        let (found, own) = measure(&scene, word);
        let (expected, error) = signal(&path, &["--cfc", "180"], of_signal);
        let off = (found - expected).abs();
        assert!(off <= error + own, "{word}: {found} ± {own}, not {expected} ± {error}");
    }
    let (peak, _) = measure(&scene, "peak-acceleration");
    assert!((peak / GRAVITY - 232.2).abs() < 0.1, "{peak}");
    // The shell swings back, which takes from the mean; that of the magnitude, 1342, is told.
    let (of_scene, _) = measure(&scene, "hic15");
    let (of_signal, error) = signal(&path, &["--cfc", "180"], "hic15");
    assert!((of_signal - 961.5).abs() < 0.5, "{of_signal}");
    assert!((of_scene - of_signal).abs() <= error, "{of_scene}, not {of_signal} ± {error}");
    let said = json(&["run", &scene, "--json"])["runs"][0]["measures"].to_string();
    assert!(
        said.contains("larger-by-magnitude") && said.contains("of its magnitude 134"),
        "{said}"
    );
}

#[test]
fn what_a_record_holds_before_the_run_is_warned_of() {
    let folder = TempDir::new().unwrap();
    write(&folder, "drop.csv", &half_sine(0.0, 0.0));
    let said = |name: &str, file: &str| {
        let output = run(&["check", &headform(&folder, name, file)]);
        err(&output).split_whitespace().collect::<Vec<_>>().join(" ")
    };
    // The pulse, from 10 to 15 ms, has its peak of 1961.33 m/s² at −0.5 ms then, and begins the run at 0.
    let early = said("early.toml", "\"drop.csv\", shift = \"-13 ms\"");
    assert!(
        early.contains("begins 13 ms before the run, and up to 1960 m/s^2 take no part"),
        "{early}"
    );
    assert!(early.contains("shift = \"13 ms\""), "{early}");
    let late = said("late.toml", "\"drop.csv\", shift = \"-9 ms\"");
    assert!(!late.contains("before the run"), "{late}");
}

#[test]
fn the_criterion_of_a_shell_that_rings_is_that_of_its_channel_and_that_of_the_magnitude_is_told() {
    let folder = TempDir::new().unwrap();
    let mut record = "t [s],acc [g]\n".to_owned();
    for at in 0..600 {
        let t = 5e-5 * f64::from(at);
        let ringing = (-150.0 * t).exp() * (TAU * 260.0 * t).sin();
        writeln!(
            record,
            "{t:.6},{:.4}",
            220.0 * ringing + 30.0 * (-150.0 * t).exp() * (1.0 - (-3e3 * t).exp())
        )
        .unwrap();
    }
    let path = write(&folder, "shell.csv", &record);
    let scene = headform(&folder, "shell.toml", "\"shell.csv\"");
    for word in ["hic15", "hic36"] {
        let (found, _) = measure(&scene, word);
        let (expected, error) = signal(&path, &[], word);
        assert!((found - expected).abs() <= error, "{word}: {found}, not {expected} ± {error}");
    }
    let said = json(&["run", &scene, "--json"])["runs"][0]["measures"].to_string();
    assert!(said.contains("larger-by-magnitude"), "{said}");
}

#[test]
fn a_velocity_that_drives_a_node_is_written_and_read_back() {
    use dashpot::scene::{ReadOptions, read, write_scene};

    // The velocity jumps at 10 ms, so that no acceleration tells it.
    let points = "[[\"0 ms\", \"0 m/s\"], [\"10 ms\", \"2 m/s\"], [\"10 ms\", \"0.5 m/s\"], [\"20 ms\", \"0 m/s\"]]";
    let text = format!(
        "[nodes]\nplate = {{ velocity = {{ table = {points} }} }}\nhead = {{ mass = \"2 kg\" }}\n[elements]\n\
         pad = {{ between = [\"plate\", \"head\"], kelvin-voigt = {{ spring = \"20 kN/m\", dashpot = \"30 N s/m\" }} }}\n\
         [measures]\nhead = [\"end-velocity\"]\n[run]\nduration = \"30 ms\"\n"
    );
    let own = read(&text, &ReadOptions::default()).unwrap().value;
    let settings = own.settings("auto").unwrap();
    let written = write_scene("again", &[], &own.network, &own.run, &settings).unwrap();
    assert!(written.contains("velocity = { table = "), "{written}");
    let folder = TempDir::new().unwrap();
    let ends =
        [text, written].map(|text| measure(&write(&folder, "scene.toml", &text), "end-velocity").0);
    assert!((ends[0] - ends[1]).abs() <= 1e-12 * ends[0].abs(), "{ends:?}");
}
