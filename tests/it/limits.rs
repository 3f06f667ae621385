//! Limits: scenes whose exact value is known, judged, shown and enforced.

use std::fs;

use dashpot::scene::{ReadOptions, read, write_scene};
use serde_json::Value;
use tempfile::TempDir;

use crate::cli::{code, err, file, json, out, run, said};

/// 4 kg at 5 m/s on 25 kN/m: the peak force is V √(K m) = 1581.138830084190 N.
const PEAK: f64 = 1_581.138_830_084_19;

fn scene(limits: &str) -> String {
    format!(
        "[nodes]\nhead = {{ mass = \"4 kg\", velocity = \"5 m/s\" }}\n[elements]\n\
         pad = {{ between = [\"head\", \"ground\"], spring = \"25 kN/m\" }}\n\
         [limits]\n{limits}\n[run]\nduration = \"100 ms\"\n"
    )
}

fn written(limits: &str) -> (TempDir, String) {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "scene.toml", &scene(limits)).to_str().unwrap().to_owned();
    (folder, path)
}

fn of_force(max: f64, more: &[&str]) -> Value {
    let (_folder, path) = written(&format!("pad.peak-force = \"{max} N\""));
    json(&[&["run", &path, "--json"], more].concat())["runs"][0]["limits"][0].clone()
}

#[test]
fn a_limit_is_kept_or_exceeded_by_the_margin_of_the_closed_form() {
    let close = |own: &Value, right: f64| (own.as_f64().unwrap() - right).abs() < 1e-9;
    for (max, verdict) in [(1600.0, "pass"), (1581.2, "pass"), (1581.1, "fail"), (1000.0, "fail")] {
        let found = of_force(max, &[]);
        assert_eq!(found["verdict"], verdict, "{found}");
        assert!(close(&found["margin"], (max - PEAK) / max), "{found}");
        assert_eq!((&found["key"], &found["max"]), (&"pad.peak-force".into(), &max.into()));
    }
}

#[test]
fn limits_are_told_in_the_unit_in_which_they_are_written() {
    let (_folder, path) =
        written("pad.peak-force = \"1600 N\"\nhead.peak-acceleration = \"400 m/s^2\"");
    let output = run(&["run", &path, "--limit", "pad.peak-deformation<=0.08 m"]);
    let text = out(&output).split_whitespace().collect::<Vec<_>>().join(" ");
    // V √(K/m) and V √(m/K).
    for told in
        ["1581 N, at most 1600 N", "395.3 m/s^2, at most 400 m/s^2", "0.06325 m, at most 0.08 m"]
    {
        assert!(text.contains(told), "no {told:?} in {text}");
    }
}

#[test]
fn limits_that_exclude_each_other_are_refused() {
    let refused = |limits: &str, more: &[&str], told: &str| {
        let (_folder, path) = written(limits);
        let output = run(&[&["run", &path], more].concat());
        assert_eq!(code(&output), 2, "{}", out(&output));
        let said = err(&output).split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(said.contains(told), "no {told:?} in {said}");
    };
    let own = "pad.peak-force = { max = \"1 kN\", min = \"2 kN\" }";
    refused(own, &[], "at most 1000 N = 1 kN and at least 2000 N = 2 kN");
    refused("pad.peak-force = [{ min = \"2 kN\" }, \"1 kN\"]", &[], "no value keeps the limits");
    let own = "pad.peak-force = \"2 kN\"";
    refused(own, &["--limit", "pad.peak-force>=2.5 kN"], "at most 2 kN and at least 2.5 kN");
    let (_folder, path) = written("pad.peak-force = { max = \"2 kN\", min = \"2 kN\" }");
    assert_eq!(code(&run(&["check", &path])), 0);
}

