//! Pads between an impactor and what it strikes, against equations of motion by hand.

use std::f64::consts::FRAC_PI_2;

use super::{
    by_hand::{self, Peak},
    close, solved,
};

/// Spring `k` beside a Maxwell element of spring `k1` and dashpot `c1`.
struct Zener {
    k: f64,
    k1: f64,
    c1: f64,
}

impl Zener {
    /// Force at the deformation `y` when the dashpot is pressed in by `d`.
    fn force(&self, y: f64, d: f64) -> f64 {
        self.k * y + self.k1 * (y - d)
    }

    fn dashpot_rate(&self, y: f64, d: f64) -> f64 {
        self.k1 * (y - d) / self.c1
    }
}

#[test]
fn a_puck_on_two_layers_keeps_momentum_and_follows_the_equations_by_hand() {
    let solved = solved("hockey-pad");
    let (puck, interval, speed, area) = (0.17, 4.0, 30.0, 60e-4);
    let layer = |k: f64, k1: f64, c1: f64, thickness: f64| {
        let size = area / thickness;
        Zener { k: k * size, k1: k1 * size, c1: c1 * size }
    };
    let cap = layer(30e6, 60e6, 6e3, 4e-3);
    let foam = layer(0.9e6, 2.1e6, 1.5e3, 16e-3);
    let judge = by_hand::refined(2e-7, |h| {
        // In series one force: it says how the deformation is shared out.
        let share = |own: &[f64; 6]| {
            let (first, second) = (cap.k + cap.k1, foam.k + foam.k1);
            (second * (own[0] - own[2]) - foam.k1 * own[5] + cap.k1 * own[4]) / (first + second)
        };
        let force = |own: &[f64; 6]| cap.force(share(own), own[4]);
        let rates = |_: f64, own: &[f64; 6]| {
            let (y, force) = (share(own), force(own));
            [
                own[1],
                -force / puck,
                own[3],
                force / interval,
                cap.dashpot_rate(y, own[4]),
                foam.dashpot_rate(own[0] - own[2] - y, own[5]),
            ]
        };
        let (mut t, mut state, mut is_over) = (0.0, [0.0, speed, 0.0, 0.0, 0.0, 0.0], false);
        let [mut peak, mut depth] = [Peak::NONE; 2];
        while !is_over {
            (t, state, is_over) = by_hand::guarded(t, h, state, &rates, force);
            peak.see(t, force(&state));
            depth.see(t, state[0] - state[2]);
        }
        [peak.value, depth.value, t, (state[3] - state[1]) / speed]
    });
    for (key, own) in
        ["peak-force", "peak-deformation", "contact-time", "coefficient-of-restitution"]
            .iter()
            .zip(judge)
    {
        solved.is(&format!("pad.{key}"), own.0, own.1);
    }
    // Momentum goes from the puck to the leg: what both have in the end follows from e alone.
    let e = solved.measure("pad.coefficient-of-restitution").0;
    let (impulse, after) = (solved.measure("pad.impulse").0, puck * speed / (puck + interval));
    close("impulse", impulse, (1.0 + e) * interval * after, 1e-8 * impulse);
    solved.is("leg.end-velocity", (1.0 + e) * after, 1e-8 * after);
}

#[test]
fn a_hammer_on_felt_follows_twelve_maxwell_elements_by_hand() {
    let solved = solved("felt-hammer");
    let (hammer, string, speed, tension, rest) = (9e-3, 8e-3, 3.0, 6e3, 12e3);
    let times =
        [1e-6, 3e-6, 8e-6, 23e-6, 66e-6, 0.19e-3, 0.53e-3, 1.5e-3, 4.3e-3, 12e-3, 35e-3, 0.1];
    let springs = [9e3, 9e3, 8e3, 8e3, 7e3, 7e3, 6e3, 5e3, 4e3, 3e3, 2e3, 2e3];
    // At the first instant no element has relaxed: F' = (K_e + Σ K_j) V.
    let all = rest + springs.iter().sum::<f64>();
    let force = solved.signal("felt.force");
    close("slope at touch", force.slope(0.0), all * speed, 1e-6 * all * speed);
    let judge = by_hand::refined(4e-7, |h| {
        let force = |own: &[f64; 16]| rest * (own[0] - own[2]) + own[4..].iter().sum::<f64>();
        let rates = |_: f64, own: &[f64; 16]| {
            let push = force(own);
            std::array::from_fn(|at| match at {
                0 => own[1],
                1 => -push / hammer,
                2 => own[3],
                3 => (push - tension * own[2]) / string,
                _ => springs[at - 4] * (own[1] - own[3]) - own[at] / times[at - 4],
            })
        };
        let (mut t, mut state, mut is_over) = (0.0, [0.0; 16], false);
        state[1] = speed;
        let mut peak = Peak::NONE;
        while !is_over {
            (t, state, is_over) = by_hand::guarded(t, h, state, &rates, force);
            peak.see(t, force(&state));
        }
        [peak.value, t, state[1]]
    });
    solved.is("felt.peak-force", judge[0].0, judge[0].1);
    solved.is("felt.contact-time", judge[1].0, judge[1].1);
    let speed = solved.signal("hammer.velocity").value(judge[1].0);
    close("speed of the hammer", speed, judge[2].0, judge[2].1 + 1e-8);
}

