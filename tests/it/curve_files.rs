//! Curves from files at the command line: named models read them, and results hold what became of their rows.

use std::{fs, path::Path};

use serde_json::Value;
use tempfile::TempDir;

use crate::cli::{code, err, file, out, run, said, text};

const SCENE: &str = "[values]\nV = \"1 m/s\"\n[materials]\nfoam = { table-spring = \"data/foam.csv\" }\n\
     [nodes]\nhead = { mass = \"1 kg\", velocity = \"V\" }\n[elements]\n\
     pad = { between = [\"head\", \"ground\"], material = \"foam\", thickness = \"2 cm\", area = \"10 cm^2\" }\n\
     [effects]\nseparation.pad = {}\n[run]\nduration = \"40 ms\"\n";
/// Rises, falls by 40 of its 400 kPa, and goes back at the end.
const ROWS: &str =
    "Machine A\n\nstrain [%];stress [kPa]\n0;0\n20;100\n40;200\n50;120\n80;400\n78;330\n";

fn folder() -> (TempDir, String) {
    let folder = TempDir::new().unwrap();
    fs::create_dir(folder.path().join("data")).unwrap();
    fs::write(folder.path().join("data/foam.csv"), ROWS).unwrap();
    let scene = file(&folder, "scene.toml", SCENE);
    let path = text(&scene).to_owned();
    (folder, path)
}

fn read(path: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

fn codes(notes: &Value) -> Vec<&str> {
    notes.as_array().unwrap().iter().map(|own| own["code"].as_str().unwrap()).collect()
}

#[test]
fn a_model_with_a_curve_from_a_file_is_tested_and_no_refusal_is_without_a_word() {
    let (_folder, scene) = folder();
    let named = format!("{scene}:foam");
    let tested = run(&["rheometer", &named, "--test", "load-unload", "--json"]);
    assert_eq!(code(&tested), 0, "{}", err(&tested));
    assert!(said(&tested).contains("line 9, after the largest deformation"), "{}", err(&tested));
    for arguments in [&["convert", &named, "--to", "prony"][..], &["compare", &named, &named]] {
        let refused = run(arguments);
        assert_eq!(code(&refused), 2);
        assert!(!err(&refused).trim().is_empty(), "{arguments:?}");
    }
    let refused = run(&["convert", &named, "--to", "generalized-maxwell"]);
    assert!(said(&refused).contains("`table-spring` in"), "{}", err(&refused));
}

#[test]
fn what_became_of_a_curve_is_part_of_every_result() {
    let (folder, scene) = folder();
    let own = folder.path().join("run");
    let done = run(&["run", &scene, "--out", text(&own)]);
    assert_eq!(code(&done), 0, "{}", err(&done));
    let result = read(&own.join("result.json"));
    let warning = &result["scene"]["warnings"][0];
    assert_eq!(warning["line"], 4);
    assert!(warning["message"].as_str().unwrap().contains("of the peak, in line 6"), "{warning}");
    assert_eq!(
        codes(&result["scene"]["notes"]),
        ["weight-left-out", "lines-left-out", "way-back-left-out"]
    );
    let page = fs::read_to_string(own.join("report.html")).unwrap();
    for told in ["of the peak, in line 6", "line 9, after the largest", "line 1 is no part"] {
        assert!(page.contains(told), "{told}");
    }
    let designs = folder.path().join("designs");
    let variant = ["run", &scene, "--variant", "V=2 m/s", "--out", text(&designs)];
    assert_eq!(code(&run(&variant)), 0);
    let result = read(&designs.join("result.json"));
    for at in 0..2 {
        let own = &result["runs"][at]["scene"];
        assert_eq!(own["warnings"][0]["line"], 4);
        assert_eq!(
            codes(&own["notes"]),
            ["weight-left-out", "lines-left-out", "way-back-left-out"]
        );
    }
    let page = fs::read_to_string(designs.join("report.html")).unwrap();
    for told in
        ["line 9, after the largest", "SHA-256 of the scene", "thickness = &quot;2 cm&quot;"]
    {
        assert!(page.contains(told) || page.contains(&told.replace("&quot;", "\"")), "{told}");
    }
    let curves = ["1-V=1-m-s.csv", "2-V=2-m-s.csv"];
    assert!(curves.iter().all(|own| designs.join(own).is_file()));
}

#[test]
fn a_sweep_says_what_was_asked_of_it() {
    let (folder, scene) = folder();
    let own = folder.path().join("sweep");
    let vary = ["--vary", "V=1..2 m/s", "--vary", "pad.thickness=2..3 cm"];
    let rest = ["--sample", "8", "--seed", "3", "--set", "head.mass=2 kg", "--out", text(&own)];
    let done = run(&[&["sweep", &scene, "--table", "always"], &vary[..], &rest[..]].concat());
    assert_eq!(code(&done), 0, "{}", err(&done));
    assert!(out(&done).contains("a Latin hypercube of 1..2 m/s"), "{}", out(&done));
    assert!(said(&done).contains("designs of a table or a sample"), "{}", err(&done));
    let result = read(&own.join("result.json"));
    let asked = &result["asked"];
    assert_eq!(asked["vary"], "V=1..2 m/s; pad.thickness=2..3 cm");
    assert_eq!(asked["set"], "head.mass=2 kg");
    assert_eq!(asked["sample, seed"], "8, 3");
    assert_eq!(
        codes(&result["scene_notes"]),
        ["weight-left-out", "lines-left-out", "way-back-left-out"]
    );
    let page = fs::read_to_string(own.join("report.html")).unwrap();
    for told in ["pad.thickness=2..3 cm", "head.mass=2 kg", "line 9, after the largest"] {
        assert!(page.contains(told), "{told}");
    }
}

#[test]
fn what_an_elastic_pad_takes_up_is_zero_in_a_sweep_as_in_a_run() {
    let (folder, scene) = folder();
    let own = folder.path().join("sweep");
    let arguments = ["sweep", &scene, "--vary", "V=0.5..1 m/s,3", "--table", "always", "--out"];
    let done = run(&[&arguments[..], &[text(&own)]].concat());
    assert_eq!(code(&done), 0, "{}", err(&done));
    assert!(out(&done).contains("`pad.energy` is zero within"), "{}", out(&done));
    assert!(!own.join("pad.energy.svg").exists() && own.join("pad.peak-force.svg").is_file());
}
