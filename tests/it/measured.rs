//! Measured curves beside runs, made of closed forms.

use std::{f64::consts::PI, fmt::Write as _, fs};

use dashpot::signal::{Cfc, Padding};
use serde_json::Value;
use tempfile::TempDir;

use crate::cli::{code, err, file, json, out, run};

/// A mass of 4 kg at 5 m/s on a spring of 25 kN/m: F = V √(K m) sin ωt.
const PEAK: f64 = 1_581.138_830_084_19;
const OMEGA: f64 = 79.056_941_504_209_5;
/// Standard gravity \[m/s²\].
const GRAVITY: f64 = 9.806_65;
const SCENE: &str = "[values]\nK = \"25 kN/m\"\n[nodes]\nhead = { mass = \"4 kg\", velocity = \"5 m/s\" }\n\
     plate = { mass = \"90 kg\" }\n[elements]\n\
     pad = { between = [\"head\", \"ground\"], spring = \"K\" }\n\
     mount = { between = [\"plate\", \"ground\"], spring = \"1 MN/m\" }\n[run]\nduration = \"100 ms\"\n";
/// The same mass falls 1 m on the spring and leaves it again.
const DROP: &str = "[nodes]\nhead = { mass = \"4 kg\", drop = \"1 m\" }\n[elements]\n\
     pad = { between = [\"head\", \"ground\"], spring = \"25 kN/m\" }\n\
     [effects]\nseparation.pad = {}\ngravity = { value = \"1 g0\" }\n[run]\nduration = \"600 ms\"\n";

/// Half a period of a force 10 % above that of the scene in 400 steps, which begins at 2 ms: machine's text, decimal
/// commas, a column that nobody asked for.
fn force() -> String {
    let mut text = "Prüfung 7\n\nZeit [ms];Kraft [kN];Temp [°C]\n".to_owned();
    for at in 0..=400 {
        let share = f64::from(at) / 400.0;
        let (time, force) = (1e3 * PI / OMEGA * share + 2.0, 1.1e-3 * PEAK * (PI * share).sin());
        let row = format!("{time:.9};{force:.12};21.5\n").replace('.', ",");
        text += &row;
    }
    text
}

/// What an accelerometer reads from 2 ms before the touch on: K y / m with y of the spring under gravity.
fn acceleration() -> String {
    let speed = (2.0 * GRAVITY).sqrt();
    let mut text = "t [ms],a [g]\n".to_owned();
    for at in -20..=200 {
        let time = f64::from(at) * 1e-4;
        let depth = GRAVITY / OMEGA.powi(2) * (1.0 - (OMEGA * time).cos())
            + speed / OMEGA * (OMEGA * time).sin();
        let pushed = if time > 0.0 { OMEGA.powi(2) * depth / GRAVITY } else { 0.0 };
        writeln!(text, "{},{pushed:.12}", f64::from(at) * 0.1).unwrap();
    }
    text
}

fn folder() -> (TempDir, [String; 4]) {
    let folder = TempDir::new().unwrap();
    let (force, acceleration) = (force(), acceleration());
    let files =
        [("scene.toml", SCENE), ("drop.toml", DROP), ("f.csv", &force), ("a.csv", &acceleration)];
    let paths = files.map(|(name, text)| file(&folder, name, text).to_str().unwrap().to_owned());
    (folder, paths)
}

fn number(own: &Value) -> f64 {
    own.as_f64().unwrap_or(f64::NAN)
}

fn close(own: &Value, wanted: f64, error: f64) {
    assert!((number(own) - wanted).abs() <= error, "{own} is not {wanted} ± {error}");
}

fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn a_force_beside_the_run_has_the_deviation_of_its_closed_form() {
    let (folder, [scene, _, force, _]) = folder();
    let results = folder.path().join("results");
    let measured = format!("{force}:pad.force");
    let all = ["run", &scene, "--measured", &measured, "--shift", "-2 ms"];
    let own = json(&[&all[..], &["--json"]].concat())["runs"][0]["measured"][0].clone();
    assert_eq!(
        (&own["output"], &own["column"], &own["rows"]),
        (&"pad.force".into(), &"Kraft".into(), &401.into())
    );
    close(&own["measured_peak"]["value"], 1.1 * PEAK, 1e-8);
    close(&own["model_peak"]["value"], PEAK, 1e-8);
    close(&own["peak_relative"], 1.0 / 1.1 - 1.0, 1e-10);
    close(&own["peak_later"], 0.0, 1e-10);
    // A tenth of a sine over half its period; between rows the difference is straight: (π/400)²/6 of it.
    close(&own["rms"], 0.1 * PEAK / 2.0_f64.sqrt(), 1e-4 * PEAK * 0.1);
    close(&own["rms_relative"], 0.1 / 1.1 / 2.0_f64.sqrt(), 1e-5);
    let output = run(&[&all[..], &["--out", results.to_str().unwrap()]].concat());
    assert_eq!(code(&output), 0, "{}", err(&output));
    let text = words(&out(&output));
    for told in [
        "pad.force beside `Kraft` of",
        "peak, measured 1.739 kN peak, model 1.581 kN the model deviates by −9.1 %",
        "401 rows from 0 s to 39.73835 ms, moved earlier by 2 ms; time 0 is the start of the run",
        "f.csv: line 1 is no part of the table and left out",
    ] {
        assert!(text.contains(told), "no {told:?} in {text}");
    }
    let read = |name: &str| fs::read_to_string(results.join(name)).unwrap();
    assert!(read("report.html").contains("pad.force beside"));
    assert!(read("force-time.svg").contains("measured, f.csv: Kraft"));
    assert!(!read("acceleration-time.svg").contains("f.csv"));
    let stored: Value = serde_json::from_str(&read("result.json")).unwrap();
    assert_eq!(stored["runs"][0]["measured"][0]["rms"], own["rms"]);
}

