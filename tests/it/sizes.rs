//! Large chains and lattices: what is kept of their solutions, how good they are, what they cost.
//!
//! The table of cost against size, which docs/sizes.md shows (some minutes):
//! `cargo test --test it sizes::cost::curve -- --ignored --nocapture`.

mod cost;
mod growth;

use std::{f64::consts::PI, sync::Arc};

use allocation_counter::measure;
use dashpot::{
    analysis::{
        Measure, MeasureWish, RunReport, Solution, Solve, SolveSettings,
        ledger::ledger,
        measures::{EndVelocity, Impulse, PeakForce},
        solve_assembly, table,
    },
    dae::{Method, Piece, Run, Silent, Trajectory, Waveform, methods::Bdf},
    network::{
        Assembly, Model, Network, Node, NodeId,
        effects::{Gravity, GravityStart},
        elements::{CubicSpring, Rigid, Spring},
        parameters::WindowWish,
        part,
    },
    rheology::{Branch, Tree},
};

use crate::thesis::{dashpot, kelvin, spring};

/// Stiffness \[N/m\] and mass \[kg\] of uniform chains, whose ω is 1000 rad/s.
const STIFFNESS: f64 = 1e6;
const MASS: f64 = 1.0;
const OMEGA: f64 = 1e3;
/// Speed of what is struck \[m/s\].
const SPEED: f64 = 2.0;

/// `count` masses in a row on springs, free at both ends, of which the first one is struck.
fn uniform_chain(count: usize) -> Network {
    let mut network = Network::new();
    let mut last = network.add_node(Node::mass("struck", MASS).moving(SPEED));
    for at in 1..count {
        let next = network.add_node(Node::mass(format!("m{at}"), MASS));
        network.connect(format!("s{at}"), last, next, part(Spring { stiffness: STIFFNESS }));
        last = next;
    }
    network
}

/// A square of `side` times `side` masses, joined by springs to their neighbours and struck at a
/// corner.
fn lattice(side: usize) -> Network {
    let mut network = Network::new();
    let node = |network: &mut Network, at: usize| match at {
        0 => network.add_node(Node::mass("struck", MASS).moving(SPEED)),
        _ => network.add_node(Node::mass(format!("m{at}"), MASS)),
    };
    let nodes: Vec<NodeId> = (0..side * side).map(|at| node(&mut network, at)).collect();
    for at in 0..side * side {
        let mut join = |to: usize, name: &str| {
            network.connect(format!("{name}{at}"), nodes[at], nodes[to], spring(STIFFNESS));
        };
        if at % side + 1 < side {
            join(at + 1, "right");
        }
        if at / side + 1 < side {
            join(at + side, "down");
        }
    }
    network
}

/// The chain of impacts: 10 kg at 10 m/s on `count` masses of 1 kg together, to the ground.
fn struck_chain(count: usize) -> Network {
    let stiffness = 1e6 * count as f64;
    let mut network = Network::new();
    let mut last = network.add_node(Node::mass("impactor", 10.0).moving(10.0));
    for at in 0..=count {
        let next = if at == count {
            network.ground()
        } else {
            network.add_node(Node::mass(format!("m{at}"), 1.0 / count as f64))
        };
        network.connect(format!("link{at}"), last, next, kelvin(stiffness, 1e-4 * stiffness));
        last = next;
    }
    network
}

/// The same chain hanging under its weight, on a ground that shakes, pulled by a load that jumps.
fn driven_chain(count: usize) -> Network {
    let mut network = struck_chain(count);
    let pieces = vec![
        Piece { value: 50.0, ..Piece::default() },
        Piece { start: 2e-3, value: -80.0, slope: 1e4, ..Piece::default() },
    ];
    let shake = Piece { sine: 1e-4, omega: 900.0, ..Piece::default() };
    let shaker = Waveform::new(vec![shake]).unwrap();
    let table = network.add_node(Node::prescribed("table", shaker));
    let third = network.nodes().find(|(_, node)| node.name == "m2").unwrap().0;
    network.connect("drive", third, table, kelvin(2e5, 30.0));
    network.add_load("push", third, Waveform::new(pieces).unwrap());
    network.add_effect(Gravity { acceleration: 9.81, start: GravityStart::Unloaded });
    network
}

/// `J₁(x)` by the trapezoidal rule, which errs by Bessel functions of the order of its points.
fn bessel_1(x: f64) -> f64 {
    let points = 2 * x as u32 + 60;
    let value = |at: u32| {
        let angle = 2.0 * PI * f64::from(at) / f64::from(points);
        (angle - x * angle.sin()).cos()
    };
    (0..points).map(value).sum::<f64>() / f64::from(points)
}

