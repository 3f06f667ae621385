//! The thesis' example with what it lacks: separation, a stop, mass on the face.

use std::{f64::consts::FRAC_PI_2, fs};

use super::{
    by_hand::{self, Peak},
    close, solved,
};
use crate::{
    independent::Groups,
    thesis::{burgers, from_groups, impact, reference, solve},
};

/// The constants of the thesis' padding, K1, C1, K2, C2.
const PAD: [f64; 4] = [20e6, 4e3, 20e6, 6e3];
/// The same of a softer padding, from the groups with d = 60.
const SOFT: [f64; 4] = [14.688_601_65e6, 3.916_960_439e3, 20e6, 4.500_450_045e3];

#[test]
fn the_head_lets_go_at_zero_force_and_flies_and_the_padding_returns_by_itself() {
    let separated = solved("thesis-separation");
    let bonded = solve(&reference(1e4), "exact", 0.02, 1e-6);
    let release = separated.times("padding.contact", "open")[0];
    // Until then nothing is different; the numbers are those of the thesis page.
    close("release", release, 7.425_568_132e-3, 1e-12);
    let (own, other) = (separated.signal("padding.force"), bonded.signal("padding.force"));
    for at in 0..=100 {
        let t = release * f64::from(at) / 100.0;
        close("force", own.value(t), other.value(t), 1e-9 * own.bound());
    }
    let velocity = separated.signal("head.velocity");
    for t in [release, 0.01, 0.02] {
        close("flight", velocity.value(t), -0.481_681_328, 1e-9);
    }
    assert!(own.minimum((0.0, 0.02)).value >= -1e-12 * own.bound(), "it pulls");
    assert!(other.minimum((0.0, 0.02)).value < -1000.0, "glued it pulls");
    // What the dashpot C2 gave way is its set for good; the Kelvin element returns with C1/K1.
    let [k1, c1, _, c2] = PAD;
    let set = own.integral((0.0, release)) / c2;
    let deformation = separated.signal("padding.deformation");
    let kelvin = deformation.value(release) - set;
    for t in [8e-3, 9e-3, 10e-3, 20e-3] {
        let expected = set + kelvin * (-k1 / c1 * (t - release)).exp();
        close("free padding", deformation.value(t), expected, 1e-9 * expected);
    }
}

#[test]
fn the_softer_padding_goes_beyond_its_thickness_unless_it_bottoms_out() {
    // Bonded and without a stop it is the thesis' family, d = 60: 1.1411 of the thickness.
    let [k1, c1, k2, c2] = SOFT;
    let bonded = solve(
        &impact(10.0, 10.0, burgers(k1, c1, k2, c2), [100.0, 50e6, 10e3]),
        "exact",
        0.02,
        1e-6,
    );
    let deepest = bonded.signal("padding.deformation").maximum((0.0, 0.02)).value;
    close("in parts of the thickness", deepest / 0.02, 1.1411, 5e-5);

    let stopped = solved("thesis-stop");
    assert!(stopped.measure("padding.peak-deformation").0 < 0.02);
    let (gap, stop, damping) = (18e-3, 200e6, 10e3);
    let judge = by_hand::refined(1e-6, |h| {
        // State: head, panel, Kelvin element, dashpot C2; the spring K2 has the force.
        let pad = |own: &[f64; 6]| k2 * (own[0] - own[2] - own[4] - own[5]);
        let bottom = |own: &[f64; 6]| stop * (own[0] - own[2] - gap) + damping * (own[1] - own[3]);
        let (mut t, mut state) = (0.0, [0.0, 10.0, 0.0, 0.0, 0.0, 0.0]);
        let [mut peak, mut depth] = [Peak::NONE; 2];
        for phase in 0..3 {
            let all = |own: &[f64; 6]| pad(own) + if phase == 1 { bottom(own) } else { 0.0 };
            let rates = |_: f64, own: &[f64; 6]| {
                let (force, push) = (pad(own), all(own));
                [
                    own[1],
                    -push / 10.0,
                    own[3],
                    (push - 50e6 * own[2] - 10e3 * own[3]) / 100.0,
                    (force - k1 * own[4]) / c1,
                    force / c2,
                ]
            };
            let guard = |own: &[f64; 6]| match phase {
                0 => gap - (own[0] - own[2]),
                1 => bottom(own),
                _ => pad(own),
            };
            let mut is_over = false;
            while !is_over {
                (t, state, is_over) = by_hand::guarded(t, h, state, &rates, guard);
                peak.see(t, all(&state));
                depth.see(t, state[0] - state[2]);
            }
        }
        [peak.value / 10.0, depth.value, t]
    });
    stopped.is("head.peak-acceleration", judge[0].0, judge[0].1);
    stopped.is("padding.peak-deformation", judge[1].0, judge[1].1);
    let release = stopped.times("padding.contact", "open")[0];
    close("release", release, judge[2].0, judge[2].1);
}

