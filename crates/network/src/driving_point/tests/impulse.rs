//! The worst time after an impulse, against closed forms of the motion.

use super::{judge::scene, *};
use crate::driving_point::{Agreement, Pole};
use std::f64::consts::{PI, TAU};

/// What the search leaves unresolved, relative.
const SEARCH: f64 = 1e-3;

#[derive(Debug)]
struct Found {
    time: f64,
    size: f64,
    is_growing: bool,
    until: f64,
}

fn found(a: &Receptance, b: &Receptance) -> Found {
    match a.agreement(b) {
        Agreement::Different { time, after_impulse: size, is_growing, until, .. } => {
            Found { time, size, is_growing, until }
        }
        other => panic!("{other:?}"),
    }
}

fn on_pad(mass: f64, pad: Model) -> Receptance {
    let (network, nodes) = network(&[mass], &[(1, 0, pad)]);
    massive(&network, nodes[1], nodes[0])
}

/// The largest difference, in units of the largest motion up to then, of `(h, Δh)` on a grid.
fn on_grid(motion: impl Fn(f64) -> [f64; 2], step: f64, end: f64) -> (f64, f64) {
    let [first, change] = motion(1e-4 * step);
    let (mut best, mut largest, mut t) = ((0.0, 0.0), first.abs().max((first - change).abs()), 0.0);
    while t < end {
        t += step;
        let [h, change] = motion(t);
        largest = largest.max(h.abs()).max((h - change).abs());
        if change.abs() / largest > best.1 {
            best = (t, change.abs() / largest);
        }
    }
    best
}

#[test]
fn undamped_oscillators_drift_apart_until_the_end() {
    let change = 1e-3;
    let found = found(&on_pad(1.0, spring(1.0)), &on_pad(1.0, spring(1.0 + change)));
    let omega = (1.0 + change).sqrt();
    let motion = |t: f64| [t.sin(), t.sin() - (omega * t).sin() / omega];
    let (time, size) = on_grid(motion, 1e-3, found.until);
    assert!(found.is_growing, "{found:?}");
    assert!(near(found.until, 100.0 * TAU, 1e-2), "{found:?}");
    assert!(near(found.size, size, SEARCH), "{found:?} {size}");
    assert!((found.time - time).abs() < 0.01, "{found:?} {time}");
}

#[test]
fn undamped_oscillators_differ_most_in_the_middle_of_their_beat() {
    // Near ones are taken together, far ones are not.
    for change in [0.015, 0.05] {
        let found = found(&on_pad(1.0, spring(1.0)), &on_pad(1.0, spring(1.0 + change)));
        let omega = (1.0 + change).sqrt();
        let motion = |t: f64| [t.sin(), t.sin() - (omega * t).sin() / omega];
        let (_, size) = on_grid(motion, 1e-3, found.until);
        assert!(near(found.size, size, SEARCH), "{found:?} {size}");
        assert!(size > 1.9 && !found.is_growing, "{found:?}");
        // Beats repeat; each middle is as good as another to the shape of one oscillation.
        let beat = (omega - 1.0) * found.time / PI;
        assert!((beat - beat.round()).abs() < 0.1 && beat.round() % 2.0 > 0.5, "{found:?}");
    }
}

#[test]
fn a_small_change_of_damping_shows_as_its_derivative() {
    let (half, change) = (0.05, 1e-9);
    let found = found(
        &on_pad(1.0, kelvin(1.0, 2.0 * half)),
        &on_pad(1.0, kelvin(1.0, 2.0 * half * (1.0 + change))),
    );
    // ∂h/∂c of h = e^{−at} sin(ωt)/ω with a = c/2, ω² = 1 − a².
    let omega = (1.0 - half * half).sqrt();
    let motion = |t: f64| {
        let (decay, angle) = ((-half * t).exp(), omega * t);
        let h = decay * angle.sin() / omega;
        let by_omega = decay * (t * angle.cos() / omega - angle.sin() / (omega * omega));
        let by_damping = 0.5 * (-t * h - by_omega * half / omega);
        [h, by_damping * 2.0 * half * change]
    };
    let (time, size) = on_grid(motion, 1e-4, 200.0);
    assert!(near(found.size, size, SEARCH * 0.1), "{found:?} {size:e}");
    assert!((found.time - time).abs() < 1e-2, "{found:?} {time}");
    assert!(!found.is_growing && found.until.is_infinite(), "{found:?}");
}

#[test]
fn a_change_at_critical_damping_shows_beside_its_double_pole() {
    let change = 1e-6;
    let found = found(&on_pad(1.0, kelvin(1.0, 2.0)), &on_pad(1.0, kelvin(1.0, 2.0 + change)));
    // To first order h = t e^{−t} changes by −Δc ½ (1 − t/3) t² e^{−t}: a triple and a fourfold
    // pole of s/(s + 1)⁴.
    let motion = |t: f64| [t * (-t).exp(), change * t * t * (0.5 - t / 6.0) * (-t).exp()];
    let (time, size) = on_grid(motion, 1e-4, 60.0);
    assert!(near(found.size, size, SEARCH), "{found:?} {size:e}");
    assert!((found.time - time).abs() < 1e-2, "{found:?} {time}");
    assert!(found.until.is_infinite(), "{found:?}");
}

#[test]
fn free_masses_differ_by_the_same_part_at_all_times() {
    let free = |mass: f64| {
        let (network, nodes) = network(&[mass, 1.0], &[(2, 0, spring(1.0))]);
        massive(&network, nodes[1], nodes[0])
    };
    let found = found(&free(2.0), &free(2.0 * (1.0 + 1e-9)));
    assert!(found.time <= 0.0 && !found.is_growing, "{found:?}");
    assert!(near(found.size, 1e-9, 1e-6), "{found:?}");
    assert!(found.until.is_infinite());
}

