//! Cushion curves of foam: 3 heights, 5 thicknesses, 40 static stresses, by hand and by ours, with a stop and without.

use std::{hint::black_box, ops::ControlFlow};

use dashpot::{
    design::cushion::{Asked, Cushion, Platen, cushion},
    network::effects::Stop,
};

use super::{
    Contender, WANTED,
    foam::{AREA, Block, GRAVITY},
    race, tolerance_by_hand,
};

const HEIGHTS: [f64; 3] = [0.3, 0.6, 0.9];
const THICKNESSES: [f64; 5] = [0.04, 0.055, 0.07, 0.085, 0.1];
const STRESSES: u16 = 40;
/// The ends of the static stresses \[Pa\].
const ENDS: [f64; 2] = [1e3, 1e4];
/// Where the stop is met \[m\], and its stiffness \[N/m\].
const STOP: f64 = 0.03;
const STIFFNESS: f64 = 2e6;
const SCENES: usize = HEIGHTS.len() * THICKNESSES.len() * STRESSES as usize;

fn stresses() -> Vec<f64> {
    let last = f64::from(STRESSES - 1);
    let place = |at: u16| f64::from(at) / last;
    (0..STRESSES).map(|at| ENDS[0] * (ENDS[1] / ENDS[0]).powf(place(at))).collect()
}

/// All drops by hand: the sum of the peaks.
fn by_hand(rtol: f64) -> f64 {
    let mut sum = 0.0;
    for height in HEIGHTS {
        for thickness in THICKNESSES {
            for stress in stresses() {
                let mass = stress * AREA / GRAVITY;
                sum += Block { mass, thickness }.by_hand(black_box(height), rtol)[6];
            }
        }
    }
    sum
}

/// All curves by ours.
fn ours(has_stop: bool) -> Cushion {
    let pose = |thickness: f64| {
        let mut own = Block { mass: 8.0, thickness }.scene(HEIGHTS[0]);
        if has_stop {
            let element = "pad".to_owned();
            own.network.add_effect(Stop {
                element,
                at: Some(STOP),
                restitution: 0.0,
                stiffness: Some(STIFFNESS),
                damping: 0.0,
            });
        }
        Ok(own)
    };
    let own = pose(THICKNESSES[0]).expect("a scene");
    let platen = Platen::of(&own.network, None, None).expect("a platen");
    let asked = Asked {
        heights: HEIGHTS.to_vec(),
        thicknesses: THICKNESSES.to_vec(),
        stresses: stresses(),
        limit: None,
        over: None,
        row: None,
        creep: Vec::new(),
        threads: 1,
    };
    cushion(&platen, &asked, &pose, &mut |_, _| ControlFlow::Continue(())).expect("curves")
}

pub(crate) fn curves() {
    let rtol = tolerance_by_hand(WANTED);
    let peak = |has_stop: bool| ours(has_stop).curves[0].points[0].peak;
    race(
        "cushion curves of foam, 3 × 5 × 40 drops",
        &[
            Contender {
                name: "by hand: order 5, events",
                scenes: SCENES,
                solve: Box::new(|| by_hand(rtol)),
            },
            Contender {
                name: "with errors and best stresses",
                scenes: SCENES,
                solve: Box::new(|| peak(false)),
            },
            Contender {
                name: "the same with a stop",
                scenes: SCENES,
                solve: Box::new(|| peak(true)),
            },
        ],
    );
    for has_stop in [false, true] {
        let work = ours(has_stop).work;
        println!(
            "{} of {} drops instantiated, errors estimated at {}; {} drops besides for the best stresses",
            work.instantiated, work.points, work.estimated, work.probes
        );
    }
}
