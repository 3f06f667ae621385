//! Several unknowns, stiff or many.

use std::f64::consts::PI;

use super::{Parts, Problem, TIME_SCALE, differential};
use crate::UnknownKind;

/// `y′ = −y`, `z′ = 10⁶ (y − z)`, `y(0) = 1`, `z(0) = 0`.
pub(crate) fn stiff_pair() -> Problem {
    const FAST: f64 = 1e6;
    let system = Parts {
        unknowns: differential(&["slow", "fast"]),
        jacobian: &[(0, 0, -1.0), (1, 0, FAST), (1, 1, -FAST)],
        input_matrix: &[],
        waveforms: Vec::new(),
        initial: vec![1.0, 0.0],
    }
    .build();
    let solution = |t: f64| {
        let slow = (-t).exp();
        vec![slow, FAST / (FAST - 1.0) * (slow - (-FAST * t).exp())]
    };
    Problem {
        name: "stiff pair",
        difficulty: "rates a factor of 10⁶ apart",
        system,
        t_end: 5.0 * TIME_SCALE,
        stiff: true,
        solution: Box::new(solution),
    }
}

/// 40 decays with rates from 0.1 to 10, not coupled.
pub(crate) fn diagonal_chain() -> Problem {
    const COUNT: u32 = 40;
    let rate = |k: u32| 0.1 * 100_f64.powf(f64::from(k) / f64::from(COUNT - 1));
    let entries: Vec<_> = (0..COUNT).map(|k| (at(k), at(k), -rate(k))).collect();
    let system = Parts {
        unknowns: (0..COUNT).map(|k| (format!("decay {k}"), UnknownKind::Differential)).collect(),
        jacobian: &entries,
        input_matrix: &[],
        waveforms: Vec::new(),
        initial: vec![1.0; at(COUNT)],
    }
    .build();
    Problem {
        name: "diagonal chain",
        difficulty: "more unknowns than dense matrices are used for",
        system,
        t_end: 5.0 * TIME_SCALE,
        stiff: false,
        solution: Box::new(move |t| (0..COUNT).map(|k| (-rate(k) * t).exp()).collect()),
    }
}

/// 24 masses on springs between two walls.
pub(crate) fn vibrating_chain() -> Problem {
    chain(24, "vibrating chain", "coupled unknowns in sparse matrices, no damping")
}

/// 4 masses on springs between two walls.
pub(crate) fn short_chain() -> Problem {
    chain(4, "short chain", "as many unknowns as lie on the stack, no damping")
}

/// Masses on springs between two walls, swinging in their third mode.
fn chain(masses: u32, name: &'static str, difficulty: &'static str) -> Problem {
    let mut entries = Vec::new();
    for k in 0..masses {
        let velocity = at(masses + k);
        entries.push((at(k), velocity, 1.0));
        entries.push((velocity, at(k), -2.0));
        if k > 0 {
            entries.push((velocity, at(k - 1), 1.0));
        }
        if k + 1 < masses {
            entries.push((velocity, at(k + 1), 1.0));
        }
    }
    let phase = 3.0 * PI / f64::from(masses + 1);
    let shape = move |k: u32| (phase * f64::from(k + 1)).sin();
    let omega = 2.0 * (0.5 * phase).sin();
    let solution = move |t: f64| {
        let (sin, cos) = (omega * t).sin_cos();
        let positions = (0..masses).map(|k| shape(k) * cos);
        positions.chain((0..masses).map(|k| -omega * shape(k) * sin)).collect()
    };
    let name_of = |k: u32| {
        if k < masses { format!("position {k}") } else { format!("velocity {}", k - masses) }
    };
    let system = Parts {
        unknowns: (0..2 * masses).map(|k| (name_of(k), UnknownKind::Differential)).collect(),
        jacobian: &entries,
        input_matrix: &[],
        waveforms: Vec::new(),
        initial: solution(0.0),
    }
    .build();
    Problem {
        name,
        difficulty,
        system,
        t_end: 20.0 * TIME_SCALE,
        stiff: false,
        solution: Box::new(solution),
    }
}

/// A count as an index.
fn at(k: u32) -> usize {
    k as usize
}
