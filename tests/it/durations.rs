//! `duration = "auto"`: until the impact is over, and nothing larger follows.

use std::f64::consts::PI;

use dashpot::{
    analysis::{RunReport, Solve},
    scene::{ReadOptions, Scene, read, write_scene},
};
use tempfile::TempDir;

use crate::cli::{code, err, file, out, run, text};

/// A scene with `[run]` at its end, and what it is odd in.
fn scene(text: &str, run: &str) -> (Scene, String) {
    let text = format!("{text}\n[run]\nduration = \"auto\"\n{run}\n");
    let checked =
        read(&text, &ReadOptions::default()).unwrap_or_else(|own| panic!("{}", own.render(false)));
    (checked.value, checked.warnings.render(false))
}

fn solved(scene: &Scene) -> RunReport {
    scene.network.solve_with(&scene.settings("auto").unwrap()).unwrap()
}

const SPRING: &str = r#"
[nodes]
head = { mass = "5 kg", velocity = "4 m/s" }
[elements]
pad = { between = ["head", "ground"], spring = "60 kN/m" }
"#;

#[test]
fn a_spring_is_followed_through_its_half_period() {
    let (scene, odd) = scene(SPRING, "");
    let end = PI * (5.0_f64 / 60e3).sqrt();
    // 1.25 times the half period of 28.68 ms, rounded up to two digits.
    assert!((scene.run.duration - 0.036).abs() < 1e-15, "{} of {end}", scene.run.duration);
    assert!(odd.is_empty(), "{odd}");
    let report = solved(&scene);
    assert!((report.value("pad.contact-time").unwrap() / end - 1.0).abs() < 1e-9);
    let text =
        write_scene("again", &[], &scene.network, &scene.run, &scene.settings("auto").unwrap())
            .unwrap();
    assert!(text.contains("duration = \"auto\"\nat-most = \"1 s\""), "{text}");
    assert_eq!(read(&text, &ReadOptions::default()).unwrap().value.run, scene.run);
}

#[test]
fn a_fall_from_above_belongs_to_the_run() {
    let text = r#"
[nodes]
head = { mass = "5 kg", drop = "1 m" }
[elements]
pad = { between = ["head", "ground"], hunt-crossley = { force = "1.2 kN", at = "20 mm", dissipation = 0.4, exponent = 1 } }
[effects]
gravity = {}
"#;
    let (scene, odd) = scene(text, "");
    let fall = (2.0 / 9.80665_f64).sqrt();
    let impact = solved(&scene).contacts[0].impact;
    assert!(impact.has_ended() && (impact.start - fall).abs() < 1e-6, "{impact:?}");
    assert!(
        scene.run.duration > impact.end && scene.run.duration < 1.4 * impact.end,
        "{}",
        scene.run.duration
    );
    assert!(odd.is_empty(), "{odd}");
}

#[test]
fn it_waits_for_loads_and_for_what_rings_behind() {
    // A pulse, twenty impacts later, on what the bed carries.
    let late = r#"
[nodes]
head = { mass = "5 kg", velocity = "4 m/s" }
bed  = { mass = "50 kg" }
[elements]
pad  = { between = ["head", "bed"], spring = "60 kN/m" }
legs = { between = ["bed", "ground"], parallel = [{ spring = "200 kN/m" }, { dashpot = "600 N s/m" }] }
[effects]
separation.pad = {}
[loads.knock]
on = "bed"
force = { half-sine = { peak = "20 kN", duration = "10 ms", start = "500 ms" } }
"#;
    let (own, _) = scene(late, "at-most = \"3 s\"");
    assert!(own.run.duration > 1.25 * 0.51 && own.run.duration <= 1.0, "{}", own.run.duration);
    // Without it the legs bear their most a quarter of their period after the impact, which the pad alone
    // would not see.
    let (own, odd) = scene(&late[..late.find("[loads").unwrap()], "");
    let report = solved(&own);
    let quarter = 0.5 * PI * (50.0_f64 / 200e3).sqrt();
    let solution = report.solution();
    let legs = report.assembly.connections.iter().find(|own| own.name == "legs").unwrap();
    let peak = solution.signal(legs.force.unwrap()).absolute_maximum((0.0, solution.end()));
    assert!(
        peak.time > quarter && own.run.duration >= 1.2 * peak.time,
        "{peak:?}, {}",
        own.run.duration
    );
    assert!(odd.is_empty(), "{odd}");
}

#[test]
fn what_comes_to_rest_is_followed_until_its_peaks_are_old() {
    let text = r#"
[nodes]
head = { mass = "5 kg", velocity = "1 m/s" }
[elements]
pad = { between = ["head", "ground"], parallel = [{ spring = "10 kN/m" }, { dashpot = "600 N s/m" }] }
[effects]
gravity = {}
separation.pad = {}
"#;
    let (scene, odd) = scene(text, "");
    let report = solved(&scene);
    let peak = report.measure("pad.peak-deformation").unwrap();
    assert!(!report.contacts[0].impact.has_ended());
    assert!(
        scene.run.duration >= 8.0 * peak.time.unwrap(),
        "{} after {peak:?}",
        scene.run.duration
    );
    assert!(scene.run.duration < 0.9, "{}", scene.run.duration);
    assert!(odd.is_empty(), "{odd}");
}

