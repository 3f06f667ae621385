//! Extrema over windows, against all windows of a grid: of runs by every method, of sweeps and of records.

use std::fmt::Write as _;

use dashpot::{
    analysis::{RunReport, Solve},
    dae::Signal,
    scene::{ReadOptions, read},
    units::STANDARD_GRAVITY,
};
use tempfile::TempDir;

use crate::cli::{file, json, text};

/// A head on a foam on a panel: its pulse has a peak, and a shoulder behind it that is about as good.
const HEAD: &str = r#"
[materials.pad-stuff]
series = [{ parallel = [{ stiffening-spring = { stiffness = "2.4292388 MPa", limit = 0.53303965 } }, { dashpot = "1.5517313 kPa s" }] }, { parallel = [{ spring = "5.3463582 MPa" }, { dashpot = "0.96576642 kPa s" }] }]
[nodes]
panel = { mass = "9.965 kg" }
head = { mass = "9.614 kg", velocity = "5.395 m/s" }
[elements]
mount = { between = ["panel", "ground"], parallel = [{ cubic-spring = { stiffness = "2.086 MN/m", cubic = "1479000000.0 N/m^3" } }, { dashpot = "0.7657 N s/mm" }] }
pad = { between = ["head", "panel"], material = "pad-stuff", thickness = "0.0227 m", area = "0.0134 m^2" }
[effects]
gravity = { value = "1 g0" }
separation.pad = {}
[measures]
head = ["hic15", "clip-3ms"]
[run]
duration = "0.0294 s"
"#;

/// A pulse with a shoulder \[g0\], at equal steps.
const PULSE: [f64; 27] = [
    20.099, 51.388, 74.938, 93.831, 108.545, 119.841, 131.153, 129.458, 129.320, 117.737, 97.941,
    90.637, 78.189, 63.776, 60.569, 58.435, 58.426, 58.382, 58.329, 57.951, 57.672, 57.658, 46.873,
    42.239, 27.965, 16.125, 1.862,
];

/// The largest `V^2.5/T^1.5` of windows up to `cap` between points `(t, area up to t)`.
fn brute(areas: &[(f64, f64)], cap: f64) -> f64 {
    let mut best = 0.0_f64;
    for (at, from) in areas.iter().enumerate() {
        for to in areas[at + 1..].iter().take_while(|to| to.0 - from.0 <= cap) {
            let (length, area) = (to.0 - from.0, (to.1 - from.1).abs());
            best = best.max(area.powf(2.5) / length.powf(1.5));
        }
    }
    best
}

/// Areas under lines between points at equal steps, with so many places in each line.
fn under_lines(points: &[f64], step: f64, parts: u32) -> Vec<(f64, f64)> {
    let (mut areas, mut area, mut start) = (vec![(0.0, 0.0)], 0.0, 0.0);
    for pair in points.windows(2) {
        for part in 1..=parts {
            let share = f64::from(part) / f64::from(parts);
            let mean = pair[0] + 0.5 * share * (pair[1] - pair[0]);
            areas.push((start + share * step, area + share * step * mean));
        }
        area += 0.5 * step * (pair[0] + pair[1]);
        start += step;
    }
    areas
}

/// Areas under an acceleration in parts of standard gravity, by Simpson's rule on a fine grid.
fn under(signal: &Signal, end: f64, parts: u32) -> Vec<(f64, f64)> {
    let step = end / f64::from(parts);
    let value = |time: f64| signal.value(time) / STANDARD_GRAVITY;
    let mut area = 0.0;
    let mut areas = vec![(0.0, 0.0)];
    for at in 0..parts {
        let from = step * f64::from(at);
        area += step / 6.0 * (value(from) + 4.0 * value(from + 0.5 * step) + value(from + step));
        areas.push((from + step, area));
    }
    areas
}

fn solved(method: &str) -> RunReport {
    let scene = read(HEAD, &ReadOptions::default()).unwrap().value;
    scene.network.solve_with(&scene.settings(method).unwrap()).unwrap()
}

fn measured(report: &RunReport, key: &str) -> (f64, f64) {
    let own = report.measure(key).unwrap();
    (own.value.unwrap(), own.error.unwrap())
}

#[test]
fn no_window_of_a_run_has_more_by_any_method_nor_of_a_sweep() {
    let mut found = Vec::new();
    for method in ["bdf", "dop853", "tr-bdf2"] {
        let report = solved(method);
        let (value, error) = measured(&report, "head.hic15");
        let solution = report.solution();
        let at = report.assembly.nodes.iter().position(|node| node.name == "head").unwrap();
        let acceleration = solution.node_acceleration(at).unwrap();
        // To the end of the impact.
        let end = measured(&report, "pad.contact-time").0;
        let best = brute(&under(acceleration, end, 400), 0.015);
        assert!(value >= best * (1.0 - 1e-6), "{method}: {value} ± {error}, of a grid {best}");
        assert!(value <= best * 1.001, "{method}: {value} ± {error}, of a grid {best}");
        found.push((value, error));
    }
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "head.toml", HEAD);
    let swept = json(&["sweep", text(&path), "--vary", "head.mass=9.614 kg..9.7 kg,2", "--json"]);
    let measures = swept["measures"].as_array().unwrap();
    let own = measures.iter().find(|own| own["key"] == "head.hic15").unwrap();
    found.push((own["values"][0].as_f64().unwrap(), own["errors"][0].as_f64().unwrap_or(0.01)));
    for (value, error) in &found {
        let (first, bar) = found[1];
        assert!((value - first).abs() <= 2.0 * (error + bar) + 1e-6 * first, "{found:?}");
    }
}

#[test]
fn no_window_of_a_table_or_record_has_more() {
    let folder = TempDir::new().unwrap();
    for step in [0.49e-3, 0.5e-3] {
        let points: Vec<String> = (0..27)
            .map(|at| format!("[{:?}, \"{} g0\"]", f64::from(at) * step, PULSE[at as usize]))
            .collect();
        let scene = format!(
            "[nodes]\nhead = {{ mass = 5, acceleration = {{ table = [{}] }} }}\n[measures]\nhead = [\"hic15\"]\n\
             [run]\nduration = {:?}\n",
            points.join(", "),
            26.0 * step
        );
        let path = file(&folder, "table.toml", &scene);
        let run = json(&["run", text(&path), "--json"]);
        let measures = &run["runs"][0]["measures"];
        let value = |key: &str| measures[key]["value"].as_f64().unwrap();
        let best = brute(&under_lines(&PULSE, step, 16), 0.015);
        let found = value("head.hic15");
        assert!(found >= best * (1.0 - 1e-9) && found <= best * 1.001, "{found}, of a grid {best}");
        let mut record = "t [s],a [g]\n".to_owned();
        for (at, value) in PULSE.iter().enumerate() {
            writeln!(record, "{:?},{value:?}", at as f64 * step).unwrap();
        }
        let path = file(&folder, "pulse.csv", &record);
        let read = json(&["signal", text(&path), "--json"]);
        for key in ["a.hic15", "a.hic36", "a.hic"] {
            let own = &read["channels"][0]["measures"][key];
            let [value, samples] = ["value", "on_samples"].map(|key| own[key].as_f64().unwrap());
            assert!((value / best - 1.0).abs() < 1e-3, "{key}: {value}, of a grid {best}");
            assert!(samples <= value * (1.0 + 1e-12), "{key}: {samples} of samples, and {value}");
        }
    }
}
