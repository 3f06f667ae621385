//! Models from measurements, made of closed forms.

use std::{fmt::Write as _, fs};

use serde_json::Value;
use tempfile::TempDir;

use crate::cli::{code, err, file, json, out, run, text};

/// A Zener solid: 2 MPa at rest, 5 MPa at once, 20 ms between.
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
