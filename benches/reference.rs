//! The reference impact: hand-written code and ours, side by side in one run.
//!
//! `cargo bench --bench reference` prints criterion's times, and before them a table of what each
//! contender reaches: true error of the padding's force, steps, and the ratios that matter.
#![allow(
    clippy::expect_used,
    clippy::print_stdout,
    reason = "a benchmark prints its table and has no one to report errors to"
)]

use std::{
    hint::black_box,
    time::{Duration, Instant},
};

use criterion::Criterion;
use dashpot::{
    analysis::{SolveSettings, solve},
    dae::{Method, Run, Silent, System, methods},
    network::{
        Assembly, Network, Node,
        elements::{Dashpot, Spring},
        part,
    },
    rheology::Tree,
};
use diffsol::{DenseMatrix, NalgebraLU, NalgebraMat, OdeBuilder, OdeSolverMethod};
use nalgebra::{SMatrix, SVector};

/// Groups of the thesis: a, b, c, d, α, β, γ of the reference in SI.
const GROUPS: [f64; 7] = [80.0 / 3.0, 200.0 / 3.0, 8.0, 80.0, 0.2, 2.0, 0.1];
/// Dimensionless end of the run, 20 ms.
const END: f64 = 10.0;
/// Output samples.
const SAMPLES: usize = 501;

fn rates(z: &[f64], rate: &mut [f64]) {
    let [a, b, c, d, alpha, beta, gamma] = GROUPS;
    let (zeta2, eta2) = (-z[4], -alpha * z[3] - beta * z[2] + gamma * z[4]);
    rate[0] = z[1];
    rate[1] = zeta2;
    rate[2] = z[3];
    rate[3] = eta2;
    rate[4] = z[5];
    rate[5] = -a * z[5] - b * z[4] + c * (zeta2 - eta2) + d * (z[1] - z[3]);
}

fn start() -> [f64; 6] {
    [0.0, 1.0, 0.0, 0.0, 0.0, GROUPS[2]]
}

/// Hand-written diffsol: φ at all samples, and the steps.
fn hand_written_bdf(rtol: f64, times: &[f64]) -> Vec<f64> {
    let problem = OdeBuilder::<NalgebraMat<f64>>::new()
        .rtol(rtol)
        .atol([rtol])
        .rhs_implicit(|z, _p, _t, rate| rates(z, rate), |_z, _p, _t, v, rate| rates(v, rate))
        .init(|_p, _t, z| z.copy_from_slice(&start()), 6)
        .build()
        .expect("hand-written problem");
    let mut solver = problem.bdf::<NalgebraLU<f64>>().expect("hand-written solver");
    let (found, _) = solver.solve_dense(times).expect("hand-written solution");
    (0..times.len()).map(|at| found.get_index(4, at)).collect()
}

/// Hand-written matrix exponential and a loop of static products: φ at all samples.
fn hand_written_exponential() -> Vec<f64> {
    let mut matrix = SMatrix::<f64, 6, 6>::zeros();
    for column in 0..6 {
        let mut unit = [0.0; 6];
        unit[column] = 1.0;
        let mut rate = [0.0; 6];
        rates(&unit, &mut rate);
        for row in 0..6 {
            matrix[(row, column)] = rate[row];
        }
    }
    let propagator = (matrix * (END / (SAMPLES - 1) as f64)).exp();
    let mut state = SVector::<f64, 6>::from(start());
    let mut force = Vec::with_capacity(SAMPLES);
    force.push(state[4]);
    for _ in 1..SAMPLES {
        state = propagator * state;
        force.push(state[4]);
    }
    force
}

