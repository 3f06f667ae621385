//! Groups, similar scenes and laboratory tests, from the text of scenes to the command.

use std::fs;

use dashpot::{
    analysis::similarity::{Inventory, Laboratory, Similarity, Wish, scaled, similar_settings},
    network::Network,
    scene::{ReadOptions, Scene, Unwritable, read, write_scene},
};
use serde_json::Value;
use tempfile::TempDir;

use crate::{
    cli::{code, err, file, json, out, run, text},
    scenes::{scene_path, scene_paths},
};

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
    for path in scene_paths() {
        let name = path.display().to_string();
        let own = scene(&fs::read_to_string(&path).unwrap(), &name);
        let text =
            match write_scene("again", &[], &own.network, &own.run, &own.settings("auto").unwrap())
            {
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
            let is_driving = quantity.name.contains('[') || quantity.name.contains("acceleration.");
            let within = if is_driving { 1e-12 } else { 4e-15 };
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
    for path in scene_paths() {
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
    let (similar, left_out) = similar_settings(&real.settings("auto").unwrap(), &found.scale);
    assert_eq!(left_out, ["head.dri"]);
    let run = dashpot::scene::RunSettings { duration: similar.duration, ..real.run.clone() };
    let text = write_scene("lab", &[], &found.network, &run, &similar).unwrap();
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
    let scene = fs::read_to_string(scene_path("reference"));
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

const DROPPED: &str = "title = \"A parcel that is dropped\"
[nodes]
parcel = { mass = \"20 kg\", drop = \"0.8 m\" }
[elements]
cushion = { between = [\"parcel\", \"ground\"], kelvin-voigt = { spring = \"200 kN/m\", dashpot = \"500 N s/m\" }, thickness = \"60 mm\" }
[effects]
gravity = true
separation.cushion = { at = \"parcel\" }
[run]
duration = \"600 ms\"
";

#[test]
fn what_is_dropped_falls_in_the_laboratory_as_well() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "parcel.toml", DROPPED);
    let lab = folder.path().join("lab.toml").display().to_string();
    let wish = "mass=1 kg, thickness=6 mm";
    let designed = json(&["groups", text(&path), "--lab", wish, "--out", &lab, "--json"]);
    let pairs = designed["laboratory"]["measures"].as_array().unwrap();
    assert!(pairs.iter().any(|pair| pair["measure"] == "cushion.energy-at-end"));
    for pair in pairs {
        let number = |value: &Value| value.as_f64().unwrap();
        let [real, there] = [0, 1].map(|at| number(&pair["values"][at]));
        let apart = (there / number(&pair["factor"]) / real - 1.0).abs();
        assert!(apart < 1e-9, "{pair}");
    }
    // Under the gravity of every place the fall takes longer, but the impact is in the run.
    let own = designed["laboratory"]["with_own_gravity"].as_array().unwrap();
    let force = own.iter().find(|own| own["measure"] == "cushion.peak-force").unwrap();
    assert!(force["apart"].as_f64().unwrap() < 0.1, "{force}");
    let written = fs::read_to_string(&lab).unwrap();
    assert!(written.contains("drop = \"80 mm\""), "{written}");
    let side = json(&["groups", text(&path), &lab, "--json"]);
    assert_eq!(side["similarity"]["similar"], true);
    for own in side["similarity"]["measures"].as_array().unwrap() {
        assert!(own["apart"].as_f64().unwrap() < 1e-9, "{own}");
    }
    // So do scenes of which one begins at touch.
    let speed = format!("velocity = \"{} m/s\"", (2.0 * 9.806_65 * 0.8_f64).sqrt());
    let struck = file(&folder, "struck.toml", &DROPPED.replace("drop = \"0.8 m\"", &speed));
    let side = json(&["groups", text(&path), text(&struck), "--json"]);
    for own in side["similarity"]["measures"].as_array().unwrap() {
        assert!(own["apart"].as_f64().unwrap() < 1e-9, "{own}");
    }
}

#[test]
fn what_cannot_be_told_from_zero_is_zero_and_an_area_is_no_group() {
    let folder = TempDir::new().unwrap();
    let helmet = "[nodes]
head = { mass = \"5 kg\", velocity = \"5.42 m/s\" }
[elements]
liner = { between = [\"head\", \"ground\"], foam = { modulus = \"15 MPa\", plateau = \"0.7 MPa\", densification = \"0.15 MPa\", exponent = 3 }, thickness = \"25 mm\", area = \"80 cm^2\" }
[effects]
gravity = true
separation.liner = { at = \"head\" }
[run]
duration = \"30 ms\"
";
    let path = file(&folder, "helmet.toml", helmet);
    let told = json(&["groups", text(&path), "--lab", "mass=1 kg", "--json"]);
    let pairs = told["laboratory"]["measures"].as_array().unwrap();
    let energy = pairs.iter().find(|pair| pair["measure"] == "liner.energy").unwrap();
    assert_eq!(energy["values"], serde_json::json!([0.0, 0.0]));
    let groups = told["groups"].as_array().unwrap();
    let names: std::collections::BTreeSet<_> =
        groups.iter().map(|group| group["parameter"].as_str().unwrap()).collect();
    assert_eq!(names.len(), groups.len());
}

/// A group of the thesis in an answer.
fn of_thesis(told: &Value, name: &str) -> f64 {
    let all = told["thesis"]["groups"].as_array().unwrap();
    all.iter().find(|own| own["parameter"] == name).unwrap()["value"].as_f64().unwrap()
}

fn peak_of_padding(path: &str) -> f64 {
    let told = json(&["run", path, "--method", "exact", "--json"]);
    told["runs"][0]["measures"]["padding.peak-force"]["value"].as_f64().unwrap()
}

#[test]
fn gravity_and_mass_of_the_face_are_those_of_the_equations() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("heavy.toml");
    let output = run(&["groups", "--from", "A=0.1, B=0.5", "--out", text(&path)]);
    assert_eq!(code(&output), 0, "{}", err(&output));
    // Runge–Kutta of 2.20 to 2.22 with these groups.
    assert!((peak_of_padding(text(&path)) / 45_606.5 - 1.0).abs() < 2e-6);
    let again = json(&["groups", text(&path), "--json"]);
    assert!((of_thesis(&again, "A") - 0.1).abs() < 1e-14);
    assert!((of_thesis(&again, "B") - 0.5).abs() < 1e-14);
    let shown = out(&run(&["groups"]));
    assert!(shown.contains("make 9 independent groups"), "{shown}");
}

#[test]
fn groups_that_are_as_they_were_leave_the_scene_as_it_was() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("same.toml");
    let padding = scene_path("padding-mass");
    let own = text(&padding);
    let output = run(&["groups", own, "--from", "c=8", "--out", text(&path)]);
    assert_eq!(code(&output), 0, "{}", err(&output));
    let written = fs::read_to_string(&path).unwrap();
    assert!(written.contains("touch = \"impact\""), "{written}");
    assert!((peak_of_padding(text(&path)) / peak_of_padding(own) - 1.0).abs() < 1e-12);
}

#[test]
fn groups_that_no_scene_has_are_refused_with_their_ranges() {
    for (groups, said) in [
        ("B=2", "group B is 2, and must be above 0 and up to 1"),
        ("B=0", "group B is 0"),
        ("gamma=0", "group gamma is 0, and must be finite and positive"),
        ("alpha=-1", "group alpha is -1, and must be finite, zero or positive"),
        ("c=40", "3.3509 < c < 28.649"),
    ] {
        let output = run(&["groups", "--from", groups]);
        assert_eq!(code(&output), 2, "{groups}");
        let shown = err(&output).replace('\n', " ");
        assert!(shown.contains(said), "{groups}: {shown}");
    }
}

#[test]
fn what_is_apart_is_so_by_the_numbers_beside_it() {
    let wishes = "mass=1 kg, speed=2 m/s";
    let told = json(&["groups", text(&scene_path("helmet-drop")), "--lab", wishes, "--json"]);
    let all = told["laboratory"]["with_own_gravity"].as_array().unwrap();
    assert!(all.len() > 5);
    for own in all {
        let [Some(one), Some(other)] = [0, 1].map(|at| own["values"][at].as_f64()) else {
            continue;
        };
        let larger = one.abs().max(other.abs());
        let apart = if larger > 0.0 { (one - other).abs() / larger } else { 0.0 };
        assert!((own["apart"].as_f64().unwrap() - apart).abs() < 1e-12, "{own}");
    }
}

#[test]
fn scenes_whose_effects_differ_are_compared_all_the_same() {
    let output = run(&["groups", "reference", text(&scene_path("reference-gravity"))]);
    assert_eq!(code(&output), 3, "{}", err(&output));
    let shown = out(&output);
    for part in ["gravity.value δ/V²", "0.00196133", "padding.contact-time", "0.77 %"] {
        assert!(shown.contains(part), "{part}:\n{shown}");
    }
    assert!(!shown.contains("factor of"), "{shown}");
    let output = run(&["groups", "reference", text(&scene_path("padding-mass"))]);
    assert_eq!(code(&output), 3, "{}", err(&output));
    let shown = out(&output);
    for part in ["`separation.padding` is in the second only", "face.padding.mass/m", "36.892 kN"] {
        assert!(shown.contains(part), "{part}:\n{shown}");
    }
    assert!(!shown.contains("Word(") && !shown.contains("factor of"), "{shown}");
}

#[test]
fn a_pulse_is_told_by_its_peak_and_duration() {
    let told = json(&["groups", text(&scene_path("shock-table")), "--json"]);
    // m, K, C, peak and duration: five parameters of rank three.
    assert_eq!((&told["parameters"], &told["rank"]), (&5.into(), &3.into()), "{told}");
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("lab.toml");
    let table = scene_path("shock-table");
    let own = text(&table);
    let wishes = "mass=1 kg, table.acceleration.duration=22 ms";
    let output = run(&["groups", own, "--lab", wishes, "--out", text(&path)]);
    assert_eq!(code(&output), 0, "{}", err(&output));
    let written = fs::read_to_string(&path).unwrap();
    assert!(written.contains("acceleration = { half-sine = {"), "{written}");
    assert!(written.contains("duration = \"22 ms\""), "{written}");
    let output = run(&["groups", own, text(&path), "--within", "1e-11"]);
    assert_eq!(code(&output), 0, "{}{}", out(&output), err(&output));
    // Nothing is thrown here.
    let output = run(&["groups", own, "--lab", "speed=2 m/s"]);
    assert_eq!(code(&output), 2, "{}", out(&output));
}

#[test]
fn points_of_a_curve_are_told_together() {
    let folder = TempDir::new().unwrap();
    let scene = "[nodes]\nhead = { mass = 4, velocity = 5 }\n[elements]\npad = { between = [\"head\", \"ground\"], \
                 table-spring = [[0, 0], [0.01, 100], [0.02, 400], [0.04, 2000]] }\n[run]\nduration = 0.1\n";
    let path = file(&folder, "scene.toml", scene);
    let shown = out(&run(&["groups", text(&path)]));
    // Of four points one is zero, and one coordinate is a reference.
    let rows: Vec<&str> = shown.lines().filter(|line| line.contains("table-spring.")).collect();
    assert_eq!(rows.len(), 2, "{shown}");
    assert!(rows.iter().all(|row| row.contains(" points")), "{shown}");
    // Programs have each.
    let told = json(&["groups", text(&path), "--json"]);
    let groups = told["groups"].as_array().unwrap().iter();
    let points = groups.filter(|own| own["parameter"].as_str().unwrap().contains("table-spring["));
    assert!(points.count() >= 7, "{told}");
}

#[test]
fn sizes_that_act_in_products_alone_make_no_groups() {
    let names = |scene: &str| {
        let told = json(&["groups", text(&scene_path(scene)), "--json"]);
        let groups = told["groups"].as_array().unwrap().iter();
        groups.map(|group| group["parameter"].as_str().unwrap().to_owned()).collect::<Vec<String>>()
    };
    let foam = names("eps-helmet");
    assert!(foam.contains(&"liner.eps.modulus*area".to_owned()), "{foam:?}");
    assert!(!foam.iter().any(|own| own.contains(".area") || own.contains(".thickness")));
    let bar = names("polymer-bar");
    assert!(bar.contains(&"bar.nylon-1.mass".to_owned()), "{bar:?}");
    assert!(!bar.iter().any(|own| own.contains(".area") || own.contains(".density")), "{bar:?}");
    // Half the area of twice the density and modulus is the same bar; half the area alone is not.
    let folder = TempDir::new().unwrap();
    let own = fs::read_to_string(scene_path("polymer-bar")).unwrap();
    let thin = own.replace("3 cm^2", "1.5 cm^2");
    let same = thin.replace("3 GPa", "6 GPa").replace("1150 kg/m^3", "2300 kg/m^3");
    for (content, expected) in [(same, 0), (thin, 3)] {
        let path = file(&folder, "other.toml", &content);
        let output = run(&["groups", text(&scene_path("polymer-bar")), text(&path)]);
        assert_eq!(code(&output), expected, "{}{}", out(&output), err(&output));
    }
}
