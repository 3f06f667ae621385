//! Tests of what is left out: every claim beside runs with and without it.

use std::sync::{
    Arc,
    atomic::{AtomicUsize, Ordering},
};

use dashpot_dae::{Silent, Waveform};
use dashpot_network::{
    Effect, Influence, Network, Node, NodeId, Situation,
    effects::{Face, Gravity, GravityStart, Stop, Touch},
    elements::{Dashpot, Spring},
    layers::{Layer, Layers, Resolution},
    parameters::Described,
    part,
};
use dashpot_rheology::Tree;

use super::*;
use crate::{Accuracy, MeasureWish, Solve, differences, measures::PeakForce};

/// The reference impact of the thesis at a speed \[m/s\].
fn at_speed(speed: f64) -> Network {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 10.0).moving(speed));
    let panel = network.add_node(Node::mass("panel", 100.0));
    let spring = || part(Spring { stiffness: 2e7 });
    let dashpot = |damping: f64| part(Dashpot { damping });
    let kelvin = Tree::parallel([spring(), dashpot(4e3)]);
    let pad = Tree::series([spring(), dashpot(6e3), kelvin]);
    network.connect("padding", head, panel, pad).thickness = Some(0.02);
    let mount = Tree::parallel([part(Spring { stiffness: 5e7 }), dashpot(1e4)]);
    network.connect("mount", panel, network.ground(), mount);
    network
}

fn reference() -> Network {
    at_speed(10.0)
}

fn gravity(acceleration: f64) -> Gravity {
    Gravity { acceleration, start: GravityStart::Equilibrium }
}

fn with(mut network: Network, effect: impl Effect + 'static) -> Network {
    network.add_effect(effect);
    network
}

fn below(bound: Option<f64>) -> SolveSettings {
    let accuracy = Accuracy { neglect_below: bound, ..Accuracy::default() };
    SolveSettings { accuracy, ..SolveSettings::lasting(0.02).by_name("exact").unwrap() }
}

fn run(network: &Network, bound: Option<f64>) -> RunReport {
    network.solve_with(&below(bound)).unwrap()
}

fn left_out(partial: &Partial) -> Vec<&str> {
    partial.left_out.iter().map(|own| own.effect.as_str()).collect()
}

fn put_back(partial: &Partial) -> Vec<&str> {
    partial.put_back.iter().map(|own| own.effect.as_str()).collect()
}

fn values(report: &RunReport) -> Vec<Option<u64>> {
    report.measures.iter().map(|measure| measure.value.map(f64::to_bits)).collect()
}

/// The measure that differs the most between two runs, and by how much.
fn largest_difference(one: &RunReport, other: &RunReport) -> (String, f64) {
    let all = differences(one, other).into_iter();
    let largest = all.max_by(|one, other| one.relative.total_cmp(&other.relative)).unwrap();
    (largest.key, largest.relative)
}

/// A body force on the impactor whose number is what it is told to be; it counts how often it is
/// asked.
#[derive(Debug)]
struct Push {
    acceleration: f64,
    number: f64,
    compiled: Arc<AtomicUsize>,
    estimated: Arc<AtomicUsize>,
}

impl Push {
    fn new(acceleration: f64, number: f64) -> Self {
        let (compiled, estimated) = (Arc::default(), Arc::default());
        Self { acceleration, number, compiled, estimated }
    }
}

impl Described for Push {
    fn kind(&self) -> &'static str {
        "push"
    }
}

impl Effect for Push {
    fn body_forces(&self, network: &Network) -> Vec<(NodeId, Waveform)> {
        self.compiled.fetch_add(1, Ordering::Relaxed);
        let head = network.node_named("head").unwrap();
        vec![(head, Waveform::constant(network.node(head).mass * self.acceleration))]
    }

    fn influences(&self, _situation: &Situation<'_>) -> Vec<Influence> {
        self.estimated.fetch_add(1, Ordering::Relaxed);
        vec![Influence::new("as told", self.number)]
    }
}

