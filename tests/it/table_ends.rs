//! What tables are before their first and after their last point, and what is told of it.

use dashpot::{
    analysis::{RunReport, Solve, SolveSettings},
    scene::{Checked, Diagnostics, ReadOptions, Scene, read},
};
use tempfile::TempDir;

use crate::cli::{code, err, file, json, out, run, text};

const METHODS: [&str; 4] = ["exact", "bdf", "esdirk34", "tr-bdf2"];
const RECORD: &str = "time [ms], force [N]\n0, 0\n20, 1000\n";
const POINTS: &str = "[[\"0 ms\", 0], [\"20 ms\", \"1 kN\"]]";

fn read_beside(text: &str, csv: &str) -> Result<Checked<Scene>, Diagnostics> {
    let loader = |path: &str| match path {
        "pulse.csv" => Ok(csv.into()),
        other => Err(format!("no {other}")),
    };
    read(text, &ReadOptions { loader: Some(&loader), ..ReadOptions::default() })
}

/// A mass of 2 kg that nothing holds, pushed by a table for 0.1 s.
fn pushed(table: &str) -> String {
    format!(
        "[nodes]\nhead = {{ mass = 2 }}\n[elements]\n\
         guide = {{ between = [\"head\", \"ground\"], spring = 0 }}\n\
         [loads.push]\non = \"head\"\nforce = {{ table = {table} }}\n\
         [measures]\nhead = [{{ kind = \"end-velocity\", window = \"run\" }}]\n[run]\nduration = 0.1\n"
    )
}

/// A mass on a pad whose base has this motion.
fn moved(key: &str, table: &str) -> String {
    format!(
        "[nodes]\nhead = {{ mass = 2 }}\nbase = {{ {key} = {{ table = {table} }} }}\n[elements]\n\
         pad = {{ between = [\"head\", \"base\"], spring = \"2 kN/m\" }}\n[run]\nduration = 0.1\n"
    )
}

/// What `check` tells, and what each run does.
fn told(text: &str) -> String {
    let checked = read_beside(text, RECORD).unwrap();
    checked.warnings.render(false)
}

fn reports(text: &str) -> impl Iterator<Item = (&'static str, RunReport)> {
    let scene = read_beside(text, RECORD).unwrap().value;
    METHODS.into_iter().map(move |method| {
        let settings = scene.settings(method).unwrap();
        (method, scene.network.solve_with(&settings).unwrap())
    })
}

#[test]
fn a_table_that_ends_above_zero_holds_is_zero_or_is_refused() {
    // The impulse of the ramp is 10 N s, that of what is held 80 N s more.
    let outside = |own: &str| {
        [
            format!("{{ points = {POINTS}, outside = \"{own}\" }}"),
            format!("{{ file = \"pulse.csv\", outside = \"{own}\" }}"),
        ]
    };
    let held = [POINTS.to_owned(), "\"pulse.csv\"".to_owned()];
    for (tables, speed, warned) in
        [(held, 45.0, true), (outside("hold"), 45.0, false), (outside("zero"), 5.0, false)]
    {
        for table in tables {
            let text = pushed(&table);
            let shown = told(&text);
            let message = "the table of the load `push` ends at 20 ms with 1 kN, which is held to the \
                           end of the run at 100 ms";
            assert_eq!(shown.contains(message), warned, "{table}: {shown}");
            assert_eq!(shown.contains("outside = \"zero\""), warned, "{table}: {shown}");
            for (method, report) in reports(&text) {
                let found = report.measure("head.end-velocity").unwrap();
                let (value, error) = (found.value.unwrap(), found.error.unwrap());
                assert!((value - speed).abs() <= error + 1e-12, "{method}: {value} {error:e}");
                let is_told = report
                    .warnings
                    .iter()
                    .any(|warning| warning.to_string().contains("which is held to"));
                assert_eq!(is_told, warned, "{method}: {:?}", report.warnings);
            }
        }
    }
    for table in outside("error") {
        let refused = read_beside(&pushed(&table), RECORD).unwrap_err().render(false);
        for part in
            ["`push` is given from 0 s to 0.02 s", "the run lasts from 0 s to 0.1 s", "force ="]
        {
            assert!(refused.contains(part), "{part}: {refused}");
        }
        let within = pushed(&table).replace("duration = 0.1", "duration = \"20 ms\"");
        let scene = read_beside(&within, RECORD).unwrap().value;
        let longer = SolveSettings { duration: 0.021, ..scene.settings("auto").unwrap() };
        let error = scene.network.solve_with(&longer).unwrap_err().to_string();
        assert!(error.contains("the run lasts from 0 s to 0.021 s"), "{error}");
    }
}

