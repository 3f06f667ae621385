//! Things that fall and are thrown back.

use dashpot::analysis::Solve;

use super::{
    G0, Solved,
    by_hand::{self, Peak},
    changed, close, scene, solved,
};

/// The stress of the foam's law at a strain.
pub(super) fn foam(strain: f64, [modulus, plateau, densification, exponent]: [f64; 4]) -> f64 {
    plateau * (1.0 - (-modulus * strain / plateau).exp())
        + densification * (strain / (1.0 - strain)).powf(exponent)
}

/// Speed before minus speed after is what the force and the weight make of the mass.
fn keeps_momentum(solved: &Solved, mass: f64, force: &str, body: &str, window: (f64, f64)) {
    let (force, velocity) = (solved.signal(force), solved.signal(body));
    let gained = mass * (velocity.left_value(window.1) - velocity.value(window.0));
    let given = mass * G0 * (window.1 - window.0) - force.integral(window);
    close("momentum", given, gained, 1e-6 * gained.abs().max(mass * velocity.bound()));
}

#[test]
fn a_helmet_drop_flies_touches_bottoms_and_rebounds_as_by_hand() {
    let solved = solved("helmet-drop");
    let (mass, height) = (5.0, 1.5);
    let touch = solved.times("liner.contact", "closed")[0];
    let fall = f64::sqrt(2.0 * height / G0);
    close("time of the fall, √(2 h/g)", touch, fall, 1e-9 * fall);
    close("speed", solved.signal("head.velocity").value(touch), G0 * fall, 1e-8 * G0 * fall);

    // Spring k beside a Maxwell element, and the stop while its force pushes.
    let (k, k1, c1) = (60e3, 60e3, 300.0);
    let (gap, stop, damping) = (0.02, 5e6, 1e3);
    let judge = by_hand::refined(4e-6, |h| {
        let pad = |own: &[f64; 4]| k * own[0] + k1 * (own[0] - own[2]);
        let bottom = |own: &[f64; 4]| stop * (own[0] - gap) + damping * own[1];
        let (mut t, mut state) = (0.0, [0.0, G0 * fall, 0.0, 0.0]);
        let [mut peak, mut depth] = [Peak::NONE; 2];
        // Pressed, pressed against the stop, pressed again: each ends where its guard falls.
        for phase in 0..3 {
            let force = |own: &[f64; 4]| pad(own) + if phase == 1 { bottom(own) } else { 0.0 };
            let rates = |_: f64, own: &[f64; 4]| {
                [own[1], G0 - force(own) / mass, k1 * (own[0] - own[2]) / c1, force(own)]
            };
            let guard = |own: &[f64; 4]| match phase {
                0 => gap - own[0],
                1 => bottom(own),
                _ => pad(own),
            };
            let mut is_over = false;
            while !is_over {
                (t, state, is_over) = by_hand::guarded(t, h, state, &rates, guard);
                peak.see(t, force(&state));
                depth.see(t, state[0]);
            }
        }
        [peak.value / mass, depth.value, t, state[3], -state[1]]
    });
    solved.is("head.peak-acceleration", judge[0].0, judge[0].1);
    solved.is("liner.peak-deformation", judge[1].0, judge[1].1);
    let leaves = solved.times("liner.contact", "open")[0];
    close("contact", leaves - touch, judge[2].0, judge[2].1);
    let force = solved.signal("liner.contact.force");
    close("impulse", force.integral((touch, leaves)), judge[3].0, judge[3].1);
    let speed = -solved.signal("head.velocity").value(leaves);
    close("speed of rebound", speed, judge[4].0, judge[4].1);
    assert!(judge[1].0 > gap, "it must bottom out");
    keeps_momentum(&solved, mass, "liner.contact.force", "head.velocity", (0.0, 0.6));
}