#[test]
fn what_is_left_out_costs_what_runs_with_and_without_it_differ_by() {
    let network = with(reference(), gravity(9.806_65));
    let (full, bare) = (run(&network, None), run(&reference(), None));
    let report = run(&network, Some(0.01));
    let partial = report.partial.as_ref().unwrap();
    assert_eq!(left_out(partial), ["gravity"]);
    assert!(partial.put_back.is_empty() && report.system.effects.is_empty());
    assert_eq!(values(&report), values(&bare));
    let (key, most) = largest_difference(&full, &bare);
    let worst = partial.worst().unwrap();
    assert_eq!((&worst.measure, worst.relative.to_bits()), (&key, most.to_bits()));
    assert_eq!(partial.left_out[0].alone.as_ref(), Some(worst));
    assert_eq!(partial.verification.solves, 1);
    // The errors reach from what is reported to what is true.
    for measure in &report.measures {
        let right = full.measure(&measure.key).unwrap();
        let off = (measure.value.unwrap() - right.value.unwrap()).abs();
        assert!(measure.error.unwrap() >= off, "{}", measure.key);
        assert!(measure.error.unwrap() <= 0.0101 * measure.size, "{}", measure.key);
    }
}

#[test]
fn the_estimate_of_the_thesis_is_not_enough_for_its_own_impact() {
    // A = 0.00196 is below 0.5 %, but the contact lasts 0.77 % longer.
    let network = with(reference(), gravity(9.806_65));
    let (full, bare) = (run(&network, None), run(&reference(), None));
    let (key, most) = largest_difference(&full, &bare);
    assert_eq!(key, "padding.contact-time");
    assert!(most > 0.0077 && most < 0.0078, "{most}");
    let report = run(&network, Some(0.005));
    let partial = report.partial.as_ref().unwrap();
    assert!(partial.left_out.is_empty() && partial.costs.is_empty());
    assert_eq!(put_back(partial), ["gravity"]);
    let Why::Moves(cost) = &partial.put_back[0].why else { panic!("{partial:?}") };
    assert_eq!((&cost.measure, cost.relative.to_bits()), (&key, most.to_bits()));
    assert!((partial.put_back[0].influence.value - 0.001_961_33).abs() < 1e-15);
    assert_eq!(values(&report), values(&full));
    assert_eq!(report.system.effects, ["gravity"]);
}

#[test]
fn an_estimate_that_is_wrong_by_orders_is_found_out() {
    let network = with(reference(), Push::new(1e3, 1e-9));
    let report = run(&network, Some(0.01));
    let partial = report.partial.as_ref().unwrap();
    assert_eq!((left_out(partial), put_back(partial)), (vec![], vec!["push"]));
    assert_eq!(values(&report), values(&run(&network, None)));
}

#[test]
fn what_is_above_the_bound_by_estimate_is_never_tried() {
    let network = with(reference(), gravity(9.806_65));
    let report = run(&network, Some(0.001));
    let partial = report.partial.as_ref().unwrap();
    assert!(partial.left_out.is_empty() && partial.put_back.is_empty());
    assert_eq!(partial.verification, Verification::default());
    assert_eq!(values(&report), values(&run(&network, None)));
}

#[test]
fn without_a_bound_nothing_is_estimated_and_nothing_solved_again() {
    let push = Push::new(1.0, 1e-9);
    let (compiled, estimated) = (Arc::clone(&push.compiled), Arc::clone(&push.estimated));
    let network = with(reference(), push);
    network.compile(0.02).unwrap();
    let once = compiled.swap(0, Ordering::Relaxed);
    let report = run(&network, None);
    assert_eq!(report.partial, None);
    assert_eq!(compiled.swap(0, Ordering::Relaxed), once);
    assert_eq!(estimated.load(Ordering::Relaxed), 0);
    run(&network, Some(0.01));
    assert!(estimated.load(Ordering::Relaxed) > 0);
}

