//! Groups, similar scenes and laboratory tests, from the text of scenes to the command.

use std::{fs, path::PathBuf};

use dashpot::{
    analysis::similarity::{Inventory, Laboratory, Similarity, Wish, scaled, similar_settings},
    network::Network,
    scene::{ReadOptions, Scene, Unwritable, read, write_scene},
};
use serde_json::Value;
use tempfile::TempDir;

use crate::cli::{code, err, file, json, out, run, text};

/// The files of the folder `scenes`.
fn files() -> Vec<PathBuf> {
    let folder = format!("{}/scenes", env!("CARGO_MANIFEST_DIR"));
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let is_scene = |path: &PathBuf| path.extension().is_some_and(|own| own == "toml");
    entries.filter(is_scene).collect()
}

fn scene(text: &str, file: &str) -> Scene {
    let options = ReadOptions { file: Some(file), ..ReadOptions::default() };
    read(text, &options).unwrap_or_else(|faults| panic!("{file}: {faults}\n{text}")).value
}

fn inventory(network: &Network) -> Inventory {
    Inventory::of(network).unwrap()
}

#[test]
fn scenes_that_are_written_are_read_back_equal() {
    let mut written = 0;
    for path in files() {
        let name = path.display().to_string();
        let own = scene(&fs::read_to_string(&path).unwrap(), &name);
        let text = match write_scene("again", &[], &own.network, &own.run, &own.measures) {
            Ok(text) => text,
            Err(Unwritable::Function { .. }) => continue,
            Err(other) => panic!("{name}: {other}"),
        };
        written += 1;
        let again = scene(&text, &name);
        let (one, other) = (inventory(&own.network), inventory(&again.network));
        assert_eq!(one.structure, other.structure, "{name}:\n{text}");
        for quantity in &one.quantities {
            let found = other.quantity(&quantity.name).unwrap().value;
            let apart = (found - quantity.value).abs();
            // Functions of time are written as other numbers than they are kept.
            let within = if quantity.name.contains('[') { 1e-12 } else { 4e-15 };
            assert!(apart <= within * quantity.value.abs(), "{name}: {} {found}", quantity.name);
        }
        assert_eq!(own.run, again.run, "{name}");
        assert_eq!(own.measures.len(), again.measures.len(), "{name}");
        for (one, other) in own.measures.iter().zip(&again.measures) {
            // They are written by target, in order of names.
            let same = again.measures.iter().any(|other| {
                other.target == one.target
                    && other.measure.kind() == one.measure.kind()
                    && other.measure.values() == one.measure.values()
            });
            assert!(same, "{name}: {other:?}");
        }
    }
    assert!(written >= 15, "{written}");
}

#[test]
fn every_scene_has_similar_ones() {
    let (mass, length, time) = (0.1, 0.25, 3.0);
    let scale = dashpot::analysis::similarity::Scale { mass, length, time };
    for path in files() {
        let name = path.display().to_string();
        let own = scene(&fs::read_to_string(&path).unwrap(), &name);
        let other = scaled(&own.network, &scale).unwrap();
        let found = Similarity::between(&own.network, &other, Similarity::WITHIN).unwrap();
        assert!(found.is_similar(), "{name}: {:?}", found.structure);
        assert!(other.compile(own.run.duration * time).is_ok(), "{name}");
    }
}

#[test]
fn measures_of_laboratory_scenes_survive_their_text() {
    let own = r#"
[nodes]
head = { mass = "4 kg", velocity = "5 m/s" }
[elements]
pad = { between = ["head", "ground"], spring = "40 kN/m", thickness = "8 cm" }
[measures]
head = ["hic15", { kind = "clip-3ms", counted = "at-once" }, { kind = "edi", mass = "2 kg", model = { series = [{ spring = "4 kN/m" }, { dashpot = "90 N s/m" }] } }, "dri"]
[run]
duration = "40 ms"
"#;
    let real = scene(own, "real.toml");
    let wishes = [Wish { name: "speed".to_owned(), value: 2.5 }];
    let found = Laboratory::design(&real.network, &wishes).unwrap();
    let (similar, left_out) = similar_settings(&real.settings("auto"), &found.scale);
    assert_eq!(left_out, ["head.dri"]);
    let run = dashpot::scene::RunSettings { duration: similar.duration, ..real.run.clone() };
    let text = write_scene("lab", &[], &found.network, &run, &similar.measures).unwrap();
    for part in ["cap = \"30 ms\"", "duration = \"6 ms\"", "mass = \"2 kg\"", "spring = \"1 kN/m\""]
    {
        assert!(text.contains(part), "{part}:\n{text}");
    }
    let again = scene(&text, "lab.toml");
    assert_eq!(again.measures.len(), 3);
    assert!((again.run.duration - 0.08).abs() < 1e-15);
}

