//! What a comparison of two models says, against closed forms.

use std::f64::consts::TAU;

use dashpot::{
    analysis::{Solve, SolveSettings},
    network::model_of,
    rheology::{Canonical, LinearModel, Primitive, Tree, equivalence::compare},
    scene::reference,
};

use Primitive::{Dashpot, Rigid, Spring};

use super::{
    alone, canonical, kelvin, lay, lay_bridge, linear, massless, maxwell, padded, pair, scene,
};

/// A spring, a dashpot and Kelvin–Voigt elements of these times and compliances, in a row.
fn row(singles: Tree<Primitive>, terms: &[(f64, f64)]) -> Tree<Primitive> {
    let elements = terms
        .iter()
        .map(|(time, compliance)| Tree::parallel(pair(1.0 / compliance, time / compliance)));
    Tree::series([singles].into_iter().chain(elements))
}

#[test]
fn a_tree_its_two_forms_and_a_bridge_that_reduces_to_it_are_the_same() {
    let bell: Vec<(f64, f64)> = (0..12)
        .map(|at| (1e-6 * 10f64.powf(0.5 * f64::from(at)), 1e-9 * f64::from(at + 1)))
        .collect();
    let solid = Tree::parallel([Spring(4e5).into(), maxwell()]);
    let halves = [
        [maxwell(), kelvin()],
        [solid.clone(), kelvin()],
        [row(maxwell(), &bell), Spring(3e6).into()],
        [row(solid, &bell[..5]), row(Dashpot(2e3).into(), &bell[7..])],
    ];
    for (case, [above, below]) in halves.iter().enumerate() {
        let tree = Tree::series([above.clone(), below.clone()]);
        let own = linear(&tree);
        let bridge = alone(|network, ends| lay_bridge(network, ends, [above, below]));
        let graph = alone(|network, ends| lay(network, ends, &tree, "part"));
        let bridge = massless(&bridge);
        // The bridge has the midpoints' own motion besides, which never shows.
        assert!(!bridge.hidden.is_empty(), "{case}");
        let all: [LinearModel; 5] = [
            own.clone(),
            linear(&canonical(&own, Canonical::Maxwell)),
            linear(&canonical(&own, Canonical::Kelvin)),
            bridge.model,
            massless(&graph).model,
        ];
        for (i, first) in all.iter().enumerate() {
            for (j, second) in all.iter().enumerate() {
                let found = compare(first, second);
                assert!(found.is_same, "{case}: {i} and {j}: {found:#?}");
                assert_eq!(first.least_elements(), second.least_elements(), "{case}: {i} and {j}");
            }
        }
    }
}

/// The thesis' pad beside a Maxwell element that relaxes over 11 days.
fn beside_slow(stiffness: f64, damping: f64) -> Tree<Primitive> {
    Tree::parallel([Tree::series([maxwell(), kelvin()]), Tree::series(pair(stiffness, damping))])
}

/// `|Q(iω)|`.
fn size(model: &LinearModel, omega: f64) -> f64 {
    model.storage(omega).hypot(model.loss(omega))
}

/// That no frequency from 1e-12 to 1e12 rad/s shows a larger difference than the one found.
#[track_caller]
fn assert_worst(found: (f64, f64), difference: impl Fn(f64) -> f64) {
    let (omega, size) = found;
    // Differences in closed form and as found are each right to a few roundings; 0 is a limit.
    let there = difference(omega.max(1e-12));
    assert!((there / size - 1.0).abs() < 1e-9, "{size:e} at {omega:e}, but it is {there:e}");
    for at in -2400..=2400 {
        let omega = 10f64.powf(f64::from(at) / 200.0);
        assert!(difference(omega) <= size * (1.0 + 1e-9), "more than {size:e} at {omega:e}");
    }
}

