//! Laws at references far from where they work, beside closed forms.

use dashpot::{
    analysis::{RunReport, Solve},
    scene::{ReadOptions, read},
};

fn run(text: &str, method: &str) -> RunReport {
    let scene = read(text, &ReadOptions::default()).unwrap().value;
    scene
        .network
        .solve_with(&scene.settings(method).unwrap())
        .unwrap_or_else(|error| panic!("{method}: {error}\n{text}"))
}

/// Asserts that a measure is this within its bar, which is no wider than so.
fn is(report: &RunReport, key: &str, truth: f64, widest: f64) {
    let own = report.measure(key).unwrap_or_else(|| panic!("no {key}"));
    let (value, bar) = (own.value.unwrap(), own.error.unwrap());
    assert!((value - truth).abs() <= bar, "{key}: {value} ± {bar} for {truth}");
    assert!(bar <= widest * truth.abs(), "{key}: {value} ± {bar}");
}

/// The restitution of a mass that meets Hunt and Crossley's contact of `n = 3/2` at the number of damping
/// `d = c v`: `d (1 + e) = ln((1 + d)/(1 − e d))`.
fn restitution(d: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0_f64.min(d.recip()));
    for _ in 0..200 {
        let e = f64::midpoint(low, high);
        if d * (1.0 + e) > ((1.0 + d) / (1.0 - e * d)).ln() { low = e } else { high = e }
    }
    low
}

fn struck(speed: f64, law: &str, wish: &str, duration: f64) -> String {
    format!(
        "[nodes]\nm = {{ mass = 0.1, velocity = {speed} }}\n[elements]\n\
         c = {{ between = [\"m\", \"ground\"], {law} }}\n[measures]\n{wish}\n\
         [run]\nduration = {duration}\n"
    )
}

const RESTITUTION: &str = "c = [\"coefficient-of-restitution\"]";

#[test]
fn a_hertzian_contact_given_by_its_force_at_a_metre_gives_back_what_its_dissipation_tells() {
    let truth = restitution(0.3);
    assert!((truth - 0.832_870).abs() < 5e-7);
    for (speed, dissipation, duration) in [(1.0, 0.3, 3e-4), (0.01, 30.0, 8e-4)] {
        let law = format!(
            "hunt-crossley = {{ force = \"10 GN\", at = \"1 m\", dissipation = {dissipation} }}"
        );
        let report = run(&struck(speed, &law, RESTITUTION, duration), "auto");
        is(&report, "c.coefficient-of-restitution", truth, 1e-3);
        assert!(report.warnings.is_empty(), "{:?}", report.warnings);
        if speed < 0.1 {
            // By Runge and Kutta's classical method with steps of 2 ns.
            let peak = report.measure("c.peak-force").unwrap();
            let (value, bar) = (peak.value.unwrap(), peak.error.unwrap());
            assert!((value - 10.583_146_7).abs() <= bar, "{peak:?}");
        }
    }
}

#[test]
fn a_bumper_given_at_a_metre_gives_back_half_of_a_speed() {
    let law = "bumper = { force = \"10 GN\", at = \"1 m\", restitution = 0.5, speed = 0.1 }";
    let report = run(&struck(0.1, law, RESTITUTION, 1e-3), "auto");
    is(&report, "c.coefficient-of-restitution", 0.5, 1e-3);
    assert!(report.warnings.is_empty(), "{:?}", report.warnings);
}

const END: &str = "m = [{ kind = \"end-velocity\", window = \"run\" }, \
                   { kind = \"end-position\", window = \"run\" }]";

#[test]
fn a_cubic_dashpot_brakes_what_is_slow_as_long_as_it_moves() {
    // m v' = −C v³: v = v0/√(1 + 2 C v0² t/m), and the way is (m/C) (1/v − 1/v0).
    let law = "power-dashpot = { force = \"100 kN\", at = \"1 m/s\", exponent = 3 }";
    for (duration, widest) in [(10.0, 1e-3), (1e5, 0.1)] {
        let report = run(&struck(1e-3, law, END, duration), "auto");
        let v = 1e-3 / (2.0 * duration + 1.0).sqrt();
        is(&report, "m.end-velocity", v, widest);
        is(&report, "m.end-position", 1e-6 * (v.recip() - 1e3), widest);
    }
}

#[test]
fn a_dashpot_of_the_root_of_the_speed_stops_a_mass_in_time() {
    // m v' = −C √v: √v = √v0 − C t/(2 m), at rest after 2 m √v0/C, the way being (2 m/(3 C)) v0^(3/2).
    for (speed, force, at) in [(1e-4, 1.0, 1.0), (1e-4, 1e3, 1e6), (9.0, 1e-3, 1e-6)] {
        let c: f64 = force / f64::sqrt(at);
        let stop = 0.2 * f64::sqrt(speed) / c;
        let law = format!("power-dashpot = {{ force = {force:e}, at = {at:e}, exponent = 0.5 }}");
        let report = run(&struck(speed, &law, END, 1.5 * stop), "auto");
        is(&report, "m.end-position", 0.2 / (3.0 * c) * speed.powf(1.5), 1e-2);
        let end = report.measure("m.end-velocity").unwrap();
        let (value, bar) = (end.value.unwrap(), end.error.unwrap());
        assert!(value.abs() <= bar + 1e-9 * speed, "{value} ± {bar}");
    }
}
