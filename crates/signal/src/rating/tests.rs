use std::f64::consts::PI;

use dashpot_units::Dimension;

use super::*;

const RATE: f64 = 10e3;
/// Length of the records \[s\].
const LENGTH: f64 = 0.06;

fn channel(value: impl Fn(f64) -> f64) -> Channel {
    let times: Vec<f64> = (0..=600).map(|at| f64::from(at) / RATE).collect();
    let values = times.iter().copied().map(value).collect();
    Channel::new("a", Dimension::ACCELERATION, times, values).unwrap()
}

/// A haversine of height 1 and 20 ms from 15 ms on.
fn pulse(time: f64) -> f64 {
    let place = (time - 0.015) / 0.02;
    if (0.0..=1.0).contains(&place) { (PI * place).sin().powi(2) } else { 0.0 }
}

fn rated(model: impl Fn(f64) -> f64) -> Rating {
    Rating::of(&channel(pulse), &channel(model), (0.0, LENGTH)).unwrap()
}

#[test]
fn a_model_that_is_the_test_has_a_rating_of_one() {
    let own = rated(pulse);
    let all = [own.corridor, own.phase, own.magnitude, own.slope, own.overall()];
    assert!(all.iter().all(|own| (own - 1.0).abs() < 1e-15), "{own:?}");
    assert_eq!((own.grade(), own.later), ("excellent", 0.0));
}

#[test]
fn a_shift_alone_costs_phase_and_corridor_alone() {
    for steps in [-60_i32, -7, 5, 31, 90] {
        let by = f64::from(steps) / RATE;
        let own = rated(|time| pulse(time - by));
        assert!((own.later - by).abs() < 1e-12, "{own:?}");
        let expected = 1.0 - f64::from(steps.abs()) / (0.2 * 601.0);
        assert!((own.phase - expected).abs() < 1e-12, "{own:?}");
        assert!(own.magnitude > 1.0 - 1e-9 && own.slope > 1.0 - 1e-9, "{own:?}");
        assert!(own.corridor < 1.0, "{own:?}");
    }
    // Further than may be shifted: the score is 0.
    assert!(rated(|time| pulse(time - 0.02)).phase < 0.01);
}

#[test]
fn a_factor_alone_costs_no_phase_and_its_own_part_of_the_slopes() {
    for factor in [0.7, 0.95, 1.1, 1.6] {
        let own = rated(|time| factor * pulse(time));
        let off: f64 = factor - 1.0;
        assert_eq!((own.phase, own.later), (1.0, 0.0));
        assert!((own.slope - (1.0 - off.abs() / 2.0)).abs() < 1e-12, "{own:?}");
        // Without warping it would be the factor; warping brings both nearer.
        assert!(own.magnitude >= 1.0 - off.abs() / 0.5 && own.magnitude < 1.0, "{own:?}");
        // Within 5 % of the peak the corridor costs nothing.
        assert_eq!(own.corridor < 1.0, off.abs() > 0.05 + 1e-9, "{own:?}");
    }
}

#[test]
fn a_constant_difference_has_the_corridor_of_its_closed_form() {
    for (off, expected) in [(0.04, 1.0), (0.275, 0.25), (0.5, 0.0), (0.7, 0.0)] {
        let own = rated(|time| pulse(time) + off);
        assert!((own.corridor - expected).abs() < 1e-12, "{off}: {own:?}");
        assert!((own.slope - 1.0).abs() < 1e-12, "{own:?}");
    }
}

#[test]
fn steps_of_the_records_do_not_matter() {
    let fine = |value: fn(f64) -> f64| {
        let times: Vec<f64> = (0..=6000).map(|at| f64::from(at) / (10.0 * RATE)).collect();
        let values = times.iter().copied().map(value).collect();
        Channel::new("a", Dimension::ACCELERATION, times, values).unwrap()
    };
    let model = |time: f64| 0.9 * pulse(time - 0.001);
    let coarse = Rating::of(&channel(pulse), &channel(model), (0.0, LENGTH)).unwrap();
    let fine = Rating::of(&fine(pulse), &fine(model), (0.0, LENGTH)).unwrap();
    assert!((coarse.overall() - fine.overall()).abs() < 1e-9, "{coarse:?} {fine:?}");
}

#[test]
fn what_has_no_rating_says_why() {
    let of = |test: &Channel, window| Rating::of(test, &channel(pulse), window);
    assert_eq!(of(&channel(pulse), (0.0, 0.0018)), Err(Unrated::TooShort));
    assert!(of(&channel(pulse), (0.015, 0.0169)).is_ok());
    assert_eq!(of(&channel(pulse), (0.0, 2.1)), Err(Unrated::TooLong));
    assert_eq!(of(&channel(|_| 0.0), (0.0, LENGTH)), Err(Unrated::Zero));
    // A model that does nothing has a rating: no shift is better, and rest is met.
    let own = rated(|_| 0.0);
    assert_eq!((own.phase, own.magnitude, own.slope), (1.0, 0.0, 0.5));
}
