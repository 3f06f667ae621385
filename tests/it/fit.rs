//! Models from measurements, made of closed forms.

use std::{fmt::Write as _, fs};

use dashpot::signal::{Cfc, Padding};
use serde_json::Value;
use tempfile::TempDir;

use crate::cli::{code, err, file, json, out, run, text};

/// A Zener solid by its spring, its branch and the time of that.
const SPRING: f64 = 2e6;
const BRANCH: f64 = 3e6;
const TIME: f64 = 0.02;

fn times() -> impl Iterator<Item = f64> {
    (0..120).map(|at| 1e-4 * 10.0_f64.powf(f64::from(at) / 30.0))
}

/// Its relaxation, as a machine writes it.
fn relaxation() -> String {
    let mut text = "Specimen 4\n\nZeit [ms];G [MPa]\n".to_owned();
    for t in times() {
        let modulus = SPRING + BRANCH * (-t / TIME).exp();
        let row = format!("{:.9};{:.9}\n", 1e3 * t, 1e-6 * modulus).replace('.', ",");
        text += &row;
    }
    text
}

/// Its storage and loss over the frequency, the loss times a factor.
fn oscillation(factor: f64) -> String {
    let mut text = "f,E_stor,E_loss\nHz,MPa,MPa\n".to_owned();
    for t in times() {
        let frequency = 1.0 / (std::f64::consts::TAU * t);
        let x = TIME / t;
        let storage = SPRING + BRANCH * x * x / (1.0 + x * x);
        let loss = factor * BRANCH * x / (1.0 + x * x);
        writeln!(text, "{frequency:e},{:e},{:e}", 1e-6 * storage, 1e-6 * loss).unwrap();
    }
    text
}

fn number(own: &Value) -> f64 {
    own.as_f64().unwrap()
}

fn folder(files: &[(&str, &str)]) -> (TempDir, Vec<String>) {
    let folder = TempDir::new().unwrap();
    let paths = files.iter().map(|(name, own)| text(&file(&folder, name, own)).to_owned());
    let paths = paths.collect();
    (folder, paths)
}

#[test]
fn a_relaxation_gives_back_its_solid_as_a_scene_that_can_be_tested() {
    let (folder, paths) = folder(&[("relax.csv", &relaxation())]);
    let (to, written) = (format!("{}:G=felt", paths[0]), folder.path().join("felt.toml"));
    let answer = json(&["fit", "--to", &to, "--error", "0.1%", "--json", "--out", text(&written)]);
    let branches = answer["branches"].as_array().unwrap();
    assert_eq!(branches.len(), 1, "{answer}");
    assert!((number(&branches[0]["time"]) / TIME - 1.0).abs() < 1e-3);
    assert!((number(&branches[0]["strength"]) / BRANCH - 1.0).abs() < 1e-3);
    let equilibrium = &answer["parameters"]["equilibrium"];
    assert!(equilibrium["identified"].as_bool().unwrap() && answer["converged"] == true);
    assert!(number(&equilibrium["low"]) <= SPRING && number(&equilibrium["high"]) >= SPRING);
    // Nothing tells what relaxes before the first row.
    let instant = &answer["parameters"]["instantaneous"];
    assert!(instant["high"].is_null() && instant["identified"] == false);
    assert!(number(&answer["floor"]) < 1e-4 && answer["material"] == true);
    let scene = fs::read_to_string(&written).unwrap();
    assert!(scene.contains("[materials.felt]") && scene.contains("# fitted to "), "{scene}");
    let word = format!("{}:felt", text(&written));
    let tested = run(&["rheometer", &word, "--test", "relaxation"]);
    assert_eq!(code(&tested), 0, "{}", err(&tested));
}

#[test]
fn a_scene_keeps_its_comments_and_gets_the_model() {
    let scene = "# of May\n[materials]\nfelt = { spring = \"1 MPa\" } # a guess\n\n[nodes]\n\
                 head = { mass = \"4 kg\", velocity = \"3 m/s\" }\n[elements]\n\
                 pad = { between = [\"head\", \"ground\"], material = \"felt\", area = \"50 cm^2\", \
                 thickness = \"2 cm\" }\n[run]\nduration = \"20 ms\"\n";
    let (folder, paths) = folder(&[("relax.csv", &relaxation()), ("scene.toml", scene)]);
    let (to, written) = (format!("{}:G=felt", paths[0]), folder.path().join("fitted.toml"));
    let done = run(&["fit", &paths[1], "--to", &to, "--out", text(&written)]);
    assert_eq!(code(&done), 0, "{}", err(&done));
    let fitted = fs::read_to_string(&written).unwrap();
    assert!(fitted.starts_with("# of May\n") && fitted.contains("# a guess"), "{fitted}");
    assert!(!fitted.contains("1 MPa"), "{fitted}");
    let solved = run(&["run", text(&written)]);
    assert_eq!(code(&solved), 0, "{}", err(&solved));
    // It is not overwritten unless that is asked for.
    assert_eq!(code(&run(&["fit", &paths[1], "--to", &to, "--out", text(&written)])), 2);
    assert_eq!(code(&run(&["fit", &paths[1], "--to", &to, "--out", text(&written), "--force"])), 0);
}

