use super::*;
use crate::{
    elements::hysteresis::{
        LOADING, SLACK, UNLOADING,
        tests::{never_gives_more_than_it_took, travelled},
    },
    phases::{Phase, PhaseLaw, Phases},
};

fn curve(of: &HystereticTable, deepest: f64) -> Arc<dyn Element> {
    match Phases::law(of, Phase { index: UNLOADING, memory: deepest }) {
        PhaseLaw::Element(element) => element,
        other => panic!("{other:?}"),
    }
}

#[test]
fn straight_curves_stay_straight_whatever_points_are_on_them() {
    // f = k y back along k (y − r y_m)/(1 − r): it gives back the part 1 − r of the energy.
    let (k, r) = (1e3, 0.2);
    let line = |from: f64, count: u32| -> Vec<(f64, f64)> {
        let all = (0..=count).map(|at| f64::from(at) / f64::from(count));
        let place = |part: f64| (from + (1.0 - from) * part * part, k * part * part);
        all.map(place).collect()
    };
    for (first, second) in [(1, 1), (1, 7), (5, 1), (4, 9)] {
        let table = HystereticTable::new(line(0.0, first), line(r, second)).unwrap();
        for deepest in [0.1, 0.5, 1.0, 1.7] {
            let exact = 0.5 * k * (1.0 - r) * deepest * deepest;
            assert!((table.stored(deepest) / exact - 1.0).abs() < 1e-12);
            let back = curve(&table, deepest);
            for part in [0.1, 0.3, 0.7, 0.99, 1.0] {
                let y = part * deepest;
                let exact = k * ((y - r * deepest) / (1.0 - r)).max(0.0);
                assert!((back.force(y, 0.0) - exact).abs() < 1e-12 * k, "{part}");
                let slope = if part > r { k / (1.0 - r) } else { 0.0 };
                assert!((back.tangent(y, 0.0).stiffness - slope).abs() < 1e-9 * k, "{part}");
            }
        }
    }
}

#[test]
fn from_its_own_depth_it_is_the_curve_through_the_points_of_unloading() {
    let table = HystereticTable::sample();
    let unloading = table.unloading_points().to_vec();
    let drawn = MonotoneCurve::through(unloading.clone());
    let back = curve(&table, 0.02);
    for at in 1..=100 {
        let y = 0.003 + 0.017 * f64::from(at) / 100.0;
        assert!((back.force(y, 0.0) - drawn.value(y)).abs() < 1e-9, "{y}");
    }
    // Points without force below the set are on the curve, too.
    let more = [&[(0.0, 0.0), (0.001, 0.0)][..], &unloading].concat();
    let more = HystereticTable::new(table.loading_points().to_vec(), more).unwrap();
    for y in [0.0031, 0.007, 0.0195] {
        assert!((back.force(y, 0.0) - curve(&more, 0.02).force(y, 0.0)).abs() < 1e-9, "{y}");
    }
}

#[test]
fn between_any_points_the_part_never_falls() {
    let mut stream = dashpot_numerics::Stream::new(5);
    let mut drawn_through = 0;
    for _ in 0..2000 {
        let mut curve = |count: u64, from: f64| {
            let (mut y, mut force) = (from, 0.0);
            let mut points = vec![(y, force)];
            for _ in 0..count {
                y += 0.05 + stream.share();
                force += stream.share().powi(3);
                points.push((y, force));
            }
            points
        };
        let loading = TableSpring::new(curve(6, 0.0)).unwrap();
        let mut unloading = curve(5, 0.3);
        let depth = unloading[unloading.len() - 1].0;
        // As large a part as points allow that do not exceed the first curve, and do not fall.
        let mut last = 1.0_f64;
        for (y, force) in unloading.iter_mut().rev() {
            last = last.min(if *y < depth { *force } else { 1.0 });
            *force = if *y > 0.3 { loading.force(*y, 0.0) * last } else { 0.0 };
        }
        for at in 1..unloading.len() {
            unloading[at].1 = unloading[at].1.max(unloading[at - 1].1);
        }
        let Ok(table) = HystereticTable::new(loading.points().to_vec(), unloading) else {
            continue;
        };
        drawn_through += usize::from(table.0.factor.of_curves.contains(&false));
        let mut last = 0.0;
        for at in 0..=400 {
            let part = table.0.factor.set() + (1.0 - table.0.factor.set()) * f64::from(at) / 400.0;
            let value = table.factor(part * depth, depth).0;
            assert!(value >= last - 1e-7 && value <= 1.0 + 1e-12, "{table:?} {part}");
            last = value;
        }
    }
    assert!(drawn_through > 10, "{drawn_through}");
}