#[test]
fn what_follows_the_impact_and_exceeds_a_limit_leaves_it_undecided() {
    // The second body meets a wall of stiffness k after the impact: V √(k m) is 144.2 g there, 24.98 g before. A half-sine of
    // a and T has a HIC of 0.4146 a^2.5 T and a severity index of 0.4577 a^2.5 T: 16.6 and 460, 18 and 526 of both.
    let scene = |key: &str, limit: &str| {
        format!(
            "[nodes]\na = {{ mass = \"1 kg\", velocity = \"2 m/s\" }}\nb = {{ mass = \"1 kg\" }}\n[elements]\n\
             pad = {{ between = [\"a\", \"b\"], spring = \"30 kN/m\" }}\n\
             wall = {{ between = [\"b\", \"ground\"], series = [{{ contact = {{ gap = \"300 mm\" }} }}, {{ spring \
             = \"500 kN/m\" }}] }}\n[effects]\nseparation.pad = {{}}\n[limits]\nb.{key} = \
             {limit}\n[run]\nduration = \"200 ms\"\n"
        )
    };
    let folder = TempDir::new().unwrap();
    for (key, limit, verdict, reason) in [
        ("peak-acceleration", "\"20 g\"", "fail", Value::Null),
        ("peak-acceleration", "\"60 g\"", "undecided", "harder-outside".into()),
        ("peak-acceleration", "\"150 g\"", "pass", Value::Null),
        ("hic15", "16", "fail", Value::Null),
        ("hic15", "450", "undecided", "harder-outside".into()),
        ("hic15", "470", "pass", Value::Null),
        ("severity-index", "515", "undecided", "harder-outside".into()),
        ("severity-index", "540", "pass", Value::Null),
        ("clip-3ms", "\"30 g\"", "undecided", "harder-outside".into()),
    ] {
        let path = file(&folder, "scene.toml", &scene(key, limit)).to_str().unwrap().to_owned();
        let found = json(&["run", &path, "--json"])["runs"][0]["limits"][0].clone();
        assert_eq!((&found["verdict"], &found["reason"]), (&verdict.into(), &reason), "{found}");
        let output = run(&["run", &path, "--enforce"]);
        assert_eq!(code(&output), if verdict == "pass" { 0 } else { 4 }, "{}", out(&output));
    }
}

#[test]
fn what_pulls_harder_than_it_pushes_is_told_to_let_go() {
    // V √(k m) is 2 kN in compression and 4 kN in tension.
    let scene = "[nodes]\nhead = { mass = \"4 kg\", velocity = \"5 m/s\" }\n[elements]\n\
         pad = { between = [\"head\", \"ground\"], piecewise-spring = [[\"-1 m\", \"-160 kN\"], [0, 0], \
         [\"1 m\", \"40 kN\"]] }\n[limits]\npad.peak-force = \"3 kN\"\n[run]\nduration = \"80 ms\"\n";
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "scene.toml", scene).to_str().unwrap().to_owned();
    for more in [&[][..], &["--variant", "head.mass=5 kg"]] {
        let told = out(&run(&[&["run", &path], more].concat()));
        let told = told.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(told.contains("lets go with `separation.pad = {}` under [effects]"), "{told}");
    }
    let parted = scene.replace("[limits]", "[effects]\nseparation.pad = {}\n[limits]");
    let path = file(&folder, "parted.toml", &parted).to_str().unwrap().to_owned();
    assert_eq!(json(&["run", &path, "--json"])["runs"][0]["limits"][0]["verdict"], "pass");
}

#[test]
fn a_limit_within_the_error_is_undecided_until_more_accuracy_decides_it() {
    let coarse = ["--method", "bdf", "--accuracy", "2%"];
    let first = of_force(PEAK, &coarse);
    let error = first["error"].as_f64().unwrap();
    assert!(error > 1e-6 * PEAK, "{first}");
    // Two bounds that lie within the bar of the coarse run, on both sides of the value.
    for (max, verdict) in [(PEAK + 0.3 * error, "pass"), (PEAK - 0.3 * error, "fail")] {
        let found = of_force(max, &coarse);
        assert_eq!(found["verdict"], "undecided", "{found}");
        let finer = of_force(max, &["--method", "bdf", "--accuracy", "1e-8"]);
        assert_eq!(finer["verdict"], verdict, "{finer}");
        let (_folder, path) = written(&format!("pad.peak-force = \"{max} N\""));
        let output = run(&[&["run", &path, "--enforce"], &coarse[..]].concat());
        assert_eq!(code(&output), 4, "{}", err(&output));
        let text = out(&output).split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(text.contains("UNDECIDED pad.peak-force"), "{text}");
        assert!(text.contains("may decide"), "{text}");
    }
}

