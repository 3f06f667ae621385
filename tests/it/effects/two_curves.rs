//! Paddings with measured curves of loading and of unloading: areas between the curves, and the
//! speed with which a mass leaves.
//!
//! Points on straight lines keep everything in closed form: `f = k y`, and back along
//! `k (y − r y_m)/(1 − r)`, which gives back the part `1 − r`, from whatever depth.

use dashpot::analysis::RunReport;

use super::trial::{STEPPING, run};

/// Stiffness of loading [N/m], depth of the measurement [m], set.
const K: f64 = 5e4;
const Y: f64 = 0.02;
const R: f64 = 0.25;

fn points(own: impl Fn(f64) -> f64, from: f64) -> String {
    let parts = [0.0, 0.2, 0.3, 0.55, 0.8, 1.0].map(|part| from + part * (1.0 - from));
    let points = parts.map(|part| format!("[{:?}, {:?}]", part * Y, own(part)));
    format!("[{}]", points.join(", "))
}

/// Curves on straight lines.
fn straight() -> String {
    let loading = points(|part| K * Y * part, 0.0);
    let unloading = points(|part| K * Y * (part - R) / (1.0 - R), R);
    format!("hysteretic-table = {{ loading = {loading}, unloading = {unloading} }}")
}

/// The part of the energy of a press that comes back.
fn part_given_back() -> f64 {
    1.0 - R
}

fn drop_on(pad: &str, mass: f64, speed: f64, duration: f64) -> String {
    format!(
        "[nodes]\nbox = {{ mass = {mass:?}, velocity = {speed:?} }}\n\
         [elements]\npad = {{ between = [\"box\", \"ground\"], {pad} }}\n\
         [measures]\npad = [\"coefficient-of-restitution\"]\nbox = [\"end-velocity\"]\n\
         [accuracy]\npad.energy-at-end = 1e-6\n[run]\nduration = {duration:?}\n"
    )
}

fn value(report: &RunReport, key: &str) -> f64 {
    report.measure(key).and_then(|own| own.value).unwrap_or_else(|| panic!("no {key}"))
}

/// As in [`super::trial`].
fn allowed(report: &RunReport) -> f64 {
    let errors = if report.solver.method == "tr-bdf2" { 1e4 } else { 1e3 };
    errors * report.solver.rtol.expect("a stepping method")
}

#[test]
fn a_mass_leaves_with_the_root_of_the_ratio_of_both_areas() {
    let mass = 2.0;
    let restitution = part_given_back().sqrt();
    // Less deep than measured, as deep, and deeper, where the curve goes on as a straight line.
    for depth in [0.3 * Y, Y, 1.5 * Y] {
        let speed = depth * (K / mass).sqrt();
        let energy = 0.5 * mass * speed * speed;
        for method in STEPPING {
            let report = run(&drop_on(&straight(), mass, speed, 0.1), method);
            let near = allowed(&report);
            let is = |key: &str, exact: f64| {
                let found = value(&report, key);
                let stated = report.measure(key).and_then(|own| own.error).unwrap_or(0.0);
                let near = stated + near * exact.abs();
                assert!((found - exact).abs() <= near, "{method}: {key} {found}, not {exact}");
            };
            is("pad.coefficient-of-restitution", restitution);
            is("box.end-velocity", -restitution * speed);
            is("pad.peak-deformation", depth);
            is("pad.peak-force", K * depth);
            is("pad.energy-at-end", energy * (1.0 - part_given_back()));
            let lost = report.energy.total_dissipated() / (energy * (1.0 - part_given_back()));
            let stated =
                report.measure("pad.energy-at-end").and_then(|own| own.error).unwrap_or(0.0);
            let near_lost = near.max(1e-6) + stated / (energy * (1.0 - part_given_back()));
            assert!((lost - 1.0).abs() <= near_lost, "{method}: {lost}");
            assert!(report.energy.closure().abs() <= near.max(1e-6), "{method}");
            let beyond = report
                .warnings
                .iter()
                .any(|warning| warning.to_string().contains("beyond the end of its law"));
            assert_eq!(beyond, depth > Y, "{:?}", report.warnings);
            assert!(report.warnings.iter().all(|warning| !warning.code().contains("pulls")
                && !warning.to_string().contains("pulls")));
        }
    }
}

