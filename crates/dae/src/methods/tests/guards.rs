use super::*;
use crate::{Direction, Guard, Outcome};

fn guard(output: usize, level: f64, direction: Direction, stops: bool) -> Guard {
    Guard {
        name: format!("{output} at {level}"),
        output,
        level,
        direction,
        stops,
        begins: None,
        rate_of: None,
    }
}

/// All methods but those that only choose.
fn methods() -> Vec<Box<dyn Method>> {
    all().into_iter().filter(|method| method.name() != "auto").collect()
}

fn run(problem: &Problem, guards: Vec<Guard>) -> Run {
    Run { guards, ..Run::to(problem.t_end).with_rtol(1e-8) }
}

#[test]
fn a_stopping_guard_cuts_the_run_at_its_crossing() {
    // x = 1 − t/2 is zero at t = 2; at the same instant it leaves the watched band from above.
    let problem = problems::free_motion();
    let guards = vec![
        guard(0, -0.25, Direction::Either, false),
        guard(0, 0.25, Direction::Either, false),
        guard(0, 0.0, Direction::Falling, true),
    ];
    for method in methods() {
        let run = run(&problem, guards.clone());
        let trajectory = method.integrate(&problem.system, &run, &mut Silent).unwrap();
        let name = method.name();
        assert_eq!(trajectory.outcome, Outcome::Stopped { guard: 2 }, "{name}");
        let expected = 2.0 * problem.system.time_scale;
        assert!((trajectory.t_end - expected).abs() < 1e-12, "{name}: {}", trajectory.t_end);
        let found: Vec<usize> = trajectory.events.iter().map(|event| event.guard).collect();
        assert_eq!(found, [1, 2], "{name}");
        assert_eq!(trajectory.events[1].time, trajectory.t_end, "{name}");
        let signal = trajectory.signal(&problem.system, 0);
        assert_eq!(signal.end(), trajectory.t_end, "{name}");
        assert!(signal.value(trajectory.t_end).abs() < 1e-12, "{name}");
        assert!((signal.value(0.5 * expected) - 0.25).abs() < 1e-12, "{name}");
    }
}

#[test]
fn guards_at_one_instant_are_all_reported_in_order() {
    // Position and twice the position cross their levels together, as do both directions' guards.
    let mut problem = problems::underdamped();
    let own = problem.system.outputs.at(0);
    let (unit, scale, unknowns, inputs) =
        (own.unit, 2.0 * own.scale, own.unknowns.to_form(), own.inputs.to_form());
    problem.system.outputs.push("double", unit, scale, &unknowns, &inputs);
    let guards = vec![
        guard(2, 0.0, Direction::Falling, false),
        guard(0, 0.0, Direction::Falling, true),
        guard(0, 0.0, Direction::Rising, true),
        guard(2, 0.0, Direction::Either, true),
    ];
    for method in methods() {
        let run = run(&problem, guards.clone());
        let trajectory = method.integrate(&problem.system, &run, &mut Silent).unwrap();
        let found: Vec<usize> = trajectory.events.iter().map(|event| event.guard).collect();
        assert_eq!(found, [0, 1, 3], "{}", method.name());
        assert_eq!(trajectory.outcome, Outcome::Stopped { guard: 1 }, "{}", method.name());
        assert!(trajectory.events.iter().all(|event| !event.rising));
        assert!(trajectory.events.iter().all(|event| event.time <= trajectory.t_end));
    }
}

#[test]
fn every_method_finds_the_events_of_the_exact_solution() {
    let problem = problems::underdamped();
    let guards = vec![
        guard(0, 0.1, Direction::Either, false),
        guard(1, 0.0, Direction::Rising, false),
        guard(1, 0.0, Direction::Falling, false),
    ];
    let events = |name: &str| {
        let method = by_name(name).unwrap();
        let run = run(&problem, guards.clone());
        method.integrate(&problem.system, &run, &mut Silent).unwrap().events
    };
    let exact = events("exact");
    assert!(exact.len() > 10);
    for name in steppers() {
        let found = events(name);
        assert_eq!(found.len(), exact.len(), "{name}");
        for (found, exact) in found.iter().zip(&exact) {
            assert_eq!((found.guard, found.rising), (exact.guard, exact.rising), "{name}");
            let late = (found.time - exact.time).abs() / problem.system.time_scale;
            assert!(late < 3e-4, "{name}: {late}");
        }
    }
}

#[test]
fn a_guard_that_starts_on_its_level_is_armed_and_does_not_fire() {
    // The position starts at 0.5 m, rises, and comes back through 0.5 m once in the first period.
    let problem = problems::underdamped();
    for level in [0.5, 0.5 * (1.0 + f64::EPSILON), 0.5 * (1.0 - f64::EPSILON)] {
        for method in methods() {
            let run = run(&problem, vec![guard(0, level, Direction::Either, true)]);
            let trajectory = method.integrate(&problem.system, &run, &mut Silent).unwrap();
            assert_eq!(trajectory.outcome, Outcome::Stopped { guard: 0 }, "{}", method.name());
            assert!(!trajectory.events[0].rising, "{}", method.name());
            assert!(trajectory.t_end > 0.5 * problem.system.time_scale, "{}", method.name());
        }
    }
}

#[test]
fn a_value_that_decays_to_its_level_never_crosses_it() {
    let problem = problems::diagonal_chain();
    for method in methods() {
        let run = run(&problem, vec![guard(39, 0.0, Direction::Either, true)]);
        let trajectory = method.integrate(&problem.system, &run, &mut Silent).unwrap();
        assert!(trajectory.events.is_empty(), "{}: {:?}", method.name(), trajectory.events);
    }
}

#[test]
fn a_jump_across_the_level_is_an_event_at_its_time() {
    // The force is let go from e⁻¹ to e⁻¹ − 1 at t = 1.
    let problem = problems::maxwell_under_steps();
    for method in methods() {
        let run = run(&problem, vec![guard(1, 0.0, Direction::Falling, true)]);
        let Ok(trajectory) = method.integrate(&problem.system, &run, &mut Silent) else {
            assert!(matches!(method.name(), "tsit45" | "dop853" | "exact"));
            continue;
        };
        assert_eq!(trajectory.outcome, Outcome::Stopped { guard: 0 }, "{}", method.name());
        assert!((trajectory.t_end - problem.system.time_scale).abs() < 1e-15, "{}", method.name());
    }
}