/// The impact with a pad of `links` Kelvin links behind a Maxwell element; the reference has one.
/// Without links the pad is one Kelvin element.
fn network(links: usize) -> Network {
    let kelvin =
        |k, c| Tree::parallel([part(Spring { stiffness: k }), part(Dashpot { damping: c })]);
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 10.0).moving(10.0));
    let panel = network.add_node(Node::mass("panel", 100.0));
    let maxwell = [part(Spring { stiffness: 2e7 }), part(Dashpot { damping: 6e3 })];
    let link = |at: usize| kelvin(2e7 * (at + links) as f64, 4e3 / (1 + at) as f64);
    let pad = match links {
        0 => kelvin(2e7, 4e3),
        1 => Tree::series(maxwell.into_iter().chain([kelvin(2e7, 4e3)])),
        _ => Tree::series(maxwell.into_iter().chain((0..links).map(link))),
    };
    network.connect("padding", head, panel, pad).thickness = Some(0.02);
    network.connect("mount", panel, network.ground(), kelvin(5e7, 1e4));
    network
}

/// Our way from the system to the samples: all unknowns at all times.
fn ours(method: &dyn Method, system: &System, rtol: f64, times: &[f64]) -> Vec<f64> {
    let run = Run::to(0.02).with_rtol(rtol);
    let trajectory = method.integrate(system, &run, &mut Silent).expect("our run");
    trajectory.dense.sample(system, times)
}

/// φ from our unknowns.
fn force(assembly: &Assembly, states: &[f64]) -> Vec<f64> {
    let output = &assembly.system.outputs[assembly.output("padding.force").expect("force")];
    let scale = output.scale * 0.02 / 1000.0;
    states.chunks(assembly.system.len()).map(|z| scale * output.unknowns.at(z)).collect()
}

fn error(found: &[f64], truth: &[f64]) -> f64 {
    found.iter().zip(truth).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
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
    let times: Vec<f64> = (0..SAMPLES).map(|at| END * at as f64 / (SAMPLES - 1) as f64).collect();
    let own: Vec<f64> = times.iter().map(|t| t / END * (0.02 / system.time_scale)).collect();
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
    let assembly = network(links).compile(0.02).expect("the pad compiles");
    let system = &assembly.system;
    let end = 0.02 / system.time_scale;
    let times: Vec<f64> = (0..SAMPLES).map(|at| end * at as f64 / (SAMPLES - 1) as f64).collect();
    let sampled =
        |method: &dyn Method, rtol: f64| force(&assembly, &ours(method, system, rtol, &times));
    let truth = sampled(&*exact, 1e-6);
    let scale = truth.iter().copied().fold(0.0, f64::max);
    let trajectory =
        exact.integrate(system, &Run::to(0.02), &mut Silent).expect("the pad is solved");
    let signal = trajectory.signal(system, assembly.output("padding.force").expect("force"));
    let seconds: Vec<f64> = times.iter().map(|t| t * system.time_scale).collect();
    let other: Vec<f64> =
        signal.sample(&seconds).iter().map(|force| force * 0.02 / 1000.0).collect();
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
    let network = network(1);
    let assembly = network.compile(0.02).expect("the reference compiles");
    table(&assembly);

    let mut criterion = Criterion::default()
        .sample_size(50)
        .measurement_time(Duration::from_secs(2))
        .warm_up_time(Duration::from_millis(500))
        .configure_from_args();
    let times: Vec<f64> = (0..SAMPLES).map(|at| END * at as f64 / (SAMPLES - 1) as f64).collect();
    let system = &assembly.system;
    let own: Vec<f64> = times.iter().map(|t| t / END * (0.02 / system.time_scale)).collect();
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
    let settings = SolveSettings::lasting(0.02).by("exact");
    criterion.bench_function("exact with all measures and the energy ledger", |b| {
        b.iter(|| solve(black_box(&network), &settings, &mut Silent));
    });
    let settings = SolveSettings::lasting(0.02).by("bdf");
    criterion.bench_function("bdf with all measures, error bars and the energy ledger", |b| {
        b.iter(|| solve(black_box(&network), &settings, &mut Silent));
    });
    criterion.final_summary();
}
