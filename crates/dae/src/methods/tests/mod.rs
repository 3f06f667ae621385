#![expect(clippy::float_cmp, reason = "what is promised to the last bit is compared so")]

use super::*;
use crate::{
    Silent,
    tests::problems::{self, Problem},
};

mod drives;
mod guards;
mod limits;

/// What takes too many steps where a problem is stiff.
const EXPLICIT: [&str; 2] = ["tsit45", "dop853"];

/// Times at which solutions are compared.
fn times(problem: &Problem) -> Vec<f64> {
    (0..=400).map(|k| problem.t_end * f64::from(k) / 400.0).collect()
}

/// Solves the problem and returns the largest error of samples and of signals, dimensionless.
fn solve(method: &dyn Method, problem: &Problem, rtol: f64) -> (Trajectory, f64, f64) {
    let system = &problem.system;
    let run = Run::to(problem.t_end).with_rtol(rtol);
    let trajectory = method.integrate(system, &run, &mut Silent).unwrap();
    let times = times(problem);
    let hats: Vec<f64> = times.iter().map(|t| t / system.time_scale).collect();
    let samples = trajectory.dense.sample(system, &hats);
    let signals: Vec<_> = (0..system.len()).map(|k| trajectory.signal(system, k)).collect();
    let (mut in_samples, mut in_signals) = (0.0_f64, 0.0_f64);
    for (&time, row) in times.iter().zip(samples.chunks_exact(system.len())) {
        for (at, exact) in problem.exact(time).into_iter().enumerate() {
            in_samples = in_samples.max((row[at] - exact).abs());
            let value = signals[at].value(time) / system.outputs.at(at).scale;
            in_signals = in_signals.max((value - exact).abs());
        }
    }
    (trajectory, in_samples, in_signals)
}

/// The names of the step-by-step methods.
fn steppers() -> impl Iterator<Item = &'static str> {
    METHODS.iter().filter(|own| own.order.is_some()).map(|own| own.name)
}

/// Calls `judge` with every step-by-step method and every problem that it claims.
fn for_all_steppers(mut judge: impl FnMut(&dyn Method, &Problem)) {
    for problem in problems::all() {
        for name in steppers() {
            let method = by_name(name).unwrap();
            let claims = method.applies(&problem.system, &Run::to(problem.t_end)).is_ok();
            if claims && !(problem.stiff && EXPLICIT.contains(&name)) {
                judge(&*method, &problem);
            }
        }
    }
}

/// Orders that the ladder of tolerances must show: a method of order q that keeps the error of each
/// step at the tolerance has a global error like its power q/(q + 1).
fn least_slope(method: &str) -> f64 {
    match method {
        // Of variable order; with steps that the rates of a system limit; with a step for the error of one
        // order less.
        "bdf" | "dop853" => 0.7,
        "tsit45" => 0.85,
        name => {
            let order = METHODS.iter().find(|own| own.name == name).and_then(|own| own.order);
            let order = f64::from(order.unwrap_or(1));
            order / (order + 1.0) - 0.045
        }
    }
}

#[test]
fn names_in_the_register_are_unique_and_found() {
    let methods = all();
    for method in &methods {
        let same = methods.iter().filter(|other| other.name() == method.name()).count();
        assert_eq!(same, 1, "{}", method.name());
        assert_eq!(by_name(method.name()).unwrap().name(), method.name());
        assert!(!method.summary().is_empty());
    }
    assert!(by_name("euler").is_none());
}

#[test]
fn error_falls_with_the_tolerance() {
    for_all_steppers(|method, problem| {
        let ladder = [1e-4, 1e-6, 1e-8, 1e-10];
        let errors = ladder.map(|rtol| solve(method, problem, rtol).1);
        let what = format!("{} on {}: {errors:?}", method.name(), problem.name);
        // Where the solution is a low polynomial, only rounding is left.
        let rounding = if problem.t_end > 1.0 { 1e-10 } else { 3e-13 };
        for pair in errors.windows(2) {
            assert!(pair[1] <= pair[0] || pair[1] < rounding, "{what}");
        }
        let slope = (errors[0] / errors[3]).log10() / 6.0;
        assert!(slope > least_slope(method.name()) || errors[0] < 1e-6, "{what}, slope {slope}");
        assert!(errors[0] < 1e-2, "{what}");
    });
}

#[test]
fn signals_and_samples_are_the_same_solution() {
    for_all_steppers(|method, problem| {
        let (_, samples, signals) = solve(method, problem, 1e-5);
        let what = format!("{} on {}", method.name(), problem.name);
        let size = if problem.t_end > 1.0 { 500.0 } else { 1.0 };
        assert!((samples - signals).abs() < 1e-13 * size, "{what}: {samples} {signals}");
    });
}

#[test]
fn exact_solutions_leave_only_rounding() {
    for problem in problems::all() {
        for method in all().iter().filter(|method| method.is_exact()) {
            if method.applies(&problem.system, &Run::to(problem.t_end)).is_err() {
                continue;
            }
            let (_, samples, signals) = solve(&**method, &problem, 1e-6);
            let size = if problem.t_end > 1.0 { 500.0 } else { 1.0 };
            assert!(samples.max(signals) < 1e-12 * size, "{}: {samples} {signals}", problem.name);
        }
    }
}