#[test]
fn those_that_together_exceed_the_bound_are_put_back_one_by_one() {
    // Each moves the time of contact by half of what gravity does, 0.39 %.
    let network = with(with(reference(), gravity(4.0)), gravity(5.0));
    let report = run(&network, Some(0.005));
    let partial = report.partial.as_ref().unwrap();
    assert_eq!((left_out(partial), put_back(partial)), (vec!["gravity"], vec!["gravity"]));
    let sizes = [partial.put_back[0].influence.value, partial.left_out[0].influence.value];
    assert!(sizes[0] > sizes[1], "{sizes:?}");
    let kept = run(&with(reference(), gravity(5.0)), None);
    assert_eq!(values(&report), values(&kept));
    // All together, each alone, the one that remains; and the full one that is not reported.
    assert_eq!(partial.verification.solves, 4);
    assert!(partial.left_out[0].alone.is_some());
}

#[test]
fn an_innocent_effect_is_not_put_back_with_the_culprit() {
    let stop = Stop {
        element: "padding".to_owned(),
        at: Some(0.05),
        restitution: 0.0,
        stiffness: None,
        damping: 0.0,
    };
    let network = with(with(reference(), Push::new(100.0, 1e-9)), stop);
    let report = run(&network, Some(0.01));
    let partial = report.partial.as_ref().unwrap();
    assert_eq!(left_out(partial), ["stop.padding"]);
    assert_eq!(put_back(partial), ["push"]);
    assert!(partial.worst().unwrap().most() < 1e-9, "{:?}", partial.worst());
    assert!(report.system.modes == 1 && report.assembly.switching.is_none());
    assert!(partial.unreported.iter().all(|key| key.starts_with("padding.stop.")));
}

#[test]
fn what_is_asked_for_by_name_is_kept() {
    let face = Face { element: "padding".to_owned(), mass: 0.01, at: None, touch: Touch::Moving };
    let network = with(reference(), face);
    let mut settings = below(Some(0.01));
    settings.measures = vec![MeasureWish::new("padding.contact", PeakForce::default())];
    let report = network.solve_with(&settings).unwrap();
    let partial = report.partial.as_ref().unwrap();
    assert_eq!((left_out(partial), put_back(partial)), (vec![], vec!["face.padding"]));
    let Why::Fails(error) = &partial.put_back[0].why else { panic!("{partial:?}") };
    assert!(matches!(error, RunError::UnknownTarget { .. }), "{error}");
}

#[test]
fn a_bound_out_of_its_range_is_refused() {
    for bound in [0.0, -1.0, 0.21, 1.0, f64::NAN] {
        let error = reference().solve_with(&below(Some(bound))).unwrap_err();
        assert!(matches!(error, RunError::InvalidSetting { .. }), "{error}");
    }
}

/// The reference impact with gravity at these speeds.
fn speeds(all: impl IntoIterator<Item = f64>) -> Vec<Network> {
    all.into_iter().map(|speed| with(at_speed(speed), gravity(9.806_65))).collect()
}

#[test]
fn a_sweep_is_verified_at_points_spread_over_it() {
    let networks = speeds((0..16).map(|at| 12.0 + f64::from(at)));
    let found = sweep(&networks, &below(Some(0.01)), &mut Silent).unwrap();
    assert_eq!(found.checked, [0, 5, 10, 15]);
    assert_eq!(found.saving.solves, 16 + 4);
    assert_eq!(found.left_out.len(), 1);
    assert!(found.put_back.is_empty());
    let worst = found.worst.unwrap();
    // The slowest one feels gravity the most, so its error is that of all others, too.
    for (network, run) in networks.iter().zip(&found.runs) {
        let reduced = run.as_ref().unwrap();
        assert!(reduced.system.effects.is_empty());
        let full = network.solve_with(&below(None)).unwrap();
        let (key, most) = largest_difference(&full, reduced);
        assert!(most <= worst.most(), "{key}: {most}, not {}", worst.most());
    }
}

#[test]
fn a_single_point_of_a_sweep_puts_an_effect_back_everywhere() {
    // At 5 m/s A = 0.0078 is below 1 %, but the contact lasts longer by more.
    let networks = speeds([5.0, 10.0, 15.0, 20.0]);
    let found = sweep(&networks, &below(Some(0.01)), &mut Silent).unwrap();
    assert!(found.left_out.is_empty() && found.worst.is_none());
    assert_eq!(found.put_back.len(), 1);
    for (network, run) in networks.iter().zip(&found.runs) {
        let full = network.solve_with(&below(None)).unwrap();
        assert_eq!(values(run.as_ref().unwrap()), values(&full));
    }
}