#[test]
fn a_ball_bounces_at_the_times_of_the_series_and_rests_at_its_limit() {
    let solved = solved("bouncing-ball");
    let (mass, height, e): (f64, f64, f64) = (0.1, 0.3, 0.7);
    let fall = f64::sqrt(2.0 * height / G0);
    // Touch n, counted from 0, is at fall (1 + 2 (e + … + e^n)).
    let touch = |n: i32| fall * (1.0 + 2.0 * e * (1.0 - e.powi(n)) / (1.0 - e));
    let found: Vec<f64> = {
        let switches = solved.first().trajectory.switches.iter();
        switches.filter(|switch| switch.impulse > 0.0).map(|switch| switch.time).collect()
    };
    for (n, time) in (0..15).zip(&found) {
        close("touch", *time, touch(n), 1e-9);
    }
    assert!(found.len() >= 15, "{}", found.len());
    let rest = fall * (1.0 + e) / (1.0 - e);
    let (position, force) = (solved.signal("ball.position"), solved.signal("floor.force"));
    // The peak of flight n is e^(2n) of the height; positions count from the floor, downwards.
    for n in 1..6 {
        let top = 0.5 * (touch(n - 1) + touch(n));
        close("height", position.value(top), -height * e.powi(2 * n), 1e-9);
    }
    for t in [rest + 1e-3, 1.7, 2.0] {
        close("it rests on the floor", position.value(t), 0.0, 1e-9);
        close("with its weight", force.value(t), mass * G0, 1e-9);
    }
    // All that gravity gave in 2 s, the floor took; the first measure is that of the first touch.
    solved.is("floor.impulse-2", mass * G0 * 2.0, 1e-9);
}

#[test]
fn crushed_polystyrene_keeps_its_set_and_meets_the_second_hit_with_it_as_by_hand() {
    let solved = solved("eps-helmet");
    let (mass, height, damping): (f64, f64, f64) = (5.0, 1.5, 20.0);
    let (thickness, area, set, power) = (0.03, 40e-4, 0.5, 2.0);
    let loading = |y: f64| area * foam(y / thickness, [20e6, 0.7e6, 0.2e6, 2.0]);
    let fall = f64::sqrt(2.0 * height / G0);
    let judge = by_hand::refined(4e-6, |h| {
        // State: head, its speed, and the face of the liner. It is loaded, unloaded, free, and
        // pressed in again on the curve on which it was unloaded.
        let (mut t, mut state) = (fall, [0.0, G0 * fall, 0.0]);
        let (mut deepest, mut peaks) = (f64::MAX, [Peak::NONE; 4]);
        let mut ends = [(0.0, 0.0); 4];
        for phase in 0..4 {
            let later = |y: f64| {
                let kept = set * deepest;
                loading(y) * ((y - kept) / (deepest - kept)).max(0.0).powf(power)
            };
            let elastic = |y: f64| if phase == 0 { loading(y) } else { later(y) };
            let is_free = phase == 2;
            let h = if is_free { 10.0 * h } else { h };
            let force = |own: &[f64; 3]| {
                if is_free { 0.0 } else { elastic(own[0]) + damping * own[1] }
            };
            let rates = |_: f64, own: &[f64; 3]| {
                let face = if is_free { -later(own[2]) / damping } else { own[1] };
                [own[1], G0 - force(own) / mass, face]
            };
            let guard = |own: &[f64; 3]| match phase {
                0 => own[1],
                2 => own[2] - own[0],
                _ => force(own),
            };
            let mut is_over = false;
            while !is_over {
                (t, state, is_over) = by_hand::guarded(t, h, state, &rates, guard);
                peaks[phase].see(t, force(&state));
            }
            if phase == 0 {
                deepest = state[0];
            }
            ends[phase] = (t, state[1]);
        }
        [
            peaks[0].value,
            deepest,
            ends[1].0 - fall,
            -ends[1].1 / (G0 * fall),
            ends[2].0,
            peaks[3].value,
        ]
    });
    let keys = ["peak-force", "peak-deformation", "contact-time", "coefficient-of-restitution"];
    for (key, own) in keys.iter().zip(judge) {
        solved.is(&format!("liner.{key}"), own.0, own.1);
    }
    let touches = solved.times("liner.contact", "closed");
    let accuracy = 1e-3;
    close("second touch", touches[1], judge[4].0, judge[4].1 + accuracy * judge[4].0);
    let again = solved.signal("liner.force").maximum((touches[1], 1.2)).value;
    close("second peak", again, judge[5].0, judge[5].1 + accuracy * judge[5].0);
    // What the first hit took is the area between the curves, and what the dashpot took.
    let deepest = judge[1].0;
    let all = mass * G0 * (height + deepest);
    let below = by_hand::integral(0.0, deepest, loading);
    let most = damping * G0 * fall * deepest;
    assert!(below < all && all < below + most, "energy: {all}, {below} and up to {most}");
}

