//! What accuracy costs: against solutions that are compared here, and as users of the command meet it.

use std::fs;

use dashpot::{
    analysis::{
        Choice, RunError, SolveSettings, solve_assembly,
        work_precision::{CostReport, Ladder, work_precision_assembly},
    },
    dae::{Silent, SolveError},
    scene::{ReadOptions, Scene, read},
};
use tempfile::TempDir;

use crate::{
    cli::{code, err, json, out, run, text},
    scenes::scene_path,
};

fn scene(name: &str) -> Scene {
    read(&fs::read_to_string(scene_path(name)).unwrap(), &ReadOptions::default()).unwrap().value
}

/// What accuracy costs at these tolerances, without regard to time.
fn cost(scene: &Scene, methods: &[&str], rtols: &[f64]) -> CostReport {
    let ladder = Ladder {
        methods: methods.iter().map(|method| Choice::named(method).unwrap()).collect(),
        rtols: rtols.to_vec(),
        repeats: Some(1),
        ..Ladder::default()
    };
    work_precision_assembly(&scene.assembly, &scene.settings("auto").unwrap(), &ladder, &mut Silent)
        .unwrap()
}

#[test]
fn errors_of_the_reference_impact_fall_and_are_those_of_runs_beside_the_exact_one() {
    let scene = scene("reference");
    let solved = |method: &str, rtol| {
        let settings = SolveSettings { rtol, ..scene.settings(method).unwrap() };
        solve_assembly(&scene.assembly, &[], &settings, &mut Silent).unwrap()
    };
    let exact = solved("exact", None);
    let rtols = [1e-4, 1e-6, 1e-8, 1e-10];
    let report = cost(&scene, &["bdf", "tr-bdf2", "esdirk34", "tsit45"], &rtols);
    assert_eq!(report.points.len(), 16);
    for point in &report.points {
        let direct = solved(point.method, point.rtol);
        for (at, own) in exact.measures.iter().enumerate() {
            let value = direct.measure(&own.key).unwrap().value.unwrap();
            let error = (value - own.value.unwrap()).abs() / own.size;
            let found = point.measures[at].deviation.unwrap();
            assert!((found.value - error).abs() <= 1e-15, "{} {}", point.method, own.key);
            assert!(found.known_within < 1e-10);
        }
    }
    for of_method in report.points.chunks(rtols.len()) {
        let worst: Vec<f64> = of_method.iter().map(|own| own.worst(&report.asked)).collect();
        assert!(worst.windows(2).all(|pair| pair[1] < pair[0]), "{worst:?}");
    }
}

#[test]
fn the_agreement_of_two_families_limits_what_is_said_of_a_nonlinear_scene() {
    for name in ["crash-mat", "eps-helmet"] {
        let report = cost(&scene(name), &["bdf", "esdirk34"], &[1e-5, 1e-11]);
        let truth = &report.reference;
        assert_eq!(truth.witness.map(|witness| witness.0), Some("esdirk34"), "{name}");
        assert!(truth.why_not_exact.is_some() && report.auto == "bdf", "{name}: {}", report.auto);
        let agreement = truth.measure_agreement.unwrap();
        assert!(agreement > 0.0 && agreement < 1e-6, "{name}: {agreement:e}");
        assert!(truth.state_agreement.unwrap() < 1e-4, "{name}: {truth:?}");
        let known = report.measures.iter().map(|measure| measure.known_within).fold(0.0, f64::max);
        assert!((known - agreement).abs() <= 0.0, "{name}: {known:e} {agreement:e}");
        assert!(
            report.points.iter().all(|point| point.worst(&report.asked) >= agreement),
            "{name}"
        );
    }
}

#[test]
fn a_method_that_loses_its_way_on_a_stiff_scene_is_listed() {
    let stiff = scene("reference-stiff");
    let report = cost(&stiff, &["tsit45"], &[1e-3, 1e-5]);
    let [failure] = &report.failures[..] else { panic!("{:?}", report.failures) };
    assert_eq!((failure.method, failure.rtol), ("tsit45", Some(1e-3)));
    assert!(matches!(failure.error, RunError::EnergyLost { .. }), "{}", failure.error);
    // A run a thousand times as long takes more steps than are tried.
    let text = stiff.text.replace("20 ms", "20 s");
    assert_ne!(*text, *stiff.text);
    let long = read(&text, &ReadOptions::default()).unwrap().value;
    let report = cost(&long, &["tsit45"], &[1e-6, 1e-8]);
    let [failure] = &report.failures[..] else { panic!("{:?}", report.failures) };
    let error = &failure.error;
    assert!(matches!(error, RunError::Solve(SolveError::TooManySteps { .. })), "{error}");
    assert!(failure.ends && report.points.is_empty());
}

