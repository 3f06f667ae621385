//! Designs side by side: several scenes, and a scene with other values.

use std::fs;

use serde_json::Value;
use tempfile::TempDir;

use crate::cli::{code, err, file, json, out, run};

/// A mass of 4 kg at 5 m/s on a spring of `stiffness`: the peak force is 5 √(4 K).
fn scene(title: &str, stiffness: &str) -> String {
    format!(
        "title = \"{title}\"\n[values]\nK = \"{stiffness}\"\n[nodes]\n\
         head = {{ mass = \"4 kg\", energy = \"50 J\" }}\n[elements]\n\
         pad = {{ between = [\"head\", \"ground\"], spring = \"K\", thickness = \"8 cm\" }}\n\
         [limits]\npad.peak-force = \"2 kN\"\n[run]\nduration = \"100 ms\"\n"
    )
}

fn written() -> (TempDir, [String; 2]) {
    let folder = TempDir::new().unwrap();
    let paths = [("soft", "25 kN/m"), ("stiff", "64 kN/m")].map(|(name, stiffness)| {
        let path = file(&folder, &format!("{name}.toml"), &scene(name, stiffness));
        path.to_str().unwrap().to_owned()
    });
    (folder, paths)
}

fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn scenes_stand_side_by_side_each_with_its_verdict() {
    let (folder, [soft, stiff]) = written();
    let results = folder.path().join("results");
    let output = run(&["run", &soft, &stiff, "--out", results.to_str().unwrap()]);
    assert_eq!(code(&output), 0, "{}", err(&output));
    let text = words(&out(&output));
    // 5 √(4 · 25 000) and 5 √(4 · 64 000) newtons.
    for told in [
        "2 designs side by side PASS soft keeps all its limits FAIL stiff keeps 0 of 1 limits; the worst is \
         pad.peak-force",
        "soft: pass, 1.581 kN, margin 21 %",
        "stiff: FAIL, 2.530 kN, margin −26 %",
        "measure soft stiff unit pad.peak-force 1.581139 2.529822 kN",
    ] {
        assert!(text.contains(told), "no {told:?} in {text}");
    }
    let page = fs::read_to_string(results.join("report.html")).unwrap();
    assert!(page.contains("2 designs side by side") && page.contains("FAIL: stiff keeps"));
    let figure = fs::read_to_string(results.join("acceleration-time.svg")).unwrap();
    assert!(figure.contains("soft") && figure.contains("stiff"));
    let rows = |name: &str| fs::read_to_string(results.join(name)).unwrap().lines().count();
    assert_eq!((rows("1-soft.csv"), rows("2-stiff.csv")), (502, 502));
    let events = fs::read_to_string(results.join("events.csv")).unwrap();
    assert!(events.starts_with("design,time [s],error [s],event,what\n"), "{events}");
}

#[test]
fn variants_are_designs_besides_the_scene_as_it_is() {
    let (_folder, [soft, stiff]) = written();
    let told = |more: &[&str]| words(&out(&run(&[&["run"], more].concat())));
    let of_one = told(&[&soft, "--variant", "K=36 kN/m", "--variant", "K=49 kN/m"]);
    let row =
        "measure, by K 25 kN/m 36 kN/m 49 kN/m unit pad.peak-force 1.581139 1.897367 2.213594 kN";
    assert!(of_one.contains(row), "{of_one}");
    let of_two = json(&["run", &soft, &stiff, "--variant", "K=36 kN/m", "--json"]);
    let runs = of_two["runs"].as_array().unwrap();
    let names: Vec<&Value> = runs.iter().map(|run| &run["scene"]["name"]).collect();
    assert_eq!(names, ["soft", "soft, K=36 kN/m", "stiff", "stiff, K=36 kN/m"]);
    let peaks = runs.iter().map(|run| run["measures"]["pad.peak-force"]["value"].as_f64().unwrap());
    let peaks: Vec<f64> = peaks.collect();
    assert!((peaks[1] - peaks[3]).abs() < 1e-9 * peaks[1], "{peaks:?}");
    // Alone, a design says what a run of it says.
    let alone = json(&["run", &stiff, "--json"]);
    for key in ["measures", "limits", "energy"] {
        assert_eq!(runs[2][key], alone["runs"][0][key]);
    }
}