#[test]
fn a_billionth_in_a_mode_that_no_impact_sees_makes_another_model() {
    // A billionth of 10 N/m beside 20 MN/m is less than the last digit of any force.
    let (stiffness, damping) = (10.0, 1e7);
    let first = beside_slow(stiffness, damping);
    let a = linear(&first);
    let reference = scene(reference());
    let measured = |tree: &Tree<Primitive>| {
        let network = padded(&reference, model_of(tree));
        let settings = SolveSettings::lasting(reference.run.duration).by_name("exact").unwrap();
        network.solve_with(&settings).unwrap().measures
    };
    let before = measured(&first);
    let more = 1.0 + 1e-9;
    for (other_stiffness, other_damping) in
        [(stiffness, damping * more), (stiffness * more, damping * more)]
    {
        let second = beside_slow(other_stiffness, other_damping);
        let b = linear(&second);
        let found = compare(&a, &b);
        assert!(!found.is_same, "{found:#?}");
        for form in [found.maxwell.unwrap(), found.kelvin.unwrap()] {
            // All of it is in one mode; others only follow in the Kelvin form.
            assert!(form.largest > 1e-12 && form.largest < 1.1e-9, "{}", form.largest);
        }
        let worst = found.worst.unwrap();
        // K′iω/(iω + r′) − K iω/(iω + r) = iω (iω δK + K K′ δC/(C C′))/((iω + r)(iω + r′)), where
        // the differences of doubles this close are exact.
        let [rate, other_rate] = [stiffness / damping, other_stiffness / other_damping];
        let extra = rate * other_rate * (other_damping - damping);
        let difference = |omega: f64| {
            let own = omega * (omega * (other_stiffness - stiffness)).hypot(extra)
                / (omega.hypot(rate) * omega.hypot(other_rate));
            own / size(&a, omega).max(size(&b, omega))
        };
        assert_worst((worst.omega, worst.stiffness), difference);
        assert!(worst.omega < 1e-3 && worst.time > 1.0 && worst.creep > 1e-12, "{worst:?}");
        for (one, other) in before.iter().zip(measured(&second)) {
            let gap = (one.value.unwrap() - other.value.unwrap()).abs();
            let threshold = one.error.unwrap() + other.error.unwrap();
            // The bound of `exact`: what it says of all digits that it has.
            assert!(
                gap <= threshold && threshold < 1e-11 * one.size,
                "{}: {gap:e} of {threshold:e}",
                one.key
            );
        }
    }
}

#[test]
fn models_that_differ_most_in_a_limit_are_said_to_differ_there() {
    let row = |stiffness, damping| linear(&Tree::series(pair(stiffness, damping)));
    let side = |stiffness, damping| linear(&Tree::parallel(pair(stiffness, damping)));
    // |Q₁ − Q₂|/max|Q| of Maxwell elements with unlike springs rises with ω to 1 − K₁/K₂, and the
    // creep t/C + 1/K differs by as much at once. With unlike dashpots it is the other way round,
    // and so on for Kelvin–Voigt elements; with times far apart the limits are far off as well.
    for [a, b] in [[1e7, 2e7], [1e-3, 2e-3], [1e12, 2e12]] {
        for (case, models, limits) in [
            ("springs in a row", [row(a, 6e3), row(b, 6e3)], [f64::INFINITY, 0.0]),
            ("dashpots in a row", [row(6e3, a), row(6e3, b)], [0.0, f64::INFINITY]),
            ("springs side by side", [side(a, 6e3), side(b, 6e3)], [0.0, f64::INFINITY]),
            ("dashpots side by side", [side(6e3, a), side(6e3, b)], [f64::INFINITY, 0.0]),
        ] {
            let worst = compare(&models[0], &models[1]).worst.unwrap();
            assert!((worst.stiffness - 0.5).abs() < 1e-6, "{case}, {a:e}: {worst:?}");
            assert!((worst.creep - 0.5).abs() < 1e-6, "{case}, {a:e}: {worst:?}");
            let found = [worst.omega, worst.time];
            assert!(
                found.iter().zip(limits).all(|(own, limit)| own.to_bits() == limit.to_bits()),
                "{case}: {worst:?}"
            );
        }
    }
    // With a mode besides.
    let [a, b] = [1e7, 2e7]
        .map(|stiffness| linear(&Tree::series([Tree::series(pair(stiffness, 6e3)), kelvin()])));
    let worst = compare(&a, &b).worst.unwrap();
    assert!((worst.stiffness - 0.5).abs() < 1e-6 && worst.omega.is_infinite(), "{worst:?}");
    assert!((worst.creep - 0.5).abs() < 1e-6 && worst.time <= 0.0, "{worst:?}");
}

#[test]
fn a_spring_and_a_dashpot_differ_most_where_they_are_equally_stiff() {
    // |K − iωC|/max(K, ωC) is √2 at ω = K/C and 1 in both limits.
    for (stiffness, damping) in [(2.0, 3.0), (2e7, 6e-3)] {
        let [a, b] = [Spring(stiffness), Dashpot(damping)].map(LinearModel::primitive);
        let worst = compare(&a, &b).worst.unwrap();
        assert!((worst.stiffness / 2f64.sqrt() - 1.0).abs() < 1e-6, "{worst:?}");
        // A maximum with a kink is found to 1e-6 of the distance of two places.
        assert!((worst.omega * damping / stiffness - 1.0).abs() < 1e-5, "{worst:?}");
        assert!((worst.creep - 1.0).abs() < 1e-6, "{worst:?}");
    }
}

