//! Drops that are minute beside what a weight could do in the time of the run.

use dashpot::analysis::RunReport;

use super::trial::{ALL, STEPPING, run};

const GRAVITY: f64 = 9.806_65;

fn scene(duration: f64, floor: &str) -> String {
    format!(
        "
        [nodes]
        ball = {{ mass = 1 }}
        [elements]
        floor = {{ between = [\"ball\", \"ground\"], {floor} }}
        [effects]
        gravity = {{ start = \"unloaded\" }}
        [run]
        duration = {duration}
        "
    )
}

fn solved(duration: f64, floor: &str, method: &str) -> RunReport {
    run(&scene(duration, floor), method)
}

#[test]
fn balls_touch_the_floor_when_they_have_fallen_however_long_the_run_is() {
    for height in [1e-9, 1e-6, 1e-3] {
        for duration in [0.1, 10.0, 1000.0] {
            for method in ALL {
                let floor = format!("contact = {{ gap = {height}, restitution = 0.5 }}");
                let report = solved(duration, &floor, method);
                let first =
                    report.trajectory.switches.first().map_or(f64::NAN, |switch| switch.time);
                let error = first / (2.0 * height / GRAVITY).sqrt() - 1.0;
                // 1000 times the tolerance that accuracies of 0.1 % take at most.
                assert!(error.abs() < 1e-2, "{method}, {height} m in {duration} s: {error:e}");
            }
        }
    }
}

#[test]
fn balls_that_lose_nothing_are_where_they_should_be_after_thousands_of_bounces() {
    for (height, duration) in [(3.631e-9, 0.7404), (1e-6, 1.0), (1e-3, 10.0)] {
        let floor = format!("contact = {{ gap = {height}, restitution = 1 }}");
        let text = scene(duration, &floor)
            + "[measures]\nball = [{ kind = \"end-velocity\", window = \"run\" }]\n";
        let report = run(&text, "exact");
        let own = report.measure("ball.end-velocity").unwrap();
        let fall = (2.0 * height / GRAVITY).sqrt();
        let since = (duration - fall) % (2.0 * fall);
        let difference = (own.value.unwrap() - GRAVITY * (since - fall)).abs();
        // What the rounding of the fall's time makes of the time since the last bounce.
        let rounding = 4.0 * f64::EPSILON * GRAVITY * duration;
        let bound = own.error.unwrap();
        assert!(difference <= bound + rounding, "{height} m: {difference:e}, not {bound:e}");
        // Perturbed digits of the speed shift every later bounce.
        assert!(bound <= 1e-4 * GRAVITY * fall, "{height} m: {bound:e}");
    }
}

#[test]
fn balls_near_the_end_of_their_bounces_are_where_they_should_be() {
    // After bounce n the ball comes with e^n of its first speed v, and n flights of 2 e^k v/g lie behind it.
    let (height, restitution, bounces) = (6.3497e-9, 0.996_136_f64, 900);
    let fall = (2.0_f64 * height / GRAVITY).sqrt();
    let share = restitution.powi(bounces);
    let flights = 2.0 * restitution * (1.0 - share) / (1.0 - restitution);
    let duration = fall * (1.0 + flights + 0.5 * restitution * share);
    let floor = format!("contact = {{ gap = {height:e}, restitution = {restitution} }}");
    let text = scene(duration, &floor)
        + "[measures]\nball = [{ kind = \"end-velocity\", window = \"run\" }]\n";
    let report = run(&text, "exact");
    let own = report.measure("ball.end-velocity").unwrap();
    // A quarter of the flight after bounce n + 1.
    let truth = -0.5 * GRAVITY * fall * restitution * share;
    let difference = (own.value.unwrap() - truth).abs();
    let rounding = 8.0 * f64::EPSILON * GRAVITY * duration;
    let bound = own.error.unwrap();
    assert!(difference <= bound + rounding, "{difference:e}, not {bound:e}");
    assert!(bound <= 1e-6 * truth.abs(), "{bound:e}");
}

#[test]
fn pads_give_way_to_short_drops_as_they_do_exactly_however_long_the_run_is() {
    let damped = "{ kelvin-voigt = { spring = 1e6, dashpot = 1000 } }";
    for height in [1e-9, 1e-6] {
        let floor = format!("series = [{{ contact = {{ gap = {height} }} }}, {damped}]");
        for duration in [1.0, 10.0] {
            let exact = solved(duration, &floor, "exact");
            for method in STEPPING {
                let report = solved(duration, &floor, method);
                let peak = |report: &RunReport| {
                    let peak = report.measure("floor.peak-force").unwrap();
                    (peak.value.unwrap(), peak.error.unwrap())
                };
                let ((value, error), (truth, bound)) = (peak(&report), peak(&exact));
                let difference = (value - truth).abs();
                assert!(
                    difference <= error + bound,
                    "{method}, {height} m in {duration} s: {difference:e}, not {error:e}"
                );
            }
        }
    }
}
