//! Sweeps against single runs.

mod bent;
mod elastic;

use std::ops::ControlFlow;

use dashpot_network::{
    Network, Node, dashpot,
    effects::{Gravity, GravityStart},
    spring,
};
use dashpot_rheology::Tree;

use super::*;
use crate::{Choice, Solve};

/// Numbers of a generator of its own, so that a failure can be repeated.
struct Random(u64);

impl Random {
    /// A number of 0…1.
    fn share(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A number from `low` to `high`, all ratios being as likely.
    fn ratio(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.share())
    }
}

/// 10 kg at 10 m/s on a pad over 100 kg on a mount.
fn struck(pad: dashpot_network::Model, mount: f64) -> Network {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 10.0).moving(10.0));
    let panel = network.add_node(Node::mass("panel", 100.0));
    network.connect("padding", head, panel, pad).thickness = Some(0.02);
    let mount = Tree::parallel([spring(5e7), dashpot(mount)]);
    network.connect("mount", panel, network.ground(), mount);
    network
}

/// The pads that are tried: Burgers, Zener, three Maxwell branches, and a Kelvin chain behind a dashpot.
fn pad(shape: usize, random: &mut Random) -> dashpot_network::Model {
    let mut k = || spring(random.ratio(5e6, 8e7));
    let springs = [k(), k(), k()];
    let mut c = || dashpot(random.ratio(1.5e3, 2e4));
    let dashpots = [c(), c(), c()];
    let [k1, k2, k3] = springs;
    let [c1, c2, c3] = dashpots;
    match shape {
        0 => Tree::series([k1, c1, Tree::parallel([k2, c2])]),
        1 => Tree::parallel([k1, Tree::series([k2, c2])]),
        2 => {
            Tree::parallel([Tree::series([k1, c1]), Tree::series([k2, c2]), Tree::series([k3, c3])])
        }
        _ => Tree::series([c1, Tree::parallel([k1, c2]), Tree::parallel([k2, c3])]),
    }
}

fn scene_point(network: Network) -> ScenePoint {
    ScenePoint { network, settings: SolveSettings::lasting(0.04) }
}

fn swept(networks: &[Network], keys: &[&str], threads: usize) -> SweepReport {
    let keys: Vec<String> = keys.iter().map(|key| (*key).to_owned()).collect();
    let (columns, wishes) = columns(&scene_point(networks[0].clone()), &keys).unwrap();
    let pose = |places: &[usize]| {
        let mut own = scene_point(networks[places[0]].clone());
        own.settings.measures.clone_from(&wishes);
        Ok(own)
    };
    let grid = Grid::new(vec![networks.len()]).unwrap();
    sweep(
        &grid,
        &pose,
        &columns,
        SweepOptions { threads, ..SweepOptions::default() },
        &mut |_, _| ControlFlow::Continue(()),
    )
    .unwrap()
}

/// What a sweep is warned of at a point, but for numbers.
fn warned_at(found: &SweepReport, point: usize) -> Vec<String> {
    let here = found.warnings.iter().filter(|warning| warning.points.contains(&point));
    sorted(here.map(|here| kind(&here.warning)))
}

fn kind(warning: &Warning) -> String {
    format!("{} of {}", warning.code(), warning.names().join(", "))
}

fn sorted(all: impl Iterator<Item = String>) -> Vec<String> {
    let mut all: Vec<String> = all.collect();
    all.sort();
    all
}