#[test]
fn what_is_let_go_at_a_place_of_its_own_is_followed_until_it_was_fastest() {
    let let_go = |at: &str, pad: &str| {
        format!(
            "[nodes]\nblock = {{ mass = \"1 kg\", position = \"{at}\" }}\n[elements]\n{pad}\n\
             [measures]\nblock = [\"peak-velocity\"]\n"
        )
    };
    let speed = |text: &str| {
        let (scene, odd) = scene(text, "");
        assert!(odd.is_empty(), "{odd}");
        solved(&scene).value("block.peak-velocity").unwrap()
    };
    // Damped by a third: where the acceleration is zero the speed is ω x e^(−ζ φ / √(1 − ζ²)), with cos φ = ζ.
    let (omega, zeta) = (1000_f64.sqrt(), 10.0 / 1000_f64.sqrt());
    let right = omega * 0.02 * (-zeta * zeta.acos() / (1.0 - zeta * zeta).sqrt()).exp();
    let kelvin = "s = { between = [\"block\", \"ground\"], kelvin-voigt = { spring = \"1 kN/m\", dashpot = \
                  \"20 N s/m\" } }";
    assert!((speed(&let_go("20 mm", kelvin)) / right - 1.0).abs() < 1e-9);
    // It slides against 5 N, so that it swings about 5 mm.
    let sliding = "s = { between = [\"block\", \"ground\"], spring = \"1 kN/m\" }\n\
                   f = { between = [\"block\", \"ground\"], friction = { friction = \"5 N\", \
                   static-to-kinetic = 2 } }";
    let right = omega * 0.047;
    assert!((speed(&let_go("52 mm", sliding)) / right - 1.0).abs() < 1e-9);
}

#[test]
fn a_bound_counts_from_the_arrival_of_what_falls() {
    for height in [1.5_f64, 6.0, 60.0] {
        let text = format!(
            "[nodes]\nhead = {{ mass = \"5 kg\", drop = \"{height} m\" }}\n[elements]\n\
             pad = {{ between = [\"head\", \"ground\"], kelvin-voigt = {{ spring = \"60 kN/m\", dashpot = \
             \"300 N s/m\" }} }}\n[effects]\ngravity = {{}}\nseparation.pad = {{}}\n"
        );
        let (scene, odd) = scene(&text, "");
        assert!(odd.is_empty(), "{odd}");
        let fall = (2.0 * height / 9.80665).sqrt();
        let impact = solved(&scene).contacts[0].impact;
        assert!(impact.has_ended() && (impact.start - fall).abs() < 1e-6, "{impact:?}");
        let after = scene.run.duration - fall;
        // Rounded up to two digits of the whole.
        assert!(after >= 1.2 * (impact.end - fall) && after < 0.2 + 0.1 * fall, "{after}");
    }
}

#[test]
fn a_soft_toe_ends_an_impact_as_well() {
    for toe in [2, 20, 100] {
        let text = format!(
            "[nodes]\nhead = {{ mass = \"2 kg\", velocity = \"3 m/s\" }}\n[elements]\n\
             pad = {{ between = [\"head\", \"ground\"], table-spring = [[0, 0], [\"1 mm\", \"{toe} N\"], \
             [\"20 mm\", \"20 kN\"]] }}\n[effects]\nseparation.pad = {{}}\n"
        );
        let (scene, odd) = scene(&text, "");
        assert!(odd.is_empty() && scene.run.duration < 0.1, "{toe}: {} {odd}", scene.run.duration);
    }
}

#[test]
fn what_does_not_end_is_cut_off_and_says_so() {
    // A dashpot alone stops a body after ever longer times, and never quite.
    let text = SPRING.replace("spring = \"60 kN/m\"", "dashpot = \"5 N s/m\"");
    let (scene, odd) = scene(&text, "at-most = \"200 ms\"");
    assert_eq!(scene.run.duration.to_bits(), 0.2_f64.to_bits());
    assert!(odd.contains("the run is cut off at 200 ms") && odd.contains("at-most"), "{odd}");
}

#[test]
fn a_condition_that_stops_the_run_ends_it() {
    let stop = "stop = [{ when = \"pad.deformation\", rises-above = \"20 mm\" }]";
    let (scene, _) = scene(SPRING, stop);
    // y = V/ω sin ω t.
    let omega = (60e3_f64 / 5.0).sqrt();
    let time = (0.02 * omega / 4.0).asin() / omega;
    let report = solved(&scene);
    assert!((report.solution().end() / time - 1.0).abs() < 1e-9);
    assert!(
        scene.run.duration >= time && scene.run.duration < 1.4 * time,
        "{}",
        scene.run.duration
    );
}

#[test]
fn a_bound_beside_a_given_length_is_an_error() {
    let text = format!("{SPRING}[run]\nduration = \"20 ms\"\nat-most = \"1 s\"\n");
    let told = read(&text, &ReadOptions::default()).unwrap_err().render(false);
    assert!(told.contains("`at-most` bounds a length that is to be found"), "{told}");
    assert!(told.contains("duration = \"auto\"") && told.contains("scene:8"), "{told}");
}

#[test]
fn every_point_of_a_sweep_has_a_length_of_its_own() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "auto.toml", &format!("{SPRING}[run]\nduration = \"auto\"\n"));
    let ranges = ["--vary", "pad.spring=0.6,60 kN/m", "--measure", "pad.contact-time"];
    let swept = run(&[&["sweep", text(&path)], &ranges[..]].concat());
    assert_eq!(code(&swept), 0, "{}", err(&swept));
    let table = out(&swept);
    let rows: Vec<Vec<f64>> = table
        .lines()
        .skip(1)
        .map(|line| line.split(',').take(2).map(|own| own.parse().unwrap()).collect())
        .collect();
    assert_eq!(rows.len(), 2);
    for row in rows {
        // The contact times differ by a factor of ten: one length for both would cut the first off.
        let right = PI * (5.0 / row[0]).sqrt();
        assert!((row[1] / right - 1.0).abs() < 1e-6, "{row:?} against {right}");
    }
}
