//! What `run` hands over: JSON, the scene as it was run, folders.

use std::fs;

use serde_json::Value;
use tempfile::TempDir;

use super::{SOFT, code, err, file, json, keys, out, run, text};

#[test]
fn json_has_one_shape_and_si_values() {
    let answer = json(&["run", "--json"]);
    for key in ["scene", "runs", "difference", "settings", "failed"] {
        assert!(answer.get(key).is_some(), "{key}");
    }
    assert_eq!(answer["scene"]["file"], "reference.toml");
    let runs = answer["runs"].as_array().unwrap();
    let names: Vec<&str> =
        runs.iter().map(|run| run["solver"]["method"].as_str().unwrap()).collect();
    assert_eq!(names, ["exact", "bdf"]);
    for run in runs {
        for key in [
            "method",
            "why",
            "rtol",
            "accepted",
            "rejected",
            "rhs_calls",
            "jacobian_calls",
            "factorizations",
            "solves_for_error",
        ] {
            assert!(run["solver"].get(key).is_some(), "{key}");
        }
        assert_eq!(keys(&run["system"]), ["algebraic", "effects", "modes", "states"]);
        for key in ["work-in", "kinetic", "stored", "dissipated", "closure"] {
            assert!(run["energy"].get(key).is_some(), "{key}");
        }
        assert_eq!(keys(&run["events"][0]), ["code", "error", "time", "what"]);
        assert!(run["warnings"][0].as_str().unwrap().contains("in tension"));
        let peak = &run["measures"]["padding.peak-force"];
        assert_eq!(keys(peak), ["error", "time", "unit", "value", "window"]);
        let off = (peak["value"].as_f64().unwrap() - 38_359.411_601_331).abs();
        assert!(off <= peak["error"].as_f64().unwrap() + 1e-8, "{peak}");
        assert_eq!(run["measures"]["head.severity-index"]["exponent"], 2.5);
        assert!(run["measures"]["padding.contact-time"]["window"].is_null());
    }
    assert!(answer["difference"]["padding.peak-force"].as_f64().unwrap() < 1e-3);
}

#[test]
fn one_method_leaves_no_difference_and_off_means_no_errors() {
    let answer = json(&["run", "--json", "--method", "bdf", "--estimate", "off", "--rtol", "1e-5"]);
    assert!(keys(&answer["difference"]).is_empty());
    let run = &answer["runs"][0];
    assert_eq!(run["solver"]["solves_for_error"], 0);
    assert!(run["measures"]["padding.peak-force"]["error"].is_null());
    assert_eq!(answer["settings"]["rtol"], 1e-5);
}

#[test]
fn accuracy_is_taken_in_percent_and_reached() {
    let answer = json(&["run", "--json", "--method", "bdf", "--accuracy", "0.001%"]);
    for (key, measure) in answer["runs"][0]["measures"].as_object().unwrap() {
        let (value, error) = (measure["value"].as_f64(), measure["error"].as_f64());
        // One speed over another: it has the size 1.
        let is_ratio = key.ends_with("coefficient-of-restitution");
        let size = if is_ratio { 1.0 } else { value.unwrap().abs() };
        assert!(error.unwrap() <= 1.01e-5 * size, "{key}: {measure}");
    }
}

#[test]
fn values_are_set_from_outside() {
    let folder = TempDir::new().unwrap();
    let scene = file(&folder, "soft.toml", SOFT);
    let peak = |arguments: &[&str]| {
        let answer = json(&[&["run", text(&scene), "--json"], arguments].concat());
        answer["runs"][0]["measures"]["pad.peak-deformation"]["value"].as_f64().unwrap()
    };
    assert!(peak(&["--set", "K=200 kN/m"]) < 0.6 * peak(&[]));
    let output = run(&["run", text(&scene), "--set", "K=200 kN/m"]);
    assert!(out(&output).contains("\nwith K = 200 kN/m\n"), "{}", out(&output));
    let output = run(&["run", text(&scene), "--set", "Q=1 N/m"]);
    assert_eq!(code(&output), 2);
    assert!(err(&output).contains("there is no value named `Q`"));
}

#[test]
fn saved_scene_repeats_the_run() {
    let folder = TempDir::new().unwrap();
    let scene = file(&folder, "soft.toml", SOFT);
    let results = folder.path().join("results");
    let asked = ["--set", "K=200 kN/m", "--method", "exact, bdf", "--accuracy", "0.01%"];
    let first =
        json(&[&["run", text(&scene), "--json", "--out", text(&results)], &asked[..]].concat());
    let saved = results.join("scene-as-run.toml");
    let again = json(&["run", text(&saved), "--json"]);
    for (first, again) in
        first["runs"].as_array().unwrap().iter().zip(again["runs"].as_array().unwrap())
    {
        assert_eq!(first["solver"]["method"], again["solver"]["method"]);
        assert_eq!(first["measures"], again["measures"]);
    }
    assert_eq!(again["runs"].as_array().unwrap().len(), 2);
    let page = fs::read_to_string(results.join("report.html")).unwrap();
    assert!(page.contains("with K = 200 kN/m") && page.contains("# as run with"));
    assert!(!page.contains('`'));
}

#[test]
fn folder_of_results_holds_every_form_and_is_never_foreign() {
    let folder = TempDir::new().unwrap();
    let results = folder.path().join("results");
    for _ in 0..2 {
        let output = run(&["run", "--out", text(&results)]);
        assert_eq!(code(&output), 0, "{}", err(&output));
        assert!(out(&output).contains("report.html"));
    }
    let read = |name: &str| fs::read_to_string(results.join(name)).unwrap();
    for figure in ["force-time", "deformation-time", "force-deformation", "energy-time", "network"]
    {
        assert!(read(&format!("{figure}.svg")).starts_with("<svg"), "{figure}");
    }
    assert!(read("report.html").contains("38.36 kN"));
    assert_eq!(read("scene-as-run.toml"), dashpot::scene::reference());
    let answer: Value = serde_json::from_str(&read("result.json")).unwrap();
    assert_eq!(answer["runs"].as_array().unwrap().len(), 2);
    let table = read("exact.csv");
    let mut lines = table.lines();
    let header = lines.next().unwrap();
    assert!(header.starts_with("time [s],") && header.contains("padding.force [N]"), "{header}");
    assert_eq!(lines.count(), 501);
    assert!(results.join("bdf.csv").exists());

    let foreign = folder.path().join("foreign");
    fs::create_dir(&foreign).unwrap();
    fs::write(foreign.join("exact.csv"), "mine").unwrap();
    let output = run(&["run", "--out", text(&foreign)]);
    assert_eq!(code(&output), 2);
    assert!(err(&output).contains("exact.csv` exists already"));
    assert_eq!(fs::read_to_string(foreign.join("exact.csv")).unwrap(), "mine");
}
