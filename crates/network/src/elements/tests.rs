//! What holds for every element of the register, and for each of its phases.

use std::sync::Arc;

use super::*;
use crate::{
    parameters::Value,
    phases::{Phase, PhaseLaw},
};

/// Deformations \[m\] at which laws are looked at, none of them at a kink of a sample.
const DEFORMATIONS: [f64; 12] = [
    -0.031, -0.0123, -0.0037, -0.000_41, -2.3e-5, 2.3e-5, 0.000_41, 0.0037, 0.0087, 0.0123, 0.0191,
    0.031,
];
/// Rates \[m/s\].
const RATES: [f64; 8] = [-30.0, -1.7, -0.02, -1e-4, 1e-4, 0.02, 1.7, 30.0];
/// How far elements with a memory have been pressed \[m\].
const DEEPEST: [f64; 3] = [-0.001, 0.006, 0.0185];

/// Every law that an element may follow: its own, and those of its phases.
fn laws(element: &Arc<dyn Element>) -> Vec<Arc<dyn Element>> {
    let mut laws = vec![Arc::clone(element)];
    for (index, _) in element.phases().map_or(&[][..], |own| own.names()).iter().enumerate() {
        for memory in DEEPEST {
            let phase = Phase { index, memory };
            if let Some(PhaseLaw::Element(own)) = element.phases().map(|own| own.law(phase)) {
                laws.push(own);
            }
        }
    }
    laws
}

fn for_each_law(mut look: impl FnMut(&dyn Element)) {
    for kind in ELEMENTS {
        laws(&kind.example().unwrap()).iter().for_each(|law| look(law.as_ref()));
    }
}

/// The law of the first loading, of one that unloads on another curve.
fn first_curve(law: &dyn Element) -> Option<Arc<dyn Element>> {
    match law.kind() {
        HystereticFoam::KIND => Some(Arc::new(HystereticFoam::sample())),
        HystereticTable::KIND => Some(Arc::new(HystereticTable::sample())),
        _ => None,
    }
}

/// Slope of a function by central differences, and how wrong it may be: the difference of two step
/// widths, and the rounding of the values.
fn slope(f: impl Fn(f64) -> f64, at: f64) -> (f64, f64) {
    let by = |step: f64| (f(at + step) - f(at - step)) / (2.0 * step);
    let step = 1e-5 * at.abs();
    let (coarse, fine) = (by(2.0 * step), by(step));
    let rounding = 16.0 * f64::EPSILON * f(at).abs().max(f(at + 2.0 * step).abs()) / step;
    (fine, (coarse - fine).abs() + rounding)
}

#[test]
fn tangents_are_the_slopes_of_the_force() {
    for_each_law(|law| {
        for y in DEFORMATIONS {
            for v in RATES {
                let tangent = law.tangent(y, v);
                for (found, (slope, error)) in [
                    (tangent.stiffness, slope(|y| law.force(y, v), y)),
                    (tangent.damping, slope(|v| law.force(y, v), v)),
                ] {
                    let off = (found - slope).abs();
                    assert!(off <= error, "{law:?} at {y}, {v}: {found} {slope} ± {error}");
                }
            }
        }
    });
}

#[test]
fn forces_never_fall_with_the_deformation_nor_with_the_rate() {
    for_each_law(|law| {
        for y in DEFORMATIONS {
            for v in RATES {
                let Tangent { stiffness, damping } = law.tangent(y, v);
                assert!(stiffness >= 0.0 && damping >= 0.0, "{law:?} at {y}, {v}");
            }
        }
    });
}

#[test]
fn what_is_stored_rises_by_no_more_than_the_work_done() {
    for_each_law(|law| {
        // One that has a force at zero deformation stores something there.
        let is_loaded = law.force(0.0, 0.0) != 0.0;
        assert!(is_loaded || law.stored(0.0).abs() <= 0.0, "{law:?}");
        for y in DEFORMATIONS {
            let (stored, error) = slope(|y| law.stored(y), y);
            for v in RATES {
                let excess = (stored - law.force(y, v)) * v.signum();
                // While it is pressed for the first time, foam with a set loses energy for good.
                let is_first = first_curve(law)
                    .is_some_and(|own| law.force(y, v).to_bits() == own.force(y, v).to_bits());
                assert!(is_first && v < 0.0 || excess <= error, "{law:?} at {y}, {v}: {excess}");
                // A straight line may be that between corners away from where it has no force.
                assert!(law.stored(y) >= 0.0 || law.push() != 0.0, "{law:?} at {y}");
            }
        }
    });
}