#[test]
fn enforcing_exits_with_4_unless_every_limit_is_kept() {
    let (_folder, path) = written("pad.peak-force = { max = \"1.6 kN\", min = \"1.5 kN\" }");
    assert_eq!(code(&run(&["run", &path, "--enforce"])), 0);
    let exceeded = ["run", &path, "--limit", "pad.peak-deformation<=1 cm"];
    assert_eq!(code(&run(&exceeded)), 0);
    assert_eq!(code(&run(&[&exceeded[..], &["--enforce"]].concat())), 4);
    let (_folder, path) = written("");
    let output = run(&["run", &path, "--enforce"]);
    assert_eq!(code(&output), 2);
    assert!(err(&output).contains("`--enforce` has no limit to enforce"), "{}", err(&output));
}

#[test]
fn a_run_that_ends_before_the_peak_passes_nothing() {
    let text = scene("pad.peak-force = \"2 kN\"").replace("100 ms", "15 ms");
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "scene.toml", &text);
    let path = path.to_str().unwrap();
    let shown = out(&run(&["run", path])).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(shown.contains("UNDECIDED pad.peak-force"), "{shown}");
    assert!(shown.contains("make `duration` longer"), "{shown}");
    let sure = json(&["run", path, "--limit", "pad.peak-force<=1 kN", "--json"]);
    assert_eq!(sure["runs"][0]["limits"][1]["verdict"], "fail");
}

/// A measured law of 100 kN/m up to 5 mm under 5 kg: it is pressed to V √(m/K), with V √(K m).
fn measured(speed: &str, limits: &str) -> (TempDir, String) {
    let text = format!(
        "[nodes]\nhead = {{ mass = \"5 kg\", velocity = \"{speed}\" }}\n[elements]\npad = {{ between = \
         [\"head\", \"ground\"], table-spring = [[0, 0], [\"2 mm\", \"200 N\"], [\"5 mm\", \"500 N\"]] }}\n\
         [limits]\n{limits}\n[run]\nduration = \"50 ms\"\n"
    );
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "scene.toml", &text).to_str().unwrap().to_owned();
    (folder, path)
}

