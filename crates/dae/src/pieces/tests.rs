//! What is kept and summed up on the way, judged by runs of which everything is kept.

use std::sync::Arc;

use crate::{
    Direction, Guard, Keep, LinearForm, Method, Part, Run, Silent, Trajectory,
    methods::{Bdf, Esdirk34, TrBdf2},
    tests::problems::{self, Problem},
};

/// A problem with two more outputs: the sum of all unknowns, and the difference of the first two with
/// all driving functions in it.
fn problem(problem: Problem) -> Problem {
    let mut problem = problem;
    let system = &mut problem.system;
    let form = |count: usize, sign: f64| {
        let term = |at: usize| (at, if at % 2 == 1 { sign } else { 1.0 });
        LinearForm::sum((0..count).map(term))
    };
    let inputs = LinearForm::sum((0..system.inputs.len()).map(|at| (at, 0.5)));
    let sum = form(system.unknowns.len(), 1.0);
    system.outputs.push("sum", "m", 0.25, &sum, &LinearForm::zero());
    system.outputs.push("driven", "m", 0.25, &form(2, -1.0), &inputs);
    problem
}

fn problems() -> Vec<Problem> {
    problems::all().into_iter().filter(|own| own.system.len() > 1).map(problem).collect()
}

fn methods() -> [Box<dyn Method>; 3] {
    [Box::new(Bdf), Box::new(TrBdf2), Box::new(Esdirk34)]
}

/// Runs in which everything is kept, and in which a part is.
fn both(method: &dyn Method, own: &Problem, part: &Part, guards: &[Guard]) -> [Trajectory; 2] {
    let run = Run { guards: guards.to_vec(), ..Run::to(own.t_end).with_rtol(1e-5) };
    let part = Run { keep: Keep::Part(Arc::new(part.clone())), ..run.clone() };
    [run, part].map(|run| method.integrate(&own.system, &run, &mut Silent).unwrap())
}

/// Squares, pairs of different unknowns, and what is driven.
fn products(own: &Problem) -> Vec<[usize; 2]> {
    let count = own.system.outputs.len();
    vec![[1, 1], [0, 1], [count - 2, 0], [count - 1, 1], [count - 1, count - 1]]
}

#[test]
fn kept_outputs_are_those_of_a_full_run_to_the_bit() {
    for problem in problems() {
        for method in methods() {
            let part = Part { outputs: vec![1], ..Part::default() };
            let [all, some] = both(&*method, &problem, &part, &[]);
            assert_eq!(
                all.signal(&problem.system, 1),
                some.signal(&problem.system, 1),
                "{}",
                problem.name
            );
            assert_eq!(all.statistics.accepted, some.statistics.accepted);
            assert!(some.keeps(&problem.system, 1) && all.keeps(&problem.system, 0));
        }
    }
}

#[test]
fn rates_of_what_balances_determine_follow_from_the_equations() {
    let Problem { system, t_end, .. } = problems::maxwell_relaxation();
    let run = Run::to(t_end).with_rtol(1e-3);
    let trajectory = Bdf.integrate(&system, &run, &mut Silent).unwrap();
    for time in [0.3 * t_end, 0.7 * t_end, t_end] {
        let rate = trajectory.dense.values(&system, 1, 1, &[time]).unwrap()[0];
        let scale = system.outputs.at(1).scale / system.time_scale;
        let dashpot = trajectory.dense.sample(&system, &[time / system.time_scale])[0];
        assert!((rate / scale - (dashpot - 1.0)).abs() < 1e-14, "{rate}");
        let slope = trajectory.signal(&system, 1).slope(time);
        assert!((slope - rate).abs() > 1e-6 * rate.abs(), "a slope as good: {slope}");
    }
}

#[test]
fn output_that_was_not_kept_is_not_a_number() {
    let own = problem(problems::vibrating_chain());
    let part = Part { outputs: vec![1], ..Part::default() };
    let [_, some] = both(&Bdf, &own, &part, &[]);
    let sum = own.system.outputs.len() - 2;
    for output in [0, sum] {
        assert!(!some.keeps(&own.system, output));
        let signal = some.signal(&own.system, output);
        assert!(signal.value(0.0).is_nan() && signal.value(own.t_end).is_nan());
        assert!(signal.integral((0.0, own.t_end)).is_nan());
    }
    assert!(some.dense.sample(&own.system, &[0.0]).is_empty());
}