#[test]
fn a_mass_behind_a_dashpot_shows_after_ever_longer_times() {
    let pair = |mass: f64| {
        let (network, nodes) = network(&[1.0, mass], &[(1, 2, dashpot(1.5))]);
        massive(&network, nodes[1], nodes[0])
    };
    let change = 1e-9;
    let found = found(&pair(3.0), &pair(3.0 * (1.0 + change)));
    assert!(found.time.is_infinite() && found.until.is_infinite(), "{found:?}");
    assert!(near(found.size, 0.75 * change, 1e-6), "{found:?}");
}

#[test]
fn a_driven_mass_shows_at_once() {
    let change = 1e-8;
    let pad = || kelvin(1.0, 50.0);
    let found = found(&on_pad(1.0, pad()), &on_pad(1.0 + change, pad()));
    // h = t/m at first; a heavier mass keeps its speed for longer, but by no more than that.
    assert!(found.time <= 0.0, "{found:?}");
    assert!(near(found.size, change, 1e-6), "{found:?}");
}

#[test]
fn a_spring_before_everything_shows_in_no_motion_after_the_instant() {
    let before = |stiffness: f64| {
        let links = [(1, 2, spring(stiffness)), (2, 0, kelvin(1.0, 0.1))];
        let (network, nodes) = network(&[0.0, 1.0], &links);
        massive(&network, nodes[1], nodes[0])
    };
    let found = found(&before(5.0), &before(6.0));
    assert!(found.size <= 0.0 && found.time <= 0.0, "{found:?}");
}

#[test]
fn a_fast_oscillation_that_lasts_shortens_what_is_looked_at() {
    // A light mass rings at 10⁵ rad/s on a heavy one that swings at 1 rad/s, and nothing is damped.
    let scene = |light: f64| {
        let links = [(1, 0, spring(1e6)), (2, 1, spring(1e6))];
        let (network, nodes) = network(&[1e6, light], &links);
        massive(&network, nodes[2], nodes[0])
    };
    let found = found(&scene(1e-4), &scene(1.001e-4));
    assert!(found.until < 10.0 && found.until > 0.1, "{found:?}");
    assert!(found.size > 1.9 && !found.is_growing, "{found:?}");
}

#[test]
fn a_pole_of_no_account_changes_nothing() {
    // Its rate is 10¹² times that of the swing: near its time the motion is rounding.
    let pair = |pad: &Model| [0.0, 1e-10].map(|change| on_pad(1.0 + change, pad.clone()));
    let [plain, stiff] =
        [pair(&kelvin(1.0, 0.1)), pair(&Tree::parallel([kelvin(1.0, 0.1), maxwell(1e6, 1e-6)]))]
            .map(|[a, b]| found(&a, &b));
    // 10⁻⁶ more damping is a part of 10⁻⁵ of what the size depends on.
    assert!(near(plain.size, stiff.size, SEARCH), "{plain:?} {stiff:?}");
    assert!(near(plain.time, stiff.time, SEARCH), "{plain:?} {stiff:?}");
}

#[test]
fn random_networks_differ_most_where_a_fine_grid_says_so() {
    let mut checked = 0;
    for seed in 0..300 {
        let pair = [0.0, 1e-3].map(|change| {
            let (mut network, nodes) = scene(&mut Dice(seed), true, 2.0);
            if change > 0.0 {
                network.connect("extra", nodes[1], nodes[2], kelvin(change, change));
            }
            network.driving_point(nodes[1], nodes[2]).unwrap()
        });
        let [Response::Massive(a), Response::Massive(b)] = pair else { continue };
        let found = found(&a, &b);
        assert!(found.size >= 0.0 && found.size <= 2.0, "{seed}: {found:?}");
        let poles = [a.poles(), b.poles()];
        if poles.iter().flatten().any(|pole| pole.order > 1 && pole.at[0] < 0.0) {
            continue;
        }
        let motion = |t: f64| {
            let [a, b] = [&poles[0], &poles[1]].map(|poles| {
                let all = poles.iter().map(|Pole { at: [re, im], residues, .. }| {
                    let simple = residues[residues.len() - 1];
                    let free = if residues.len() > 1 { residues[0][0] * t } else { 0.0 };
                    let (sin, cos) = (im * t).sin_cos();
                    (re * t).exp() * (simple[0] * cos - simple[1] * sin) + free
                });
                all.sum::<f64>()
            });
            [a, a - b]
        };
        let sizes = poles.iter().flatten().map(|pole| pole.at[0].hypot(pole.at[1]));
        let fastest = sizes.fold(0.0, f64::max);
        let end = if found.time > 0.0 && found.time.is_finite() {
            1.5 * found.time
        } else {
            100.0 / fastest
        };
        let end = end.min(found.until);
        if end * fastest > 4e3 {
            continue;
        }
        checked += 1;
        let (time, size) = on_grid(motion, 0.01 / fastest, end);
        let rounding = 1e-9;
        assert!(size <= found.size * (1.0 + SEARCH) + rounding, "{seed}: {found:?} {time} {size}");
        if found.time.is_finite() {
            // The grid starts a hundredth of the fastest time after the impulse.
            let least = if found.time > 0.0 { 1.0 - SEARCH } else { 0.9 };
            assert!(size >= found.size * least - rounding, "{seed}: {found:?} {time} {size}");
        }
    }
    assert!(checked > 100, "{checked}");
}
