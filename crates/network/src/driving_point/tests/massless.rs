use super::*;
use crate::{driving_point::DrivingPointError, elements::Rigid, linear_model, part};

/// Of doubles that come from twice the digits, through at most a few roundings.
const DOUBLES: f64 = 4.0 * f64::EPSILON;

fn tree(dice: &mut Stream, depth: usize, in_series: bool) -> Model {
    if depth == 0 || dice.share() < 0.2 {
        let constant = around(dice, 6.0);
        return if dice.share() < 0.5 { spring(constant) } else { dashpot(constant) };
    }
    let count = 2 + dice.below(2);
    let branches: Vec<Model> = (0..count).map(|_| tree(dice, depth - 1, !in_series)).collect();
    if in_series { Tree::series(branches) } else { Tree::parallel(branches) }
}

#[test]
fn a_tree_responds_as_its_linear_model() {
    let mut dice = Stream::new(7);
    for round in 0..60 {
        let tree = tree(&mut dice, 4, round % 2 == 0);
        let (network, nodes) = network(&[0.0], &[(1, 0, tree.clone())]);
        let found = massless(&network, nodes[1], nodes[0]);
        assert!(found.error < 1e-15, "{:e}", found.error);
        assert_same(&found.model, &linear_model(&tree), DOUBLES);
    }
}

#[test]
fn times_over_twenty_four_decades_keep_all_digits() {
    let elements = (0..13).map(|k| kelvin(3.0, 3.0 * 10_f64.powi(2 * k - 12)));
    let series = Tree::series(elements);
    let parallel = Tree::parallel(
        (0..13).map(|k| maxwell(10_f64.powi((5 * k) % 16), 10_f64.powi((5 * k) % 16 + 2 * k - 12))),
    );
    for tree in [series, parallel] {
        let (network, nodes) = network(&[0.0, 0.0], &[(1, 2, tree.clone())]);
        let found = massless(&network, nodes[1], nodes[2]);
        assert!(found.error < 1e-13, "{:e}", found.error);
        assert_same(&found.model, &linear_model(&tree), DOUBLES.max(2.0 * found.error));
    }
}

/// Springs in the arms, a dashpot across.
fn wheatstone([k1, k2, k3, k4]: [f64; 4], c: f64) -> Massless {
    let links = [
        (1, 2, spring(k1)),
        (2, 0, spring(k2)),
        (1, 3, spring(k3)),
        (3, 0, spring(k4)),
        (2, 3, dashpot(c)),
    ];
    let (network, nodes) = network(&[0.0; 3], &links);
    massless(&network, nodes[1], nodes[0])
}

#[test]
fn a_bridge_out_of_balance_is_its_closed_form() {
    for (arms, c) in [([1.0, 2.0, 5.0, 3.0], 0.7), ([1e6, 3.0, 2e-3, 8.0], 1e4)] {
        let [k1, k2, k3, k4] = arms;
        let found = wheatstone(arms, c);
        let fast = (k1 + k3) * (k2 + k4) / (k1 + k2 + k3 + k4);
        let slow = k1 * k2 / (k1 + k2) + k3 * k4 / (k3 + k4);
        let rate = (k1 * k3 / (k1 + k3) + k2 * k4 / (k2 + k4)) / c;
        let form = found.model.kelvin().unwrap();
        assert!(near(form.spring_compliance(), 1.0 / fast, DOUBLES));
        assert_eq!(form.elements().len(), 1);
        assert!(near(form.elements()[0].rate.high(), rate, DOUBLES));
        // The difference of two compliances: their rounding counts.
        let change = (form.elements()[0].compliance - (1.0 / slow - 1.0 / fast)).abs();
        assert!(change <= DOUBLES / slow);
        assert!(found.hidden.is_empty());
    }
}

#[test]
fn a_bridge_in_balance_hides_its_mode() {
    // The second one is in balance but for the rounding of its constants.
    for (arms, c) in [([1.0, 2.0, 3.0, 6.0], 5.0), ([0.1, 0.3, 0.7, 3.0 * 0.7], 0.9)] {
        let [k1, k2, k3, k4] = arms;
        let found = wheatstone(arms, c);
        let stiffness = k1 * k2 / (k1 + k2) + k3 * k4 / (k3 + k4);
        let form = found.model.kelvin().unwrap();
        assert!(form.elements().is_empty());
        assert!(near(form.spring_compliance(), 1.0 / stiffness, DOUBLES));
        let rate = (k1 * k3 / (k1 + k3) + k2 * k4 / (k2 + k4)) / c;
        assert_eq!(found.hidden.len(), 1);
        assert_eq!(found.hidden[0].count, 1);
        assert!(near(found.hidden[0].rate[0], -rate, DOUBLES));
    }
}

#[test]
fn a_faint_mode_that_the_constants_determine_is_kept() {
    // A Maxwell element 1e15 times softer than the spring beside it.
    let tree = Tree::parallel([spring(1e15), maxwell(1.0, 2.0)]);
    let (network, nodes) = network(&[0.0], &[(1, 0, tree.clone())]);
    let found = massless(&network, nodes[1], nodes[0]);
    assert!(found.hidden.is_empty());
    assert_same(&found.model, &linear_model(&tree), DOUBLES);
}

