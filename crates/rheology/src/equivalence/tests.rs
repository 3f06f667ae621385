//! Pairs that are the same, and pairs that differ by a known amount.

use proptest::prelude::*;

use super::*;
use crate::{
    Canonical, Primitive,
    Primitive::{Dashpot, Rigid, Spring},
    Tree,
};

fn model(tree: &Tree<Primitive>) -> LinearModel {
    LinearModel::of(tree, |&part| part)
}

fn prony(terms: &[(f64, f64)]) -> LinearModel {
    let element = |&(time, stiffness): &(f64, f64)| {
        Tree::series([Spring(stiffness).into(), Dashpot(stiffness * time).into()])
    };
    model(&Tree::parallel(terms.iter().map(element)))
}

fn terms(count: i32) -> Vec<(f64, f64)> {
    (0..count)
        .map(|at| (10_f64.powf(-6.0 + 0.5 * f64::from(at)), 1e6 * (1.2 + f64::from(at).sin())))
        .collect()
}

#[test]
fn canonical_networks_rounded_to_doubles_are_the_same() {
    let original = prony(&terms(12));
    for form in [Canonical::Maxwell, Canonical::Kelvin] {
        let comparison = compare(&original, &model(&original.tree(form).unwrap()));
        assert!(comparison.is_same, "{form:?}");
        let worst = comparison.worst.unwrap();
        assert!(worst.stiffness < 1e-14 && worst.creep < 1e-14, "{worst:?}");
    }
}

#[test]
fn a_billionth_in_one_mode_is_seen_and_placed() {
    let original = terms(12);
    for at in [0, 5, 11] {
        let mut changed = original.clone();
        changed[at].1 *= 1.0 + 1e-9;
        let comparison = compare(&prony(&original), &prony(&changed));
        assert!(!comparison.is_same);
        let mode = comparison.maxwell.as_ref().unwrap().modes[at];
        assert!((mode.strength.difference - 1e-9).abs() < 1e-15, "{mode:?}");
        let worst = comparison.worst.unwrap();
        // It is a share of the whole at any frequency or time, and some percent of it at one.
        assert!(worst.stiffness > 1e-11 && worst.stiffness < 1e-9, "{worst:?}");
        assert!(worst.creep > 1e-11 && worst.creep < 1e-9, "{worst:?}");
    }
}

#[test]
fn the_worst_disagreement_is_that_of_a_fine_scan() {
    let (first, second) = (prony(&terms(4)), prony(&[(1e-6, 1e6), (1e-4, 3e6)]));
    let worst = compare(&first, &second).worst.unwrap();
    let (mut stiffness, mut creep) = (0.0_f64, 0.0_f64);
    for at in 0..=24_000 {
        let place = 10_f64.powf(-12.0 + f64::from(at) * 1e-3);
        let apart = (first.storage(place.recip()) - second.storage(place.recip()))
            .hypot(first.loss(place.recip()) - second.loss(place.recip()));
        let size = |linear_model: &LinearModel| {
            linear_model.storage(place.recip()).hypot(linear_model.loss(place.recip()))
        };
        stiffness = stiffness.max(apart / size(&first).max(size(&second)));
        let [a, b] = [&first, &second].map(|own| own.creep(place));
        creep = creep.max((a - b).abs() / a.max(b));
    }
    // A scan misses a smooth maximum by the square of its step.
    assert!((worst.stiffness / stiffness - 1.0).abs() < 1e-5, "{worst:?} {stiffness}");
    assert!((worst.creep / creep - 1.0).abs() < 1e-5, "{worst:?} {creep}");
}

#[test]
fn a_mode_that_cancels_does_not_count() {
    // Both halves relax with the same time: one pole, and a zero upon the other.
    let twins = prony(&[(1e-3, 1e6), (1e-3, 2e6)]);
    assert!(compare(&twins, &prony(&[(1e-3, 3e6)])).is_same);
    assert_eq!(twins.merged().len(), 1);
}

