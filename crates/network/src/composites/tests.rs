//! Composites by closed forms.

use dashpot_rheology::Tree;

use super::*;
use crate::{elements::Law, parameters::ParameterKind};

/// Relaxance `Q(s)` \[N/m\] of a model at real `s` > 0 \[1/s\].
fn relaxance(model: &Model, s: f64) -> f64 {
    let all = || model.branches().iter().map(|branch| relaxance(&branch.tree, s));
    match model {
        Tree::Part(element) => match element.law() {
            Law::Spring(stiffness) => stiffness,
            Law::Dashpot(damping) => damping * s,
            Law::Rigid => f64::INFINITY,
            law => panic!("{law:?} is not linear"),
        },
        Tree::Series(_) => all().map(f64::recip).sum::<f64>().recip(),
        Tree::Parallel(_) => all().sum(),
    }
}

fn names(model: &Model) -> Vec<&str> {
    model.branches().iter().map(|branch| &*branch.name).collect()
}

/// Points over all times of a model, and beyond.
fn points() -> impl Iterator<Item = f64> {
    (-40..=40).map(|power| 10.0_f64.powf(0.25 * f64::from(power)))
}

/// Sums of `terms` positive numbers, each from a few products and quotients.
fn is_same(found: f64, expected: f64, terms: usize) -> bool {
    let terms = f64::from(u32::try_from(terms).unwrap());
    (found / expected - 1.0).abs() <= (terms + 8.0) * f64::EPSILON
}

#[test]
fn prony_has_the_relaxance_of_its_series() {
    let terms = (0..12).map(|at| (10.0_f64.powi(at - 6), 1e6 / f64::from(at + 1)));
    let prony = Prony { equilibrium: 2e5, terms: terms.collect() };
    let model = prony.compose().unwrap().model;
    for s in points() {
        let terms = prony.terms.iter().map(|&(time, stiffness)| stiffness * s / (s + time.recip()));
        assert!(is_same(relaxance(&model, s), prony.equilibrium + terms.sum::<f64>(), 13), "{s}");
    }
}

#[test]
fn a_kelvin_chain_has_the_retardance_of_its_spectrum() {
    let terms = (0..12).map(|at| (10.0_f64.powi(at - 6), 1e-8 * f64::from(at + 1)));
    let chain = KelvinChain { terms: terms.collect() };
    let model = chain.compose().unwrap().model;
    for s in points() {
        let terms = chain.terms.iter().map(|&(time, compliance)| compliance / (1.0 + time * s));
        assert!(is_same(relaxance(&model, s).recip(), terms.sum(), 12), "{s}");
    }
}

#[test]
fn parts_are_named_in_rising_order_of_time() {
    let prony = Prony::sample().compose().unwrap();
    assert_eq!(names(&prony.model), ["equilibrium", "maxwell-1", "maxwell-2"]);
    assert_eq!(names(&prony.model.branches()[1].tree), ["spring", "dashpot"]);
    assert_eq!(prony.note, None);
    let slowest_first = Prony { equilibrium: 0.0, terms: vec![(0.1, 1e6), (1e-3, 3e6)] };
    let prony = slowest_first.compose().unwrap();
    assert_eq!(names(&prony.model), ["maxwell-1", "maxwell-2"]);
    assert!(is_same(relaxance(&prony.model.branches()[0].tree, 1e9), 3e6 / (1.0 + 1e-6), 1));
    assert!(prony.note.unwrap().to_string().contains("`maxwell-1` is the fastest"));
    let chain = KelvinChain::sample().compose().unwrap();
    assert_eq!(names(&chain.model), ["kelvin-1", "kelvin-2"]);
}

#[test]
fn one_term_is_the_single_element_of_the_thesis() {
    let chain = KelvinChain { terms: vec![(0.02, 5e-8)] }.compose().unwrap();
    assert_eq!(names(&chain.model), ["kelvin-1"]);
    let laws: Vec<Law> = chain.model.branches()[0].tree.branches().iter().map(leaf).collect();
    assert_eq!(laws, [Law::Spring(2e7), Law::Dashpot(4e5)]);
}

fn leaf(branch: &dashpot_rheology::Branch<std::sync::Arc<dyn crate::Element>>) -> Law {
    match &branch.tree {
        Tree::Part(element) => element.law(),
        _ => panic!("`{}` is composed", branch.name),
    }
}

#[test]
fn what_is_no_spectrum_is_refused() {
    let prony = |equilibrium, terms: &[(f64, f64)]| {
        Prony { equilibrium, terms: terms.to_vec() }.compose().unwrap_err().to_string()
    };
    assert_eq!(prony(0.0, &[]), "`terms` must be one term or more, but it is empty");
    assert!(prony(-1.0, &[(1.0, 1.0)]).starts_with("`equilibrium` must be zero or positive"));
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(prony(0.0, &[(1.0, 1.0), (bad, 1.0)]).contains("positive and finite"), "{bad}");
        assert!(prony(0.0, &[(1.0, 1.0), (2.0, bad)]).contains("positive and finite"), "{bad}");
    }
    let twice = prony(0.0, &[(2.0, 1.0), (1.0, 1.0), (2.0, 3.0)]);
    assert!(twice.contains("different times") && twice.contains("2.0 s twice"), "{twice}");
}

#[test]
fn constants_beyond_double_precision_are_refused() {
    for term in [(1e200, 1e200), (1e-200, 1e-200), (1e-155, 1e-155)] {
        let error = Prony { equilibrium: 0.0, terms: vec![term] }.compose().unwrap_err();
        assert!(error.to_string().contains("double precision"), "{term:?}: {error}");
    }
    for term in [(1.0, 1e-310), (1e200, 1e-200), (1e-200, 1e200)] {
        let error = KelvinChain { terms: vec![term] }.compose().unwrap_err();
        assert!(error.to_string().contains("double precision"), "{term:?}: {error}");
    }
}

#[test]
fn every_kind_composes_its_sample() {
    for kind in COMPOSITES {
        let values = (kind.sample)();
        assert_eq!(values.len(), kind.parameters.len(), "{}", kind.word);
        assert_eq!((kind.again)(&values).unwrap(), values, "{}", kind.word);
        let (one, other) = (kind.example().unwrap(), kind.example().unwrap());
        assert_eq!(format!("{one:?}"), format!("{other:?}"), "{}", kind.word);
        assert!(relaxance(&one.model, 1.0) > 0.0, "{}", kind.word);
        let has_table =
            kind.parameters.iter().any(|parameter| parameter.kind == ParameterKind::TimeTable);
        assert!(kind.about != Dimension::NUMBER || !has_table, "{}", kind.word);
        assert!((kind.make)(&[]).is_err(), "{}", kind.word);
    }
}