#[test]
fn a_table_that_starts_late_is_told_where_it_starts_away_from_zero() {
    let late = |first: &str| pushed(&format!("[[\"10 ms\", {first}], [\"20 ms\", 0]]"));
    let shown = told(&late("500"));
    let message = "begins at 10 ms with 500 N, which is held from the start of the run";
    assert!(shown.contains(message), "{shown}");
    assert_eq!(told(&late("0")).matches("held").count(), 0);
    // What is held has pushed for 10 ms already.
    for (table, speed) in [
        ("[[\"10 ms\", 500], [\"20 ms\", 0]]", 3.75),
        ("{ points = [[\"10 ms\", 500], [\"20 ms\", 0]], outside = \"zero\" }", 1.25),
    ] {
        for (method, report) in reports(&pushed(table)) {
            let found = report.measure("head.end-velocity").unwrap();
            let (value, error) = (found.value.unwrap(), found.error.unwrap());
            assert!((value - speed).abs() <= error + 1e-12, "{method}: {value} {error:e}");
        }
    }
    let refused = pushed("{ points = [[\"10 ms\", 0], [1, 0]], outside = \"error\" }");
    assert!(read_beside(&refused, "").unwrap_err().render(false).contains("from 0.01 s to 1 s"));
}

#[test]
fn of_motions_it_is_told_where_they_stop_dead_or_begin_displaced() {
    let stops = told(&moved("motion", "[[0, 0], [\"10 ms\", \"5 mm\"]]"));
    let message = "the table of the motion of `base` ends at 10 ms at 500 mm/s";
    assert!(stops.contains(message) && stops.contains("held at 5 mm, so it stops dead"), "{stops}");
    let rests = "[[0, 0], [\"10 ms\", \"5 mm\"], [\"20 ms\", \"5 mm\"]]";
    assert_eq!(told(&moved("motion", rests)), "");
    let meant = "{ points = [[0, 0], [\"10 ms\", \"5 mm\"]], outside = \"hold\" }";
    assert_eq!(told(&moved("motion", meant)), "");
    let displaced = told(&moved("motion", "[[\"10 ms\", \"5 mm\"], [\"20 ms\", 0], [1, 0]]"));
    assert!(
        displaced.contains("of `base` begins at 10 ms with 5 mm, which is held"),
        "{displaced}"
    );
    let pushes = told(&moved("acceleration", "[[0, 0], [\"10 ms\", 20]]"));
    let message =
        "the table of the acceleration of `base` ends at 10 ms with 20 m/s^2, which is held";
    assert!(pushes.contains(message), "{pushes}");
    // A displacement that ends is a jump, which springs take.
    let jumps = moved("motion", &meant.replace("hold", "zero"));
    for (method, report) in reports(&jumps) {
        let peak = report.measure("pad.peak-deformation").unwrap().value.unwrap();
        assert!(peak > 1e-3, "{method}: {peak}");
    }
}

#[test]
fn where_outside_stands_in_the_wrong_place_the_right_one_is_told() {
    let beside = pushed(POINTS).replace("]] }", "]], outside = \"zero\" }");
    let shown = read_beside(&beside, "").unwrap_err().render(false);
    assert!(shown.contains("write `table = { points = …, outside = … }`"), "{shown}");
    let unknown = pushed(&format!("{{ points = {POINTS}, outside = \"nothing\" }}"));
    let shown = read_beside(&unknown, "").unwrap_err().render(false);
    assert!(shown.contains("hold") && shown.contains("zero") && shown.contains("error"), "{shown}");
}

/// A free mass that the ramp pushes, with this after it; the run ends with the ramp.
fn ramp(folder: &TempDir, outside: &str) -> std::path::PathBuf {
    let table = format!("{{ points = {POINTS}{outside} }}");
    let scene = pushed(&table).replace("duration = 0.1", "duration = \"20 ms\"");
    file(folder, "ramp.toml", &scene)
}

#[test]
fn sweeps_take_what_a_table_is_beyond_its_points() {
    let folder = TempDir::new().unwrap();
    // The end velocity of 2 kg after half of the ramp, after all of it, and 80 ms later.
    for (outside, last, is_told) in [
        ("", 45.0, true),
        (", outside = \"hold\"", 45.0, false),
        (", outside = \"zero\"", 5.0, false),
    ] {
        let scene = ramp(&folder, outside);
        let vary = ["--vary", "duration=10,20,100 ms", "--measure", "head.end-velocity"];
        let swept = run(&[&["sweep", text(&scene)], &vary[..]].concat());
        assert_eq!(code(&swept), 0, "{}", err(&swept));
        let table = out(&swept);
        let rows = table.lines().skip(1).map(|line| line.split(',').collect::<Vec<_>>());
        let found: Vec<(f64, f64)> =
            rows.map(|row| (row[1].parse().unwrap(), row[2].parse().unwrap())).collect();
        assert_eq!(found.len(), 3, "{table}");
        for ((value, error), expected) in found.into_iter().zip([1.25, 5.0, last]) {
            assert!((value - expected).abs() <= error + 1e-12, "{outside}: {value} {error:e}");
        }
        let words = err(&swept).split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(words.contains("at 1 of 3 points"), is_told, "{words}");
        assert_eq!(words.contains("is held to the end of the run at 100 ms"), is_told, "{words}");
    }
    let scene = ramp(&folder, ", outside = \"error\"");
    let sweep = |durations: &str| run(&["sweep", text(&scene), "--vary", durations]);
    let within = sweep("duration=10,20 ms");
    assert_eq!(code(&within), 0, "{}", err(&within));
    for (durations, status) in [("duration=10,20,100 ms", 0), ("duration=100,200 ms", 2)] {
        let beyond = sweep(durations);
        assert_eq!(code(&beyond), status, "{}", out(&beyond));
        assert!(err(&beyond).contains("is given from 0 s to 0.02 s"), "{}", err(&beyond));
    }
}