#[test]
fn what_is_kept_beyond_the_points_of_a_law_is_undecided() {
    // 3.5 mm and 354 N; 14 mm and 1414 N.
    let limits = "pad.peak-force = [\"2 kN\", \"300 N\"]";
    for (speed, verdicts, status) in [
        ("0.5 m/s", [("pass", Value::Null), ("fail", Value::Null)], 0),
        ("2 m/s", [("undecided", "beyond-known".into()), ("fail", Value::Null)], 4),
    ] {
        let (_folder, path) = measured(speed, limits);
        let found = json(&["run", &path, "--json"])["runs"][0]["limits"].clone();
        for (at, (verdict, reason)) in verdicts.into_iter().enumerate() {
            assert_eq!((&found[at]["verdict"], &found[at]["reason"]), (&verdict.into(), &reason));
        }
        let (_folder, path) = measured(speed, "pad.peak-force = \"2 kN\"");
        let output = run(&["run", &path, "--enforce"]);
        assert_eq!(code(&output), status, "{}", err(&output));
    }
    let (_folder, path) = measured("2 m/s", limits);
    let told = "would pass, but hangs on pad.table-spring beyond the points of its law";
    let words = |arguments: &[&str]| {
        let output = run(arguments);
        let shown = out(&output) + &err(&output);
        shown.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let shown = words(&["run", &path]);
    assert!(shown.contains("UNDECIDED pad.peak-force 1.414 kN, at most 2 kN"), "{shown}");
    assert!(shown.contains(told), "{shown}");
    let shown = words(&["run", &path, "--variant", "head.velocity=0.5 m/s"]);
    assert!(shown.contains(told) && shown.contains("pass, 0.3536 kN"), "{shown}");
    // The last point is reached at 0.707 m/s.
    let sweep = ["sweep", &path, "--vary", "head.velocity=0.5,0.7,0.8,2 m/s"];
    let shown = words(&sweep);
    let told = "max 2 kN: 2 of 4 points pass, from 0.5 m/s to 0.7 m/s, 0 fail, 2 undecided (2 would pass, but";
    assert!(shown.contains(told), "{shown}");
    let found = json(&[&sweep[..], &["--json"]].concat());
    let verdicts: Vec<Value> = ["pass", "pass", "undecided", "undecided"].map(Value::from).into();
    assert_eq!(found["limits"][0]["verdicts"], Value::from(verdicts));
    assert_eq!(found["limits"][0]["reasons"][3], "beyond-known");
}

#[test]
fn designs_of_a_sample_beyond_the_points_of_a_law_keep_nothing() {
    let (_folder, path) =
        measured("0.6 ± 0.1 m/s", "pad.peak-force = { max = \"2 kN\", mean = true }");
    let found = json(&["run", &path, "--sample", "200", "--json"])["runs"][0].clone();
    let chance = &found["scatter"]["limits"][0];
    // Beyond 0.7071 m/s, which is 1.071 standard deviations above the mean: 14.2 % of the designs. A Latin
    // hypercube has one in each of 200 parts.
    let beyond = chance["beyond_known"].as_u64().unwrap();
    assert!((27..=30).contains(&beyond), "{chance}");
    assert_eq!(chance["kept"].as_u64().unwrap() + beyond, 200, "{chance}");
    let own = &found["limits"][0];
    assert_eq!((&own["verdict"], &own["reason"]), (&"undecided".into(), &"beyond-known".into()));
}

#[test]
fn limits_are_written_with_their_units() {
    let text = scene(
        "head.peak-acceleration = { max = \"250 g\", from = \"EN 1078:2012\" }\nhead.hic15 = 700\n\
         pad.peak-force = [{ max = \"1.3 kN\", mean = true }, { min = 0 }]\npad.contact-time = { min = \"5 ms\" }",
    );
    let read = |text: &str| read(text, &ReadOptions::default()).unwrap();
    let own = read(&text);
    assert!(own.warnings.is_empty(), "{}", own.warnings);
    let own = own.value;
    let settings = own.settings("auto").unwrap();
    let written = write_scene("again", &[], &own.network, &own.run, &settings).unwrap();
    let again = read(&written);
    assert!(again.warnings.is_empty(), "{written}\n{}", again.warnings);
    assert_eq!(again.value.limits.len(), own.limits.len(), "{written}");
    for limit in &own.limits {
        assert!(again.value.limits.contains(limit), "{limit:?}\n{written}");
    }
    assert!(written.contains("max = 700.0") && written.contains("m/s^2"), "{written}");
}

#[test]
fn the_verdict_leads_with_the_limits_and_where_they_are_from() {
    let (folder, path) = written(
        "head.peak-acceleration = \"en-1078\"\n\
         pad.peak-force = [{ max = \"1.5 kN\", from = \"our own\" }, { max = \"2 kN\", mean = true }]",
    );
    let results = folder.path().join("results");
    let output = run(&["run", &path, "--out", results.to_str().unwrap()]);
    assert_eq!(code(&output), 0, "{}", err(&output));
    let text = out(&output).split_whitespace().collect::<Vec<_>>().join(" ");
    let told = "PASS head.peak-acceleration 40.31 g, at most 250 g (EN 1078:2012); margin 84 % \
                FAIL pad.peak-force 1.581 kN, at most 1.5 kN (our own); margin −5.4 % \
                PASS pad.peak-force 1.581 kN, at most 2 kN; margin 21 %; one run stands for the mean \
                of the tests peak force";
    assert!(text.contains(told), "{text}");
    let figure = |name: &str| fs::read_to_string(results.join(name)).unwrap();
    assert!(figure("force-time.svg").contains("max 1.5 kN (our own)"));
    assert!(figure("acceleration-time.svg").contains("max 250 g (EN 1078:2012)"));
    assert!(!figure("velocity-time.svg").contains("max "));
    assert!(figure("report.html").contains("FAIL"));
}

#[test]
fn sweeps_have_columns_and_contours_for_limits() {
    let (folder, path) = written("pad.peak-force = \"2 kN\"");
    let sweep = |more: &[&str]| {
        let stiffness = "pad.spring=10..60 kN/m,6";
        run(&[&["sweep", &path, "--vary", stiffness], more].concat())
    };
    let output = sweep(&["--measure", "pad.contact-time"]);
    let text = out(&output);
    let rows: Vec<Vec<&str>> = text.lines().map(|row| row.split(',').collect()).collect();
    let at = rows[0].iter().position(|own| *own == "pad.peak-force <= 2e3 N").expect(&text);
    let verdicts: Vec<&str> = rows[1..].iter().map(|row| row[at]).collect();
    // V √(K m) is 2 kN at 40 kN/m, which rounding leaves open.
    let right = ["pass", "pass", "pass", "undecided", "fail", "fail"];
    assert_eq!((&verdicts[..3], &verdicts[4..]), (&right[..3], &right[4..]));
    let told =
        "pad.peak-force max 2 kN: 3 of 6 points pass, from 10 kN/m to 30 kN/m, 2 fail, 1 undecided";
    let notes = err(&output).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(verdicts[3] != "undecided" || notes.contains(told), "{notes}");
    let found: Value = serde_json::from_str(&out(&sweep(&["--json"]))).unwrap();
    assert_eq!(found["limits"][0]["verdicts"][0], "pass");
    let margin = found["limits"][0]["margins"][5].as_f64().unwrap();
    assert!((margin - (1.0 - 5.0 * (60e3_f64 * 4.0).sqrt() / 2e3)).abs() < 1e-9, "{margin}");
    let results = folder.path().join("results");
    let more = ["--vary", "head.velocity=3..7 m/s,5", "--out", results.to_str().unwrap()];
    assert_eq!(code(&sweep(&more)), 0);
    let map = fs::read_to_string(results.join("pad.peak-force-map.svg")).unwrap();
    assert!(map.contains("max 2 kN"));
}

#[test]
fn what_is_wrong_with_a_limit_is_told_with_its_place() {
    let faults = [
        ("head.peak-acceleration = \"250 mm\"", "`250 mm` is a length (m); an acceleration"),
        ("head.peak-acceleration = \"en-1077\"", "did you mean `en-1078`?"),
        ("head.hic15 = \"en-1078\"", "but this is one on `peak-acceleration`"),
        ("head.peak-g = \"250 g\"", "`peak-g` is not a measure of a node"),
        ("haed.hic15 = 700", "did you mean `head`?"),
        ("head = \"250 g\"", "name a measure, as in `head.peak-acceleration = \"250 g\"`"),
        ("head.hic15 = {}", "has no `max` or `min`"),
        ("head.hic15 = { max = 700, from = 208 }", "`from`"),
        ("head.hic15 = { max = 700, standard = \"fmvss-208-hic15\" }", "exclude each other"),
        ("head.hic15 = { most = 700, max = 1 }", "unknown key `most`"),
    ];
    for (limit, told) in faults {
        let (_folder, path) = written(limit);
        let output = run(&["check", &path]);
        let shown = err(&output) + &out(&output);
        assert_eq!(code(&output), 2, "{limit}: {shown}");
        let words = shown.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains(told) && words.contains("scene.toml:6"), "{limit}: {shown}");
    }
    let (_folder, path) = written("");
    for (limit, told) in [
        ("pad.peak-force", "write a measure, `<=` or `>=`"),
        ("pad.peak-force < 1 kN", "write `pad.peak-force<=1 kN`"),
        ("pad.peak-force>1 kN", "write `pad.peak-force>=1 kN`"),
        ("pad.peak-froce<=1 kN", "`pad.peak-froce` is no measure"),
        ("pod.peak-force<=1 kN", "pod"),
        ("pad.peak-force<=1 m", "`1 m` is a length (m); a force (N) is expected"),
        ("pad.peak-force=en-1621", "is no standard"),
    ] {
        let output = run(&["run", &path, "--limit", limit]);
        assert_eq!(code(&output), 2, "{limit}");
        let shown = said(&output);
        assert!(shown.contains(told), "{limit}: {shown}");
    }
}

