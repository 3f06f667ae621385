//! Sweeps of the reference impact and of a drop on foam: code written by hand and ours, side by side in one run.
//!
//! `cargo bench -p dashpot-benches --bench sweep` prints the CPU time of a scene on one core, as a ratio to that by hand. By hand a
//! scene of the reference impact is a matrix exponential and 500 products with it, after each of which force and
//! deformation are looked at; it finds the largest sample, ours the largest value. Impacts that are not linear are by
//! hand in `explicit`.
#![expect(
    clippy::expect_used,
    clippy::print_stdout,
    reason = "a benchmark prints its table and has no one to report errors to"
)]

#[path = "../equal_error/by_hand.rs"]
mod by_hand;
#[path = "../equal_error/cpu.rs"]
mod cpu;
mod cushion;
mod explicit;
mod foam;
mod formulas;
#[path = "../equal_error/impact.rs"]
mod impact;
mod record;
mod runs;
mod thesis;

use std::{hint::black_box, ops::ControlFlow, time::Instant};

use dashpot::{
    analysis::{
        MeasureWish, SolveSettings,
        sweep::{Column, Estimates, Grid, ScenePoint, SweepOptions, SweepReport, columns, sweep},
    },
    network::{
        Network, Node,
        effects::{Gravity, GravityStart, Separation},
        elements::{Dashpot, Spring},
        part,
    },
    rheology::Tree,
};
use nalgebra::{SMatrix, SVector};

use self::{by_hand::ByHand, cpu::cpu, impact::Impact};

/// Values of each of two parameters.
const SIDE: usize = 100;
/// Products of a scene by hand.
const SAMPLES: usize = 500;
/// How often each contender has its turn.
const TURNS: usize = 9;
/// How long a turn lasts at least \[s\]: CPU time is told in steps of some milliseconds.
const TURN: f64 = 0.1;

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

/// What acts besides in a linear scene, in which then the head alone has mass.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Besides {
    Nothing,
    Separation,
    /// With separation.
    Gravity,
}

/// A scene of ours.
fn posed(places: &[usize], besides: Besides) -> ScenePoint {
    let (stiffness, damping) = (2e7 * factor(places[0]), 4e3 * factor(places[1]));
    let mut network = if besides == Besides::Nothing {
        network(stiffness, damping)
    } else {
        alone(stiffness, damping)
    };
    if besides == Besides::Gravity {
        network.add_effect(Gravity { acceleration: 9.80665, start: GravityStart::Equilibrium });
    }
    if besides != Besides::Nothing {
        let element = "padding".to_owned();
        network.add_effect(Separation { element, at: None, restitution: 0.0 });
    }
    ScenePoint { network, settings: SolveSettings::lasting(0.02) }
}

/// The head and its padding on the ground.
fn alone(stiffness: f64, damping: f64) -> Network {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 10.0).moving(10.0));
    // Little enough damping that all of them rebound.
    let kelvin =
        Tree::parallel([part(Spring { stiffness: 2e7 }), part(Dashpot { damping: 0.2 * damping })]);
    let pad = Tree::series([part(Spring { stiffness }), kelvin]);
    network.connect("padding", head, network.ground(), pad).thickness = Some(0.02);
    network
}