#[test]
fn a_padding_that_stiffens_keeps_within_its_thickness_as_by_hand() {
    let [k1, c1, k2, c2] = SOFT;
    let (stiffness, limit) = (0.3e6, 0.02);
    let solved = solved("thesis-stiffening");
    let judge = by_hand::refined(1e-6, |h| {
        // State: head, panel, Kelvin element, dashpot C2; the spring K2 has the force.
        let inner = |own: &[f64; 6]| k2 * (own[0] - own[2] - own[4] - own[5]);
        let beside = |y: f64| stiffness * limit / FRAC_PI_2 * (FRAC_PI_2 * y / limit).tan();
        let push = |own: &[f64; 6]| inner(own) + beside(own[0] - own[2]);
        let rates = |_: f64, own: &[f64; 6]| {
            let (force, push) = (inner(own), push(own));
            [
                own[1],
                -push / 10.0,
                own[3],
                (push - 50e6 * own[2] - 10e3 * own[3]) / 100.0,
                (force - k1 * own[4]) / c1,
                force / c2,
            ]
        };
        let (mut t, mut state, mut is_over) = (0.0, [0.0, 10.0, 0.0, 0.0, 0.0, 0.0], false);
        let [mut peak, mut depth] = [Peak::NONE; 2];
        while !is_over {
            (t, state, is_over) = by_hand::guarded(t, h, state, &rates, push);
            peak.see(t, push(&state));
            depth.see(t, state[0] - state[2]);
        }
        [peak.value, depth.value, t]
    });
    for (key, own) in ["peak-force", "peak-deformation", "contact-time"].iter().zip(judge) {
        solved.is(&format!("padding.{key}"), own.0, own.1);
    }
    assert!(judge[1].0 < limit);
}

#[test]
fn the_groups_beyond_which_the_padding_is_pressed_in_by_its_thickness_are_those_of_the_chapter() {
    let base = Groups::printed(0.2);
    // At these groups the deepest point is the thickness; the digits are all that is printed.
    for groups in [Groups { b: 77.24, ..base }, Groups { d: 69.43, ..base }] {
        let solved = solve(&from_groups(&groups), "exact", 10.0, 1e-6);
        let deepest = solved.signal("padding.deformation").maximum((0.0, 10.0)).value;
        close("deepest point", deepest, 1.0, 1e-4);
    }
}

#[test]
fn the_values_in_the_scene_are_those_of_the_groups() {
    let (a, b, c, d) = (26.6, 66.66, 8.0, 60.0);
    let (mass, time) = (10.0, 2e-3);
    let q: f64 = a - b * c / d - d / c;
    let values = [
        d * mass / (q * time * time) / 1e6,
        c * mass / (q * time) / 1e3,
        c * mass / (time * time) / 1e6,
        d * mass / (b * time) / 1e3,
    ];
    let path = format!("{}/scenes/thesis-stop.toml", env!("CARGO_MANIFEST_DIR"));
    let text = fs::read_to_string(path).unwrap();
    for (name, value) in ["K1", "C1", "K2", "C2"].iter().zip(values) {
        let line = text.lines().find(|line| line.starts_with(&format!("{name} = "))).unwrap();
        let written: f64 =
            line.split('"').nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
        close(name, written, value, 1e-8 * value);
    }
}

#[test]
fn a_face_with_mass_is_taken_along_and_both_forces_are_those_of_one_body() {
    let solved = solved("padding-mass");
    let (head, face, speed) = (10.0, 0.5, 10.0);
    let together = head * speed / (head + face);
    let velocity = solved.signal("head.velocity");
    close("speed after the touch", velocity.value(0.0), together, 1e-9);
    let lost = 0.5 * head * face / (head + face) * speed * speed;
    let switches = solved.first().trajectory.switches.iter();
    let (impulse, energy) =
        switches.fold((0.0, 0.0), |sum, own| (sum.0 + own.impulse, sum.1 + own.lost));
    close("energy lost at the touch", energy, lost, 1e-9 * lost);
    close("impulse of the touch", impulse, face * together, 1e-9 * face * together);
    // From then on head and face are one body of both masses, until F1 is zero.
    let [k1, c1, k2, c2] = PAD;
    let one = impact(head + face, together, burgers(k1, c1, k2, c2), [100.0, 50e6, 10e3]);
    let one = solve(&one, "exact", 0.02, 1e-6);
    let inner = one.signal("padding.force");
    let release = inner.first_crossing(0.0, (1e-4, 0.02), Some(false)).unwrap().time;
    close("release", solved.times("padding.contact", "open")[0], release, 1e-9);
    let (first, second) = (solved.signal("padding.contact.force"), solved.signal("padding.force"));
    for at in 1..100 {
        let t = release * f64::from(at) / 100.0;
        let force = inner.value(t);
        close("F2", second.value(t), force, 1e-9 * inner.bound());
        close("F1", first.value(t), force * head / (head + face), 1e-9 * inner.bound());
    }
}
