//! What is asked for besides the measures: values at times, curves, some of the files; and where results are from.

use std::fs;

use serde_json::Value;
use tempfile::TempDir;

use crate::cli::{code, err, file, out, run};

/// A ball of 2 kg that falls 1.25 m on a spring, and again.
const BALL: &str = "title = \"ball\"\n\
[nodes]\nball = { mass = \"2 kg\", drop = \"1.25 m\" }\n\
[elements.pad]\nbetween = [\"ball\", \"ground\"]\nspring = \"80 kN/m\"\n\
[effects]\ngravity = { value = \"10 m/s^2\" }\nseparation.pad = { at = \"ball\" }\n\
[run]\nduration = \"1.8 s\"\n";

fn json(arguments: &[&str]) -> (String, Value) {
    let output = run(arguments);
    assert_eq!(code(&output), 0, "{}", err(&output));
    let text = out(&output);
    let value = serde_json::from_str(&text).unwrap();
    (text, value)
}

#[test]
fn events_happen_when_their_errors_say() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "ball.toml", BALL);
    let path = path.to_str().unwrap();
    // It falls for t0 = √(2h/g) = 0.5 s, and is in touch for the arc of x = (g/ω²)(1 − cos ωt) + (v/ω) sin ωt.
    let (omega, speed) = ((8e4_f64 / 2.0).sqrt(), 5.0);
    let touch = 2.0 * (std::f64::consts::PI - (speed * omega / 10.0).atan()) / omega;
    let expected = [0.5, 0.5 + touch, 1.5 + touch, 1.5 + 2.0 * touch];
    for (method, most) in [("exact", 1e-9), ("bdf", 1e-3), ("esdirk34", 1e-3)] {
        let (_, object) = json(&["run", path, "--json", "--method", method]);
        let events = object["runs"][0]["events"].as_array().unwrap();
        assert_eq!(events.len(), expected.len(), "{events:?}");
        for (event, expected) in events.iter().zip(expected) {
            let (time, error) = (event["time"].as_f64().unwrap(), event["error"].as_f64().unwrap());
            assert!((time - expected).abs() <= error, "{method}: {event} {expected}");
            assert!(error < most * expected, "{method}: {event}");
        }
    }
}

#[test]
fn a_slide_turns_back_when_its_errors_say() {
    // It swings about 5 mm with the period of the spring, and turns back after each half of it.
    let text = "[nodes]\nblock = { mass = \"1 kg\", position = \"52 mm\" }\n[elements]\n\
                s = { between = [\"block\", \"ground\"], spring = \"1 kN/m\" }\n\
                f = { between = [\"block\", \"ground\"], friction = { friction = \"5 N\", static-to-kinetic = 2 \
                } }\n[run]\nduration = \"1 s\"\n";
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "slide.toml", text);
    let half = std::f64::consts::PI / 1000_f64.sqrt();
    for (method, most) in [("exact", 1e-9), ("bdf", 1e-3)] {
        let (_, object) = json(&["run", path.to_str().unwrap(), "--json", "--method", method]);
        let events = object["runs"][0]["events"].as_array().unwrap();
        assert_eq!(events.len(), 5, "{method}: {events:?}");
        for (at, event) in events.iter().enumerate() {
            let expected = (at + 1) as f64 * half;
            let (time, error) = (event["time"].as_f64().unwrap(), event["error"].as_f64().unwrap());
            assert!((time - expected).abs() <= error, "{method}: {event} {expected}");
            assert!(error < most * expected, "{method}: {event}");
        }
    }
}

#[test]
fn an_object_is_the_same_bytes_in_every_run() {
    let arguments = ["run", "reference", "--json", "--curves", "--at", "5 ms"];
    let (first, object) = json(&arguments);
    assert_eq!(first, json(&arguments).0);
    let own = &object["runs"][0];
    let curves = own["curves"]["time"].as_array().unwrap().len();
    assert!(curves > 100);
    for output in own["curves"]["outputs"].as_array().unwrap() {
        assert_eq!(output["values"].as_array().unwrap().len(), curves, "{}", output["name"]);
    }
    assert_eq!(own["at"]["time"], serde_json::json!([0.005]));
}

