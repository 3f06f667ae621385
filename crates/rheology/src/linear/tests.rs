//! The forms against each other, against closed forms, and against invariants.

use proptest::prelude::*;

use super::*;
use crate::{
    MOST_LEVELS, Tree,
    appendix_a::{Burgers, SpringDashpot, TwoMaxwell},
};
use Primitive::{Dashpot, Rigid, Spring};

fn prony(spring: f64, terms: &[(f64, f64)]) -> LinearModel {
    let element = |&(time, stiffness): &(f64, f64)| {
        Tree::series([Spring(stiffness).into(), Dashpot(stiffness * time).into()])
    };
    let parts = terms.iter().map(element).chain([Spring(spring).into()]);
    LinearModel::of(&Tree::parallel(parts), |&part| part)
}

fn through(model: &LinearModel, form: Canonical) -> LinearModel {
    LinearModel::of(&model.tree(form).unwrap(), |&part| part)
}

#[track_caller]
fn assert_near(found: f64, expected: f64, tolerance: f64, what: &str) {
    let error = (found / expected - 1.0).abs();
    assert!(error <= tolerance, "{what}: {found:e} for {expected:e}, off by {error:.1e}");
}

/// Largest relative difference of the constants of two Maxwell forms of equal structure.
fn distance(a: &LinearModel, b: &LinearModel) -> f64 {
    let (a, b) = (a.maxwell().unwrap(), b.maxwell().unwrap());
    let (ours, theirs) = (a.elements(), b.elements());
    assert_eq!(ours.len(), theirs.len());
    let relative = |a: f64, b: f64| if a + b > 0.0 { (a / b - 1.0).abs() } else { 0.0 };
    let pairs = ours.iter().zip(&theirs);
    let differences = pairs.flat_map(|(a, b)| {
        [relative(a.stiffness, b.stiffness), relative(a.relaxation_time, b.relaxation_time)]
    });
    differences
        .chain([relative(a.spring(), b.spring()), relative(a.dashpot(), b.dashpot())])
        .fold(0.0, f64::max)
}

/// A series like that of a glassy polymer: 11 times over 10 decades, a rubbery plateau.
fn glassy() -> LinearModel {
    let weights = [180.0, 230.0, 300.0, 350.0, 380.0, 300.0, 180.0, 60.0, 12.0, 3.0, 1.1];
    let terms = weights
        .iter()
        .enumerate()
        .map(|(at, weight)| (10_f64.powi(i32::try_from(at).unwrap() - 5), weight * 1e6));
    prony(2.2e6, &terms.collect::<Vec<_>>())
}

/// 60 times over 24 decades, with these powers of ten as weights.
fn wide(spring: f64, power: impl Fn(f64) -> f64) -> LinearModel {
    let terms = (0..60).map(|at| {
        let time = 10_f64.powf(-12.0 + 24.0 * f64::from(at) / 59.0);
        (time, 10_f64.powf(power(f64::from(at))))
    });
    prony(spring, &terms.collect::<Vec<_>>())
}

/// Weights that fall by 15 decades.
fn falling(spring: f64) -> LinearModel {
    wide(spring, |at| 7.5 - 15.0 * at / 59.0)
}

/// Weights of which even neighbours are up to 15 decades apart.
fn rugged(spring: f64) -> LinearModel {
    wide(spring, |at| 7.5 * (at * at * 0.37).sin())
}

#[test]
fn there_and_back_keeps_every_strength() {
    let all = [
        (glassy(), "glassy", 1e-15),
        (falling(1e-7), "falling", 1e-15),
        (falling(0.0), "falling liquid", 1e-15),
        // A weight 10⁻¹⁵ of its neighbour's moves a pole by its last digit in doubles.
        (rugged(1e-7), "rugged", 1e-15),
        (rugged(0.0), "rugged liquid", 1e-15),
    ];
    for (model, name, tolerance) in all {
        let back = LinearModel::of_kelvin(model.kelvin().unwrap().0.clone(), Vec::new());
        let error = distance(&model, &back);
        assert!(error < tolerance, "{name}: {error:e}");
        let count = 480;
        for at in 0..=count {
            let t = 10_f64.powf(-14.0 + 28.0 * f64::from(at) / f64::from(count));
            let (g, j) = (model.relaxation(t), model.creep(t));
            if g > 1e-300 {
                assert_near(back.relaxation(t), g, 1e-13, name);
            }
            assert_near(back.creep(t), j, 1e-13, name);
        }
    }
}

#[test]
fn rounding_a_form_to_doubles_costs_what_its_gaps_say() {
    let model = glassy();
    assert!(distance(&model, &through(&model, Canonical::Maxwell)) < 1e-15);
    for model in [glassy(), falling(1e-7), falling(0.0)] {
        let error = distance(&model, &through(&model, Canonical::Kelvin));
        assert!(error < 1e-13, "{error:e}");
    }
}