#[test]
fn a_limit_of_the_command_line_has_a_unit_but_for_indices() {
    let (_folder, path) = written("head.severity-index = 1000");
    let bare = run(&["run", &path, "--limit", "head.peak-acceleration<=250"]);
    assert_eq!(code(&bare), 2);
    assert!(err(&bare).contains("write \"250 g\" or \"250 m/s^2\""), "{}", err(&bare));
    let index = run(&["run", &path, "--limit", "head.hic15<=700"]);
    assert_eq!(code(&index), 0, "{}", err(&index));
}

#[test]
fn a_limit_of_the_command_line_tells_of_a_constant_area_as_one_of_the_scene_does() {
    let pad = |limits: &str| {
        format!(
            "[materials]\nfoam = {{ table-spring = [[0, 0], [0.9, 1e5]] }}\n[nodes]\n\
             head = {{ mass = \"5 kg\", velocity = \"4.47 m/s\" }}\n[elements.pad]\n\
             between = [\"head\", \"ground\"]\nmaterial = \"foam\"\nthickness = \"20 mm\"\n\
             area = \"12 cm^2\"\n[limits]\n{limits}\n[run]\nduration = \"20 ms\"\n"
        )
    };
    let folder = TempDir::new().unwrap();
    let path =
        |name: &str, limits: &str| file(&folder, name, &pad(limits)).to_str().unwrap().to_owned();
    let (bare, limited) =
        (path("bare.toml", ""), path("limited.toml", "pad.peak-force = \"en-1621-1-level-1\""));
    let by_flag = ["--limit", "pad.peak-force=en-1621-1-level-1"];
    let notes = |verb: &str, path: &str, more: &[&str]| {
        let told = said(&run(&[&[verb, path], more].concat()));
        told.matches("EN 1621-1:2012, level 1 lays it on a dome with the radius 50 mm").count()
    };
    assert_eq!(notes("run", &bare, &[]), 0);
    assert_eq!(notes("run", &limited, &[]), 1);
    assert_eq!(notes("run", &bare, &by_flag), 1);
    assert_eq!(notes("run", &limited, &by_flag), 1);
}