#[test]
fn instantiated_values_are_those_of_full_runs_within_their_errors() {
    let mut random = Random(7);
    for shape in 0..4 {
        let networks: Vec<Network> = (0..60)
            .map(|_| {
                let mount = random.ratio(2e3, 1e5);
                struck(pad(shape, &mut random), mount)
            })
            .collect();
        let found = swept(&networks, &[], 2);
        assert!(found.instantiated >= 50, "{shape}: {} of 60", found.instantiated);
        let width = found.columns.len();
        for (at, network) in networks.iter().enumerate() {
            let full = network.solve(0.04).unwrap();
            assert_eq!(warned_at(&found, at), sorted(full.warnings.iter().map(kind)));
            for (place, column) in found.columns.iter().enumerate() {
                let measure = full.measure(&column.key).unwrap();
                let unit = if column.is_share { 0.02 } else { 1.0 };
                let (value, error) =
                    (found.values[at * width + place], found.errors[at * width + place]);
                let Some(right) = measure.value else {
                    assert!(value.is_nan(), "{shape} {at} {}", column.key);
                    continue;
                };
                let room = error + measure.error.unwrap_or(0.0) / unit;
                let difference = (value - right / unit).abs();
                assert!(
                    difference <= room,
                    "{shape} {at} {}: {value} against {}: {difference:e} of {room:e}",
                    column.key,
                    right / unit
                );
            }
        }
    }
}

#[test]
fn the_result_is_the_same_to_the_bit_by_any_number_of_threads() {
    let mut random = Random(3);
    let networks: Vec<Network> = (0..200).map(|_| struck(pad(0, &mut random), 1e4)).collect();
    let bits = |sweep_report: &SweepReport| -> Vec<u64> {
        sweep_report
            .values
            .iter()
            .chain(&sweep_report.errors)
            .map(|value| value.to_bits())
            .collect()
    };
    let alone = swept(&networks, &[], 1);
    for threads in [2, 5] {
        let other = swept(&networks, &[], threads);
        assert_eq!(bits(&other), bits(&alone));
        assert_eq!((other.instantiated, other.gaps), (alone.instantiated, alone.gaps.clone()));
    }
}

#[test]
fn scenes_of_another_kind_are_solved_in_full() {
    let mut random = Random(1);
    let mut network = struck(pad(0, &mut random), 1e4);
    network.add_effect(Gravity { acceleration: 9.81, start: GravityStart::Unloaded });
    let found = swept(&vec![network; 3], &["padding.peak-force"], 1);
    assert_eq!((found.instantiated, found.checked.len()), (0, 0));
    assert!(found.column(0).all(|own| own > 1e4));
    // A force that decays for ever is not one that ends.
    let mut lasting = Network::new();
    let head = lasting.add_node(Node::mass("head", 10.0).moving(10.0));
    lasting.connect("padding", head, lasting.ground(), dashpot(4e3));
    let found = swept(&[lasting.clone(), lasting], &["padding.peak-force"], 1);
    assert_eq!(found.instantiated, 0);
    assert!(found.column(0).all(|own| (own / 4e4 - 1.0).abs() < 1e-9));
}

#[test]
fn instantiated_points_are_warned_of_what_full_ones_are() {
    // The head of 10 kg throws the light plate off; what stops both comes after the impact.
    let struck_twice = |(mass, damping): (f64, f64)| {
        let mut network = Network::new();
        let head = network.add_node(Node::mass("head", 10.0).moving(10.0));
        let plate = network.add_node(Node::mass("plate", mass));
        let pad = Tree::parallel([spring(1e6), dashpot(damping)]);
        network.connect("padding", head, plate, pad).thickness = Some(0.02);
        let mount = Tree::parallel([spring(1e5), dashpot(10.0)]);
        network.connect("mount", plate, network.ground(), mount);
        network
    };
    let networks: Vec<Network> =
        [(0.1, 10.0), (0.2, 10.0), (20.0, 1e3), (40.0, 1e3)].map(struck_twice).to_vec();
    let found = swept(&networks, &["padding.peak-force"], 1);
    for (at, network) in networks.iter().enumerate() {
        let full = network.solve(0.04).unwrap();
        assert_eq!(warned_at(&found, at), sorted(full.warnings.iter().map(kind)));
    }
    let harder = found
        .warnings
        .iter()
        .find(|warning| warning.warning.to_string().contains("more than in the impact"))
        .unwrap();
    assert_eq!(harder.points, [0, 1]);
    let pulls = found
        .warnings
        .iter()
        .find(|warning| warning.warning.to_string().contains("in tension"))
        .unwrap();
    assert_eq!(pulls.points, [0, 1, 2, 3]);
    assert_eq!(found.instantiated, 2, "{:?}", found.warnings);
}

