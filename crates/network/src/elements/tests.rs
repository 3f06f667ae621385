//! What holds for every element of the register, and for each of its phases.

use std::sync::Arc;

use super::*;
use crate::{
    elements::monotone::MonotoneCurve,
    parameters::{CurveRole, Parameter, ParameterKind, Value},
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
            if parameter.kind != ParameterKind::Flag {
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

/// A curve with more points on it: on straight lines between its points, or on a law through them.
fn with_more(points: &[(f64, f64)], count: u32, on: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
    let mut all = vec![points[0]];
    for pair in points.windows(2) {
        for at in 1..count {
            // At uneven distances.
            let y =
                pair[0].0 + (pair[1].0 - pair[0].0) * (f64::from(at) / f64::from(count)).powf(1.3);
            all.push((y, on(y)));
        }
        all.push(pair[1]);
    }
    all
}

/// Every element that takes curves, with these for curves from rest and of unloading.
fn with_curves(from_rest: &[(f64, f64)], unloading: &[(f64, f64)]) -> Vec<Arc<dyn Element>> {
    let is_curve = |parameter: &Parameter| matches!(parameter.kind, ParameterKind::Curve(..));
    let kinds = ELEMENTS.iter().filter(|kind| kind.parameters.iter().any(is_curve));
    // Of straight lines there are 20 at most.
    let kinds = kinds.filter(|kind| kind.word != PiecewiseSpring::KIND || from_rest.len() < 22);
    let made = kinds.map(|kind| {
        let mut values = (kind.sample)();
        for (value, parameter) in values.iter_mut().zip(kind.parameters) {
            if is_curve(parameter) {
                let is_back = parameter.curve == CurveRole::Unloading;
                *value = Value::Table(if is_back { unloading } else { from_rest }.to_vec());
            }
        }
        (kind.make)(&values).unwrap_or_else(|error| panic!("{}: {error}", kind.word))
    });
    made.collect()
}

/// How far two lists of laws are apart, in parts of the largest force of each.
fn apart(one: &[Arc<dyn Element>], other: &[Arc<dyn Element>]) -> f64 {
    let mut worst = 0.0_f64;
    assert_eq!(one.len(), other.len());
    for (one, other) in one.iter().zip(other) {
        for deepest in [0.004, 0.0121, 0.0185, 0.02, 0.024] {
            let phase = Phase { index: 2, memory: deepest };
            let unloaded = |law: &Arc<dyn Element>| {
                let phases = law.phases().filter(|_| law.two_curves().is_some());
                match phases.map(|own| own.law(phase)) {
                    Some(PhaseLaw::Element(own)) => own,
                    _ => Arc::clone(law),
                }
            };
            for (one, other) in [(one.clone(), other.clone()), (unloaded(one), unloaded(other))] {
                for at in 1..=60 {
                    let y = deepest * f64::from(at) / 60.0;
                    let force = (one.force(y, 1.0) - other.force(y, 1.0)).abs();
                    let stored = (one.stored(y) - other.stored(y)).abs();
                    let most = one.force(0.024, 1.0).max(other.force(0.024, 1.0));
                    worst = worst.max(force / most).max(stored / (most * 0.024));
                }
            }
        }
    }
    worst
}

#[test]
fn points_on_a_straight_curve_change_no_law() {
    let (line, back) = ([(0.0, 0.0), (0.02, 400.0)], [(0.0072, 0.0), (0.02, 400.0)]);
    let plain = with_curves(&line, &back);
    assert_eq!(plain.len(), 3);
    let back_at = |y: f64| 400.0 * (y - 0.0072) / 0.0128;
    for (first, second) in [(2, 1), (1, 2), (7, 3), (1, 15), (15, 1)] {
        let (line, back) =
            (with_more(&line, first, |y| 2e4 * y), with_more(&back, second, back_at));
        let worst = apart(&plain, &with_curves(&line, &back));
        assert!(worst < 1e-13, "{first}, {second}: {worst:e}");
    }
}

#[test]
fn points_on_a_bent_curve_tend_to_it() {
    let line = [(0.0, 0.0), (0.004, 500.0), (0.012, 800.0), (0.02, 3000.0)];
    let back = [(0.003, 0.0), (0.012, 200.0), (0.02, 3000.0)];
    let plain = with_curves(&line, &back);
    let drawn = |points: &[(f64, f64)]| MonotoneCurve::through(points.to_vec());
    let [loading, unloading] = [drawn(&line), drawn(&back)];
    let more = |count: u32| {
        let line = with_more(&line, count, |y| loading.value(y));
        let back = with_more(&back, count, |y| unloading.value(y));
        let is_smooth = |law: &Arc<dyn Element>| law.kind() != PiecewiseSpring::KIND;
        let smooth = |laws: Vec<Arc<dyn Element>>| laws.into_iter().filter(is_smooth).collect();
        let (one, other): (Vec<_>, Vec<_>) =
            (smooth(plain.clone()), smooth(with_curves(&line, &back)));
        apart(&one, &other)
    };
    // The slopes at the points are those of parabolas, so that the law is nearer with the square of their number.
    let (few, many) = (more(4), more(16));
    assert!(few < 0.02 && many < few / 8.0, "{few:e} {many:e}");
    // Straight lines have them to roundings.
    let lines = PiecewiseSpring::new(line.to_vec()).unwrap();
    let points = with_more(&line, 6, |y| lines.force(y, 0.0));
    let others = PiecewiseSpring::new(points).unwrap();
    for at in 0..100 {
        let y = 0.025 * f64::from(at) / 100.0;
        assert!((lines.force(y, 0.0) - others.force(y, 0.0)).abs() < 1e-9, "{y}");
    }
}