#[test]
fn two_straight_curves_give_back_what_they_say_and_the_documented_ones_their_areas() {
    let pad = |loading: &str, unloading: &str| {
        format!("hysteretic-table = {{ loading = {loading}, unloading = {unloading} }}")
    };
    // Back along k/0.8²: 0.64 of 4 J.
    let lines = [
        pad("[[0, 0], [0.02, 400]]", "[[0.0072, 0], [0.02, 400]]"),
        pad("[[0, 0], [0.003, 60], [0.02, 400]]", "[[0.0072, 0], [0.0136, 200], [0.02, 400]]"),
        pad(
            "[[0, 0], [0.019, 380], [0.02, 400]]",
            "[[0, 0], [0.0072, 0], [0.0104, 100], [0.02, 400]]",
        ),
    ];
    for text in &lines {
        for method in STEPPING {
            let report = run(&drop_on(text, 2.0, 2.0, 0.06), method);
            let near = allowed(&report);
            assert!((value(&report, "pad.coefficient-of-restitution") - 0.8).abs() <= near);
            assert!((value(&report, "pad.energy-at-end") - 1.44).abs() <= 4.0 * near.max(1e-6));
        }
    }
    // The example of docs/elements.md, whose areas a script has summed: 18.633 333 J of 27.823 347 J.
    let text = pad(
        "[[0, 0], [\"2 mm\", \"0.4 kN\"], [\"8 mm\", \"0.7 kN\"], [\"20 mm\", \"4 kN\"]]",
        "[[\"4 mm\", 0], [\"8 mm\", \"0.1 kN\"], [\"20 mm\", \"4 kN\"]]",
    );
    let report = run(&drop_on(&text, 2.0, 27.823_346_56_f64.sqrt(), 0.1), "bdf");
    assert!((value(&report, "pad.peak-deformation") - 0.02).abs() < 1e-6);
    let found = value(&report, "pad.coefficient-of-restitution");
    assert!((found - 0.818_352_8).abs() < 1e-6, "{found}");
}

/// Cubics through points of no particular law are judged by areas that this sums itself.
#[test]
fn curves_of_a_foam_test_give_back_the_area_below_the_second_one() {
    let loading = "[[0, 0], [\"2 mm\", \"0.4 kN\"], [\"8 mm\", \"0.7 kN\"], [\"14 mm\", \"1.2 kN\"], [\"20 mm\", \"4 kN\"]]";
    let unloading =
        "[[\"4 mm\", 0], [\"8 mm\", \"0.1 kN\"], [\"14 mm\", \"0.3 kN\"], [\"20 mm\", \"4 kN\"]]";
    let pad = format!("hysteretic-table = {{ loading = {loading}, unloading = {unloading} }}");
    // A slow press to the depth of the measurement and back goes through all points.
    let text = format!(
        "[nodes]\nplate = {{ motion = {{ table = [[0, 0], [\"1 s\", \"20 mm\"], [\"2 s\", 0]] }} }}\n\
         [elements]\npad = {{ between = [\"plate\", \"ground\"], {pad} }}\n\
         [accuracy]\npad.energy-at-end = 1e-6\n[run]\nduration = \"2 s\"\n"
    );
    let report = run(&text, "bdf");
    let near = allowed(&report);
    let solution = report.solution();
    let force = solution.signal(report.assembly.output("pad.force").unwrap());
    for (time, exact) in [(0.1, 400.0), (0.4, 700.0), (0.7, 1200.0), (1.3, 300.0), (1.6, 100.0)] {
        let found = force.value(time);
        assert!((found - exact).abs() <= near * 4e3, "{time} s: {found} N, not {exact}");
    }
    let (mut put_in, mut given_back) = (0.0, 0.0);
    let steps = 20_000;
    for at in 0..steps {
        let part = (f64::from(at) + 0.5) / f64::from(steps);
        let step = 0.02 / f64::from(steps);
        put_in += step * force.value(part);
        given_back += step * force.value(2.0 - part);
    }
    let taken = value(&report, "pad.energy-at-end");
    assert!((taken / (put_in - given_back) - 1.0).abs() < 1e-6, "{taken} {put_in} {given_back}");
    // A mass that is stopped at that depth leaves with what the second curve gives back.
    let mass = 1.5;
    let speed = (2.0 * put_in / mass).sqrt();
    for method in STEPPING {
        let report = run(&drop_on(&pad, mass, speed, 0.1), method);
        let found = value(&report, "pad.coefficient-of-restitution");
        let exact = (given_back / put_in).sqrt();
        assert!(
            (found / exact - 1.0).abs() <= 1e-6 + allowed(&report),
            "{method}: {found} {exact}"
        );
    }
}