#[test]
fn a_comparison_lists_stiffnesses_of_maxwell_and_compliances_of_kelvin_elements() {
    let own = linear(&Tree::series([maxwell(), kelvin()]));
    let found = compare(&own, &own);
    let element = &found.kelvin.unwrap().modes[0];
    assert!((element.time.first / 2e-4 - 1.0).abs() < 1e-14, "{element:?}");
    assert!((element.strength.first / 5e-8 - 1.0).abs() < 1e-14, "{element:?}");
    let stiffnesses: f64 =
        found.maxwell.unwrap().modes.iter().map(|mode| mode.strength.first).sum();
    assert!((stiffnesses / 2e7 - 1.0).abs() < 1e-14, "{stiffnesses}");
}

#[test]
fn poles_that_zeros_cancel_do_not_count() {
    // Two Maxwell elements of one relaxation time are one.
    let twice =
        linear(&Tree::parallel([Tree::series(pair(1e6, 2e3)), Tree::series(pair(3e6, 6e3))]));
    let once = linear(&Tree::series(pair(4e6, 8e3)));
    assert!(compare(&twice, &once).is_same);
    assert_eq!((twice.merged().len(), twice.merged()[0].count), (1, 2));
    // Two Kelvin–Voigt elements of one retardation time are one.
    let twice =
        linear(&Tree::series([Tree::parallel(pair(2e6, 3e3)), Tree::parallel(pair(2e6, 3e3))]));
    assert!(compare(&twice, &linear(&Tree::parallel(pair(1e6, 1.5e3)))).is_same);
    // A balanced bridge of springs hides the dashpot across it, and its pole.
    let spring = Spring(2e6).into();
    let bridge = massless(&alone(|network, ends| lay_bridge(network, ends, [&spring, &spring])));
    assert!(compare(&bridge.model, &Spring(1e6).into()).is_same);
    assert_eq!((bridge.model.least_elements(), bridge.hidden.len()), (1, 1));
    // The midpoints meet again through 4·(2e6/4 · 3·2e6/4)/(2e6) … as two springs of
    // 2·(0.5e6 · 1.5e6)/(2e6) = 0.75e6 N/m across 5e3 N s/m: a rate of 150 1/s.
    let [rate, turning] = bridge.hidden[0].rate;
    assert!((rate / -150.0 - 1.0).abs() < 1e-12 && turning == 0.0, "{:?}", bridge.hidden);
}

#[test]
fn rigid_links_springs_and_nothing_are_three_different_things() {
    let rigid = LinearModel::primitive(Rigid);
    let nothing = LinearModel::primitive(Spring(0.0));
    let spring = LinearModel::primitive(Spring(1e300));
    let all = [rigid, nothing, spring, LinearModel::primitive(Dashpot(1e300))];
    for (i, first) in all.iter().enumerate() {
        for (j, second) in all.iter().enumerate() {
            assert_eq!(compare(first, second).is_same, i == j, "{i} and {j}");
        }
    }
    // A rigid link in a row changes nothing; beside anything, it is all there is.
    let pad = linear(&Tree::series([maxwell(), kelvin()]));
    assert!(compare(&LinearModel::series(&[all[0].clone(), pad.clone()]), &pad).is_same);
    assert!(compare(&LinearModel::parallel(&[all[0].clone(), pad]), &all[0]).is_same);
}

#[test]
fn just_within_and_just_beyond_the_limit_are_told_apart() {
    let of = |factor: f64| linear(&Tree::series([Tree::series(pair(2e7, 6e3 * factor)), kelvin()]));
    let own = of(1.0);
    assert!(compare(&own, &of(1.0 + 2e-12)).is_same);
    assert!(!compare(&own, &of(1.0 + 2e-11)).is_same);
    let worst = compare(&own, &of(1.0 + 1e-9)).worst.unwrap();
    // Both are liquids whose viscosities differ: the limit of low frequencies and long times.
    assert!((worst.stiffness / 1e-9 - 1.0).abs() < 1e-6, "{worst:?}");
    assert!(worst.omega <= 1.0 / TAU && worst.time > 1.0, "{worst:?}");
}
