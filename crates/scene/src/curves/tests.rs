use dashpot_network::{elements::HystereticTable, parameters::CurveRole};

use super::{
    thin::{WITHIN, thinned},
    *,
};

fn rows(points: &[(f64, f64)]) -> Vec<Row> {
    points.iter().enumerate().map(|(start, &(at, value))| Row { at, value, start }).collect()
}

/// A measured record up to 20 mm and back to where it gives no force, with noise of `part` of the peak.
fn record(part: f64, count: u32) -> Vec<Row> {
    let mut state = 1_u32;
    let mut noise = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state) / f64::from(u32::MAX) - 0.5
    };
    let law = |y: f64| 1e5 * y + 2e9 * y.powi(3);
    let peak = law(0.02);
    let place = |own: u32| 0.02 * f64::from(own) / f64::from(count);
    let there = (0..=count).map(|own| (place(own), law(place(own))));
    let back = (0..=count).rev().map(|own| {
        let share = (place(own) / 0.02 - 0.2).max(0.0) / 0.8;
        (place(own), law(place(own)) * share * share)
    });
    let noisy: Vec<(f64, f64)> = there
        .chain(back)
        .map(|(y, force)| (y + 1e-5 * part * noise(), force + part * peak * noise()))
        .collect();
    rows(&noisy)
}

#[test]
fn rows_at_rest_become_rest_and_nothing_pulls_beyond_it() {
    let own = fit(&rows(&[(0.0, 3.0), (1.0, -2.0), (2.0, 10.0), (3.0, 30.0)]), CurveRole::FromRest);
    assert_eq!(own.points, [(0.0, 0.0), (1.0, 0.0), (2.0, 10.0), (3.0, 30.0)]);
    assert!((own.difference.largest - 3.0).abs() < 1e-15 && own.difference.start == 0);
    assert!((own.difference.mean - 1.25).abs() < 1e-15);
    // Without a row at rest, rest is put before the first one.
    let own = fit(&rows(&[(1.0, 4.0), (2.0, 10.0)]), CurveRole::FromRest);
    assert_eq!(own.points, [(0.0, 0.0), (1.0, 4.0), (2.0, 10.0)]);
    assert_eq!(own.difference.begins, Some((1.0, 4.0)));
}

#[test]
fn rows_in_any_order_and_twice_are_one_curve() {
    let own = fit(&rows(&[(2.0, 9.0), (0.0, 0.0), (1.0, 4.0), (2.0, 11.0)]), CurveRole::FromRest);
    assert_eq!(own.points, [(0.0, 0.0), (1.0, 4.0), (2.0, 10.0)]);
    assert!((own.difference.largest - 1.0).abs() < 1e-15);
}

#[test]
fn a_noisy_record_is_a_law_at_any_noise() {
    for part in [0.0, 1e-4, 1e-2, 0.1, 0.3] {
        for count in [20, 200, 3000] {
            let (out, back) = split(&record(part, count)).unwrap();
            let loading = fit(&out, CurveRole::FromRest);
            let unloading = unloading(&loading.points, &back).unwrap();
            let most = loading.difference.largest / loading.difference.peak;
            assert!(most <= part.max(1e-12), "{most} at {part}");
            let law = HystereticTable::new(loading.points, unloading.points);
            assert!(law.is_ok(), "{part}, {count}: {law:?}");
        }
    }
}

#[test]
fn thinned_curves_stay_within_what_is_said() {
    let all: Vec<(f64, f64)> = (0..20_001)
        .map(|at| f64::from(at) / 20_000.0)
        .map(|y| (y, (6.0 * y).sinh() + 0.1 * (40.0 * y).sin()))
        .collect();
    let few = thinned(all.clone());
    assert!(few.len() < 500, "{}", few.len());
    let peak = all.last().unwrap().1;
    for (y, value) in all {
        let at = few.partition_point(|own| own.0 <= y).clamp(1, few.len() - 1);
        let [(from, low), (to, high)] = [few[at - 1], few[at]];
        let line = low + (high - low) * (y - from) / (to - from);
        assert!((line - value).abs() <= WITHIN * peak * (1.0 + 1e-12));
    }
}
