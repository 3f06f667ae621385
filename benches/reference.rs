//! The reference impact: hand-written code and ours, side by side in one run.
//!
//! `cargo bench -p dashpot-benches --bench reference` prints criterion's times, and before them a table of what each
//! contender reaches: true error of the padding's force, steps, and the ratios that matter.
#![expect(
    clippy::expect_used,
    clippy::print_stdout,
    reason = "a benchmark prints its table and has no one to report errors to"
)]

#[path = "equal_error/by_hand.rs"]
mod by_hand;
#[path = "equal_error/impact.rs"]
mod impact;

use std::{
    hint::black_box,
    time::{Duration, Instant},
};

use criterion::Criterion;
use dashpot::{
    analysis::{Solve, SolveSettings},
    dae::{Method, Run, Silent, System, methods},
    network::Assembly,
};
use nalgebra::{SMatrix, SVector};

use self::{by_hand::ByHand, impact::Impact};

/// Damping of the mount \[N s/m\], and the same in the groups of the thesis.
const MOUNT: (f64, f64) = (1e4, 0.2);
/// Output samples.
const SAMPLES: usize = 501;

/// The samples' times by hand.
fn times() -> Vec<f64> {
    let end = Impact::with_mount(MOUNT.1).end();
    (0..SAMPLES).map(|at| end * at as f64 / (SAMPLES - 1) as f64).collect()
}

/// The same in our units.
fn own_times(system: &System) -> Vec<f64> {
    let end = 0.02 / system.time_scale;
    (0..SAMPLES).map(|at| end * at as f64 / (SAMPLES - 1) as f64).collect()
}

/// Hand-written diffsol: the force at all samples.
fn hand_written_bdf(rtol: f64, times: &[f64]) -> Vec<f64> {
    let impact = Impact::with_mount(MOUNT.1);
    let mut job = by_hand::bdf(&impact, times).expect("hand-written problem");
    job(rtol).expect("hand-written solution")
}

/// Hand-written matrix exponential and a loop of static products: the force at all samples.
fn hand_written_exponential() -> Vec<f64> {
    let impact = Impact::with_mount(MOUNT.1);
    let mut matrix = SMatrix::<f64, 6, 6>::zeros();
    for column in 0..6 {
        let mut unit = [0.0; 6];
        unit[column] = 1.0;
        let mut rate = [0.0; 6];
        impact.rates(&unit, &mut rate);
        for row in 0..6 {
            matrix[(row, column)] = rate[row];
        }
    }
    let propagator = (matrix * times()[1]).exp();
    let mut state = SVector::<f64, 6>::from_vec(impact.start());
    let mut force = Vec::with_capacity(SAMPLES);
    force.push(impact.observed(&|at| state[at]));
    for _ in 1..SAMPLES {
        state = propagator * state;
        force.push(impact.observed(&|at| state[at]));
    }
    force
}

/// Our way from the system to the samples: all unknowns at all times.
fn ours(method: &dyn Method, system: &System, rtol: f64, times: &[f64]) -> Vec<f64> {
    let run = Run::to(0.02).with_rtol(rtol);
    let trajectory = method.integrate(system, &run, &mut Silent).expect("our run");
    trajectory.dense.sample(system, times)
}

/// The force \[N\] from our unknowns.
fn force(assembly: &Assembly, states: &[f64]) -> Vec<f64> {
    let output = assembly.system.outputs.at(assembly.output("padding.force").expect("force"));
    states.chunks(assembly.system.len()).map(|z| output.scale * output.unknowns.at(z)).collect()
}

/// The largest difference in units of the equations by hand.
fn error(found: &[f64], truth: &[f64]) -> f64 {
    let differences = found.iter().zip(truth).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max) / impact::UNIT
}

/// Medians of two jobs that take turns, so that the machine's moods hit both alike.
fn race(mut one: impl FnMut(), mut other: impl FnMut()) -> [Duration; 2] {
    let mut times = [Vec::new(), Vec::new()];
    for _ in 0..400 {
        for (at, job) in [&mut one as &mut dyn FnMut(), &mut other].into_iter().enumerate() {
            let clock = Instant::now();
            job();
            times[at].push(clock.elapsed());
        }
    }
    times.map(|mut times| {
        times.sort();
        times[times.len() / 2]
    })
}

fn line(name: &str, [ours, theirs]: [Duration; 2], target: &str) {
    let ratio = ours.as_secs_f64() / theirs.as_secs_f64();
    println!("{name:<58} {ours:>9.1?} {theirs:>9.1?} {ratio:>8.3}  {target}");
}

