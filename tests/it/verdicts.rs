//! What the command says of runs that end in contact, of zeros, of work from outside, and of folders
//! with earlier results.

use std::fs;

use tempfile::TempDir;

use crate::cli::{code, err, json, out, run};

const PAD: &str = r#"
[nodes]
head = { mass = "5 kg", velocity = "5 m/s" }
[elements]
pad = { between = ["head", "ground"], kelvin-voigt = { spring = "100 kN/m", dashpot = "80 N s/m" } }
"#;

/// A scene in a folder, its text, and the words of a report on it with these arguments.
fn written(text: &str) -> (TempDir, String) {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("scene.toml");
    fs::write(&path, text).unwrap();
    let path = path.to_str().unwrap().to_owned();
    (folder, path)
}

fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn told(text: &str, more: &[&str]) -> String {
    let (_folder, path) = written(text);
    let output = run(&[&["run", &path], more].concat());
    assert_eq!(code(&output), 0, "{}", err(&output));
    words(&(out(&output) + &err(&output)))
}

#[test]
fn a_run_that_ends_in_contact_claims_no_more_than_it_has_seen() {
    let cut = told(&format!("{PAD}[run]\nduration = \"3 ms\"\n"), &[]);
    assert!(cut.contains("at 3.00 ms so far, still rising at the end of the run"), "{cut}");
    assert!(cut.contains("the run ends in contact, so that figures are those so far"), "{cut}");
    let whole = told(&format!("{PAD}[run]\nduration = \"40 ms\"\n"), &[]);
    assert!(!whole.contains("so far"), "{whole}");
}

#[test]
fn what_is_next_to_nothing_is_zero_without_errors_too() {
    let curve = PAD.replace(
        "kelvin-voigt = { spring = \"100 kN/m\", dashpot = \"80 N s/m\" }",
        "table-spring = [[0, 0], [0.01, 500], [0.02, 1500], [0.05, 9000]]",
    );
    let text = format!("{curve}[effects]\nseparation.pad = {{}}\n[run]\nduration = \"40 ms\"\n");
    for more in [&[][..], &["--estimate", "off"]] {
        let shown = told(&text, more);
        assert!(shown.contains("pad takes up 0 J of 62.5 J"), "{shown}");
    }
    let shown = told(&text, &[]);
    let row = shown.split("pad.energy-at-end ").nth(1).unwrap_or_default();
    let row: Vec<&str> = row.split(' ').take(3).collect();
    assert!(row[0] == "0" && row[1].starts_with('±') && row[2] == "J", "{row:?}");
}

#[test]
fn work_from_outside_is_called_by_what_does_it() {
    let run = "[run]\nduration = \"0.2 s\"\n";
    let fall = PAD.replace("velocity = \"5 m/s\"", "drop = \"10 cm\"");
    let gravity = "[effects]\ngravity = {}\nseparation.pad = {}\n";
    let load = "[loads.push]\non = \"head\"\nforce = { constant = \"1 kN\" }\n";
    for (text, label) in [
        (format!("{fall}{gravity}{run}"), "work of gravity"),
        (format!("{PAD}{load}{run}"), "work of loads"),
        (format!("{PAD}{load}{gravity}{run}"), "put in from outside"),
    ] {
        let shown = told(&text, &[]);
        assert!(shown.contains(label), "{shown}");
    }
}

#[test]
fn measures_without_hope_are_told_by_check_and_before_a_run() {
    let text = format!("{PAD}[measures]\nground = [\"hic15\"]\n[run]\nduration = \"40 ms\"\n");
    let (_folder, path) = written(&text);
    for verb in ["check", "run"] {
        let output = run(&[verb, &path]);
        let shown = words(&err(&output));
        assert!(shown.contains("`ground.hic15` can have no value"), "{verb}: {shown}");
        assert_eq!(code(&output), 0);
    }
}