/// The velocity \[m/s\] of the struck end of a long uniform chain after `time` \[s\], before anything
/// comes back from its other end: `v₀ 2 J₁(2ωt)/(2ωt)`.
fn struck_velocity(time: f64) -> f64 {
    let x = 2.0 * OMEGA * time;
    SPEED * 2.0 * bessel_1(x) / x
}

/// Settings that report the velocity of the struck mass at the end of the run.
fn until(duration: f64) -> SolveSettings {
    let wish = MeasureWish::new("struck", EndVelocity { window: WindowWish::Run });
    let own = SolveSettings::lasting(duration).by_name("bdf").unwrap();
    SolveSettings { measures: vec![wish], ..own }
}

fn end_velocity(report: &RunReport) -> (f64, Option<f64>) {
    let own = report.measure("struck.end-velocity").unwrap();
    (own.value.unwrap(), own.error)
}

/// A run of which everything is kept.
fn full(assembly: &Assembly, duration: f64, rtol: f64) -> Trajectory {
    let run = Run::to(duration).with_rtol(rtol);
    Bdf.integrate(&assembly.system, &run, &mut Silent).unwrap()
}

#[test]
fn measures_of_a_large_network_are_those_of_a_solution_kept_as_a_whole() {
    let duration = 4e-3;
    let network = struck_chain(600);
    let assembly = Arc::new(network.compile(duration).unwrap());
    let settings = SolveSettings::lasting(duration).by_name("bdf").unwrap();
    let report = solve_assembly(&assembly, &[], &settings, &mut Silent).unwrap();
    assert!(report.trajectory.digest().is_some());
    assert!(report.solver.why.contains("only what the measures need is kept"));
    let all = full(&assembly, duration, report.solver.rtol.unwrap());
    let solution = Solution::new(&assembly, &all).doubting(report.solver.threshold);
    let value = |key: &str| report.measure(key).unwrap().value;
    assert_eq!(value("link0.peak-force"), PeakForce::default().read(&solution, 0).value);
    assert_eq!(value("link0.impulse"), Impulse::default().read(&solution, 0).value);
    let own = report.solution();
    let force = assembly.connections[0].force.unwrap();
    assert_eq!(own.signal(force), solution.signal(force));
    assert!(!own.keeps(assembly.connections[300].deformation));
    // Of some 1200 unknowns a handful is kept.
    let row = report.trajectory.dense.bytes() / report.solver.statistics.accepted;
    assert!(row < 200, "{row} bytes for each step");
}

#[test]
fn energies_of_a_large_network_are_those_of_a_solution_kept_as_a_whole() {
    let duration = 4e-3;
    for network in [struck_chain(520), driven_chain(520)] {
        let assembly = Arc::new(network.compile(duration).unwrap());
        let settings = SolveSettings {
            rtol: Some(1e-5),
            estimate: false,
            ..SolveSettings::lasting(duration).by_name("bdf").unwrap()
        };
        let report = solve_assembly(&assembly, &[], &settings, &mut Silent).unwrap();
        let all = full(&assembly, duration, 1e-5);
        let expected = ledger(&Solution::new(&assembly, &all), duration);
        let most = 1e-12 * expected.turned_over;
        let same = |one: f64, other: f64| assert!((one - other).abs() <= most, "{one} {other}");
        let own = &report.energy;
        same(own.start, expected.start);
        same(own.kinetic, expected.kinetic);
        same(own.missing(), expected.missing());
        for (own, expected) in [
            (&own.stored, &expected.stored),
            (&own.dissipated, &expected.dissipated),
            (&own.work_in, &expected.work_in),
        ] {
            assert_eq!(own.len(), expected.len());
            for (own, expected) in own.iter().zip(expected) {
                assert_eq!(own.0, expected.0);
                same(own.1, expected.1);
            }
        }
        // What the drives put in at most is no less than what any one place holds.
        assert!(own.turned_over >= expected.turned_over - most);
        assert!(own.turned_over <= 1.5 * expected.turned_over, "{}", own.turned_over);
    }
}

#[test]
fn tables_of_a_large_network_hold_what_was_kept() {
    let report = struck_chain(600).solve_with(&until_of_impact()).unwrap();
    let table = table(&report.assembly, &report.trajectory, 5);
    let names: Vec<&str> = table.columns.iter().map(|column| column.name.as_str()).collect();
    assert!(names.contains(&"link0.force") && names.contains(&"impactor.velocity"), "{names:?}");
    assert!(names.len() < 20 && !names.contains(&"link300.force"), "{names:?}");
    assert!(table.columns.iter().flat_map(|column| &column.values).all(|value| value.is_finite()));
    assert!(report.energy_after_impact.is_none());
}