#[test]
fn time_of_the_curve_counts_from_the_first_touch() {
    let (_folder, [_, drop, _, acceleration]) = folder();
    let own = json(&["run", &drop, "--measured", &acceleration, "--json"])["runs"][0]["measured"]
        [0]
    .clone();
    assert_eq!(own["output"], "head.acceleration");
    close(&own["zero"], (2.0 / GRAVITY).sqrt(), 1e-9);
    close(&own["rms_relative"], 0.0, 1e-9);
    // The peak lies between two rows, 0.1 ms apart.
    close(&own["peak_later"], 0.0, 0.5e-4);
    close(&own["peak_relative"], 0.0, 0.5 * (OMEGA * 0.5e-4).powi(2));
}

#[test]
fn each_design_has_its_own_deviation() {
    let (_folder, [scene, _, force, _]) = folder();
    let measured = format!("{force}:Kraft=pad.force");
    let all =
        ["run", &scene, "--variant", "K=30.25 kN/m", "--measured", &measured, "--shift", "-2 ms"];
    let runs = json(&[&all[..], &["--json"]].concat());
    let off = |at: usize| runs["runs"][at]["measured"][0]["peak_relative"].clone();
    close(&off(0), 1.0 / 1.1 - 1.0, 1e-10);
    // √(30.25 / 25) = 1.1.
    close(&off(1), 0.0, 1e-10);
    let text = words(&out(&run(&all)));
    assert!(text.contains("peak, model 1.581 kN 1.739 kN"), "{text}");
}

#[test]
fn what_cannot_stand_beside_is_refused_with_a_remedy() {
    let (folder, [scene, _, force, acceleration]) = folder();
    let write = |name: &str, text: &str| file(&folder, name, text).to_str().unwrap().to_owned();
    let late = write("late.csv", "t [s],F [kN]\n5,1\n6,2\n");
    let back = write("back.csv", "t [ms],F [kN]\n0,1\n2,2\n1,3\n");
    let bare = write("bare.csv", "t [ms],F\n0,1\n2,2\n");
    let two = SCENE.replace("mount = { between = [\"plate\"", "mount = { between = [\"head\"");
    let two = write("two.toml", &two);
    let timeless = write("timeless.csv", "F [kN],w [mm]\n0,1\n2,2\n");
    for (argument, told) in [
        (format!("{force}:pad.forse"), "did you mean `pad.force`?"),
        (format!("{force}:head.velocity"), "no column is a velocity by its unit"),
        (
            format!("{force}:Weg=pad.force"),
            "there is no column `Weg`; it has `Zeit [ms]`, `Kraft [kN]`",
        ),
        (
            format!("{acceleration}:a=pad.force"),
            "the column `a` is not a force by its unit, as `pad.force` is",
        ),
        (
            format!("{late}:pad.force"),
            "from 5 s to 6 s, and what figures show of the run, 0 s to 100 ms",
        ),
        (format!("{back}:pad.force"), "line 4: the time 1 ms stands after 2 ms"),
        (format!("{bare}:F=pad.force"), "the column `F` has no unit"),
        (format!("{timeless}:pad.force"), "no column is a time by its unit"),
        ("nowhere.csv".to_owned(), "nowhere.csv`: it cannot be read: there is no such file"),
    ] {
        let output = run(&["run", &scene, "--measured", &argument]);
        let found = words(&err(&output));
        assert_eq!(code(&output), 2, "{argument}: {found}");
        assert!(found.contains(told), "no {told:?} in {found}");
    }
    let found = words(&err(&run(&["run", &two, "--measured", &force])));
    let told =
        "`Kraft` may be any of pad.force, mount.force; say which, as in `drop.csv:pad.force`";
    assert!(found.contains(told), "{found}");
}