#[test]
fn shaking_does_not_ask_what_a_table_is_beyond_its_points() {
    let folder = TempDir::new().unwrap();
    let response = |scene: &str| {
        let path = file(&folder, "shaken.toml", scene);
        json(&["vibrate", text(&path), "--from", "1 Hz", "--to", "100 Hz", "--json"])
    };
    for key in ["motion", "acceleration"] {
        let sine = moved(key, POINTS).replace("table = ", "").replace(POINTS, "constant = 0");
        let expected = response(&sine);
        assert!(!expected["responses"].is_null(), "{expected}");
        for outside in ["hold", "zero", "error"] {
            let table = moved(key, "{ points = [[0, 0], [0.1, 1], [0.2, 1]], outside = \"OUT\" }");
            assert_eq!(response(&table.replace("OUT", outside)), expected, "{key} {outside}");
        }
    }
}

#[test]
fn what_is_still_falling_is_told_by_every_method() {
    let text = "[nodes]\nhead = { mass = 5, drop = \"1.5 m\" }\n[elements]\n\
        pad = { between = [\"head\", \"ground\"], spring = \"60 kN/m\" }\n\
        [effects]\ngravity = {}\nseparation.pad = { at = \"head\" }\n[run]\nduration = \"50 ms\"\n";
    let scene = read(text, &ReadOptions::default()).unwrap().value;
    for method in METHODS.into_iter().chain(["tsit45", "auto"]) {
        for estimate in [true, false] {
            let settings = SolveSettings { estimate, ..scene.settings(method).unwrap() };
            let report = scene.network.solve_with(&settings).unwrap();
            let told = report.warnings.iter().any(|warning| warning.code() == "still-falling");
            assert!(told, "{method}: {:?}", report.warnings);
        }
    }
}

#[test]
fn what_is_dropped_begins_in_the_air_only_where_it_falls_and_nothing_is_bonded_to_it() {
    let cases = [
        ("", "", 0.0),
        ("gravity = {}", "", 0.0),
        ("", "separation.pad = { at = \"head\" }", 0.0),
        ("gravity = {}", "separation.pad = { at = \"head\" }", 0.1),
        ("gravity = { value = \"-1 g0\" }", "separation.pad = { at = \"head\" }", 0.0),
        ("gravity = {}", "separation.pad = { at = \"ground\" }", 0.0),
    ];
    let g = 9.806_65;
    for (gravity, separation, height) in cases {
        let text = format!(
            "[nodes]\nhead = {{ mass = 5, drop = \"10 cm\" }}\n[elements]\n\
             pad = {{ between = [\"head\", \"ground\"], spring = \"60 kN/m\" }}\n\
             [effects]\n{gravity}\n{separation}\n[run]\nduration = \"0.3 s\"\n"
        );
        let scene = read(&text, &ReadOptions::default()).unwrap().value;
        let head = scene.assembly.nodes.iter().find(|node| node.name == "head").unwrap();
        let fall = f64::sqrt(2.0 * height / g);
        assert!((head.fall - fall).abs() < 1e-15, "{gravity} {separation}: {}", head.fall);
        for (method, allowed) in [("exact", 0.0), ("bdf", 1e-6)] {
            let report = scene.network.solve_with(&scene.settings(method).unwrap()).unwrap();
            let output = |name: &str| {
                let at = report.assembly.output(name).unwrap();
                report.trajectory.signal(&report.assembly.system, at).value(0.0)
            };
            let speed = if height > 0.0 { 0.0 } else { (2.0 * g * 0.1_f64).sqrt() };
            let off = (output("head.position") + height).abs();
            assert!(off <= 1e-12 + allowed, "{method} {gravity} {separation}: {off:e}");
            let off = (output("head.velocity") - speed).abs();
            assert!(off <= 1e-12 + allowed, "{method} {gravity} {separation}: {off:e}");
        }
    }
}