#[test]
fn storage_and_loss_go_by_symbols_and_are_told_where_they_contradict_each_other() {
    let (_folder, paths) =
        folder(&[("good.csv", &oscillation(1.0)), ("bad.csv", &oscillation(1.6))]);
    let to = format!("{}:E',E''=felt", paths[0]);
    let answer = json(&["fit", "--to", &to, "--json"]);
    assert!(answer["tests"][0]["contradiction"].is_null() && number(&answer["floor"]) < 1e-3);
    let branch = &answer["branches"][0];
    assert!((number(&branch["time"]) / TIME - 1.0).abs() < 0.01, "{branch}");
    let to = format!("{}:E_stor,E_loss=felt", paths[1]);
    let told = run(&["fit", "--to", &to]);
    assert_eq!(code(&told), 0);
    let words = out(&told).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("storage and loss contradict each other"), "{words}");
    let answer = json(&["fit", "--to", &to, "--json"]);
    let found = &answer["tests"][0]["contradiction"];
    assert!((number(&found["loss_from_storage"]) - (1.0 - 1.0 / 1.6)).abs() < 0.02, "{found}");
}

#[test]
fn a_strain_that_was_measured_beside_the_stress_is_the_history() {
    let mut rows = "t [s],strain [%],stress [kPa]\n".to_owned();
    // A ramp of 10 ms to 5 %, held until 0.4 s, and a release that is left out.
    for at in 0..=450 {
        let t = 1e-3 * f64::from(at);
        let rate = 0.05 / 0.01;
        let grown = |t: f64| if t > 0.0 { -(-t / TIME).exp_m1() } else { 0.0 };
        let strain = (rate * t).min(0.05);
        let stress = SPRING * strain + BRANCH * TIME * rate * (grown(t) - grown(t - 0.01));
        let stress = if at > 400 { 0.0 } else { stress };
        writeln!(rows, "{t},{},{}", 100.0 * strain, 1e-3 * stress).unwrap();
    }
    let (_folder, paths) = folder(&[("hold.csv", &rows)]);
    let to = format!("{}:stress=felt", paths[0]);
    let answer = json(&["fit", "--to", &to, "--until", "0.4 s", "--json"]);
    let branch = &answer["branches"][0];
    assert!((number(&branch["time"]) / TIME - 1.0).abs() < 0.02, "{answer}");
    assert!((number(&branch["strength"]) / BRANCH - 1.0).abs() < 0.02, "{answer}");
    assert!(number(&answer["tests"][0]["shift"]).abs() < 1e-4, "{answer}");
    // With the release in it, which the strain does not have, nothing comes near.
    let whole = json(&["fit", "--to", &to, "--json"]);
    assert!(number(&whole["floor"]) > 100.0 * number(&answer["floor"]));
}

#[test]
fn what_cannot_be_fitted_is_told_with_its_file_and_line() {
    let zero = relaxation().replacen("4,9", "-4,9", 1);
    let (_folder, paths) = folder(&[
        ("relax.csv", &relaxation()),
        ("zero.csv", &zero),
        ("bare.csv", "t [s],G\n1,2\n2,1\n3,1\n4,1\n"),
        ("short.csv", "t [s],G [Pa]\n1,2\n"),
        ("creep.csv", "t [s],J [1/Pa]\n1,2\n2,2\n3,2\n4,2\n"),
        ("stress.csv", "t [s],F [N]\n1,2\n2,1\n3,1\n4,1\n"),
    ]);
    let at = |at: usize, rest: &str| format!("{}:{rest}", paths[at]);
    let cases = [
        (vec![at(0, "stress=felt")], "there is no column `stress`"),
        (vec![at(1, "G=felt")], "only numbers above zero can be fitted"),
        (vec![at(1, "G=felt")], "line 4: the modulus is -49"),
        (vec![at(2, "G=felt")], "column `G` has no unit: write `G [MPa]`"),
        (vec![at(3, "G=felt")], "1 rows are too few"),
        (vec![at(0, "G=felt"), at(4, "J=felt")], "cannot share one spectrum"),
        (vec![at(0, "G=felt"), at(0, "G=foam")], "one model at a time"),
        (vec![at(5, "F=felt")], "needs a column of what was done"),
        (vec!["none.csv:G=felt".to_owned()], "there is no such file"),
        (vec!["relax.csv".to_owned()], "relax.csv:G=felt"),
    ];
    for (to, part) in cases {
        let mut arguments = vec!["fit"];
        to.iter().for_each(|own| arguments.extend(["--to", own]));
        let told = run(&arguments);
        assert_eq!(code(&told), 2, "{to:?}");
        let words = err(&told).split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains(part), "{to:?}: {words}");
    }
}

