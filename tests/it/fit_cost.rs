//! How often a fit solves its tests: counts of evaluations, which repeat to the bit.

use std::fmt::Write as _;

use dashpot::numerics::Stream;
use serde_json::Value;
use tempfile::TempDir;

use crate::cli::{code, err, file, json, run, text};

fn evaluations(fit: &Value) -> u64 {
    fit["unevaluated"]["of"].as_u64().unwrap()
}

fn fitted(scene: &str, rows: &str, to: &str, varied: &[&str]) -> Value {
    let folder = TempDir::new().unwrap();
    let (scene, rows) = (file(&folder, "scene.toml", scene), file(&folder, "rows.csv", rows));
    let to = format!("{}:{to}", text(&rows));
    json(&[&["fit", text(&scene), "--json", "--to", &to], varied].concat())
}

/// Asserts that the interval of a number holds the truth, but for this part of it, and is no wider than so many truths.
fn assert_holds(fit: &Value, name: &str, truth: f64, (by, widest): (f64, f64)) {
    let own = &fit["parameters"][name];
    let [low, high] = [("low", 0.0), ("high", f64::INFINITY)]
        .map(|(end, open)| own[end].as_f64().unwrap_or(open) / truth);
    assert!(low <= 1.0 + by && high >= 1.0 - by && high - low <= widest, "{name}: {own}");
}

/// Modulus, plateau and densification of a foam \[Pa\], of exponent 2.
const FOAM: [f64; 3] = [14e6, 0.62e6, 0.14e6];
const NAMES: [&str; 3] = ["eps.modulus", "eps.plateau", "eps.densification"];

fn stress([modulus, plateau, densification]: [f64; 3], exponent: f64, strain: f64) -> f64 {
    let dense = densification * (strain / (1.0 - strain)).powf(exponent);
    dense - plateau * (-modulus * strain / plateau).exp_m1()
}

#[test]
fn a_slow_test_with_its_times_takes_hardly_more_solutions_than_one_at_a_stated_rate() {
    let scene = "[materials]\neps = { foam = { modulus = \"10 MPa\", plateau = \"0.5 MPa\", \
                 densification = \"0.2 MPa\", exponent = 2.0 } }\n[nodes]\nhead = { mass = \"5 kg\", velocity = \"5 m/s\" }\n\
                 [elements]\nliner = { between = [\"head\", \"ground\"], material = \"eps\", thickness = \"25 mm\", \
                 area = \"80 cm^2\" }\n[run]\nduration = \"20 ms\"\n";
    let varied = [
        "--vary",
        "eps.modulus=1..100MPa",
        "--vary",
        "eps.plateau=0.05..5MPa",
        "--vary",
        "eps.densification=0.02..2MPa",
    ];
    let mut with = "time [s],strain [%],stress [MPa]\n".to_owned();
    let mut without = "strain [%],stress [MPa]\n".to_owned();
    for at in 0..=30 {
        let strain = 0.028 * f64::from(at);
        let row = format!("{:.2},{:.5}\n", 100.0 * strain, 1e-6 * stress(FOAM, 2.0, strain));
        write!(with, "{:.2},{row}", 5.0 * f64::from(at)).unwrap();
        without += &row;
    }
    let timed = fitted(scene, &with, "stress=eps", &varied);
    let stated = fitted(scene, &without, "stress=eps,rate=0.0056 1/s", &varied);
    for (name, truth) in NAMES.into_iter().zip(FOAM) {
        // Rows are rounded to 10 Pa.
        assert_holds(&timed, name, truth, (1e-4, 1.0));
        assert_holds(&stated, name, truth, (1e-4, 1.0));
    }
    let [timed, stated] = [&timed, &stated].map(evaluations);
    assert!(stated < 220 && timed < 800, "{timed} and {stated}");
}

/// Radii of a ball and of the hollow liner that it falls on \[m\], its mass \[kg\] and speed \[m/s\], and the liner's
/// thickness \[m\].
const RADII: [f64; 2] = [0.085, -0.11];
const BALL: [f64; 2] = [5.0, 5.4];
const THICKNESS: f64 = 0.03;