/// A pad that hardly resists takes up next to nothing of the work of the load.
#[test]
fn next_to_nothing_is_no_share() {
    let soft = told(
        "[nodes]
head = { mass = \"5 kg\", velocity = \"1 um/s\" }
plate = { mass = \"5 kg\" }
[elements]
pad = { between = [\"head\", \"plate\"], spring = \"1e-14 N/m\" }
[loads]
push = { on = \"head\", force = { half-sine = { peak = \"2 kN\", duration = \"10 ms\" } } }
[run]
duration = \"50 ms\"
",
        &[],
    );
    assert!(soft.contains("pad takes up 0 J of 16.2 J put in contact"), "{soft}");
}

#[test]
fn results_leave_none_of_the_earlier_ones_behind() {
    let (folder, path) = written(&format!("{PAD}[run]\nduration = \"40 ms\"\n"));
    let results = folder.path().join("results");
    let to = results.to_str().unwrap();
    assert_eq!(code(&run(&["run", &path, "--method", "exact", "--out", to])), 0);
    fs::write(results.join("notes.txt"), "mine").unwrap();
    let second = run(&["run", &path, "--method", "bdf", "--out", to]);
    let shown = words(&out(&second));
    assert!(shown.contains("removed exact.csv of earlier results"), "{shown}");
    assert!(!results.join("exact.csv").exists() && results.join("bdf.csv").exists());
    let vary = "head.velocity=1..5 m/s,3";
    let third = run(&["sweep", &path, "--vary", vary, "--out", to]);
    assert_eq!(code(&third), 0, "{}", err(&third));
    for name in ["bdf.csv", "events.csv", "force-time.svg"] {
        assert!(!results.join(name).exists(), "{name}");
    }
    assert_eq!(fs::read_to_string(results.join("notes.txt")).unwrap(), "mine");
    assert!(results.join("sweep.csv").exists());
}

#[test]
fn a_file_that_is_there_is_not_called_foreign() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("scene.toml");
    let path = path.to_str().unwrap();
    assert_eq!(code(&run(&["new", "drop", "--out", path])), 0);
    let again = run(&["new", "drop", "--out", path]);
    let shown = words(&err(&again));
    assert_eq!(code(&again), 2);
    assert!(shown.contains("exists already") && shown.contains("`--force`"), "{shown}");
    assert!(!shown.contains("not written by"), "{shown}");
}

#[test]
fn a_rise_that_the_rheometer_chooses_has_few_digits() {
    let (_folder, path) = written(&format!(
        "[models]\npad = {{ {} }}\n",
        "kelvin-voigt = { spring = \"100 kN/m\", dashpot = \"79.7 N s/m\" }"
    ));
    let output = run(&["rheometer", &format!("{path}:pad"), "--test", "relaxation"]);
    let shown = words(&(out(&output) + &err(&output)));
    let rise = shown.split("the deformation rises within ").nth(1).unwrap_or_default();
    let number = rise.split(' ').next().unwrap_or_default();
    assert!(!number.is_empty() && number.len() <= 5, "{shown}");
}

#[test]
fn a_model_that_is_a_parameter_is_an_object_in_si_units() {
    let measured = "[measures]\nhead = [{ kind = \"edi\", mass = \"2 kg\", model = { series = [\
                    { spring = \"4 kN/m\" }, { parallel = [{ dashpot = \"90 N s/m\" }, \
                    { spring = \"1 kN/m\" }] }] } }]";
    let (_folder, path) = written(&format!("{PAD}{measured}\n[run]\nduration = \"20 ms\"\n"));
    let found = json(&["run", &path, "--json"]);
    let model = &found["runs"][0]["measures"]["head.edi"]["model"];
    let right = serde_json::json!({ "series": [{ "spring": 4000.0 }, { "parallel": [
        { "dashpot": 90.0 }, { "spring": 1000.0 },
    ] }] });
    assert_eq!(*model, right);
}