#[test]
fn an_instrument_on_corner_foam_is_thrown_back_as_by_hand() {
    let solved = solved("instrument-drop");
    let (mass, height) = (8.0, 0.8);
    let fall = f64::sqrt(2.0 * height / G0);
    let touch = solved.times("corners.contact", "closed")[0];
    close("time of the fall", touch, fall, 1e-5 * fall);
    let (thickness, area, damping) = (0.05, 144e-4, 40.0);
    let spring = |y: f64| area * foam(y / thickness, [1.2e6, 120e3, 30e3, 2.0]);
    let judge = by_hand::refined(4e-6, |h| {
        let force = |own: &[f64; 2]| spring(own[0]) + damping * own[1];
        let rates = |_: f64, own: &[f64; 2]| [own[1], G0 - force(own) / mass];
        let (mut t, mut state, mut is_over) = (0.0, [0.0, G0 * fall], false);
        let [mut peak, mut depth] = [Peak::NONE; 2];
        while !is_over {
            (t, state, is_over) = by_hand::guarded(t, h, state, &rates, force);
            peak.see(t, force(&state));
            depth.see(t, state[0]);
        }
        [peak.value, depth.value, t]
    });
    for (key, own) in ["peak-force", "peak-deformation", "contact-time"].iter().zip(judge) {
        solved.is(&format!("corners.{key}"), own.0, own.1);
    }
    // Without its loss, the foam gives all back: peak force by energy alone.
    let elastic = changed("instrument-drop", |text| text.replace("\"40 N s/m\"", "\"1e-3 N s/m\""));
    let left = |y: f64| mass * G0 * (height + y) - by_hand::integral(0.0, y, spring);
    let deepest = by_hand::zero(0.001, 0.049, left);
    elastic.is("corners.peak-deformation", deepest, 1e-5 * deepest);
    assert!(deepest > solved.measure("corners.peak-deformation").0);
}

#[test]
fn a_landing_on_a_crash_mat_loses_what_the_law_of_hunt_and_crossley_says() {
    let (mass, height, d) = (60.0, 1.2, 0.5);
    let speed = f64::sqrt(2.0 * G0 * height);
    let mat = |y: f64| 3e3 * (y.max(0.0) / 0.1).powf(1.5);
    let solved = solved("crash-mat");
    let judge = by_hand::refined(1e-5, |h| {
        let force = |own: &[f64; 2]| mat(own[0]) * (1.0 + d * own[1]);
        let rates = |_: f64, own: &[f64; 2]| [own[1], G0 - force(own) / mass];
        let (mut t, mut state, mut is_over) = (0.0, [0.0, speed], false);
        let [mut peak, mut depth] = [Peak::NONE; 2];
        while !is_over {
            (t, state, is_over) = by_hand::guarded(t, h, state, &rates, |own| own[0]);
            peak.see(t, force(&state));
            depth.see(t, state[0]);
        }
        [peak.value, depth.value, -state[1] / speed]
    });
    solved.is("mat.peak-force", judge[0].0, judge[0].1);
    solved.is("mat.peak-deformation", judge[1].0, judge[1].1);
    solved.is("mat.coefficient-of-restitution", judge[2].0, judge[2].1);
    // Without gravity the restitution follows from d v alone: x (1 + e) = ln((1 + x)/(1 − e x)).
    let flat = changed("crash-mat", |text| text.replace("gravity = ", "# gravity = "));
    let x = d * speed;
    let e = by_hand::zero(1e-3, 0.999 / x, |e| x * (1.0 + e) - ((1.0 + x) / (1.0 - e * x)).ln());
    flat.is("mat.coefficient-of-restitution", e, 1e-6);
}

#[test]
fn peaks_of_drops_are_within_some_tolerances_without_further_solutions() {
    let laws = [
        "power-spring = { force = \"2 kN\", at = \"25 mm\", exponent = 2.5 }",
        "formula = \"0.3 kN * sinh(y / 9 mm)\"",
    ];
    for law in std::iter::once(None).chain(laws.map(Some)) {
        let scene = scene("instrument-drop", |text| {
            let is_law = |line: &&str| line.starts_with("foam = ");
            let foam = text.lines().find(is_law).unwrap().to_owned();
            text.replace(&foam, law.unwrap_or(&foam))
        });
        let peak = |method: &str, rtol: f64| {
            let mut settings = scene.settings(method).unwrap();
            (settings.rtol, settings.estimate) = (Some(rtol), false);
            let report = scene.network.solve_with(&settings).unwrap();
            report.measure("corners.peak-force").unwrap().value.unwrap()
        };
        let truth = peak("bdf", 1e-11);
        for rtol in [1e-5, 1e-6, 1e-7] {
            let off = (peak("dop853", rtol) / truth - 1.0).abs();
            assert!(off <= 30.0 * rtol, "{law:?} at {rtol:e}: {off:e} off");
        }
    }
}