#[test]
fn groups_of_the_reference_scene_are_those_of_the_thesis() {
    let output = run(&["groups"]);
    assert_eq!(code(&output), 0, "{}", err(&output));
    let shown = out(&output);
    for part in
        ["a   (1 + p1 + p2) p3/p1", "26.6667", "66.6667", "q =", "10 parameters", "rank 3: 7"]
    {
        assert!(shown.contains(part), "{part}:\n{shown}");
    }
    assert!(shown.lines().all(|line| line.chars().count() <= 80), "{shown}");
    let told = json(&["groups", "--json"]);
    assert_eq!(told["rank"], 3);
    assert_eq!(told["groups"].as_array().unwrap().len(), 7);
    let group = |name: &str| {
        let all = told["thesis"]["groups"].as_array().unwrap();
        all.iter().find(|own| own["parameter"] == name).unwrap()["value"].as_f64().unwrap()
    };
    assert!((group("a") - 80.0 / 3.0).abs() < 1e-12 && (group("gamma") - 0.1).abs() < 1e-15);
    assert!(told["similarity"].is_null() && told["laboratory"].is_null());
}

#[test]
fn laboratory_scene_is_similar_and_the_command_says_so() {
    let folder = TempDir::new().unwrap();
    let lab = folder.path().join("lab.toml");
    let wishes = "mass=1 kg, speed=2 m/s, thickness=5 mm";
    let output = run(&["groups", "reference", "--lab", wishes, "--out", text(&lab)]);
    assert_eq!(code(&output), 0, "{}", err(&output));
    let shown = out(&output);
    for part in ["head.velocity", "2 m/s", "padding.peak-force", "38.359 kN", "and back"] {
        assert!(shown.contains(part), "{part}:\n{shown}");
    }
    let output = run(&["groups", "reference", text(&lab)]);
    assert_eq!(code(&output), 0, "{}{}", out(&output), err(&output));
    assert!(out(&output).contains("Similar: reference and"), "{}", out(&output));
    // The numbers of the laboratory times the way back are those of the real scene.
    let peak =
        |answer: &Value| answer["runs"][0]["measures"]["padding.peak-force"]["value"].as_f64();
    let real = peak(&json(&["run", "reference", "--method", "exact", "--json"])).unwrap();
    let there = peak(&json(&["run", text(&lab), "--method", "exact", "--json"])).unwrap();
    let told = json(&["groups", "reference", "--lab", wishes, "--json"]);
    let factor = told["laboratory"]["scale"]["force"].as_f64().unwrap();
    assert!((there / factor / real - 1.0).abs() < 1e-12);
    // It is there already.
    let output = run(&["groups", "reference", "--lab", wishes, "--out", text(&lab)]);
    assert_eq!(code(&output), 2);
}

#[test]
fn scenes_that_are_not_similar_end_with_code_3_and_what_differs() {
    let folder = TempDir::new().unwrap();
    let scene = fs::read_to_string(format!("{}/scenes/reference.toml", env!("CARGO_MANIFEST_DIR")));
    let softer = scene
        .unwrap()
        .replace("maxwell = { spring = \"20 MN/m\"", "maxwell = { spring = \"19 MN/m\"");
    let path = file(&folder, "softer.toml", &softer);
    let output = run(&["groups", "reference", text(&path)]);
    assert_eq!(code(&output), 3, "{}", err(&output));
    let shown = out(&output);
    for part in ["Not similar", "padding.maxwell.spring δ²/(m V²)", "5.0 %", "padding.peak-force"]
    {
        assert!(shown.contains(part), "{part}:\n{shown}");
    }
    assert!(shown.lines().all(|line| line.chars().count() <= 80), "{shown}");
    let output = run(&["groups", "reference", text(&path), "--within", "0.06"]);
    assert_eq!(code(&output), 0, "{}", err(&output));
}

#[test]
fn groups_become_a_scene_where_a_padding_exists() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("groups.toml");
    let groups = "a=26.6, b=66.66, c=8, d=80";
    let output = run(&["groups", "--from", groups, "--out", text(&path)]);
    assert_eq!(code(&output), 0, "{}", err(&output));
    assert!(out(&output).contains("K1 = 20.13"), "{}", out(&output));
    let again = json(&["groups", text(&path), "--json"]);
    let all = again["thesis"]["groups"].as_array().unwrap();
    let found = all.iter().find(|own| own["parameter"] == "a").unwrap()["value"].as_f64().unwrap();
    assert!((found - 26.6).abs() < 1e-11);
    let output = run(&["groups", "--from", "a=10"]);
    assert_eq!(code(&output), 2);
    assert!(err(&output).contains("no padding has these groups"), "{}", err(&output));
    let output = run(&["groups", "--lab", "size=1 m"]);
    assert_eq!(code(&output), 2);
    assert!(err(&output).contains("head.mass"), "{}", err(&output));
    let output = run(&["groups", "--lab", "mass=1 m"]);
    assert_eq!(code(&output), 2);
}