/// A mass of 4 kg at 3 m/s on a spring and a dashpot in series: `F″ + (k/c) F′ + (k/m) F = 0`.
const MASS: f64 = 4.0;
const SPEED: f64 = 3.0;
const K: f64 = 200e3;
const C: f64 = 1500.0;

fn struck(stiffness: f64, speed: f64, t: f64) -> f64 {
    if t < 0.0 {
        return 0.0;
    }
    let rate = 0.5 * stiffness / C;
    let omega = (stiffness / MASS - rate * rate).sqrt();
    stiffness * speed * (-rate * t).exp() * (omega * t).sin() / omega
}

/// Its force at 20 kHz, 0.31 ms late and 8 N high, with ±3 N that no model has.
fn record(stiffness: f64, speed: f64) -> String {
    let mut text = "t [ms],force [kN]\n".to_owned();
    for at in 0..300 {
        let t = 5e-5 * f64::from(at);
        let noise = 3.0 * f64::from((at * at * 7919 + at * 104_729) % 201 - 100) / 100.0;
        let force = struck(stiffness, speed, t - 3.1e-4) + 8.0 + noise;
        writeln!(text, "{},{:e}", 1e3 * t, 1e-3 * force).unwrap();
    }
    text
}

const PAD: &str = "# a pad of May\n[values]\nK = \"90 kN/m\" # a guess\nC = \"800 N s/m\"\n[nodes]\n\
     head = { mass = \"4 kg\", velocity = \"3 m/s\" }\n[elements]\n\
     pad = { between = [\"head\", \"ground\"], series = [{ spring = \"K\" }, { dashpot = \"C\" }] }\n\
     [run]\nduration = \"16 ms\"\n";

#[test]
fn a_drop_gives_back_the_numbers_of_its_pad() {
    let (folder, paths) = folder(&[("pad.toml", PAD), ("drop.csv", &record(K, SPEED))]);
    let (to, written) = (format!("{}:force=pad.force", paths[1]), folder.path().join("out.toml"));
    let varied = ["--vary", "K=10..2000 kN/m", "--vary", "C=100..20000 N s/m"];
    let mut arguments = vec!["fit", &paths[0], "--to", &to, "--out", text(&written)];
    arguments.extend(varied);
    arguments.push("--json");
    let answer = json(&arguments);
    for (name, truth) in [("K", K), ("C", C)] {
        let own = &answer["parameters"][name];
        assert!((number(&own["value"]) / truth - 1.0).abs() < 0.01, "{own}");
        assert!(number(&own["low"]) <= truth && truth <= number(&own["high"]), "{own}");
        assert!(own["identified"].as_bool().unwrap());
    }
    assert!(answer["converged"].as_bool().unwrap() && answer["starts"][0] == answer["starts"][1]);
    let test = &answer["tests"][0];
    assert!((number(&test["shift"]) - 3.1e-4).abs() < 1e-5, "{test}");
    assert!((number(&test["offset"]) - 8.0).abs() < 1.0 && number(&test["rms"]) < 3.0, "{test}");
    let fitted = fs::read_to_string(&written).unwrap();
    assert!(fitted.contains("# a pad of May") && fitted.contains("# a guess"), "{fitted}");
    assert!(fitted.starts_with("# fitted to ") && !fitted.contains("90 kN/m"), "{fitted}");
    let solved = json(&["run", text(&written), "--json"]);
    let peak = number(&solved["runs"][0]["measures"]["pad.peak-force"]["value"]);
    assert!((peak / number(&test["model_peak"]) - 1.0).abs() < 1e-4, "{peak}");
}