/// All scenes by ours.
fn ours(
    grid: &Grid,
    Asked { columns, wishes }: &Asked,
    options: SweepOptions,
    pose: &(dyn Fn(&[usize]) -> ScenePoint + Sync),
) -> SweepReport {
    let pose = |places: &[usize]| {
        let mut scene = pose(places);
        scene.settings.measures.clone_from(wishes);
        Ok(scene)
    };
    sweep(grid, &pose, columns, options, &mut |_, _| ControlFlow::Continue(())).expect("a sweep")
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

/// Times contenders in turns, and prints the medians beside that of the first.
fn race(title: &str, all: &[Contender<'_>]) {
    let clock = Instant::now();
    let mut times = vec![Vec::new(); all.len()];
    for _ in 0..TURNS {
        for (own, times) in all.iter().zip(&mut times) {
            let (begin, mut rounds, mut spent) = (cpu(clock), 0, 0.0);
            while spent < TURN {
                black_box((own.solve)());
                rounds += 1;
                spent = cpu(clock) - begin;
            }
            times.push(spent / (rounds * own.scenes) as f64);
        }
    }
    println!("\n{title:<44} {:>10} {:>9}", "a scene", "by hand");
    let mut first = None;
    for (own, mut times) in all.iter().zip(times) {
        times.sort_by(f64::total_cmp);
        let median = times[TURNS / 2];
        let unit = *first.get_or_insert(median);
        println!("{:<44} {:>7.2} µs {:>8.2}×", own.name, 1e6 * median, median / unit);
    }
}

/// What is asked of each scene: its columns, and what must be measured for them.
struct Asked {
    columns: Vec<Column>,
    wishes: Vec<MeasureWish>,
}

fn asked(scene: &ScenePoint, keys: &[&str]) -> Asked {
    let keys: Vec<String> = keys.iter().map(|key| (*key).to_owned()).collect();
    let (columns, wishes) = columns(scene, &keys).expect("measures");
    Asked { columns, wishes }
}

fn main() {
    let only = std::env::var("SWEEP").unwrap_or_default();
    let is_asked_for = |part: &str| only.is_empty() || only == part;
    if is_asked_for("linear") {
        linear();
    }
    if is_asked_for("drops") {
        drops();
    }
    if is_asked_for("runs") {
        runs::runs();
    }
    if is_asked_for("cushion") {
        cushion::curves();
    }
    if is_asked_for("formulas") {
        formulas::formulas();
    }
}

/// The reference impact over two constants.
fn linear() {
    let grid = Grid::new(vec![SIDE, SIDE]).expect("a grid");
    let scene =
        ScenePoint { network: impact::network(1, 1e4), settings: SolveSettings::lasting(0.02) };
    let peaks = ["padding.peak-force", "padding.peak-deformation"];
    let with = |key: &str| asked(&scene, &[peaks[0], peaks[1], key]);
    let (severity, hic) = (with("head.severity-index"), with("head.hic15"));
    let peaks = asked(&scene, &peaks);
    let energy = asked(&scene, &["padding.peak-force", "padding.energy"]);
    let swept = |name, columns, besides| {
        let solve = move |grid: &Grid| {
            let pose = move |places: &[usize]| posed(places, besides);
            ours(grid, columns, SweepOptions::default(), &pose).values[0]
        };
        let grid = &grid;
        Contender { name, scenes: grid.len(), solve: Box::new(move || solve(grid)) }
    };
    let by_hand = || Contender {
        name: "by hand: exponential and 500 products",
        scenes: grid.len(),
        solve: Box::new(by_hand),
    };
    let diffsol = Contender {
        name: "by hand: diffsol, rtol 1e-6",
        scenes: 1,
        solve: Box::new(one_by_diffsol),
    };
    race(
        "reference impact, 10 000 scenes",
        &[
            by_hand(),
            diffsol,
            swept("peak force and deepest point", &peaks, Besides::Nothing),
            swept("the same and severity index", &severity, Besides::Nothing),
            swept("peak force and energy", &energy, Besides::Nothing),
            swept("peaks and HIC15", &hic, Besides::Nothing),
            swept("peaks, on the ground with separation", &peaks, Besides::Separation),
            swept("the same with gravity", &peaks, Besides::Gravity),
        ],
    );
    for (columns, besides) in [
        (&severity, Besides::Nothing),
        (&hic, Besides::Nothing),
        (&peaks, Besides::Gravity),
        (&peaks, Besides::Separation),
    ] {
        let found = ours(&grid, columns, SweepOptions::default(), &|own| posed(own, besides));
        told(&found);
    }
}

fn told(found: &SweepReport) {
    println!(
        "{} of {} points instantiated; largest difference from full runs at {} of them: {:.1e}",
        found.instantiated,
        found.points(),
        found.checked.len(),
        found.largest_difference
    );
}

/// Scenes of the drops.
const DROPS: usize = 1000;
/// The error that is wanted of all measures.
const WANTED: f64 = 1e-3;

/// The largest error of the drops by hand at a tolerance.
fn error_by_hand(rtol: f64) -> f64 {
    let mut worst = 0.0_f64;
    for at in (0..DROPS).step_by(50) {
        let [own, fine] = [rtol, 1e-11].map(|rtol| foam::by_hand(height(at), rtol));
        worst = own
            .iter()
            .zip(fine)
            .fold(worst, |worst, (own, fine)| worst.max((own / fine - 1.0).abs()));
    }
    worst
}

/// The coarsest tolerance at which the drops by hand are so good.
fn tolerance_by_hand(wanted: f64) -> f64 {
    tolerance(|rtol| error_by_hand(rtol) < wanted)
}

/// Ever finer tolerances, in steps of a quarter decade.
fn tolerances() -> impl Iterator<Item = f64> {
    (8..48).map(|quarters| 10_f64.powf(-0.25 * f64::from(quarters)))
}

/// The coarsest tolerance that suffices.
fn tolerance(suffices: impl Fn(f64) -> bool) -> f64 {
    tolerances().find(|&rtol| suffices(rtol)).expect("a tolerance")
}

fn height(place: usize) -> f64 {
    0.4 + 0.5 * place as f64 / (DROPS - 1) as f64
}

/// Drops from 1000 heights on foam.
fn drops() {
    let grid = Grid::new(vec![DROPS]).expect("a grid");
    let rtol = tolerance_by_hand(WANTED);
    let columns = asked(&foam::scene(height(0)), &foam::KEYS);
    let swept = |estimates, threads| {
        let pose = |places: &[usize]| foam::scene(height(places[0]));
        ours(&grid, &columns, SweepOptions { threads, estimates }, &pose)
    };
    let by_hand = || -> f64 { (0..DROPS).map(|at| foam::by_hand(height(at), rtol)[0]).sum() };
    let estimated = || swept(Estimates::Some, 1).values[0];
    let single = || swept(Estimates::Off, 1).values[0];
    race(
        "drop on foam, 1000 heights, seven measures",
        &[
            Contender { name: "by hand: order 5, events", scenes: DROPS, solve: Box::new(by_hand) },
            Contender { name: "with errors", scenes: DROPS, solve: Box::new(estimated) },
            Contender { name: "without errors", scenes: DROPS, solve: Box::new(single) },
        ],
    );
    let found = swept(Estimates::Some, 1);
    told(&found);
    let mut worst = 0.0_f64;
    for at in (0..DROPS).step_by(50) {
        let fine = foam::by_hand(height(at), 1e-11);
        for (key, fine) in foam::KEYS.iter().zip(fine) {
            let is_it = |own: &Column| own.key == *key && !own.is_share;
            let column = found.columns.iter().position(is_it).expect("a column");
            let own = found.values[at * found.columns.len() + column];
            worst = worst.max((own / fine - 1.0).abs());
        }
    }
    println!(
        "largest error: by hand {:.1e} at a tolerance of {rtol:.1e}, ours {worst:.1e}",
        error_by_hand(rtol)
    );
    let by_clock = |threads: usize| {
        let clock = Instant::now();
        swept(Estimates::Some, threads);
        clock.elapsed().as_secs_f64()
    };
    println!("two threads take {:.2} of the time of one", by_clock(2) / by_clock(1));
}