fn table(assembly: &Assembly) {
    let system = &assembly.system;
    let times = times();
    let own = own_times(system);
    let exact = methods::by_name("exact").expect("exact");
    let bdf = methods::by_name("bdf").expect("bdf");
    let truth = hand_written_exponential();
    println!("{:<58} {:>9} {:>9} {:>8}", "reference impact, 501 samples", "ours", "other", "ratio");
    for rtol in [1e-4, 1e-6, 1e-8, 1e-10] {
        let ours_error = error(&force(assembly, &ours(&*bdf, system, rtol, &own)), &truth);
        let other_error = error(&hand_written_bdf(rtol, &times), &truth);
        let raced = race(
            || drop(black_box(ours(&*bdf, system, rtol, &own))),
            || drop(black_box(hand_written_bdf(rtol, &times))),
        );
        line(
            &format!("bdf {rtol:.0e} (errors {ours_error:.1e} and {other_error:.1e})"),
            raced,
            "at most 1.1",
        );
    }
    let raced = race(
        || drop(black_box(ours(&*exact, system, 1e-6, &own))),
        || drop(black_box(hand_written_exponential())),
    );
    let reached = error(&force(assembly, &ours(&*exact, system, 1e-6, &own)), &truth);
    line(&format!("exact against a hand-written exponential ({reached:.1e})"), raced, "at most 2");
    for links in [0, 1, 5] {
        against_bdf(links);
    }
}

/// `exact` against `bdf` on pads of Kelvin links in a row, with a Maxwell element in front of them
/// unless there is none: 4, 6 and 10 states.
fn against_bdf(links: usize) {
    let (exact, bdf) =
        (methods::by_name("exact").expect("exact"), methods::by_name("bdf").expect("bdf"));
    let assembly = impact::network(links, MOUNT.0).compile(0.02).expect("the pad compiles");
    let system = &assembly.system;
    let times = own_times(system);
    let sampled =
        |method: &dyn Method, rtol: f64| force(&assembly, &ours(method, system, rtol, &times));
    let truth = sampled(&*exact, 1e-6);
    let scale = truth.iter().copied().fold(0.0, f64::max) / impact::UNIT;
    let trajectory =
        exact.integrate(system, &Run::to(0.02), &mut Silent).expect("the pad is solved");
    let signal = trajectory.signal(system, assembly.output("padding.force").expect("force"));
    let seconds: Vec<f64> = times.iter().map(|t| t * system.time_scale).collect();
    let other = signal.sample(&seconds);
    println!(
        "{} states: two evaluations of exact differ by {:.1e}",
        system.states(),
        error(&truth, &other) / scale
    );
    for (wanted, target) in [(1e-4, "at most 0.2"), (1e-9, "at most 0.033")] {
        let rtol = (4..=26)
            .map(|half| 10f64.powf(-0.5 * f64::from(half)))
            .find(|&rtol| error(&sampled(&*bdf, rtol), &truth) <= wanted * scale);
        let states = system.states();
        let Some(rtol) = rtol else {
            println!("{states} states: bdf does not reach a true error of {wanted:.0e}");
            continue;
        };
        let raced = race(
            || drop(black_box(ours(&*exact, system, 1e-6, &times))),
            || drop(black_box(ours(&*bdf, system, rtol, &times))),
        );
        line(
            &format!("{states} states: exact against bdf at a true error of {wanted:.0e}"),
            raced,
            target,
        );
    }
}

fn main() {
    let network = impact::network(1, MOUNT.0);
    let assembly = network.compile(0.02).expect("the reference compiles");
    table(&assembly);

    let mut criterion = Criterion::default()
        .sample_size(50)
        .measurement_time(Duration::from_secs(2))
        .warm_up_time(Duration::from_millis(500))
        .configure_from_args();
    let times = times();
    let system = &assembly.system;
    let own = own_times(system);
    criterion.bench_function("hand-written diffsol, 1e-6", |b| {
        b.iter(|| hand_written_bdf(1e-6, black_box(&times)));
    });
    for (name, rtol) in
        [("exact", 1e-6), ("bdf", 1e-6), ("tr-bdf2", 1e-6), ("esdirk34", 1e-6), ("tsit45", 1e-6)]
    {
        let method = methods::by_name(name).expect("method");
        criterion.bench_function(&format!("ours by {name}, 1e-6, 501 samples"), |b| {
            b.iter(|| ours(&*method, black_box(system), rtol, &own));
        });
    }
    criterion.bench_function("hand-written exponential loop", |b| b.iter(hand_written_exponential));
    criterion.bench_function("network to system", |b| b.iter(|| network.compile(black_box(0.02))));
    let settings = SolveSettings::lasting(0.02).by_name("exact").expect("a method");
    criterion.bench_function("exact with all measures and the energy ledger", |b| {
        b.iter(|| black_box(&network).solve_with(&settings));
    });
    let settings = SolveSettings::lasting(0.02).by_name("bdf").expect("a method");
    criterion.bench_function("bdf with all measures, error bars and the energy ledger", |b| {
        b.iter(|| black_box(&network).solve_with(&settings));
    });
    criterion.final_summary();
}
