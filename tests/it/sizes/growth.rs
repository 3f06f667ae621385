//! What grows with a scene grows in proportion to it.

use std::fs;

use allocation_counter::measure;
use dashpot::{
    analysis::{MeasureWish, Solve, SolveSettings, measures::EndVelocity},
    dae::{Piece, Waveform},
    network::{Network, Node, NodeId, elements::Rigid, parameters::WindowWish, part},
    scene::{ReadOptions, read},
};

use super::{MASS, STIFFNESS};
use crate::thesis::{kelvin, spring};

/// How many times as large the second of two scenes is.
const TIMES: usize = 4;
/// Most times as long that it may take; what grows as the square takes 16 times as long.
const MOST: f64 = 8.0;

/// Processor time of this thread so far \[s\].
fn spent() -> f64 {
    let own = fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let nanoseconds = own.split_whitespace().next().and_then(|text| text.parse::<f64>().ok());
    1e-9 * nanoseconds.unwrap_or(0.0)
}

/// Rounds after which a time that is too long is no noise of the machine.
const ROUNDS: usize = 5;

/// Asserts that what is done with a scene of some size takes a time in proportion to it: the shortest times
/// of both sizes count, taken in turns.
fn assert_linear(what: &str, count: usize, work: impl Fn(usize)) {
    let time = |count: usize| {
        let begin = spent();
        work(count);
        spent() - begin
    };
    let [mut small, mut large] = [f64::INFINITY; 2];
    for _ in 0..ROUNDS {
        (small, large) = (small.min(time(count)), large.min(time(TIMES * count)));
        if large <= MOST * small {
            return;
        }
    }
    panic!("{what}: {small} s and {large} s for {TIMES} times as much");
}

/// `count` masses, each joined to the one that `from` names.
fn joined(count: usize, from: impl Fn(usize) -> usize, is_rigid: bool) -> Network {
    let mut network = Network::new();
    let nodes: Vec<NodeId> =
        (0..count).map(|at| network.add_node(Node::mass(format!("m{at}"), MASS))).collect();
    for at in 1..count {
        let model = if is_rigid { part(Rigid) } else { spring(STIFFNESS) };
        network.connect(format!("l{at}"), nodes[at], nodes[from(at)], model);
    }
    network
}

/// A run that is hardly one, so that what is not integration counts.
fn settings() -> SolveSettings {
    let wish = MeasureWish::new("m0", EndVelocity { window: WindowWish::Run });
    let own = SolveSettings::lasting(1e-9).by_name("bdf").unwrap();
    SolveSettings { measures: vec![wish], estimate: false, ..own }
}

#[test]
fn free_chains_that_are_pushed_take_time_in_proportion_to_their_size() {
    assert_linear("a free chain", 4000, |count| {
        let mut network = joined(count, |at| at - 1, false);
        let first = network.nodes().nth(1).unwrap().0;
        network.add_load("push", first, Waveform::constant(1e3));
        drop(network.solve_with(&settings()).unwrap());
    });
}

#[test]
fn rigid_links_take_time_in_proportion_to_their_number() {
    let shapes: [(&str, &dyn Fn(usize) -> usize); 3] =
        [("a row", &|at| at - 1), ("a star", &|_| 0), ("a tree", &|at| (at - 1) / 2)];
    for (name, from) in shapes {
        assert_linear(&format!("{name} of rigid links"), 2000, |count| {
            let mut network = joined(count, from, true);
            let (first, ground) = (network.nodes().nth(1).unwrap().0, network.ground());
            network.connect("pad", first, ground, kelvin(STIFFNESS, 100.0));
            drop(network.solve_with(&settings()).unwrap());
        });
    }
}