#[test]
fn a_sweep_tells_where_a_limit_is_crossed_and_which_number_moves_nothing() {
    let folder = TempDir::new().unwrap();
    let thick = "spring = \"25 kN/m\", thickness = \"8 cm\"";
    let text = scene("pad.peak-force = \"2 kN\"").replace("spring = \"25 kN/m\"", thick);
    let path = file(&folder, "thick.toml", &text).to_str().unwrap().to_owned();
    let told = |vary: &[&str]| {
        let output = run(&[&["sweep", &path, "--table", "always"][..], vary].concat());
        (out(&output) + &err(&output)).split_whitespace().collect::<Vec<_>>().join(" ")
    };
    // V √(K m) = 5 √(4 K) is 2 kN at 40 kN/m; a straight line from 39 to 42 kN/m meets it at
    // 39 + 3 (2000 − 1974.84)/(2049.39 − 1974.84) kN/m.
    let text = told(&["--vary", "pad.spring=30..42 kN/m,5"]);
    assert!(text.contains("from 30 kN/m to 39 kN/m (crossed near 40.01 kN/m)"), "{text}");
    let text = told(&["--vary", "pad.thickness=4..8 cm,3"]);
    let why = "`pad.thickness` moves none of these numbers: a law in N, N/m and N s/m is the same";
    assert!(text.contains(why), "{text}");
    let both = told(&["--vary", "pad.spring=30..42 kN/m,3", "--vary", "pad.thickness=7..8 cm,2"]);
    assert!(both.contains(why) && !both.contains("`pad.spring` moves"), "{both}");
}

#[test]
fn a_sweep_is_enforced_at_every_point() {
    let (_folder, path) = written("pad.peak-force = \"2 kN\"");
    // 5 √(4 K) is 2 kN at 40 kN/m.
    let done = |vary: &str, more: &[&str]| {
        code(&run(&[&["sweep", &path, "--vary", vary][..], more].concat()))
    };
    assert_eq!(done("pad.spring=30..39 kN/m,3", &["--enforce"]), 0);
    assert_eq!(done("pad.spring=30..42 kN/m,3", &["--enforce"]), 4);
    assert_eq!(done("pad.spring=30..42 kN/m,3", &[]), 0);
    let (_folder, bare) = written("");
    let output = run(&["sweep", &bare, "--vary", "pad.spring=30..39 kN/m,3", "--enforce"]);
    assert!(
        code(&output) == 2 && said(&output).contains("no limit to enforce"),
        "{}",
        err(&output)
    );
}
