//! What switches just before a run ends, or would just after.

use super::trial::{STEPPING, run};

const GRAVITY: f64 = 9.806_65;

#[test]
fn errors_cover_both_sides_where_a_body_comes_down_at_the_end_of_the_run() {
    let (height, restitution) = (0.03, 0.5);
    let fall = (2.0 * height / GRAVITY).sqrt();
    for part in [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12].into_iter().flat_map(|part| [part, -part]) {
        let duration = fall * (1.0 + part);
        let text = format!(
            "
            [nodes]
            ball = {{ mass = 1 }}
            [elements]
            floor = {{ between = [\"ball\", \"ground\"], contact = {{ gap = {height}, restitution = {restitution} }} }}
            [effects]
            gravity = {{ start = \"unloaded\" }}
            [measures]
            ball = [{{ kind = \"end-velocity\", window = \"run\" }}]
            [run]
            duration = {duration:?}
            "
        );
        let back = if part > 0.0 { (1.0 + restitution) * fall } else { 0.0 };
        let truth = GRAVITY * (duration - back);
        for method in STEPPING {
            let report = run(&text, method);
            let velocity = report.measure("ball.end-velocity").unwrap();
            let (value, error) = (velocity.value.unwrap(), velocity.error.unwrap());
            // The duration is known to a rounding.
            let known = 8.0 * f64::EPSILON * truth.abs();
            assert!(
                (value - truth).abs() <= error + known,
                "{method}, {part:e}: {value} ±{error:e}, not {truth}"
            );
        }
    }
}