#[test]
fn noisy_loads_take_time_in_proportion_to_their_points() {
    let solved = |count: usize, method: &str| {
        let mut state = 1_u64;
        let mut noise = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 40) as f64 / 1e5
        };
        // Segments of one length: longer records last longer.
        let values: Vec<f64> = (0..=count).map(|_| noise()).collect();
        let segment = 1e-6;
        let pieces = values.windows(2).enumerate().map(|(at, ends)| Piece {
            start: segment * at as f64,
            value: ends[0],
            slope: (ends[1] - ends[0]) / segment,
            ..Piece::default()
        });
        let mut network = Network::new();
        let mass = network.add_node(Node::mass("m0", 5.0));
        network.connect("pad", mass, network.ground(), kelvin(1e6, 100.0));
        network.add_load("push", mass, Waveform::new(pieces.collect()).unwrap());
        let own = SolveSettings::lasting(segment * count as f64).by_name(method).unwrap();
        drop(network.solve_with(&SolveSettings { estimate: false, ..own }).unwrap());
    };
    for method in ["exact", "bdf", "tr-bdf2"] {
        assert_linear(&format!("a noisy load by {method}"), 7500, |count| solved(count, method));
    }
}

/// A parcel that bounces on a bed that shakes, some nine times a second.
const BOUNCING: &str = r#"
[nodes]
parcel = { mass = "12 kg" }
bed = { motion = { sine = { amplitude = "5 mm", frequency = "9 Hz", phase = "180 deg" } } }
[elements]
cushion = { between = ["parcel", "bed"], kelvin-voigt = { spring = "120 kN/m", dashpot = "480 N s/m" } }
[effects]
gravity = { value = "1 g0" }
separation.cushion = { at = "parcel" }
[run]
duration = "1 s"
"#;

#[test]
fn long_runs_that_switch_keep_little_of_each_leg() {
    let scene = read(BOUNCING, &ReadOptions::default()).unwrap().value;
    let taken = |duration: f64| {
        let settings = SolveSettings { duration, ..scene.settings("exact").unwrap() };
        let mut switches = 0;
        let memory = measure(|| {
            let report = scene.network.solve_with(&settings).unwrap();
            switches = report.trajectory.switches.len();
        });
        (memory.bytes_max as f64, switches as f64)
    };
    let [(short, few), (long, many)] = [60.0, 120.0].map(taken);
    // Two solutions, the estimate of their errors included, and the signals and rates at hand.
    let each = (long - short) / (many - few);
    assert!(each <= 11e3, "{each} bytes for each of {many} switchings");
}

#[test]
fn large_texts_are_told_what_small_ones_are() {
    let scene = |head: &str, between: &str, run: &str| {
        format!(
            "[nodes]\nhead = {{ {head} }}\n[elements]\npad = {{ between = {between}, kelvin = \
             {{ spring = \"60 kN/m\", dashpot = \"300 N s/m\" }} }}\n[run]\n{run}\n"
        )
    };
    let (massive, towards) = ("mass = \"5 kg\", velocity = \"4 m/s\"", "[\"head\", \"ground\"]");
    let scenes = [
        // What the compiler warns of, and refuses.
        scene(massive, "[\"ground\", \"head\"]", "duration = \"20 ms\""),
        scene("mass = 0, velocity = \"4 m/s\"", towards, "duration = \"20 ms\""),
        // What is sought in what it makes.
        scene(
            massive,
            towards,
            "duration = \"20 ms\"\nstop = [{ when = \"pad.force\", falls-below = \"2 kN\" }]",
        ),
        scene(massive, towards, "duration = \"auto\""),
        scene(massive, towards, "duration = \"20 ms\""),
    ];
    let comments = format!("# {}\n", "-".repeat(98)).repeat(50_000);
    for (at, small) in scenes.iter().enumerate() {
        let told = |text: &str| {
            let read = read(text, &ReadOptions::default());
            let run = read.as_ref().map_or(String::new(), |own| format!("{:?}", own.value.run));
            (read.map_or_else(|own| own, |own| own.warnings).render(false), run)
        };
        let (own, large) = (told(small), told(&format!("{small}{comments}")));
        assert_eq!(own, large);
        assert!(at > 1 || !own.0.is_empty(), "{small}");
    }
}