#[test]
fn springs_in_series_are_told_to_be_one_and_that_one_is_fitted() {
    let scene = PAD.replace("{ spring = \"K\" }", "{ spring = \"K\" }, { spring = \"K2\" }");
    let scene = scene.replace("[nodes]", "K2 = \"500 kN/m\"\n[nodes]");
    let (_folder, paths) = folder(&[("pad.toml", &scene), ("drop.csv", &record(K, SPEED))]);
    let to = format!("{}:force=pad.force", paths[1]);
    let mut arguments = vec!["fit", &paths[0], "--to", &to, "--vary", "K=50..5000 kN/m"];
    arguments.extend(["--vary", "K2=50..5000 kN/m", "--vary", "C=100..20000 N s/m"]);
    let told = run(&arguments);
    assert_eq!(code(&told), 0, "{}", err(&told));
    let words = out(&told).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("K, K2 cannot all be told apart by any test of `pad`"), "{words}");
    arguments.push("--json");
    let answer = json(&arguments);
    for name in ["K", "K2"] {
        assert_eq!(answer["parameters"][name]["identified"], false);
        assert!(answer["parameters"][name]["low"].is_null());
    }
    assert!(answer["parameters"]["C"]["identified"].as_bool().unwrap());
    let own = &answer["determined"][0]["constants"][0];
    assert!((number(&own["value"]) / K - 1.0).abs() < 0.01, "{own}");
    assert!(number(&own["low"]) <= K && K <= number(&own["high"]), "{own}");
}

#[test]
fn a_height_that_was_left_out_tells_of_a_pad_that_hardens() {
    let files = [record(K, SPEED), record(1.6 * K, 2.0 * SPEED)];
    let (_folder, paths) =
        folder(&[("pad.toml", PAD), ("low.csv", &files[0]), ("high.csv", &files[1])]);
    let low = format!("{}:force=pad.force", paths[1]);
    let high = format!("{}:force=pad.force,head.velocity=6 m/s", paths[2]);
    let mut arguments = vec!["fit", &paths[0], "--to", &low, "--to", &high];
    arguments.extend(["--vary", "K=10..2000 kN/m", "--vary", "C=100..20000 N s/m", "--json"]);
    let answer = json(&arguments);
    let tests = answer["tests"].as_array().unwrap();
    let left_out: Vec<f64> = tests.iter().map(|own| number(&own["held_out"])).collect();
    // Peaks grow with the stiffness, by less than its root, as the dashpot yields.
    assert!(left_out[0] > 0.05 && left_out[1] < -0.05, "{left_out:?}");
    arguments.pop();
    let words = out(&run(&arguments)).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("does not carry from one test to the other"), "{words}");
}

#[test]
fn a_bound_is_told_first_and_wrong_numbers_are_refused() {
    let (_folder, paths) = folder(&[("pad.toml", PAD), ("drop.csv", &record(K, SPEED))]);
    let to = format!("{}:force=pad.force", paths[1]);
    let told = run(&["fit", &paths[0], "--to", &to, "--vary", "K=10..150 kN/m"]);
    let words = out(&told).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.starts_with("! `K` is on a bound"), "{words}");
    let elsewhere = format!("{}:force=mount.force", paths[1]);
    for (to, vary, part) in [
        (&to, "K=0..150 kN/m", "wants bounds above zero"),
        (&to, "Q=1..150 kN/m", "no number `Q`"),
        (&to, "K=1..150 mm", "`K`"),
        (&elsewhere, "K=1..150 kN/m", "there is no `mount.force`"),
    ] {
        let told = run(&["fit", &paths[0], "--to", to, "--vary", vary]);
        assert_eq!(code(&told), 2, "{vary}");
        let words = err(&told).split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains(part), "{vary}: {words}");
    }
    let told = run(&["fit", &paths[0], "--to", &to]);
    assert_eq!(code(&told), 2);
    assert!(err(&told).contains("--vary"), "{}", err(&told));
}

/// The record of a pad, behind a filter of this class if any.
fn filtered(class: f64, speed: f64) -> String {
    let times: Vec<f64> = (0..1200).map(|at| 5e-5 * f64::from(at)).collect();
    let noise = |at: usize| 4.0 * ((at * at * 7919 + at * 104_729) % 201) as f64 / 100.0 - 4.0;
    // The mass leaves the pad where the force falls to zero.
    let pulse = |t: f64| struck(K, speed, t).max(0.0) * f64::from(t < 0.02);
    let force = times.iter().enumerate().map(|(at, t)| pulse(t - 0.02) + 8.0 + noise(at));
    let force: Vec<f64> = force.collect();
    let force = Cfc::new(class).unwrap().filter(&force, 2e4, Padding::Odd).unwrap();
    let mut text = "t [ms],force [kN]\n".to_owned();
    for (t, force) in times.iter().zip(force) {
        writeln!(text, "{},{:e}", 1e3 * t, 1e-3 * force).unwrap();
    }
    text
}

