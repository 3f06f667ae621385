//! A knee against a padded panel in a car that a measured pulse brakes.

use std::fs;

use super::{
    G0,
    by_hand::{self, Peak},
    close,
    drops::foam,
    scene_path, solved,
};

/// Time between two rows of the pulse \[s\].
const EVERY: f64 = 2e-3;
const SPEED: f64 = 56.0 / 3.6;
const MASS: f64 = 12.0;
/// Thickness \[m\] and law of both layers.
const SOFT: (f64, [f64; 4]) = (0.015, [1.5e6, 150e3, 40e3, 2.5]);
const STIFF: (f64, [f64; 4]) = (0.06, [8e6, 350e3, 60e3, 2.5]);

/// Place, speed and acceleration of the car at each row.
fn car() -> Vec<[f64; 3]> {
    let text = fs::read_to_string(scene_path("knee-crash")).unwrap();
    let rows = text.split("ms\", \"").skip(1).filter_map(|rest| rest.split_once(" g\"]"));
    let rows: Vec<f64> = rows.map(|(value, _)| G0 * value.parse::<f64>().unwrap()).collect();
    assert_eq!(rows.len(), 61);
    let mut now = [0.0, SPEED, rows[0]];
    let mut all = vec![now];
    for next in &rows[1..] {
        let [place, speed, first] = now;
        let further = EVERY * (speed + EVERY * (2.0 * first + next) / 6.0);
        now = [place + further, speed + 0.5 * EVERY * (first + next), *next];
        all.push(now);
    }
    all
}

/// The place of the car.
fn place(car: &[[f64; 3]], t: f64) -> f64 {
    let row = (1..60).rfind(|&row| f64::from(row) * EVERY <= t).unwrap_or(0);
    let at = usize::try_from(row).unwrap();
    let (s, [place, speed, first]) = (t - f64::from(row) * EVERY, car[at]);
    let jerk = (car[at + 1][2] - first) / EVERY;
    place + s * (speed + s * (0.5 * first + s * jerk / 6.0))
}

fn push((thickness, law): (f64, [f64; 4]), deformation: f64) -> f64 {
    let strain = deformation / thickness;
    0.01 * if strain < 0.0 { law[0] * strain } else { foam(strain, law) }
}

/// How far the soft layer is compressed where both together are.
fn soft(both: f64) -> f64 {
    let apart = |own: f64| push(SOFT, own) - push(STIFF, both - own);
    let (low, high) = (both - STIFF.0 + 1e-6, SOFT.0 - 1e-6);
    by_hand::zero(low.max(both.min(0.0)), high.min(both.max(0.0)), apart)
}

#[test]
fn a_knee_meets_the_panel_of_a_braked_car_as_by_hand() {
    let solved = solved("knee-crash");
    let car = car();
    let gap = |t: f64| 0.05 + place(&car, t) - SPEED * t;
    let touch = by_hand::zero(0.01, 0.05, gap);
    let judge = by_hand::refined(2e-5, |h| {
        let both = |t: f64, own: &[f64; 2]| own[0] - 0.05 - place(&car, t);
        let force = |t: f64, own: &[f64; 2]| push(SOFT, soft(both(t, own)));
        let rates = |t: f64, own: &[f64; 2]| [own[1], -force(t, own) / MASS];
        let (mut t, mut state) = (touch, [SPEED * touch, SPEED]);
        let [mut peak, mut depth] = [Peak::NONE; 2];
        loop {
            let next = by_hand::step(t, h, state, &rates);
            if both(t + h, &next) < 0.0 {
                break;
            }
            (t, state) = (t + h, next);
            peak.see(t, force(t, &state));
            depth.see(t, soft(both(t, &state)));
        }
        let part =
            by_hand::zero(0.0, h, |part| both(t + part, &by_hand::step(t, part, state, &rates)));
        let last = by_hand::step(t, part, state, &rates);
        [peak.value, depth.value, t + part - touch, MASS * (SPEED - last[1]), peak.value / MASS]
    });
    let keys = [
        "soft.peak-force",
        "soft.peak-deformation",
        "soft.contact-time",
        "soft.impulse",
        "knee.peak-acceleration",
    ];
    for (key, own) in keys.iter().zip(judge) {
        solved.is(key, own.0, own.1);
    }
    close("it meets the panel", solved.times("soft.contact", "closed")[0], touch, 1e-6);
}