#[test]
fn values_at_a_time_are_those_of_the_closed_form() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "ball.toml", BALL);
    let (_, object) = json(&["run", path.to_str().unwrap(), "--json", "--at", "0.3 s, 0.1 s"]);
    let at = &object["runs"][0]["at"];
    assert_eq!(at["time"], serde_json::json!([0.1, 0.3]));
    let outputs = at["outputs"].as_array().unwrap();
    let speed = outputs.iter().find(|own| own["name"] == "ball.velocity").unwrap();
    let values: Vec<f64> =
        speed["values"].as_array().unwrap().iter().map(|own| own.as_f64().unwrap()).collect();
    assert!((values[0] - 1.0).abs() < 1e-12 && (values[1] - 3.0).abs() < 1e-12, "{values:?}");
    let late = run(&["run", path.to_str().unwrap(), "--at", "2 s"]);
    assert_eq!(code(&late), 2);
    assert!(err(&late).contains("beyond the end of the run, 1.8 s"), "{}", err(&late));
}

#[test]
fn a_folder_holds_what_is_asked_for() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "ball.toml", BALL);
    let results = folder.path().join("results");
    let write = ["run", path.to_str().unwrap(), "--out", results.to_str().unwrap(), "--write"];
    for (kinds, has, lacks) in [
        ("page", vec!["report.html", "result.json"], vec!["exact.csv", "force-time.svg"]),
        ("events,curves", vec!["events.csv", "exact.csv"], vec!["report.html", "network.svg"]),
    ] {
        let output = run(&[&write[..], &[kinds]].concat());
        assert_eq!(code(&output), 0, "{}", err(&output));
        has.iter().for_each(|name| assert!(results.join(name).is_file(), "{kinds}: {name}"));
        lacks.iter().for_each(|name| assert!(!results.join(name).exists(), "{kinds}: {name}"));
    }
}

#[test]
fn results_tell_the_hashes_of_all_that_they_are_made_of() {
    let folder = TempDir::new().unwrap();
    let scene = BALL.replace("spring = \"80 kN/m\"", "table-spring = \"curve.csv\"");
    let path = file(&folder, "ball.toml", &scene);
    file(&folder, "curve.csv", "deformation [mm],force [kN]\n0,0\n100,8\n");
    let hashes = || {
        let (_, object) = json(&["run", path.to_str().unwrap(), "--json"]);
        let own = &object["scene"];
        let files = own["files"].as_array().unwrap();
        assert_eq!(files.len(), 1);
        [own["sha256"].to_string(), files[0]["sha256"].to_string()]
    };
    let before = hashes();
    fs::write(folder.path().join("curve.csv"), "deformation [mm],force [kN]\n0,0\n100,9\n")
        .unwrap();
    let after = hashes();
    assert_eq!(before[0], after[0]);
    assert_ne!(before[1], after[1]);
}

#[test]
fn a_sweep_is_a_table_for_people_where_it_is_asked_for() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "ball.toml", BALL);
    let sweep = ["sweep", path.to_str().unwrap(), "--vary", "pad.spring=20,80 kN/m"];
    let rest = ["--measure", "pad.impulse", "--limit", "pad.impulse<=20.5 N s", "--table"];
    let text = |when: &str| out(&run(&[&sweep[..], &rest, &[when]].concat()));
    assert!(text("auto").starts_with("pad.spring [N/m],pad.impulse [N s],"), "{}", text("auto"));
    let table = text("always");
    assert!(table.contains("pad.spring") && table.contains("kN/m"), "{table}");
    assert!(table.lines().all(|line| line.chars().count() <= 80), "{table}");
    // The impulse 2 m v grows with the time in touch, in which gravity acts: by m g t.
    let row = |start: &str| table.lines().filter(|own| own.trim().starts_with(start)).count();
    assert!(row("20 ") >= 1 && row("80 ") >= 1, "{table}");
    assert!(table.contains("pass") && table.contains("fail"), "{table}");
}