#[test]
fn a_variant_has_the_name_that_it_is_given() {
    let (_folder, [soft, _]) = written();
    let variants = ["--variant", "thin: pad.thickness=6 cm, K=36 kN/m", "--variant", "K=49 kN/m"];
    let all = json(&[&["run", &soft, "--json"][..], &variants].concat());
    let runs = all["runs"].as_array().unwrap();
    let names: Vec<&Value> = runs.iter().map(|run| &run["scene"]["name"]).collect();
    assert_eq!(names, ["soft", "thin", "K=49 kN/m"]);
    // 5 √(4 K).
    let peak = runs[1]["measures"]["pad.peak-force"]["value"].as_f64().unwrap();
    assert!((peak - 5.0 * 144e3_f64.sqrt()).abs() < 1e-9 * peak, "{peak}");
    let output = run(&["run", &soft, "--variant", ": K=36 kN/m"]);
    assert!(code(&output) == 2 && err(&output).contains("no name before the colon"));
}

#[test]
fn a_remark_names_the_designs_that_it_is_of() {
    let (folder, [soft, _]) = written();
    let slow = scene("slow", "25 kN/m").replace("energy = \"50 J\"", "energy = \"8 J\"");
    let slow = file(&folder, "slow.toml", &slow).to_str().unwrap().to_owned();
    // 4 kg g over 8 cm is 3.138 J.
    let told =
        "gravity is off: if it moves downwards, its weight does work of 3.14 J over the thickness";
    let of_both = words(&err(&run(&["run", &soft, &slow])));
    assert!(of_both.contains(&format!("soft: node `head`: {told}, 6.3 % of the")), "{of_both}");
    assert!(of_both.contains(&format!("slow: node `head`: {told}, 39.2 % of the")), "{of_both}");
    let alone = words(&err(&run(&["run", &slow])));
    assert!(alone.contains(&format!("note: node `head`: {told}")), "{alone}");
    let heavy = ["--set", "head.energy=200 J"];
    assert!(!err(&run(&[&["run", &slow][..], &heavy].concat())).contains("gravity is off"));
}

#[test]
fn designs_that_differ_in_a_number_and_more_have_its_order_in_colours_and_the_rest_in_patterns() {
    let (folder, [soft, _]) = written();
    let results = folder.path().join("results");
    let variants = ["K=64 kN/m", "K=64 ± 1 kN/m, pad.thickness=9 cm", "K=36 kN/m"]
        .map(|own| ["--variant", own]);
    let out = ["--sample", "4", "--out", results.to_str().unwrap()];
    let output = run(&[&["run", &soft][..], &variants.concat(), &out].concat());
    assert_eq!(code(&output), 0, "{}", err(&output));
    let svg = fs::read_to_string(results.join("force-time.svg")).unwrap();
    let groups = svg.split("<g ").filter(|own| own.starts_with("class=\"series\""));
    let drawn: Vec<(&str, bool)> = groups
        .map(|own| {
            let stroke = own.split("stroke=\"").nth(1).unwrap().split('"').next().unwrap();
            (stroke, own.contains("stroke-dasharray"))
        })
        .collect();
    let [lowest, highest, also_highest, middle] = drawn[..] else { panic!("{drawn:?}") };
    assert_eq!([lowest.1, highest.1, also_highest.1, middle.1], [false, false, true, false]);
    assert_eq!(highest.0, also_highest.0);
    assert!(lowest.0 != highest.0 && middle.0 != highest.0 && middle.0 != lowest.0, "{drawn:?}");
}