#[test]
fn from_the_depth_of_the_measurement_it_goes_through_all_points() {
    let loading: Vec<_> =
        [0.0, 0.003, 0.007, 0.02].map(|y: f64| (y, 2e3 * y.sqrt() + 1e6 * y * y)).into();
    let there = TableSpring::new(loading.clone()).unwrap();
    let ends = there.force(0.02, 0.0);
    let unloading = vec![(0.0, 0.0), (0.002, 0.0), (0.009, 30.0), (0.015, 120.0), (0.02, ends)];
    let table = HystereticTable::new(loading, unloading.clone()).unwrap();
    let back = curve(&table, 0.02);
    for (y, force) in unloading {
        assert!((back.force(y, 0.0) - force).abs() <= 1e-12 * ends, "{y}");
    }
    // The store is the integral of the force, and continuous where it turns back.
    for deepest in [0.001, 0.0123, 0.02, 0.03] {
        let back = curve(&table, deepest);
        assert!((back.stored(deepest) / table.stored(deepest) - 1.0).abs() < 1e-13);
        assert!((back.force(deepest, 0.0) / table.force(deepest, 0.0) - 1.0).abs() < 1e-13);
        let steps = 20_000;
        let step = deepest / f64::from(steps);
        let middles = (0..steps).map(|at| step * (f64::from(at) + 0.5));
        let sum: f64 = middles.map(|y| step * back.force(y, 0.0)).sum();
        assert!((sum / back.stored(deepest) - 1.0).abs() < 1e-6);
    }
}

#[test]
fn the_same_curve_twice_is_a_spring_that_never_pulls() {
    let points = vec![(0.0, 0.0), (0.004, 500.0), (0.012, 800.0), (0.02, 3000.0)];
    let table = HystereticTable::new(points.clone(), points.clone()).unwrap();
    let spring = TableSpring::new(points).unwrap();
    for y in [1e-6, 0.003, 0.01, 0.019, 0.025] {
        assert!((table.stored(y) / spring.stored(y) - 1.0).abs() < 1e-12, "{y}");
        let back = curve(&table, 0.02);
        assert!((back.force(y, 0.0) / spring.force(y, 0.0) - 1.0).abs() < 1e-13, "{y}");
    }
}

#[test]
fn it_follows_its_curves_from_phase_to_phase() {
    let table = HystereticTable::sample();
    let (_, phase, _) = travelled(&table, &[0.0, 0.01]);
    assert_eq!(phase.index, LOADING);
    let (work, phase, _) = travelled(&table, &[0.0, 0.02, -0.001]);
    assert_eq!((phase.index, phase.memory), (SLACK, 0.02));
    let lost = table.0.loading.stored(0.02) - table.stored(0.02);
    assert!((work / lost - 1.0).abs() < 1e-4, "{work} {lost}");
    never_gives_more_than_it_took(&table, 0.02);
}

#[test]
fn curves_that_would_create_energy_are_refused_with_the_place() {
    let reason = |unloading: &[(f64, f64)]| {
        let loading = vec![(0.0, 0.0), (1.0, 100.0), (2.0, 200.0), (4.0, 400.0)];
        HystereticTable::new(loading, unloading.to_vec()).unwrap_err().to_string()
    };
    let found = reason(&[(0.0, 0.0), (1.0, 150.0), (2.0, 200.0)]);
    assert!(found.contains("nowhere above") && found.contains("150.0 N at 1.0 m"), "{found}");
    let found = reason(&[(0.0, 0.0), (1.0, 90.0), (3.0, 150.0), (4.0, 400.0)]);
    assert!(found.contains("never falls") && found.contains("50.0000 % of it at 3.0 m"), "{found}");
    assert!(reason(&[(0.5, 0.0), (2.0, 150.0)]).contains("ends on that of `loading`"));
    assert!(reason(&[(0.5, 10.0), (2.0, 200.0)]).contains("begins at the set"));
    assert!(reason(&[(2.0, 200.0), (0.5, 0.0)]).contains("rising order"));
    assert!(reason(&[(0.5, 0.0)]).contains("two points"));
    let loading = vec![(-1.0, -5.0), (0.0, 0.0), (1.0, 10.0)];
    let found = HystereticTable::new(loading, vec![(0.0, 0.0), (1.0, 10.0)]).unwrap_err();
    assert_eq!(found.parameter, "loading");
}