#[test]
fn a_missing_mode_is_named() {
    let comparison = compare(&prony(&[(1e-3, 1e6), (1.0, 2e6)]), &prony(&[(1.0, 2e6)]));
    let modes = &comparison.maxwell.as_ref().unwrap().modes;
    assert_eq!(modes.len(), 2);
    assert_eq!(modes[0].strength.second.to_bits(), 0);
    assert_eq!(modes[0].strength.difference.to_bits(), 1_f64.to_bits());
    assert_eq!(modes[1].strength.difference.to_bits(), 0);
    // At high frequencies a third of the stiffness is missing.
    assert!((comparison.worst.unwrap().stiffness - 1.0 / 3.0).abs() < 1e-3);
}

#[test]
fn constants_are_those_of_the_forms() {
    // A spring of 2 in series with 5 ∥ 10: J_g = 1/2, J = 1/5, λ = 2, and seen as a Maxwell form
    // K_e = 10/7, K = 4/7, τ = λ K_e/K_g = 10/7.
    let kelvin = Tree::parallel([Spring(5.0).into(), Dashpot(10.0).into()]);
    let zener = model(&Tree::series([Spring(2.0).into(), kelvin]));
    let found = compare(&zener, &zener);
    let near = |found: f64, expected: f64| (found / expected - 1.0).abs() < 1e-15;
    let (maxwell, kelvin) = (found.maxwell.unwrap(), found.kelvin.unwrap());
    assert!(near(kelvin.at_short_times.first, 0.5) && kelvin.at_long_times.first.to_bits() == 0);
    assert!(near(kelvin.modes[0].strength.first, 0.2) && near(kelvin.modes[0].time.second, 2.0));
    assert!(near(maxwell.at_long_times.first, 10.0 / 7.0));
    assert!(near(maxwell.modes[0].strength.first, 4.0 / 7.0));
    assert!(near(maxwell.modes[0].time.first, 10.0 / 7.0));
}

#[test]
fn what_is_not_a_number_is_not_the_same() {
    let huge = |k: f64, c: f64| {
        let kelvin = Tree::parallel([Spring(k).into(), Dashpot(c).into()]);
        model(&Tree::series([Spring(2e7).into(), Dashpot(6e3).into(), kelvin]))
    };
    // Constants that are not in range must not bring anything down either.
    for power in (-60..=60).map(|at| 5.0 * f64::from(at)) {
        let constants = [10_f64.powf(power), 10_f64.powf(-power)];
        let wild = Tree::series([
            Tree::parallel([Spring(constants[0]).into(), Dashpot(constants[1]).into()]),
            Tree::parallel([Spring(constants[1]).into(), Dashpot(constants[0]).into()]),
            Tree::parallel([Spring(1.0).into(), Dashpot(constants[0]).into()]),
            Dashpot(constants[1]).into(),
        ]);
        let wild = model(&Tree::parallel([wild, Spring(constants[1]).into()]));
        assert!(wild.is_in_range() || !compare(&wild, &model(&Spring(1.0).into())).is_same);
    }
    for power in [120.0, 160.0, 250.0, 300.0, -160.0, -300.0] {
        let size = 10_f64.powf(power);
        let (one, other) = (huge(2e7, size), huge(4e7, 2.0 * size));
        assert!(!compare(&one, &other).is_same, "{power}");
    }
}

#[test]
fn nearly_equal_times_in_both_forms_are_the_same_after_rounding() {
    // Each form has neighbours that are 10⁻⁸ apart, so neither is well determined one by one.
    let maxwell = |c: f64| Tree::series([Spring(1.0).into(), Dashpot(c).into()]);
    let kelvin = |c: f64| Tree::parallel([Spring(1.0).into(), Dashpot(c).into()]);
    let inner = Tree::series([Spring(2.0).into(), kelvin(1.0), kelvin(1.000_000_01)]);
    let tree = Tree::parallel([inner, maxwell(1.0), maxwell(1.000_000_01), maxwell(0.999_999_99)]);
    let own = model(&tree);
    let forms = [Canonical::Maxwell, Canonical::Kelvin].map(|form| model(&own.tree(form).unwrap()));
    assert!(compare(&forms[0], &forms[1]).is_same);
    assert!(compare(&own, &forms[0]).is_same && compare(&own, &forms[1]).is_same);
    // At the limit of merging, too.
    let near = |gap: f64| {
        let other = Tree::series([Spring(1.0).into(), Dashpot(1.0 + gap).into()]);
        model(&Tree::parallel([maxwell(1.0), other, Spring(1.0).into()]))
    };
    assert!(compare(&near(9.9e-13), &near(1.01e-12)).is_same);
}