#[test]
fn what_was_written_is_read_back_with_its_signs() {
    let (folder, [_, drop, ..]) = folder();
    let own = folder.path().join("results");
    let done = run(&["run", &drop, "--method", "exact", "--out", own.to_str().unwrap()]);
    assert_eq!(code(&done), 0, "{}", err(&done));
    let text = fs::read_to_string(own.join("exact.csv")).unwrap();
    let at = text
        .lines()
        .next()
        .unwrap()
        .split(',')
        .position(|own| own.starts_with("head.acceleration"));
    let column = text
        .lines()
        .skip(1)
        .map(|row| row.split(',').nth(at.unwrap()).unwrap().parse::<f64>().unwrap());
    // In the fall nothing acts on it, and the spring pushes it away from the support.
    assert!(column.clone().all(|own| own > -1e-9) && column.fold(0.0, f64::max) > 300.0);
    // The time of the file is that of the run, 0 s at the first touch in figures: sqrt(2 h/g0) later.
    let touch = (2.0 / GRAVITY).sqrt();
    let measured = format!("{}:head.acceleration", own.join("exact.csv").to_str().unwrap());
    let moved = format!("-{touch} s");
    let all =
        ["run", &drop, "--method", "exact", "--measured", &measured, "--shift", &moved, "--json"];
    let own = json(&all)["runs"][0]["measured"][0].clone();
    let peak = number(&own["measured_peak"]["value"]);
    assert!(peak > 300.0, "{own}");
    assert!(number(&own["rms"]).abs() < 1e-3 * peak, "{own}");
    let refused = run(&["run", &drop, "--measured", &measured, "--shift", "-2"]);
    assert!(
        code(&refused) == 2 && words(&err(&refused)).contains("write \"-2 ms\""),
        "{}",
        err(&refused)
    );
}

/// What an accelerometer on the mass of [`DROP`] reads at a time from the touch on: K y / m until it leaves.
fn pushed(time: f64) -> f64 {
    let speed = (2.0 * GRAVITY).sqrt();
    let depth = GRAVITY / OMEGA.powi(2) * (1.0 - (OMEGA * time).cos())
        + speed / OMEGA * (OMEGA * time).sin();
    if (0.0..0.06).contains(&time) { (OMEGA.powi(2) * depth).max(0.0) } else { 0.0 }
}

/// Samples of that at 20 kHz from 20 ms before the touch to 100 ms behind it, through a filter.
fn recorded(cfc: Option<f64>) -> Vec<(f64, f64)> {
    let times: Vec<f64> = (-400..=2000).map(|at| f64::from(at) * 5e-5).collect();
    let values: Vec<f64> = times.iter().map(|time| pushed(*time)).collect();
    let filtered = |class| Cfc::new(class).unwrap().filter(&values, 20e3, Padding::Odd).unwrap();
    let values = cfc.map_or(values.clone(), filtered);
    times.into_iter().zip(values).collect()
}

fn table(rows: &[(f64, f64)]) -> String {
    let lines = rows.iter().map(|own| format!("{:.6},{:.12}\n", 1e3 * own.0, own.1));
    format!("t [ms],a [m/s^2]\n{}", lines.collect::<String>())
}

#[test]
fn a_run_says_what_the_record_says_that_is_its_own_closed_form() {
    let (folder, [_, drop, ..]) = folder();
    let path = file(&folder, "own.csv", &table(&recorded(None)));
    let all = ["run", &drop, "--measured", path.to_str().unwrap()];
    let own = json(&[&all[..], &["--json"]].concat())["runs"][0]["measured"][0].clone();
    for (word, relative) in [
        ("peak", 1e-9),
        ("contact-time", 1e-9),
        ("velocity-change", 1e-9),
        ("hic15", 1e-8),
        ("hic36", 1e-8),
        ("hic", 1e-8),
        ("severity-index", 1e-8),
        ("clip-3ms", 1e-8),
        ("peak-displacement", 1e-7),
        ("rebound-velocity", 1e-7),
        ("coefficient-of-restitution", 1e-7),
        ("energy-taken", 1e-7),
        ("energy-returned", 1e-7),
    ] {
        let reading = &own["measures"][word];
        let [measured, model] = ["measured", "model"].map(|of| number(&reading[of]["value"]));
        assert!((model / measured - 1.0).abs() < relative, "{word}: {reading}");
        assert!(number(&reading["model"]["error"]) > 0.0, "{word}: {reading}");
    }
    // Half of the mass times the square of the speed, and its weight on the way: what the spring stores.
    let depth = GRAVITY / OMEGA.powi(2)
        + ((GRAVITY / OMEGA.powi(2)).powi(2) + 2.0 * GRAVITY / OMEGA.powi(2)).sqrt();
    let taken = &own["measures"]["energy-taken"]["measured"];
    let stored = 0.5 * 25e3 * depth * depth;
    let off = (number(&taken["value"]) - stored).abs();
    assert!(off <= number(&taken["error"]) && off < 1e-4 * stored, "{taken}, not {stored}");
    close(&own["measures"]["coefficient-of-restitution"]["measured"]["value"], 1.0, 1e-4);
    let rating = &own["rating"];
    assert_eq!(rating["grade"], "excellent");
    close(&rating["overall"], 1.0, 1e-6);
    let text = words(&out(&run(&all)));
    assert!(text.contains("rating (ISO/TS 18571) 1.000, excellent"), "{text}");
    assert!(text.contains("head.acceleration: what both say at the same times"), "{text}");
}