fn until_of_impact() -> SolveSettings {
    SolveSettings::lasting(1e-3).by_name("bdf").unwrap()
}

#[test]
fn struck_end_of_a_chain_moves_as_the_closed_form_says_within_its_bar() {
    // The wave has passed 30 masses, and has not come back.
    let duration = 30.0 / OMEGA;
    for count in [60, 200, 700] {
        let report = uniform_chain(count).solve_with(&until(duration)).unwrap();
        let (value, bar) = end_velocity(&report);
        let error = (value - struck_velocity(duration)).abs();
        assert!(error <= bar.unwrap(), "{count} masses: {error:e} of {bar:?}");
        assert!(bar.unwrap() <= 1e-3 * SPEED, "{count} masses: {bar:?}");
    }
}

/// The errors of the struck mass's velocity at one tolerance for networks of rising size.
fn errors(networks: impl Iterator<Item = (Network, f64)>, duration: f64) -> Vec<f64> {
    let error = |(network, truth): (Network, f64)| {
        let settings = SolveSettings { rtol: Some(1e-5), estimate: false, ..until(duration) };
        let report = network.solve_with(&settings).unwrap();
        (end_velocity(&report).0 - truth).abs()
    };
    networks.map(error).collect()
}

#[test]
fn a_local_impact_is_not_diluted_in_a_large_chain() {
    let duration = 20.0 / OMEGA;
    let truth = struck_velocity(duration);
    let chains = [200, 400, 800].map(|count| (uniform_chain(count), truth));
    assert_alike(&errors(chains.into_iter(), duration));
}

#[test]
fn a_local_impact_is_not_diluted_in_a_large_lattice() {
    let duration = 6.0 / OMEGA;
    // The wave does not come back from the far sides, so that one truth holds for all sizes.
    let settings = SolveSettings { rtol: Some(1e-10), estimate: false, ..until(duration) };
    let finest = lattice(16).solve_with(&settings).unwrap();
    let truth = end_velocity(&finest).0;
    assert_alike(&errors([10, 16, 28].map(|side| (lattice(side), truth)).into_iter(), duration));
}

/// What has not been reached yet adds nothing to the integrator's mean, and the tolerance makes up for
/// the larger count: the steps, and with them the errors, stay what they are.
fn assert_alike(errors: &[f64]) {
    let (least, most) = errors.iter().fold((f64::INFINITY, 0.0_f64), |(least, most), &error| {
        (least.min(error), most.max(error))
    });
    assert!(most <= 1.05 * least, "{errors:?}");
    assert!(most <= 1e-3 * SPEED, "{errors:?}");
}

/// Rows of bodies and elements of every kind, all tied to the ground or to each other.
fn long_network(count: usize, link: impl Fn(usize) -> Model, to_ground: &Model) -> Network {
    let mut network = Network::new();
    let ground = network.ground();
    let mut last = network.add_node(Node::mass("struck", MASS).moving(SPEED));
    let struck = last;
    for at in 0..count {
        let next = network.add_node(Node::mass(format!("m{at}"), MASS));
        network.connect(format!("l{at}"), last, next, link(at));
        network.connect(format!("g{at}"), next, ground, to_ground.clone());
        network.add_load(format!("p{at}"), struck, Waveform::constant(1.0));
        last = next;
    }
    network
}

#[test]
fn compiling_takes_memory_in_proportion_to_the_size() {
    let cubic = || part(CubicSpring { stiffness: STIFFNESS, cubic: STIFFNESS });
    let maxwell = || {
        Tree::Series(vec![
            Branch::new("spring", spring(STIFFNESS)),
            Branch::new("dashpot", dashpot(STIFFNESS)),
        ])
    };
    let rigid = |at: usize| if at.is_multiple_of(2) { spring(STIFFNESS) } else { part(Rigid) };
    let networks: [&dyn Fn(usize) -> Network; 3] = [
        &|count| long_network(count, |_| spring(STIFFNESS), &cubic()),
        &|count| long_network(count, |_| maxwell(), &kelvin(STIFFNESS, 1.0)),
        &|count| long_network(count, rigid, &spring(STIFFNESS)),
    ];
    for (at, network) in networks.iter().enumerate() {
        let [small, large] = [1000, 4000].map(|count| {
            let network = network(count);
            measure(|| drop(network.compile(0.01).unwrap())).bytes_max as f64
        });
        // Tables grow by doubling.
        assert!(large < 8.0 * small, "network {at}: {small} and {large} bytes");
    }
}