#[test]
fn a_run_that_ends_in_contact_is_warned_of() {
    let mut random = Random(5);
    let network = struck(pad(0, &mut random), 1e4);
    let (columns, wishes) =
        columns(&scene_point(network.clone()), &["padding.peak-force".to_owned()]).unwrap();
    let pose = |places: &[usize]| {
        let mut own = scene_point(network.clone());
        own.settings.duration = [1e-3, 2e-3, 0.03, 0.04][places[0]];
        own.settings.measures.clone_from(&wishes);
        Ok(own)
    };
    let grid = Grid::new(vec![4]).unwrap();
    let found = sweep(&grid, &pose, &columns, SweepOptions::default(), &mut |_, _| {
        ControlFlow::Continue(())
    })
    .unwrap();
    let lasting = found
        .warnings
        .iter()
        .find(|warning| warning.warning.to_string().contains("still in contact"))
        .unwrap();
    assert_eq!(lasting.points, [0, 1]);
    assert!(lasting.warning.to_string().contains("at 1.00 ms"), "{}", lasting.warning);
}

#[test]
fn another_padding_is_watched_too() {
    let mut random = Random(9);
    let mut networks = Vec::new();
    for thickness in [1e-4, 0.5] {
        let mut network = Network::new();
        let head = network.add_node(Node::mass("head", 10.0).moving(10.0));
        let panel = network.add_node(Node::mass("panel", 1.0));
        network.connect("padding", head, panel, pad(0, &mut random));
        let below = Tree::parallel([spring(5e6), dashpot(1e3)]);
        network.connect("below", panel, network.ground(), below).thickness = Some(thickness);
        networks.push(network);
    }
    let found = swept(&networks, &["padding.peak-force"], 1);
    let pressed = found
        .warnings
        .iter()
        .find(|warning| warning.warning.to_string().contains("pressed in"))
        .unwrap();
    assert!(pressed.warning.to_string().contains("below"));
    assert_eq!(pressed.points, [0]);
}

#[test]
fn a_measure_that_is_not_known_is_named_with_those_that_are() {
    let mut random = Random(1);
    let scene = scene_point(struck(pad(0, &mut random), 1e4));
    let fault = columns(&scene, &["padding.peak-forse".to_owned()]).unwrap_err();
    let SweepError::Run(crate::RunError::NoMeasure { known, .. }) = &fault else {
        panic!("{fault}")
    };
    assert!(known.contains(&"padding.peak-force".to_owned()), "{fault}");
    let (found, wishes) = columns(&scene, &["head.hic15".to_owned()]).unwrap();
    let shares: Vec<bool> = found.iter().map(|own| own.is_share).collect();
    assert_eq!((shares.as_slice(), wishes.len()), (&[false, true][..], 1));
}

#[test]
fn points_that_fail_are_gaps_and_the_others_stand() {
    let mut random = Random(1);
    let network = struck(pad(0, &mut random), 1e4);
    let (columns, _) =
        columns(&scene_point(network.clone()), &["padding.energy".to_owned()]).unwrap();
    let pose = |places: &[usize]| match places[0] {
        2 => Err("no such scene".to_owned()),
        _ => Ok(scene_point(network.clone())),
    };
    let grid = Grid::new(vec![5]).unwrap();
    let found = sweep(&grid, &pose, &columns, SweepOptions::default(), &mut |_, _| {
        ControlFlow::Continue(())
    })
    .unwrap();
    assert_eq!(found.gaps.len(), 1);
    assert_eq!((found.gaps[0].point, found.gaps[0].cause.message.as_str()), (2, "no such scene"));
    let finite: Vec<bool> = found.column(0).map(f64::is_finite).collect();
    assert_eq!(finite, [true, true, false, true, true]);
}