#[test]
fn a_factor_in_the_force_is_that_of_impulse_energy_and_slope() {
    let (folder, [scene, _, force, _]) = folder();
    let mut way = "t [ms],w [mm]\n".to_owned();
    for at in 0..=400 {
        let share = f64::from(at) / 400.0;
        let depth = 5.0 / OMEGA * (PI * share).sin();
        writeln!(way, "{:.9},{:.12}", 1e3 * PI / OMEGA * share + 2.0, 1e3 * depth).unwrap();
    }
    let way = file(&folder, "w.csv", &way);
    let [force, way] =
        [format!("{force}:pad.force"), format!("{}:pad.deformation", way.to_str().unwrap())];
    let all =
        ["run", &scene, "--measured", &force, "--measured", &way, "--shift", "-2 ms", "--json"];
    let own = json(&all)["runs"][0]["measured"][0].clone();
    let relative = |word: &str| &own["measures"][word]["relative"];
    close(relative("impulse"), 1.0 / 1.1 - 1.0, 1e-8);
    close(relative("energy-taken"), 1.0 / 1.1 - 1.0, 1e-6);
    // Half of the mass times the square of the speed.
    close(&own["measures"]["energy-taken"]["model"]["value"], 50.0, 1e-2);
    close(&own["measures"]["energy-absorbed"]["model"]["value"], 0.0, 1e-2);
    let rating = &own["rating"];
    close(&rating["phase"], 1.0, 0.0);
    close(&rating["slope"], 1.0 - 0.1 / 1.1 / 2.0, 1e-3);
    assert_eq!(rating["grade"], "excellent");
}

#[test]
fn the_model_goes_through_the_filter_of_the_record() {
    let (folder, [_, drop, ..]) = folder();
    let rows = recorded(Some(60.0));
    let path = file(&folder, "own.csv", &table(&rows));
    let path = path.to_str().unwrap();
    let rms = |all: &[&str]| {
        let own = json(&[&["run", &drop, "--json"][..], all].concat());
        number(&own["runs"][0]["measured"][0]["rms_relative"])
    };
    assert!(rms(&["--measured", path]) > 1e-4);
    assert!(rms(&["--measured", path, "--cfc", "60"]) < 1e-9);
    // ISO-MME says the class in its code.
    let mut text = "Name of the channel:Head\nChannel code:11HEAD0000H3ACXD\nUnit:m/s2\n\
         Sampling interval:0.00005\nTime of first sample:-0.02\n"
        .to_owned();
    rows.iter().for_each(|own| writeln!(text, "{:.12}", own.1).unwrap());
    let test = folder.path().join("test");
    fs::create_dir(&test).unwrap();
    fs::write(test.join("drop.mme"), "Data format edition number:1.6\n").unwrap();
    fs::write(test.join("drop.001"), text).unwrap();
    let mme = test.join("drop.mme");
    let mme = mme.to_str().unwrap();
    assert!(rms(&["--measured", mme]) < 1e-9);
    for named in ["Head=head.acceleration", "11HEAD0000H3ACXD=head.acceleration"] {
        assert!(rms(&["--measured", &format!("{mme}:{named}")]) < 1e-9);
    }
    let own = json(&["run", &drop, "--measured", mme, "--json"]);
    assert_eq!(own["runs"][0]["measured"][0]["cfc"], 60.0);
    // Uneven steps have no filter.
    let uneven: Vec<_> = rows.iter().filter(|own| own.0 < 0.01 || own.0 > 0.02).copied().collect();
    let uneven = file(&folder, "uneven.csv", &table(&uneven));
    let refused = run(&["run", &drop, "--measured", uneven.to_str().unwrap(), "--cfc", "60"]);
    let told = words(&err(&refused));
    assert!(code(&refused) == 2 && told.contains("the model cannot go through CFC 60"), "{told}");
    let results = folder.path().join("results");
    let all = ["run", &drop, "--measured", mme, "--out", results.to_str().unwrap()];
    assert_eq!(code(&run(&all)), 0);
    let drawn = fs::read_to_string(results.join("acceleration-time.svg")).unwrap();
    assert!(drawn.contains("through CFC 60"));
}