#[test]
fn a_limit_of_one_design_that_is_not_kept_fails_all_where_it_is_enforced() {
    let (_folder, [soft, stiff]) = written();
    assert_eq!(code(&run(&["run", &soft, "--variant", "K=36 kN/m", "--enforce"])), 0);
    assert_eq!(code(&run(&["run", &soft, &stiff, "--enforce"])), 4);
}

#[test]
fn a_design_that_cannot_be_read_is_told_by_its_file() {
    let (_folder, [soft, _]) = written();
    let output = run(&["run", &soft, "nowhere.toml"]);
    assert_eq!(code(&output), 2);
    assert!(err(&output).contains("`nowhere.toml` cannot be read"), "{}", err(&output));
    let output = run(&["run", &soft, "--variant", "L=3"]);
    assert_eq!(code(&output), 2);
    assert!(err(&output).contains('L'), "{}", err(&output));
}

#[test]
fn every_scene_that_is_not_there_is_named() {
    let (_folder, [soft, _]) = written();
    let output = run(&["run", "nowhere.toml", &soft, "gone.toml"]);
    assert_eq!(code(&output), 2);
    for name in ["`nowhere.toml` cannot be read", "`gone.toml` cannot be read"] {
        assert!(err(&output).contains(name), "{}", err(&output));
    }
}

#[test]
fn a_limit_of_one_scene_alone_is_told_to_be_none_of_the_others() {
    let (folder, [soft, _]) = written();
    let bare = scene("bare", "36 kN/m").replace("[limits]\npad.peak-force = \"2 kN\"\n", "");
    let bare = file(&folder, "bare.toml", &bare).to_str().unwrap().to_owned();
    let text = words(&out(&run(&["run", &soft, &bare])));
    for told in
        ["PASS soft keeps all its limits – bare has no limits", "bare: – not a limit of this scene"]
    {
        assert!(text.contains(told), "no {told:?} in {text}");
    }
    // The same one of the command line is one of both, and told once.
    let text = words(&out(&run(&["run", &soft, &bare, "--limit", "pad.peak-force<=2000 N"])));
    assert!(text.contains("PASS soft keeps all its limits PASS bare keeps all"), "{text}");
    assert_eq!(text.matches("limit pad.peak-force at most").count(), 1, "{text}");
}

#[test]
fn measures_that_are_named_stand_alone_in_tables_and_json() {
    let (_folder, [soft, _]) = written();
    let all = ["run", &soft, "--measure", "head.hic15,pad.impulse"];
    let own = json(&[&all[..], &["--json"]].concat());
    let mut keys: Vec<&String> = own["runs"][0]["measures"].as_object().unwrap().keys().collect();
    keys.sort();
    assert_eq!(keys, ["head.hic15", "pad.impulse"]);
    let text = words(&out(&run(&all)));
    // 4 kg at 5 m/s turn round.
    assert!(text.contains("unit at pad.impulse 40.00000 "), "{text}");
    assert!(text.contains("peak force 1.581 kN") && !text.contains("pad.energy"), "{text}");
    let beside = words(&out(&run(&[&all[..], &["--variant", "K=36 kN/m"]].concat())));
    assert!(beside.contains("unit pad.impulse 40.00000 40.00000 N s head.hic15"), "{beside}");
    let output = run(&["run", &soft, "--measure", "pad.impulze"]);
    assert_eq!(code(&output), 2);
    assert!(words(&err(&output)).contains("did you mean `pad.impulse`?"), "{}", err(&output));
}

#[test]
fn a_warning_is_said_once_where_text_and_warnings_are_read_apart() {
    let (_folder, [soft, stiff]) = written();
    for scenes in [&[&*soft][..], &[&*soft, &*stiff]] {
        let output = run(&[&["run"], scenes].concat());
        let count = |text: &str| words(text).matches("is in tension").count();
        // Each stream has all of them: the report is kept without the other.
        assert_eq!([count(&out(&output)), count(&err(&output))], [scenes.len(); 2]);
        let data = run(&[&["run", "--json"], scenes].concat());
        assert_eq!(words(&err(&data)).matches("warning:").count(), scenes.len());
    }
}