#[test]
fn at_rest_the_force_is_the_slope_of_what_is_stored() {
    for_each_law(|law| {
        if first_curve(law).is_some() {
            return;
        }
        for y in DEFORMATIONS {
            let (stored, error) = slope(|y| law.stored(y), y);
            let force = law.force(y, 0.0);
            assert!((force - stored).abs() <= error, "{law:?} at {y}: {force} {stored} ± {error}");
        }
    });
}

#[test]
fn what_stands_for_a_law_has_slopes_of_its_size() {
    for_each_law(|law| {
        let Law::Nonlinear { stiffness, damping } = law.law() else { return };
        assert!(stiffness >= 0.0 && damping >= 0.0 && stiffness + damping > 0.0, "{law:?}");
        let all = || DEFORMATIONS.into_iter().flat_map(|y| RATES.map(|v| law.tangent(y, v)));
        let between = |own: f64, of: fn(Tangent) -> f64| {
            let (least, most) =
                (all().map(of).fold(f64::INFINITY, f64::min), all().map(of).fold(0.0, f64::max));
            own >= 0.5 * least && own <= 1.000_001 * most
        };
        assert!(between(stiffness, |own| own.stiffness), "{law:?}");
        assert!(between(damping, |own| own.damping), "{law:?}");
    });
}

#[test]
fn samples_are_valid_and_come_back_from_their_values() {
    for kind in ELEMENTS {
        let values = (kind.sample)();
        let sample = kind.example().unwrap();
        assert_eq!((sample.kind(), sample.values()), (kind.word, values.clone()));
        assert_eq!(values.len(), kind.parameters.len(), "{}", kind.word);
        for (at, parameter) in kind.parameters.iter().enumerate() {
            assert_eq!(sample.value(parameter.name).as_ref(), Some(&values[at]));
            let wrong = sample.values_with(parameter.name, &Value::Number(f64::NAN));
            if parameter.kind != crate::parameters::ParameterKind::Flag {
                assert!((kind.make)(&wrong).is_err(), "{}.{at}", kind.word);
            }
        }
    }
}

#[test]
fn laws_of_numbers_without_size_are_finite() {
    for_each_law(|law| {
        for y in [0.0, -0.0, 1e-300, -1e-300, 1e3, -1e3] {
            for v in [0.0, -0.0, 1e-300, -1e-300, 1e3, -1e3] {
                let Tangent { stiffness, damping } = law.tangent(y, v);
                let all = [law.force(y, v), stiffness, damping, law.stored(y)];
                assert!(all.iter().all(|own| own.is_finite()), "{law:?} at {y}, {v}: {all:?}");
            }
        }
    });
}

#[test]
fn slopes_and_energies_by_numbers_are_those_of_the_laws() {
    for kind in ELEMENTS {
        let law = kind.example().unwrap();
        if matches!(law.law(), Law::Phased | Law::Rigid) {
            continue;
        }
        let same = Arc::clone(&law);
        let custom = Custom::new("the-same", move |y, v| same.force(y, v));
        custom.validate().unwrap();
        let close = |found: f64, exact: f64, size: f64| {
            let off = (found - exact).abs();
            assert!(off <= 1e-5 * exact.abs() + 1e-9 * size, "{law:?}: {found} {exact}");
        };
        for y in DEFORMATIONS {
            let exact = law.stored(y);
            let size = (law.force(y, 0.0) * y).abs();
            assert!((custom.stored(y) - exact).abs() <= 1e-11 * size, "{law:?} at {y}");
            for v in RATES.into_iter().filter(|v| v.abs() > 0.01) {
                let (found, exact) = (custom.tangent(y, v), law.tangent(y, v));
                close(found.stiffness, exact.stiffness, (law.force(y, v) / 0.01).abs());
                close(found.damping, exact.damping, law.force(y, v).abs());
            }
        }
    }
}