/// The acceleration of the ball at times \[s\] behind the first touch, for the liner of a foam: the stress of columns under
/// the gap between both faces, by the rule of Simpson over the radius, in steps of Runge and Kutta.
fn drop(foam: [f64; 3], exponent: f64, times: &[f64]) -> Vec<f64> {
    let height =
        |radius: f64, at: f64| radius - radius.signum() * (radius * radius - at * at).sqrt();
    let force = |depth: f64| {
        if depth <= 0.0 {
            return 0.0;
        }
        // The columns under the edge of what is touched.
        let gap = |at: f64| height(RADII[0], at) + height(RADII[1], at);
        let (mut low, mut high) = (0.0, RADII[0]);
        for _ in 0..60 {
            let middle = f64::midpoint(low, high);
            if gap(middle) < depth { low = middle } else { high = middle }
        }
        let parts = 200;
        let ring = |at: usize| {
            let radius = low * at as f64 / f64::from(parts);
            let strain = ((depth - gap(radius)) / THICKNESS).max(0.0);
            std::f64::consts::TAU * radius * stress(foam, exponent, strain)
        };
        let weight = |at: usize| [2.0, 4.0][at % 2];
        let inner: f64 = (1..parts as usize).map(|at| weight(at) * ring(at)).sum();
        (inner + ring(parts as usize)) * low / f64::from(parts) / 3.0
    };
    let push = |depth: f64| -force(depth) / BALL[0];
    let (mut state, mut now) = ([0.0, BALL[1]], 0.0);
    let step = |[y, v]: [f64; 2], h: f64| {
        let one = [v, push(y)];
        let two = [v + 0.5 * h * one[1], push(y + 0.5 * h * one[0])];
        let three = [v + 0.5 * h * two[1], push(y + 0.5 * h * two[0])];
        let four = [v + h * three[1], push(y + h * three[0])];
        let mean = |at: usize| (one[at] + 2.0 * (two[at] + three[at]) + four[at]) / 6.0;
        [y + h * mean(0), v + h * mean(1)]
    };
    let at = |time: &f64| {
        if *time > 0.0 {
            state = step(state, time - now);
            now = *time;
        }
        -push(state[0])
    };
    times.iter().map(at).collect()
}

#[test]
fn a_ball_on_a_hollow_liner_is_fitted_in_few_runs_however_steep_the_foams_within_the_bounds() {
    let scene = "[materials]\neps = { foam = { modulus = \"10 MPa\", plateau = \"1.2 MPa\", \
                 densification = \"0.1 MPa\", exponent = 2.0 } }\n[nodes]\nhead = { mass = \"5 kg\", velocity = \"5.4 m/s\" }\n\
                 [elements.liner]\nbetween = [\"head\", \"ground\"]\nmaterial = \"eps\"\nthickness = \"30 mm\"\n\
                 pressed-by = { shape = \"sphere\", radius = \"85 mm\", pad-radius = \"-110 mm\" }\n\
                 [run]\nduration = \"24.4 ms\"\n";
    let (foam, exponent) = ([20e6, 0.7e6, 0.2e6], 2.5);
    let times: Vec<f64> = (0..245).map(|at| 1e-4 * f64::from(at) - 2e-3).collect();
    let truth = drop(foam, exponent, &times);
    let peak = truth.iter().copied().fold(0.0, f64::max);
    let mut stream = Stream::new(3);
    let mut rows = "time [s],acc [m/s^2]\n".to_owned();
    for (time, value) in times.iter().zip(truth) {
        let noise = (0..12).map(|_| stream.share()).sum::<f64>() - 6.0;
        writeln!(rows, "{:.4},{:.3}", time + 2e-3, value + 0.01 * peak * noise).unwrap();
    }
    let varied = [
        "--vary",
        "eps.modulus=2..100MPa",
        "--vary",
        "eps.plateau=0.1..5MPa",
        "--vary",
        "eps.densification=0.02..2MPa",
        "--vary",
        "eps.exponent=1..5",
    ];
    let found = fitted(scene, &rows, "acc=head.acceleration", &varied);
    // Pressed by two fifths, the foam leaves open how steep it is beyond: the best exponent lies on its bound, from which
    // the others' intervals have to come away.
    let widest = [1.0, 1.0, 2.0, f64::INFINITY];
    let numbers = NAMES.into_iter().zip(foam).chain([("eps.exponent", exponent)]);
    for ((name, truth), widest) in numbers.zip(widest) {
        assert_holds(&found, name, truth, (0.02, widest));
    }
    let rms = found["tests"][0]["rms"].as_f64().unwrap() / peak;
    assert!((0.008..0.012).contains(&rms), "{rms}");
    assert!(evaluations(&found) < 4000, "{}", evaluations(&found));
}

#[test]
fn a_fit_to_runs_that_lose_their_energy_claims_nothing() {
    // 250 periods, of which `bdf` damps the motion at so loose a tolerance.
    let scene = "[nodes]\nhead = { mass = \"10 kg\", velocity = \"10 m/s\" }\n[elements]\n\
                 pad = { between = [\"head\", \"ground\"], parallel = [{ spring = \"1 MN/m\" }, { dashpot = \"0.632 N s/m\" }] }\n\
                 [run]\nduration = \"5 s\"\nmethods = [\"bdf\"]\nrtol = 1e-3\n";
    let rows: Vec<String> = (0..50).map(|at| format!("{},{at}", 1e-4 * f64::from(at))).collect();
    let rows = rows.join("\n");
    let folder = TempDir::new().unwrap();
    let scene = file(&folder, "scene.toml", scene);
    let rows = file(&folder, "rows.csv", &format!("time [s],force [kN]\n{rows}"));
    let to = format!("{}:force=pad.force", text(&rows));
    let output = run(&["fit", text(&scene), "--to", &to, "--vary", "pad.spring=0.5..2 MN/m"]);
    assert_ne!(code(&output), 0);
    assert!(err(&output).contains("energy"), "{}", err(&output));
}
