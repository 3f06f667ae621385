use dashpot_dae::{Panel, Signal};

use super::earliest_end;

/// A force that is linear between times and values.
fn force(points: &[(f64, f64)]) -> Signal {
    let line = |pair: &[(f64, f64)]| {
        let [(start, from), (end, to)] = [pair[0], pair[1]];
        Panel { start, end, coefficients: [0.5 * (from + to), 0.5 * (to - from)].into() }
    };
    Signal::new(points.windows(2).map(line).collect(), None, 1e-15)
}

/// A push of 1 N over 1 s that falls in another second to `low`, and pushes again.
fn dipping(low: f64) -> Signal {
    force(&[(0.0, 1.0), (1.0, 1.0), (2.0, low), (3.0, 0.5), (4.0, 0.5)])
}

fn end(forces: &[&Signal]) -> Option<f64> {
    earliest_end(forces, (0.0, 4.0), 1e-3)
}

#[test]
fn force_that_goes_straight_through_zero_has_no_other_end() {
    let through = force(&[(0.0, 1.0), (1.0, 1.0), (2.0, 0.0), (4.0, -1.0)]);
    assert_eq!(earliest_end(&[&through], (0.0, 2.0), 1e-3), None);
    // Nor if it takes its time on the last of the way.
    let slower = force(&[(0.0, 1.0), (1.0, 1.0), (1.999, 1e-3), (2.001, 0.0), (4.0, -1.0)]);
    assert_eq!(earliest_end(&[&slower], (0.0, 2.001), 1e-3), None);
}

#[test]
fn force_that_turns_back_far_above_its_error_pushes() {
    assert_eq!(end(&[&dipping(2e-3)]), None);
}

#[test]
fn force_that_turns_back_within_its_error_may_end_unless_all_agree_on_how_far_above_zero() {
    let finest = dipping(1e-4);
    assert_eq!(end(&[&dipping(1.2e-4), &dipping(0.9e-4), &finest]), None);
    for other in [1e-3, 1.6e-4, 1e-5, 0.0, -1e-4] {
        let found = end(&[&dipping(other), &finest]).unwrap();
        assert!((1.99..=2.0).contains(&found), "{other:e}: {found}");
    }
}

#[test]
fn force_that_pulls_within_its_error_may_end_where_it_passes_zero_however_much_all_agree() {
    let finest = dipping(-1e-4);
    let passage = 1.0 + 1.0 / (1.0 + 1e-4);
    let found = end(&[&dipping(-1e-4), &finest]).unwrap();
    assert!((found - passage).abs() < 1e-9, "{found}");
}

#[test]
fn force_that_lingers_may_end_where_solutions_come_to_differ() {
    let dying = |off: f64| {
        let at = |place: u32| {
            let time = f64::from(place) * 0.02;
            (time, (-12.0 * time).exp() + off)
        };
        force(&(0..=200).map(at).collect::<Vec<_>>())
    };
    let window = (0.0, 4.0);
    assert_eq!(earliest_end(&[&dying(1e-30), &dying(0.0)], window, 1e-3), None);
    let found = earliest_end(&[&dying(1e-6), &dying(0.0)], window, 1e-3).unwrap();
    let (off, value) = (1e-6, (-12.0 * found).exp());
    assert!((off..100.0 * off).contains(&value), "{found}: {value:e}");
}