#[test]
fn rows_hold_what_is_kept_only() {
    let own = problem(problems::vibrating_chain());
    let part = Part { outputs: vec![1], ..Part::default() };
    let [all, some] = both(&Bdf, &own, &part, &[]);
    let rows = (all.dense.bytes() - some.dense.bytes()) / size_of::<f64>();
    // One row more than steps, and one unknown of all.
    assert_eq!(rows, (all.statistics.accepted + 1) * (own.system.len() - 1));
}

#[test]
fn ends_and_products_are_those_of_the_full_run() {
    for problem in problems() {
        for method in methods() {
            let part = Part { products: products(&problem), ..Part::default() };
            let [all, some] = both(&*method, &problem, &part, &[]);
            assert_digest(&problem, &all, &some, &part);
        }
    }
}

#[test]
fn ends_and_products_reach_to_a_stop_within_a_step() {
    for own in [problems::vibrating_chain(), problems::underdamped()].map(problem) {
        for method in methods() {
            let level = 0.3 * own.system.outputs.at(0).scale * own.exact(0.0)[0];
            let guard = Guard {
                name: "stop".to_owned(),
                output: 0,
                level,
                direction: Direction::Either,
                stops: true,
                begins: None,
                rate_of: None,
            };
            let part = Part { products: products(&own), ..Part::default() };
            let [all, some] = both(&*method, &own, &part, &[guard]);
            assert!(all.t_end < own.t_end, "{}", own.name);
            assert_digest(&own, &all, &some, &part);
        }
    }
}

/// Compares within the roundings of sums over all steps.
fn assert_digest(problem: &Problem, all: &Trajectory, some: &Trajectory, part: &Part) {
    let system = &problem.system;
    let digest = some.digest().expect("a digest");
    assert!(all.digest().is_none());
    assert_eq!(all.t_end.to_bits(), some.t_end.to_bits());
    let window = (0.0, all.t_end);
    for output in 0..system.outputs.len() {
        let signal = all.signal(system, output);
        let rounding = 64.0 * f64::EPSILON * signal.bound();
        let [first, last] = digest.ends(system, output);
        assert!((first - signal.value(0.0)).abs() <= rounding, "{}: {first}", problem.name);
        let expected = signal.left_value(all.t_end);
        assert!((last - expected).abs() <= rounding, "{}: {last} {expected}", problem.name);
    }
    for (product, pair) in digest.products.iter().zip(&part.products) {
        let [a, b] = pair.map(|output| all.signal(system, output));
        let expected = a.integral_of_product(&b, window);
        let size = a.bound() * b.bound() * all.t_end;
        // What cancels in an output is known no better than its terms.
        let noise = (a.noise * b.bound() + b.noise * a.bound()) * all.t_end;
        let difference = (product.total - expected).abs();
        let most = 1e-13 * size + noise;
        assert!(difference <= most, "{} {pair:?}: {difference:e} of {size:e}", problem.name);
        assert!(product.largest >= product.total && product.largest <= size + noise);
    }
}

#[test]
fn jumps_are_told_where_driving_functions_jump() {
    let own = problem(problems::driven_by_table());
    let driven = own.system.outputs.len() - 1;
    let part = Part { jumps: vec![0, 1, driven], ..Part::default() };
    let [_, some] = both(&Bdf, &own, &part, &[]);
    let [jump] = some.digest().unwrap().jumps[..] else {
        panic!("{:?}", some.digest().unwrap().jumps)
    };
    // The force jumps from 1 to 3 at 2.5 units of time; the states do not.
    assert_eq!(jump.output, driven);
    assert!((jump.time - 2.5 * own.system.time_scale).abs() < 1e-15);
    let step = 0.25 * 0.5 * 2.0;
    assert!((jump.after - jump.before - step).abs() < 1e-12, "{jump:?}");
}

#[test]
fn run_of_no_length_has_its_start_at_both_ends() {
    let own = problem(problems::vibrating_chain());
    let part = Arc::new(Part { products: products(&own), ..Part::default() });
    let run = Run { keep: Keep::Part(part), ..Run::to(0.0) };
    let found = Bdf.integrate(&own.system, &run, &mut Silent).unwrap();
    let digest = found.digest().unwrap();
    let [first, last] = digest.ends(&own.system, 0);
    assert_eq!(first.to_bits(), last.to_bits());
    assert!(digest.products.iter().all(|product| product.total == 0.0));
}