#[test]
fn auto_takes_the_exact_method_where_it_applies_and_else_an_explicit_one_where_nothing_is_stiff() {
    let mut taken = Vec::new();
    for problem in problems::all() {
        let run = Run::to(problem.t_end);
        let system = &problem.system;
        let trajectory = Auto.integrate(system, &run, &mut Silent).unwrap();
        let span = (0.0, problem.t_end / system.time_scale);
        let is_explicit =
            || system.len() <= 30 && !stepping::is_stiff(system, &system.initial, span);
        let chosen = match Exact.applies(system, &run) {
            Ok(_) => "exact",
            Err(_) if is_explicit() => "dop853",
            Err(_) => "bdf",
        };
        assert_eq!(trajectory.method, chosen, "{}", problem.name);
        assert!(Auto.applies(system, &run).unwrap().contains(trajectory.method));
        taken.push((problem.name, chosen));
    }
    assert!(taken.contains(&("mass on a cubic spring", "dop853")), "{taken:?}");
}

#[test]
fn a_run_repeats_to_the_bit() {
    for_all_steppers(|method, problem| {
        let (first, ..) = solve(method, problem, 1e-6);
        let (second, ..) = solve(method, problem, 1e-6);
        let (first_wall, second_wall) = (first.statistics.wall, second.statistics.wall);
        let without = |trajectory: &Trajectory, wall| {
            let mut statistics = trajectory.statistics;
            assert_eq!(statistics.wall, wall);
            statistics.wall = std::time::Duration::ZERO;
            statistics
        };
        assert_eq!(without(&first, first_wall), without(&second, second_wall));
        let times: Vec<f64> = times(problem).iter().map(|t| t / 0.01).collect();
        let (a, b) = (
            first.dense.sample(&problem.system, &times),
            second.dense.sample(&problem.system, &times),
        );
        assert!(a.iter().zip(&b).all(|(a, b)| a.to_bits() == b.to_bits()));
    });
}

#[test]
fn the_work_has_not_grown() {
    // Steps, evaluations of the right-hand side, factorisations and linear systems at 1e-6.
    let pinned = [
        ("bdf", 252, 290, 30, 290),
        ("tr-bdf2", 958, 2300, 66, 3300),
        ("esdirk34", 374, 1350, 40, 1750),
        ("tsit45", 82, 520, 0, 0),
        ("dop853", 44, 665, 0, 0),
    ];
    let problem = problems::underdamped();
    for (name, steps, calls, factorizations, solves) in pinned {
        let work = solve(&*by_name(name).unwrap(), &problem, 1e-6).0.statistics;
        assert!(
            work.accepted > steps / 2 && work.accepted <= steps + steps / 50,
            "{name} {work:?}"
        );
        assert!(work.rhs_calls > work.accepted && work.rhs_calls <= calls, "{name} {work:?}");
        assert!(work.factorizations <= factorizations, "{name} {work:?}");
        assert!(work.linear_solves <= solves, "{name} {work:?}");
        assert!((work.factorizations > 0) == (factorizations > 0), "{name} {work:?}");
        assert!((work.jacobian_calls > 0) == (factorizations > 0), "{name} {work:?}");
        assert!((work.linear_solves > 0) == (solves > 0), "{name} {work:?}");
        assert!(!work.wall.is_zero(), "{name}");
    }
}

#[test]
fn a_short_pulse_inside_a_long_run_is_not_missed() {
    let problem = problems::struck_by_pulse();
    for name in steppers().chain(["exact"]) {
        let run = Run::to(problem.t_end);
        let trajectory =
            by_name(name).unwrap().integrate(&problem.system, &run, &mut Silent).unwrap();
        let velocity = trajectory.signal(&problem.system, 1);
        let scale = problem.system.outputs.at(1).scale;
        assert_eq!(velocity.value(0.49 * problem.t_end), 0.0, "{name}");
        let gained = velocity.value(problem.t_end) / scale;
        let impulse = problem.exact(problem.t_end)[1];
        assert!((gained - impulse).abs() < 1e-9, "{name}: {gained} of {impulse}");
    }
}

#[test]
fn methods_converge_on_every_problem_that_they_claim() {
    for method in all() {
        let name = method.name();
        let mut solved = 0;
        for problem in problems::all() {
            let run = Run::to(problem.t_end);
            if method.applies(&problem.system, &run).is_err() {
                assert!(method.integrate(&problem.system, &run, &mut Silent).is_err());
                continue;
            }
            if problem.stiff && EXPLICIT.contains(&name) {
                continue;
            }
            let end = problem.t_end / problem.system.time_scale;
            let error = |rtol: f64| {
                let trajectory = method
                    .integrate(&problem.system, &run.clone().with_rtol(rtol), &mut Silent)
                    .unwrap();
                let found = trajectory.dense.sample(&problem.system, &[end]);
                let truth = problem.exact(problem.t_end);
                found.iter().zip(&truth).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
            };
            let [coarse, fine] = [1e-4, 1e-8].map(error);
            // Every method converges: four decades of tolerance gain two of error at least, down to
            // the rounding of the problem.
            let what = format!("{name} on {}: {coarse:e}, {fine:e}", problem.name);
            assert!(fine <= (1e-2 * coarse).max(1e-9), "{what}");
            solved += 1;
        }
        assert!(solved >= 5, "{name} solves only {solved} problems");
    }
}