#[test]
fn a_sweep_without_a_bound_solves_each_network_once() {
    let networks = speeds([10.0, 11.0, 12.0, 13.0]);
    let found = sweep(&networks, &below(None), &mut Silent).unwrap();
    assert_eq!(found.saving.solves, 4);
    assert!(found.checked.is_empty() && found.left_out.is_empty());
    assert!(sweep(&[], &below(Some(0.01)), &mut Silent).unwrap().runs.is_empty());
}

#[test]
fn a_run_of_a_sweep_that_fails_stands_among_the_others() {
    let mut networks = speeds([12.0, 13.0, 14.0, 15.0, 16.0]);
    let ground = networks[2].ground();
    networks[2].connect("bad", ground, ground, part(Spring { stiffness: -1.0 }));
    let found = sweep(&networks, &below(Some(0.01)), &mut Silent).unwrap();
    let failed: Vec<bool> = found.runs.iter().map(Result::is_err).collect();
    assert_eq!(failed, [false, false, true, false, false]);
    assert_eq!(found.checked, [0, 4]);
}

/// 10 kg on a fixed pad of a light material, cut into segments.
fn layered(speed: f64) -> Network {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 10.0).moving(speed));
    let model = part(Spring { stiffness: 5e6 });
    let (name, resolution) = ("felt".to_owned(), Resolution::Segments(4));
    let layer = Layer { name, thickness: 0.02, area: 0.01, density: 1.0, model };
    let layers = Layers { all: vec![layer], resolution };
    network.connect_layers("padding", head, network.ground(), layers);
    network
}

#[test]
fn a_sweep_saves_the_work_of_layers_whose_mass_is_little() {
    let networks: Vec<Network> = (0..9).map(|at| layered(5.0 + 0.5 * f64::from(at))).collect();
    let shorter = |bound: Option<f64>| SolveSettings { duration: 0.005, ..below(bound) };
    let found = sweep(&networks, &shorter(Some(0.01)), &mut Silent).unwrap();
    assert_eq!(found.left_out.len(), 1, "{:?}", found.put_back);
    assert_eq!((found.checked.len(), found.saving.solves), (3, 9 + 3));
    let states = |run: &Result<RunReport, RunError>| run.as_ref().unwrap().system.states;
    assert!(found.runs.iter().all(|run| states(run) == 2));
    // Side by side: a third of the full runs, and nine that take next to nothing.
    let in_full = sweep(&networks, &shorter(None), &mut Silent).unwrap();
    assert_eq!((in_full.saving.solves, states(&in_full.runs[0])), (9, 2 + 2 * 4));
    assert!(found.saving.wall < in_full.saving.wall, "{:?} {:?}", found.saving, in_full.saving);
    assert!(found.saving.wall < found.saving.wall_in_full, "{:?}", found.saving);
}

fn energy(value: f64, size: f64) -> MeasureReport {
    MeasureReport {
        key: "pad.energy".to_owned(),
        target: "pad".to_owned(),
        kind: "energy",
        unit: "J",
        value: Some(value),
        time: None,
        window: None,
        error: Some(0.0),
        notes: Vec::new(),
        window_wish: None,
        parameters: Vec::new(),
        is_undetermined: false,
        size,
        excess: 0.0,
    }
}

#[test]
fn a_move_is_a_part_of_the_value_however_much_has_gone_to_and_fro() {
    let moved = cost(&energy(28.8, 110.0), &energy(32.0, 110.0));
    assert!((moved.relative - 0.1).abs() < 1e-12, "{}", moved.relative);
}

#[test]
fn a_move_of_what_is_given_back_is_a_part_of_what_went_to_and_fro() {
    let moved = cost(&energy(0.0, 100.0), &energy(0.01, 100.0));
    assert!((moved.relative - 0.002).abs() < 1e-12, "{}", moved.relative);
}