const OPEN_PAD: &str = "[effects]\nseparation.pad = { at = \"head\" }\n";

#[test]
fn the_output_of_a_scene_goes_through_the_filter_of_the_record() {
    let scene = PAD.replace("16 ms", "60 ms") + OPEN_PAD;
    let files = [("pad.toml", &*scene), ("drop.csv", &filtered(60.0, SPEED))];
    let (_folder, paths) = folder(&files);
    let to = format!("{}:force=pad.force", paths[1]);
    let varied = ["--vary", "K=10..2000 kN/m", "--vary", "C=100..20000 N s/m", "--json"];
    let fit = |more: &[&str]| {
        let all = [&["fit", &paths[0], "--to", &to][..], &varied, more].concat();
        json(&all)
    };
    let off = |answer: &Value, name: &str, truth: f64| {
        number(&answer["parameters"][name]["value"]) / truth - 1.0
    };
    let (with, without) = (fit(&["--cfc", "60"]), fit(&["--robust", "off"]));
    for (name, truth) in [("K", K), ("C", C)] {
        assert!(off(&with, name, truth).abs() < 0.01, "{with}");
        let own = &with["parameters"][name];
        assert!(number(&own["low"]) < number(&own["value"]), "{own}");
    }
    assert!(off(&without, "K", K).abs() > 0.05, "{without}");
    assert!((number(&with["tests"][0]["cfc"]) - 60.0).abs() < 1e-12);
    // The same for this test alone; and the peak of the fitted scene with a band.
    let own = format!("{to},cfc=60,noise=2.3 N");
    let alone = json(&[&["fit", &paths[0], "--to", &own][..], &varied].concat());
    assert!(off(&alone, "K", K).abs() < 0.01, "{alone}");
    let peak = &with["measures"]["pad.peak-force"];
    let half = number(&peak["high"]) - number(&peak["value"]);
    assert!(half > 0.0 && half < 0.05 * number(&peak["value"]), "{peak}");
    // A number that is set and fitted is fitted.
    let set = fit(&["--cfc", "60", "--set", "K=500 kN/m"]);
    assert!(off(&set, "K", K).abs() < 0.01, "{set}");
    // By the profile likelihood the ends are nearly the same here.
    let profiled = fit(&["--cfc", "60", "--profile"]);
    for name in ["K", "C"] {
        let (one, other) = (&with["parameters"][name], &profiled["parameters"][name]);
        assert_eq!((&one["profiled"], &other["profiled"]), (&false.into(), &true.into()));
        let width = number(&one["high"]) - number(&one["low"]);
        for end in ["low", "high"] {
            let off = number(&one[end]) - number(&other[end]);
            assert!(off.abs() < 0.1 * width, "{one} {other}");
        }
    }
}

#[test]
fn a_speed_that_was_measured_with_an_error_widens_what_depends_on_it() {
    let scene = PAD.replace("C = \"800 N s/m\"", "C = \"1500 N s/m\"");
    let (_folder, paths) = folder(&[("pad.toml", &scene), ("drop.csv", &record(K, 1.01 * SPEED))]);
    let fit = |set: &str, gain: &[&str]| {
        let to = format!("{}:force=pad.force{set}", paths[1]);
        let all = ["fit", &paths[0], "--to", &to, "--vary", "K=10..2000 kN/m", "--json"];
        json(&[&all[..], gain].concat())
    };
    let known = fit(",head.velocity=3 ± 0.06 m/s", &[]);
    let speed = number(&known["tests"][0]["known"]["head.velocity"]["value"]);
    assert!((speed / (1.01 * SPEED) - 1.0).abs() < 2e-3, "{speed}");
    assert!((number(&known["parameters"]["K"]["value"]) / K - 1.0).abs() < 0.01, "{known}");
    let taken = fit("", &[]);
    assert!(number(&known["tests"][0]["rms"]) < 0.8 * number(&taken["tests"][0]["rms"]));
    // A gain does the same to a force that is linear in the speed.
    let gained = fit("", &["--gain", "2%"]);
    let gain = number(&gained["tests"][0]["gain"]);
    assert!((gain / 1.01 - 1.0).abs() < 2e-3, "{gain}");
    let told = run(&[
        "fit",
        &paths[0],
        "--to",
        &format!("{}:force=pad.force,head.velocity=3 ± 6", paths[1]),
        "--vary",
        "K=1..1000 kN/m",
    ]);
    assert_eq!(code(&told), 2, "{}", out(&told));
}