#[test]
fn events_of_a_scene_that_switches_are_met_the_better_the_tighter_the_tolerance() {
    let report = cost(&scene("thesis-stop"), &["bdf"], &[1e-5, 1e-7, 1e-9]);
    let times: Vec<f64> =
        report.points.iter().map(|point| point.events.deviation.unwrap().value).collect();
    assert!(times[2] < times[1] && times[1] < times[0] && times[2] < 1e-7, "{times:?}");
    assert!(report.points.iter().all(|point| point.events.missed + point.events.extra == 0));
    let states: Vec<f64> = report.points.iter().map(|point| point.state.unwrap().value).collect();
    assert!(states[2] < 1e-2 * states[0], "{states:?}");
}

#[test]
fn the_command_prints_tables_that_fit_and_one_object_that_says_the_same() {
    let arguments = ["cost", "reference", "--repeat", "1", "--method", "bdf,exact"];
    let output = run(&arguments);
    assert_eq!(code(&output), 0, "{}", err(&output));
    let shown = out(&output);
    assert!(shown.lines().all(|line| line.chars().count() <= 80), "{shown}");
    let object = json(&[&arguments[..], &["--json"]].concat());
    let points = object["points"].as_array().unwrap();
    assert_eq!(points.len(), 10);
    for point in points.iter().filter(|point| point["rtol"].is_f64()) {
        let counts = ["accepted", "rejected", "rhs_calls", "jacobian_calls", "factorizations"];
        let row: Vec<String> = counts.iter().map(|count| point[count].to_string()).collect();
        let is_row = |line: &str| {
            let words: Vec<&str> = line.split_whitespace().collect();
            words.len() > 7 && words[2..7] == row
        };
        assert!(shown.lines().any(is_row), "{row:?}\n{shown}");
        assert!(point["time_s"]["median"].as_f64() > Some(0.0));
        let error = &point["measures"]["padding.peak-force"]["error"];
        assert!(error.as_f64().is_some_and(|own| own > 0.0 && own < 0.1), "{error}");
    }
    assert_eq!(object["cheapest"].as_array().unwrap().len(), 3);
    assert_eq!(object["truth"]["method"], "exact");
    let sentences = shown.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(sentences.contains("the cheapest method: at 1 % it is"), "{shown}");
    // Read back, it holds the numbers of the library to the last digit but one.
    let report = cost(&scene("reference"), &["bdf", "exact"], &Ladder::default().rtols);
    for (point, own) in points.iter().zip(&report.points) {
        assert_eq!(point["method"], own.method);
        assert_eq!(point["linear_solves"].as_u64(), Some(own.work.linear_solves as u64));
        for (measure, deviation) in report.measures.iter().zip(&own.measures) {
            let found = &point["measures"][&measure.key];
            for (name, value) in [
                ("error", deviation.deviation.map(|deviation| deviation.value)),
                ("known_within", deviation.deviation.map(|deviation| deviation.known_within)),
                ("bar", deviation.bar),
            ] {
                let (read, value) = (found[name].as_f64().unwrap(), value.unwrap());
                assert!((read - value).abs() <= 1e-15 * value.abs(), "{name} {read} {value}");
            }
        }
    }
}

#[test]
fn a_folder_has_tables_figures_and_a_page() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("cost");
    let measure = ["--measure", "mat.peak-force", "--repeat", "1", "--method", "esdirk34,exact"];
    let arguments = [&["cost", "scenes/crash-mat.toml", "--out", text(&path)][..], &measure];
    let output = run(&arguments.concat());
    assert_eq!(code(&output), 0, "{}", err(&output));
    assert!(out(&output).contains("exact: `exact` cannot solve this"), "{}", out(&output));
    assert!(out(&output).contains("For mat.peak-force, the cheapest"), "{}", out(&output));
    let content = |name: &str| fs::read_to_string(path.join(name)).unwrap();
    let rows = content("cost.csv");
    assert_eq!(rows.lines().count(), 10, "{rows}");
    assert!(rows.lines().next().unwrap().contains("error of mat.peak-force [1]"));
    let figure = content("error-time.svg");
    assert_eq!(figure.matches("<circle").count(), 9);
    assert!(content("report.html").contains("What accuracy costs: mat.peak-force"));
    assert!(content("error-work.svg").starts_with("<svg"));
    // Its own folder is written again, and another verb's is not spoilt by a wrong measure.
    assert_eq!(code(&run(&arguments.concat())), 0);
    let wrong = run(&["cost", "--measure", "padding.beauty"]);
    assert_eq!(code(&wrong), 2, "{}", err(&wrong));
    assert!(err(&wrong).contains("padding.peak-force"), "{}", err(&wrong));
}