#[test]
fn nearly_equal_times_lose_no_more_than_the_gap_says() {
    for gap in [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 2e-12] {
        let model = prony(1.0, &[(1.0, 2.0), (1.0 + gap, 3.0), (5.0, 1.0)]);
        let back = through(&model, Canonical::Kelvin);
        let error = distance(&model, &back);
        assert!(error <= 100.0 * f64::EPSILON / gap, "gap {gap:e}: {error:e}");
        assert!(model.merged().is_empty());
    }
}

#[test]
fn times_closer_than_1e_12_become_one_and_are_told() {
    for gap in [0.0, 1e-15, 1e-14, 9e-13] {
        let model = prony(1.0, &[(1.0, 2.0), (1.0 + gap, 3.0)]);
        let [merged] = model.merged() else { panic!("gap {gap:e}: {:?}", model.merged()) };
        assert_eq!((merged.count, merged.form), (2, Canonical::Maxwell));
        assert!((merged.gap - gap).abs() <= 3e-16);
        let [element] = model.maxwell().unwrap().elements()[..] else { panic!() };
        assert_near(element.stiffness, 5.0, 1e-15, "stiffness");
        assert_near(element.damping, 2.0 + 3.0 * (1.0 + gap), 1e-15, "damping");
        // The error of a response is of the second order in the gap.
        let exact = 2.0 * (-1_f64).exp() + 3.0 * (-1.0 / (1.0 + gap)).exp() + 1.0;
        assert_near(model.relaxation(1.0), exact, 1e-15, "G(1)");
    }
}

#[test]
fn zener_in_both_forms() {
    // Closed forms: J_g = 1/(K0 + K1), J_e = 1/K0, λ = τ (K0 + K1)/K0.
    let model = prony(3.0, &[(0.5, 9.0)]);
    let kelvin = model.kelvin().unwrap();
    assert_near(kelvin.spring_compliance(), 1.0 / 12.0, 1e-15, "J_g");
    let [element] = kelvin.elements()[..] else { panic!() };
    assert_near(element.compliance, 1.0 / 3.0 - 1.0 / 12.0, 1e-15, "J_1");
    assert_near(element.retardation_time, 2.0, 1e-15, "λ");
    assert_near(model.equilibrium_stiffness(), 3.0, 0.0, "G(∞)");
    assert_near(model.instantaneous_stiffness(), 12.0, 1e-15, "G(0)");
    assert!(model.viscosity().is_infinite() && model.equilibrium_stiffness() > 0.0);
}

#[test]
fn limits_of_composition() {
    let spring = LinearModel::from(Spring(2.0));
    let nothing = LinearModel::from(Spring(0.0));
    let rigid = LinearModel::from(Rigid);
    assert!(rigid.maxwell().is_none() && nothing.kelvin().is_none());
    let cases = [
        (LinearModel::series(&[spring.clone(), rigid.clone()]), 2.0),
        (LinearModel::parallel(&[spring.clone(), nothing.clone()]), 2.0),
        (LinearModel::series(&[spring.clone(), nothing]), 0.0),
        (LinearModel::parallel(&[spring, rigid]), f64::INFINITY),
        (LinearModel::series(&[]), f64::INFINITY),
        (LinearModel::parallel(&[]), 0.0),
    ];
    for (at, (model, stiffness)) in cases.iter().enumerate() {
        assert_eq!(model.equilibrium_stiffness().to_bits(), stiffness.to_bits(), "case {at}");
        assert_eq!(model.relaxance(1.0).to_bits(), stiffness.to_bits(), "case {at}");
    }
    assert_eq!(cases.map(|(model, _)| model.least_elements()), [1, 1, 0, 0, 0, 0]);
}

#[test]
fn as_many_levels_as_there_may_be_tend_to_the_golden_ratio() {
    let mut tree = Tree::from(Spring(1.0));
    for _ in 0..MOST_LEVELS / 2 {
        let inner = Tree::series([Spring(1.0).into(), tree]);
        tree = Tree::parallel([Spring(1.0).into(), inner]);
    }
    assert!(tree.is_deeper_than(MOST_LEVELS - 1) && !tree.is_deeper_than(MOST_LEVELS));
    let model = LinearModel::of(&tree, |&part| part);
    assert_near(model.equilibrium_stiffness(), f64::midpoint(1.0, 5_f64.sqrt()), 1e-15, "k");
}

/// Trees of springs and dashpots with constants over 12 decades.
pub(crate) fn trees() -> impl Strategy<Value = Tree<Primitive>> {
    let constant = || (-6.0..6.0_f64).prop_map(|power| 10_f64.powf(power));
    let leaf = prop_oneof![
        constant().prop_map(|own| Spring(own).into()),
        constant().prop_map(|own| Dashpot(own).into()),
    ];
    leaf.prop_recursive(4, 40, 5, |inner| {
        let some = prop::collection::vec(inner, 1..5);
        prop_oneof![some.clone().prop_map(Tree::series), some.prop_map(Tree::parallel)]
    })
}

