//! Runs take no more memory from the system than code written by hand, and no more with each step.
//!
//! What a thread allocates is counted by the allocator of `allocation-counter`, which this binary
//! uses for that. The code by hand is that of the benchmarks.

#[path = "../../benches/equal_error/by_hand.rs"]
mod by_hand;
#[path = "../../benches/equal_error/chain.rs"]
mod chain;
#[path = "../../benches/equal_error/impact.rs"]
mod impact;

use std::{hint::black_box, ops::ControlFlow};

use allocation_counter::measure;
use dashpot::{
    analysis::{
        Solve, SolveSettings,
        sweep::{Grid, ScenePoint, SweepOptions, columns, sweep},
    },
    dae::{Run, Silent, System, methods},
    network::{
        Network, Node,
        elements::{Dashpot, Spring},
        part,
    },
    rheology::Tree,
};

use self::{by_hand::ByHand, chain::Chain, impact::Impact};

/// Allocations of a run by `bdf` that yields all unknowns at 501 times, and its steps.
fn ours(system: &System, rtol: f64) -> (u64, usize) {
    let bdf = methods::by_name("bdf").unwrap();
    let end = 0.02 / system.time_scale;
    let times: Vec<f64> = (0..=500).map(|at| end * f64::from(at) / 500.0).collect();
    let mut steps = 0;
    let counted = measure(|| {
        let run = Run::to(0.02).with_rtol(rtol);
        let trajectory = bdf.integrate(system, &run, &mut Silent).unwrap();
        steps = trajectory.statistics.accepted;
        black_box(trajectory.dense.sample(system, &times));
    });
    (counted.count_total, steps)
}

/// Allocations of the same by hand, from the equations on.
fn by_hand(problem: &dyn ByHand, rtol: f64) -> u64 {
    let times: Vec<f64> = (0..=500).map(|at| problem.end() * f64::from(at) / 500.0).collect();
    measure(|| drop(black_box(by_hand::bdf(problem, &times).unwrap()(rtol).unwrap()))).count_total
}

fn compare(network: &Network, problem: &dyn ByHand) {
    let system = network.compile(0.02).unwrap().system;
    let mut found = Vec::new();
    for rtol in [1e-4, 1e-6, 1e-8, 1e-10] {
        let ((ours, steps), hand) = (ours(&system, rtol), by_hand(problem, rtol));
        assert!(ours <= hand, "at {rtol:e}: {ours}, by hand {hand}");
        found.push((ours, steps));
    }
    // What is kept of the steps grows by doubling: three vectors, each a few times.
    let ((first, few), (last, many)) = (found[0], found[3]);
    assert!(many > 3 * few);
    assert!(last <= first + 3 * 12, "{first} in {few} steps, {last} in {many}");
}

#[test]
fn a_run_allocates_no_more_than_code_by_hand_and_nothing_with_each_step() {
    compare(&impact::network(1, 1e4), &Impact::with_mount(0.2));
}

#[test]
fn so_does_one_with_sparse_matrices() {
    let chain = Chain { nodes: 60 };
    compare(&chain.network(), &chain);
}

/// Allocations of a sweep of the reference over so many values of three of its numbers by one thread, and
/// its points.
fn swept(counts: [usize; 3]) -> (u64, usize) {
    let scene_point = |places: &[usize]| {
        let factor = |at: usize| 1.0 + 0.02 * places[at] as f64;
        let mut network = Network::new();
        let head = network.add_node(Node::mass("head", 10.0).moving(10.0 * factor(2)));
        let pad = Tree::series([
            part(Spring { stiffness: 2e7 * factor(0) }),
            part(Dashpot { damping: 2e4 * factor(1) }),
        ]);
        network.connect("padding", head, network.ground(), pad).thickness = Some(0.02);
        Ok(ScenePoint { network, settings: SolveSettings::lasting(0.02) })
    };
    let keys = ["peak-force", "peak-deformation", "energy"].map(|own| format!("padding.{own}"));
    let severity = "head.severity-index".to_owned();
    let keys: Vec<String> = keys.into_iter().chain([severity]).collect();
    let columns = columns(&scene_point(&[0; 3]).unwrap(), &keys).unwrap().0;
    let grid = Grid::new(counts.to_vec()).unwrap();
    let mut instantiated = 0;
    let counted = measure(|| {
        let watch = &mut |_, _| ControlFlow::Continue(());
        instantiated = sweep(&grid, &scene_point, &columns, SweepOptions::default(), watch)
            .unwrap()
            .instantiated;
    });
    assert_eq!(instantiated, grid.len());
    (counted.count_total, grid.len())
}

#[test]
fn a_sweep_allocates_nothing_with_each_scene() {
    // What is read along the axes and solved in full besides is nearly the same.
    let ((few, small), (many, large)) = (swept([20, 20, 2]), swept([20, 20, 20]));
    let each = many.saturating_sub(few) as f64 / (large - small) as f64;
    assert!(each < 0.5, "{each} a scene: {few} of {small}, {many} of {large}");
}

/// How often a run of the reference may ask for memory, from its network to its report.
const OF_A_RUN: u64 = 2500;

#[test]
fn a_run_by_itself_allocates_within_its_limit() {
    let network = impact::network(1, 1e4);
    let settings = SolveSettings::lasting(0.02);
    let run = || drop(black_box(network.solve_with(&settings).unwrap()));
    // What all runs share is made once.
    run();
    let counted = measure(run).count_total;
    assert!(counted < OF_A_RUN, "{counted}");
}