#[test]
fn star_and_delta_of_dashpots_respond_alike() {
    let intervals = [3.0, 5e4, 7e-3];
    let sum: f64 = intervals.iter().sum();
    let rest =
        [(1, 2, spring(4.0)), (1, 3, spring(0.2)), (2, 0, kelvin(9.0, 2.0)), (3, 0, spring(1.5))];
    let star = [(1, 4), (2, 4), (3, 4)].into_iter().zip(intervals);
    let star: Vec<_> = rest
        .iter()
        .cloned()
        .chain(star.map(|((p, q), interval)| (p, q, dashpot(interval))))
        .collect();
    let pairs = [
        (1, 2, intervals[0] * intervals[1]),
        (2, 3, intervals[1] * intervals[2]),
        (3, 1, intervals[2] * intervals[0]),
    ];
    let delta: Vec<_> = rest
        .iter()
        .cloned()
        .chain(pairs.into_iter().map(|(p, q, product)| (p, q, dashpot(product / sum))))
        .collect();
    let (star, nodes) = network(&[0.0; 4], &star);
    let star = massless(&star, nodes[1], nodes[0]);
    let (delta, nodes) = network(&[0.0; 3], &delta);
    // The constants of the delta are rounded, which the weak modes feel many times over.
    let delta = massless(&delta, nodes[1], nodes[0]);
    assert_same(&star.model, &delta.model, 1e-13);
    assert!(star.model.least_elements() > 3);
}

/// A square lattice of springs and dashpots over twelve decades between opposite corners.
fn lattice(side: usize, seed: u64, number: impl Fn(usize) -> usize) -> Massless {
    let mut dice = Stream::new(seed);
    let mut links = Vec::new();
    for row in 0..side {
        for column in 0..side {
            let at = side * row + column;
            for (other, fits) in [(at + 1, column + 1 < side), (at + side, row + 1 < side)] {
                let model = kelvin(around(&mut dice, 6.0), around(&mut dice, 6.0));
                if fits {
                    links.push((number(at) + 1, number(other) + 1, model));
                }
            }
        }
    }
    let (network, nodes) = network(&vec![0.0; side * side], &links);
    massless(&network, nodes[number(0) + 1], nodes[number(side * side - 1) + 1])
}

#[test]
fn a_lattice_does_not_depend_on_the_order_of_its_nodes() {
    for seed in 1..6 {
        let straight = lattice(3, seed, |at| at);
        let shuffled = lattice(3, seed, |at| (at * 4 + 5) % 9);
        assert!(straight.error < 1e-20);
        assert_same(&straight.model, &shuffled.model, DOUBLES);
    }
}

#[test]
fn a_lattice_of_equal_elements_shows_one_mode_only() {
    let side = 4;
    let mut links = Vec::new();
    for at in 0..side * side {
        for (other, fits) in [(at + 1, (at + 1) % side > 0), (at + side, at + side < side * side)] {
            if fits {
                links.push((at + 1, other + 1, kelvin(3.0, 0.5)));
            }
        }
    }
    let (network, nodes) = network(&vec![0.0; side * side], &links);
    let found = massless(&network, nodes[1], nodes[side * side]);
    let form = found.model.kelvin().unwrap();
    assert_eq!(form.elements().len(), 1);
    assert!(near(form.elements()[0].rate.high(), 6.0, DOUBLES));
    assert_eq!(found.hidden.iter().map(|hidden| hidden.count).sum::<usize>(), side * side - 2);
}

#[test]
fn what_hangs_loose_does_not_matter() {
    let pad = kelvin(2.0, 3.0);
    let links = [
        (1, 0, pad.clone()),
        (1, 2, spring(5.0)),
        (2, 3, maxwell(1.0, 1.0)),
        (4, 0, spring(1.0)),
        (5, 0, dashpot(1.0)),
    ];
    let (network, nodes) = network(&[0.0, 0.0, 0.0, 1.0, 0.0], &links);
    let found = massless(&network, nodes[1], nodes[0]);
    assert_same(&found.model, &linear_model(&pad), DOUBLES);
    assert!(found.hidden.is_empty());
}

#[test]
fn rigidly_linked_nodes_give_a_rigid_link() {
    let (network, nodes) = network(&[0.0; 2], &[(1, 2, part(Rigid)), (2, 0, spring(1.0))]);
    assert!(massless(&network, nodes[1], nodes[2]).model.maxwell().is_none());
}

#[test]
fn a_force_that_meets_nothing_is_refused_by_name() {
    let (network, nodes) = network(&[0.0; 3], &[(1, 2, spring(1.0)), (3, 0, spring(1.0))]);
    let error = network.driving_point(nodes[1], nodes[3]).unwrap_err();
    assert_eq!(error, DrivingPointError::NothingResists { node: "n1".into() });
}
