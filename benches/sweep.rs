//! Sweeps of the reference impact: code written by hand and ours, side by side in one run.
//!
//! `cargo bench --bench sweep` prints how long a scene takes and how many are solved per second by one
//! core. By hand a scene is a matrix exponential and 500 products with it, after each of which force and
//! deformation are looked at; it finds the largest sample, ours the largest value.
#![allow(
    clippy::expect_used,
    clippy::print_stdout,
    reason = "a benchmark prints its table and has no one to report errors to"
)]

#[path = "equal_error/by_hand.rs"]
mod by_hand;
#[path = "equal_error/impact.rs"]
mod impact;

use std::{hint::black_box, ops::ControlFlow, time::Instant};

use dashpot::{
    analysis::{
        SolveSettings,
        sweep::{Column, Grid, ScenePoint, SweepOptions, SweepReport, columns, sweep},
    },
    network::{
        Network, Node,
        elements::{Dashpot, Spring},
        part,
    },
    rheology::Tree,
};
use nalgebra::{SMatrix, SVector};

use self::{by_hand::ByHand, impact::Impact};

/// Values of each of two parameters.
const SIDE: usize = 100;
/// Products of a scene by hand.
const SAMPLES: usize = 500;
/// How often each contender has its turn.
const TURNS: usize = 9;

/// Factors of the stiffness of the Maxwell spring and the damping of the Kelvin dashpot.
fn factor(at: usize) -> f64 {
    0.25 * 16_f64.powf(at as f64 / (SIDE - 1) as f64)
}

/// The reference impact with these two constants.
fn network(stiffness: f64, damping: f64) -> Network {
    let (spring, dashpot) =
        (|stiffness: f64| part(Spring { stiffness }), |damping: f64| part(Dashpot { damping }));
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 10.0).moving(10.0));
    let panel = network.add_node(Node::mass("panel", 100.0));
    let kelvin = Tree::parallel([spring(2e7), dashpot(damping)]);
    let pad = Tree::series([spring(stiffness), dashpot(6e3), kelvin]);
    network.connect("padding", head, panel, pad).thickness = Some(0.02);
    let mount = Tree::parallel([spring(5e7), dashpot(1e4)]);
    network.connect("mount", panel, network.ground(), mount);
    network
}

/// All scenes by hand: the sum of the largest forces and deformations.
fn by_hand() -> f64 {
    let mut sum = 0.0;
    for first in 0..SIDE {
        for second in 0..SIDE {
            // The groups a, b, c, d of the thesis in their dependence on both constants.
            let (k2, c2) = (2e7 * factor(first), 4e3 * factor(second));
            let (k1, c1, time) = (2e7, 6e3, 0.002);
            let mut own = Impact::with_mount(0.2);
            own.groups[0] = (k2 / c2 + k2 / c1 + k1 / c2) * time;
            own.groups[1] = k1 * k2 / (c1 * c2) * time * time;
            own.groups[2] = k2 * time * time / 10.0;
            own.groups[3] = k1 * k2 * time * time * time / (c2 * 10.0);
            sum += scene_by_hand(&own);
        }
    }
    sum
}

fn scene_by_hand(impact: &Impact) -> f64 {
    let mut matrix = SMatrix::<f64, 6, 6>::zeros();
    for column in 0..6 {
        let mut unit = [0.0; 6];
        unit[column] = 1.0;
        let mut rate = [0.0; 6];
        impact.rates(&unit, &mut rate);
        matrix.set_column(column, &SVector::from(rate));
    }
    let propagator = (matrix * (impact.end() / SAMPLES as f64)).exp();
    let mut state = SVector::<f64, 6>::from_vec(impact.start());
    let (mut force, mut depth) = (0.0_f64, 0.0_f64);
    for _ in 0..SAMPLES {
        state = propagator * state;
        force = force.max(state[4]);
        depth = depth.max(state[0] - state[2]);
    }
    force + depth
}

/// All scenes by ours.
fn ours(grid: &Grid, columns: &[Column], threads: usize) -> SweepReport {
    let pose = |places: &[usize]| {
        let network = network(2e7 * factor(places[0]), 4e3 * factor(places[1]));
        Ok(ScenePoint { network, settings: SolveSettings::lasting(0.02) })
    };
    sweep(grid, &pose, columns, SweepOptions { threads, ..SweepOptions::default() }, &mut |_, _| {
        ControlFlow::Continue(())
    })
    .expect("a sweep")
}

/// The reference alone by hand-written diffsol, for comparison.
fn one_by_diffsol() -> f64 {
    let impact = Impact::with_mount(0.2);
    let times: Vec<f64> = (0..=SAMPLES).map(|at| impact.end() * at as f64 / 500.0).collect();
    let mut job = by_hand::bdf(&impact, &times).expect("hand-written problem");
    job(1e-6).expect("hand-written solution").into_iter().fold(0.0, f64::max)
}

/// Something that is timed: its name, its scenes, and what it does.
struct Contender<'c> {
    name: &'c str,
    scenes: usize,
    solve: Box<dyn Fn() -> f64 + 'c>,
}

fn main() {
    let grid = Grid::new(vec![SIDE, SIDE]).expect("a grid");
    let scene =
        ScenePoint { network: impact::network(1, 1e4), settings: SolveSettings::lasting(0.02) };
    let asked = |keys: &[&str]| {
        let keys: Vec<String> = keys.iter().map(|key| (*key).to_owned()).collect();
        columns(&scene, &keys).expect("measures").0
    };
    let peaks = asked(&["padding.peak-force", "padding.peak-deformation"]);
    let severity =
        asked(&["padding.peak-force", "padding.peak-deformation", "head.severity-index"]);
    let energy = asked(&["padding.peak-force", "padding.energy"]);
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let swept = |name, columns, threads| {
        let (grid, solve) = (&grid, move |grid| ours(grid, columns, threads).values[0]);
        Contender { name, scenes: grid.len(), solve: Box::new(move || solve(grid)) }
    };
    let all = [
        Contender {
            name: "by hand: diffsol, rtol 1e-6",
            scenes: 1,
            solve: Box::new(one_by_diffsol),
        },
        Contender {
            name: "by hand: exponential and 500 products",
            scenes: grid.len(),
            solve: Box::new(by_hand),
        },
        swept("peak force and deepest point", &peaks, 1),
        swept("the same and severity index", &severity, 1),
        swept("peak force and energy", &energy, 1),
        swept("peak force and energy, all cores", &energy, cores),
    ];
    let mut times = vec![Vec::new(); all.len()];
    for _ in 0..TURNS {
        for (own, times) in all.iter().zip(&mut times) {
            let clock = Instant::now();
            black_box((own.solve)());
            times.push(clock.elapsed());
        }
    }
    println!(
        "{:<42} {:>10} {:>12}",
        "sweep of the reference, 10 000 scenes", "a scene", "scenes/s"
    );
    for (own, mut times) in all.iter().zip(times) {
        times.sort();
        let seconds = times[TURNS / 2].as_secs_f64() / own.scenes as f64;
        println!("{:<42} {:>7.2} µs {:>12.0}", own.name, 1e6 * seconds, seconds.recip());
    }
    let found = ours(&grid, &severity, 1);
    println!(
        "{} of {} points instantiated; largest difference from full runs at {} points: {:.1e}",
        found.instantiated,
        grid.len(),
        found.checked.len(),
        found.largest_difference
    );
}