#[test]
fn a_head_on_a_bonnet_meets_the_engine_as_by_hand() {
    let solved = solved("bonnet-head");
    let (head, bonnet, speed) = (4.5, 3.0, 11.1);
    let skin = Zener { k: 0.8e6, k1: 1.2e6, c1: 1.2e3 };
    let (k, c) = (45e3, 350.0);
    let (gap, stop, damping) = (55e-3, 2e6, 2e3);
    let judge = by_hand::refined(1e-6, |h| {
        // State: head, panel, dashpot of the skin. While it is glued to nothing, the skin has no
        // force, and is as thick as its dashpot leaves it.
        let free = |own: &[f64; 5]| skin.k1 * own[4] / (skin.k + skin.k1);
        let push = |own: &[f64; 5]| skin.force(own[0] - own[2], own[4]);
        let bottom = |own: &[f64; 5]| stop * (own[2] - gap) + damping * own[3];
        let (mut touches, mut bottomed) = (true, false);
        let (mut t, mut state) = (0.0, [0.0, speed, 0.0, 0.0, 0.0]);
        let [mut peak, mut depth, mut engine] = [Peak::NONE; 3];
        while t < 25e-3 {
            let forces = |own: &[f64; 5]| {
                [if touches { push(own) } else { 0.0 }, if bottomed { bottom(own) } else { 0.0 }]
            };
            let rates = |_: f64, own: &[f64; 5]| {
                let ([push, bottom], (head_v, panel_v)) = (forces(own), (own[1], own[3]));
                let way = if touches { own[0] - own[2] } else { free(own) };
                let held = k * own[2] + c * own[3] + bottom;
                let dashpot = skin.dashpot_rate(way, own[4]);
                [head_v, -push / head, panel_v, (push - held) / bonnet, dashpot]
            };
            let touch = |own: &[f64; 5]| {
                if touches { push(own) } else { free(own) - (own[0] - own[2]) }
            };
            let meet = |own: &[f64; 5]| if bottomed { bottom(own) } else { gap - own[2] };
            let first = by_hand::guarded(t, h, state, &rates, touch);
            let second = by_hand::guarded(t, h, state, &rates, meet);
            let is_touch = first.0 < second.0;
            let hit;
            (t, state, hit) = if is_touch { first } else { second };
            let [push, bottom] = forces(&state);
            peak.see(t, push);
            engine.see(t, bottom);
            depth.see(t, state[2]);
            if hit && is_touch {
                touches = !touches;
            } else if hit {
                bottomed = !bottomed;
            }
        }
        let (peak, deepest, stopped) = (peak.value, depth.value, engine.value);
        [peak / head, deepest, stopped]
    });
    let (peak, error) = judge[0];
    solved.is("head.peak-acceleration", peak, error);
    let end = (0.0, 25e-3);
    let deepest = solved.signal("bonnet.position").maximum(end).value;
    close("depth of the bonnet", deepest, judge[1].0, judge[1].1);
    let stop = solved.signal("hinge.stop.force").maximum(end).value;
    close("force of the engine", stop, judge[2].0, judge[2].1);
    assert!(deepest > gap && stop > 0.0, "it must bottom out: {deepest}, {stop}");
}

#[test]
fn a_hip_protector_stiffens_with_depth_and_rate_as_by_hand() {
    let solved = solved("hip-protector");
    let (body, bone, speed) = (35.0, 0.7, 2.6);
    let (stiffness, limit) = (60e3, 16e-3);
    let spring = |y: f64| stiffness * limit / FRAC_PI_2 * (FRAC_PI_2 * y / limit).tan();
    let (force, at, gain, rate) = (800.0, 8e-3, 0.25, 5e-3);
    let pad = |y: f64, v: f64| {
        let loaded = if v > 0.0 { 1.0 + gain * (v / rate).ln_1p() } else { 1.0 };
        spring(y) + force * (y.max(0.0) / at).powf(1.5) * loaded + 60.0 * v
    };
    let judge = by_hand::refined(4e-6, |h| {
        let push = |own: &[f64; 4]| pad(own[0] - own[2], own[1] - own[3]);
        let tissue = |own: &[f64; 4]| 90e3 * own[2] + 900.0 * own[3];
        let rates = |_: f64, own: &[f64; 4]| {
            [own[1], -push(own) / body, own[3], (push(own) - tissue(own)) / bone]
        };
        let (mut t, mut state, mut is_over) = (0.0, [0.0, speed, 0.0, 0.0], false);
        let [mut peak, mut depth, mut below] = [Peak::NONE; 3];
        while !is_over {
            (t, state, is_over) = by_hand::guarded(t, h, state, &rates, push);
            peak.see(t, push(&state));
            depth.see(t, state[0] - state[2]);
            below.see(t, tissue(&state));
        }
        [peak.value, depth.value, t, below.value]
    });
    for (key, own) in
        ["pad.peak-force", "pad.peak-deformation", "pad.contact-time", "tissue.peak-force"]
            .iter()
            .zip(judge)
    {
        solved.is(key, own.0, own.1);
    }
    assert!(judge[1].0 < limit, "the pad is never thinner than nothing");
}