/// Relaxance at a real `s > 0` by the rules of composition alone.
fn composed(tree: &Tree<Primitive>, s: f64) -> f64 {
    match tree {
        Tree::Part(Spring(k)) => *k,
        Tree::Part(Dashpot(c)) => c * s,
        Tree::Part(Rigid) => f64::INFINITY,
        Tree::Series(all) => {
            all.iter().map(|own| composed(&own.tree, s).recip()).sum::<f64>().recip()
        }
        Tree::Parallel(all) => all.iter().map(|own| composed(&own.tree, s)).sum(),
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 2000, ..ProptestConfig::default() })]

    /// Whatever the constants: right to rounding, or said to be out of range. The judge has
    /// exponents without end.
    #[test]
    fn constants_of_any_size_are_converted_right_or_not_at_all(
        powers in prop::array::uniform4(-170.0..170.0_f64),
    ) {
        let [k2, c2, k1, c1] = powers.map(|power| 10_f64.powf(power));
        let kelvin = Tree::parallel([Spring(k1).into(), Dashpot(c1).into()]);
        let burgers = Tree::series([Spring(k2).into(), Dashpot(c2).into(), kelvin]);
        let model = LinearModel::of(&burgers, |&part| part);
        if !model.is_in_range() {
            return Ok(());
        }
        let pair = |spring, dashpot| SpringDashpot { spring, dashpot };
        let judge = Burgers { maxwell: pair(k2, c2), kelvin: pair(k1, c1) };
        let Ok(TwoMaxwell { slow, fast }) = judge.to_two_maxwell() else { return Ok(()) };
        let elements = model.maxwell().unwrap().elements();
        prop_assert_eq!(elements.len(), 2);
        for (found, expected) in elements.iter().zip([fast, slow]) {
            for (found, expected) in [(found.stiffness, expected.spring), (found.damping, expected.dashpot)] {
                prop_assert!((found / expected - 1.0).abs() < 1e-14, "{:e} for {:e}", found, expected);
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 512, ..ProptestConfig::default() })]

    #[test]
    fn forms_are_what_the_tree_is(tree in trees()) {
        let model = LinearModel::of(&tree, |&part| part);
        for power in -40..40 {
            let s = 10_f64.powf(f64::from(power) * 0.37);
            let (q, u, exact) = (model.relaxance(s), model.retardance(s), composed(&tree, s));
            // Sums of positive terms: a few roundings per part and level.
            prop_assert!((q / exact - 1.0).abs() < 1e-13, "Q({s:e}) = {q:e}, composed {exact:e}");
            prop_assert!((q * u - 1.0).abs() < 1e-13, "Q U = {:e} at {s:e}", q * u);
        }
    }

    #[test]
    fn poles_and_zeros_interlace_and_spectra_are_positive(tree in trees()) {
        let model = LinearModel::of(&tree, |&part| part);
        let (relaxance, retardance) = (&model.maxwell.as_ref().unwrap().0, &model.kelvin.as_ref().unwrap().0);
        let zero = DoubleDouble::ZERO;
        prop_assert!(relaxance.lines.iter().chain(&retardance.lines).all(|line| line.strength > zero));
        // The slowest time of a solid is one of retardation, that of a liquid one of relaxation. A
        // very weak mode has its zero upon its pole, to all digits.
        let [slow, fast] =
            if model.equilibrium_stiffness() > 0.0 { [retardance, relaxance] } else { [relaxance, retardance] };
        for (at, line) in slow.lines.iter().enumerate() {
            prop_assert!(fast.lines.get(at).is_none_or(|next| line.rate <= next.rate));
            prop_assert!(at == 0 || fast.lines[at - 1].rate <= line.rate);
        }
        prop_assert!(slow.lines.len() - fast.lines.len() <= 1);
        prop_assert_eq!(relaxance.at_zero.high() > 0.0, retardance.at_zero.high() == 0.0);
        prop_assert_eq!(relaxance.constant.high() > 0.0, retardance.constant.high() == 0.0);
    }

    #[test]
    fn both_canonical_networks_have_the_least_number_of_elements(tree in trees()) {
        let model = LinearModel::of(&tree, |&part| part);
        for form in [Canonical::Maxwell, Canonical::Kelvin] {
            prop_assert_eq!(parts(&model.tree(form).unwrap()), model.least_elements());
        }
    }

    #[test]
    fn the_equation_of_poles_by_doubles_is_invariant_under_scaling(tree in trees()) {
        let model = LinearModel::of(&tree, |&part| part);
        let scaled = LinearModel::of(&tree, |part| match *part {
            Spring(k) => Spring(k * 1024.0),
            Dashpot(c) => Dashpot(c * 1024.0 * 2_f64.powi(30)),
            Rigid => Rigid,
        });
        for (a, b) in model.maxwell().unwrap().elements().iter().zip(scaled.maxwell().unwrap().elements()) {
            prop_assert!((a.stiffness * 1024.0 / b.stiffness - 1.0).abs() < 1e-15);
            prop_assert!((a.relaxation_time * 2_f64.powi(30) / b.relaxation_time - 1.0).abs() < 1e-15);
        }
    }
}

fn parts(tree: &Tree<Primitive>) -> usize {
    if let Tree::Part(_) = tree {
        return 1;
    }
    tree.branches().iter().map(|branch| parts(&branch.tree)).sum()
}