#[test]
fn neighbours_count_as_one_only_where_no_response_tells_them_apart() {
    // Stiffnesses 1 and 1 with the times 1 and 1 + g, against one element with the same sums. The
    // responses are some g²/8 apart.
    for power in 1..=7 {
        let gap = 10_f64.powi(-power);
        let twins = prony(&[(1.0, 1.0), (1.0 + gap, 1.0)]);
        let single = prony(&[(1.0 + 0.5 * gap, 2.0)]);
        let found = compare(&twins, &single);
        let worst = found.worst.unwrap();
        assert_eq!(found.is_same, power > 5, "{gap:e}: {worst:?}");
        assert!(worst.stiffness < gap * gap && worst.creep < gap * gap, "{gap:e}: {worst:?}");
        assert!(worst.stiffness > 0.05 * gap * gap, "{gap:e}: {worst:?}");
    }
}

#[test]
fn a_narrow_disagreement_between_wide_models_is_found() {
    // One mode among 25 that are a decade apart differs. Stiffnesses rise with the root of the
    // rate, so each rules the response about its own rate, and nowhere else.
    let all = |at: Option<i32>| {
        let weight = |own: i32| if Some(own) == at { 1.5 } else { 1.0 };
        let size = |own: i32| 10_f64.powf(-0.5 * f64::from(own)) * weight(own);
        let terms = (-12..=12).map(|own| (10_f64.powi(own), size(own)));
        prony(&terms.collect::<Vec<_>>())
    };
    let first = all(None);
    for at in -11..=11 {
        let second = all(Some(at));
        let worst = compare(&first, &second).worst.unwrap();
        let apart = |omega: f64| {
            let size = |linear_model: &LinearModel| {
                linear_model.storage(omega).hypot(linear_model.loss(omega))
            };
            let gap = (first.storage(omega) - second.storage(omega))
                .hypot(first.loss(omega) - second.loss(omega));
            gap / size(&first).max(size(&second))
        };
        let scan = (-15_000..15_000).map(|own| apart(10_f64.powf(f64::from(own) * 1e-3)));
        let largest = scan.fold(0.0, f64::max);
        // A scan by 1e-3 of a decade misses a smooth maximum by some 1e-6.
        assert!((worst.stiffness / largest - 1.0).abs() < 1e-5, "{at}: {worst:?} {largest}");
    }
}

#[test]
fn extremes_are_the_same_as_themselves_only() {
    let all = [Rigid, Spring(0.0), Spring(1.0), Dashpot(1.0)].map(LinearModel::primitive);
    for (i, first) in all.iter().enumerate() {
        for (j, second) in all.iter().enumerate() {
            assert_eq!(compare(first, second).is_same, i == j, "{i} {j}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 256, ..ProptestConfig::default() })]

    /// Differences are bounded by the largest one of a constant, as the module says.
    #[test]
    fn responses_differ_by_no_more_than_constants(
        powers in prop::collection::vec((-6.0..6.0_f64, -6.0..6.0_f64, -1.0..1.0_f64, -1.0..1.0_f64), 1..8),
        scale in -12.0..-3.0_f64,
    ) {
        let epsilon = 10_f64.powf(scale);
        let of = |size: f64| powers.iter().map(move |power| {
            (10_f64.powf(power.0) * (1.0 + size * power.2), 10_f64.powf(power.1) * (1.0 + size * power.3))
        }).collect::<Vec<_>>();
        let comparison = compare(&prony(&of(0.0)), &prony(&of(epsilon)));
        let largest = comparison.maxwell.as_ref().unwrap().largest;
        let worst = comparison.worst.unwrap();
        prop_assert!(worst.stiffness <= 2.0 * 2_f64.sqrt() * largest * (1.0 + 1e-6) + 1e-15);
        prop_assert!(!comparison.is_same || worst.stiffness <= 3e-11, "{:e}", worst.stiffness);
    }
}
