//! What holds between the forms of any model: `s² Ĝ Ĵ = 1`, the convolution of `G` and `J`, positive
//! spectra, and poles and zeros that interlace.

use dashpot::rheology::{
    FORMS, LinearModel,
    Primitive::{self, Dashpot, Spring},
    Tree,
    forms::{Role, build},
};

use super::model;
use crate::random_networks::Dice;

/// Models of each registered form and of random trees, with constants over some decades.
fn models() -> Vec<(String, LinearModel)> {
    let (mut dice, mut all) = (Dice(3), Vec::new());
    for form in FORMS {
        for round in 0..20 {
            let tree = build(form.parts, form.in_series, &mut |_, role| {
                let constant = dice.decades(12.0);
                Ok::<_, ()>(if role == Role::Spring { Spring(constant) } else { Dashpot(constant) })
            });
            all.push((format!("{} {round}", form.word), model(&tree.unwrap())));
        }
    }
    let random = (0..200).map(|round| {
        let tree = grown(&mut dice, 4);
        (format!("tree {round}"), model(&tree))
    });
    all.extend(random);
    all
}

fn grown(dice: &mut Dice, depth: usize) -> Tree<Primitive> {
    if depth == 0 || dice.below(6) == 0 {
        let constant = dice.decades(12.0);
        return if dice.below(2) == 0 { Spring(constant) } else { Dashpot(constant) }.into();
    }
    let count = 2 + dice.below(2);
    let branches: Vec<_> = (0..count).map(|_| grown(dice, depth - 1)).collect();
    if dice.below(2) == 0 { Tree::series(branches) } else { Tree::parallel(branches) }
}

/// A rate with what is left of it beside the nearest double.
type Rate = (f64, f64);

/// Rates of the Maxwell form and of the Kelvin form, fastest first.
fn rates(model: &LinearModel) -> [Vec<Rate>; 2] {
    let maxwell = model.maxwell().unwrap().elements();
    let kelvin = model.kelvin().unwrap().elements();
    [
        maxwell.iter().map(|own| (own.rate.high(), own.rate.low())).collect(),
        kelvin.iter().map(|own| (own.rate.high(), own.rate.low())).collect(),
    ]
}

#[test]
fn the_transforms_of_relaxation_and_creep_are_reciprocal() {
    for (name, model) in models() {
        for at in 0..=80 {
            let s = 10_f64.powf(-10.0 + 0.25 * f64::from(at));
            // s Ĝ and s Ĵ.
            let product = model.relaxance(s) * model.retardance(s);
            let error = (product - 1.0).abs();
            // Each is a sum of some ten positive terms of rounded constants.
            assert!(error < 32.0 * f64::EPSILON, "{name}: {product} at {s:e}");
        }
    }
}

#[test]
fn relaxation_and_creep_obey_their_convolution() {
    let rule = gauss_legendre(16);
    for (name, model) in models() {
        let all = rates(&model).concat();
        let fastest = all.iter().map(|own| own.0).fold(1e-12, f64::max);
        let slowest = all.iter().map(|own| own.0).fold(1e12, f64::min).min(fastest);
        let (from, to) = ((0.01 / fastest).log10(), (100.0 / slowest).log10());
        for at in 0..=12 {
            let t = 10_f64.powf(from + (to - from) * f64::from(at) / 12.0);
            // Each half is resolved towards its own end, where the fast modes are.
            let near_zero = |u: f64| model.relaxation(t - u) * model.creep(u);
            let near_t = |u: f64| model.relaxation(u) * model.creep(t - u);
            let first = (0.1 / fastest).min(0.5 * t);
            let integral = graded(&rule, first, 0.5 * t, |u| near_zero(u) + near_t(u));
            let impulse = model.maxwell().unwrap().dashpot() * model.creep(t);
            let error = (integral + impulse) / t - 1.0;
            assert!(error.abs() < 1e-12, "{name}: off by {error:.1e} at {t:e}");
        }
    }
}

/// Integral from 0 to `end`, by panels `first`, then of twice the length, and so on.
fn graded(rule: &[(f64, f64)], first: f64, end: f64, integrand: impl Fn(f64) -> f64) -> f64 {
    let (mut from, mut to, mut sum) = (0.0, first, 0.0);
    loop {
        let half = 0.5 * (to - from);
        let terms =
            rule.iter().map(|(node, weight)| weight * integrand(from + half * (1.0 + node)));
        sum += half * terms.sum::<f64>();
        if to >= end {
            return sum;
        }
        (from, to) = (to, (2.0 * to).min(end));
    }
}

/// Nodes and weights on −1 … 1.
fn gauss_legendre(count: u32) -> Vec<(f64, f64)> {
    let n = f64::from(count);
    let legendre = |x: f64| {
        let (mut before, mut own) = (1.0, x);
        for degree in 2..=count {
            let k = f64::from(degree);
            (before, own) = (own, ((2.0 * k - 1.0) * x * own - (k - 1.0) * before) / k);
        }
        (own, n * (x * own - before) / (x * x - 1.0))
    };
    let node = |at: u32| {
        let mut x = (std::f64::consts::PI * (f64::from(at) + 0.75) / (n + 0.5)).cos();
        for _ in 0..6 {
            let (value, slope) = legendre(x);
            x -= value / slope;
        }
        let (_, slope) = legendre(x);
        (x, 2.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..count).map(node).collect()
}

#[test]
fn spectra_are_positive() {
    for (name, model) in models() {
        let (maxwell, kelvin) = (model.maxwell().unwrap(), model.kelvin().unwrap());
        assert!(maxwell.spring() >= 0.0 && maxwell.dashpot() >= 0.0, "{name}");
        assert!(kelvin.spring_compliance() >= 0.0 && kelvin.fluidity() >= 0.0, "{name}");
        let lines =
            maxwell.elements().into_iter().map(|element| [element.stiffness, element.damping]);
        let more =
            kelvin.elements().into_iter().map(|element| [element.stiffness, element.damping]);
        for constants in lines.chain(more) {
            assert!(
                constants.iter().all(|&constant| constant > 0.0 && constant.is_finite()),
                "{name}"
            );
        }
    }
}

#[test]
fn poles_and_zeros_interlace() {
    for (name, model) in models() {
        let [poles, zeros] = rates(&model);
        // The fastest mode is one of creep beside a bare dashpot, the slowest one in a solid.
        let has_dashpot = model.maxwell().unwrap().dashpot() > 0.0;
        let (first, second) = if has_dashpot { (&zeros, &poles) } else { (&poles, &zeros) };
        let ends_with_zero = if first.len() > second.len() { has_dashpot } else { !has_dashpot };
        assert!(first.len() == second.len() || first.len() == second.len() + 1, "{name}");
        assert!(
            first.is_empty() || ends_with_zero == (model.equilibrium_stiffness() > 0.0),
            "{name}"
        );
        let falls = |from: &Rate, to: &Rate| {
            // A mode too weak for twice the digits of a double has its zero at its pole.
            (from.0 - to.0) + (from.1 - to.1) >= -1e-30 * from.0
        };
        assert!(first.iter().zip(second).all(|(a, b)| falls(a, b)), "{name}: {first:?} {second:?}");
        let next = first.iter().skip(1);
        assert!(second.iter().zip(next).all(|(a, b)| falls(a, b)), "{name}: {first:?} {second:?}");
    }
}
