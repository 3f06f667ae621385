//! A mass on a spring and a dashpot: `x″ + 2ζx′ + x = 0`, `x(0) = 1`, `x′(0) = v`.

use super::{Parts, Problem, TIME_SCALE, differential};

/// A light damping, ζ = 0.1: five oscillations.
pub(crate) fn underdamped() -> Problem {
    oscillator("underdamped oscillator", "several periods: the phase drifts", 0.1, 30.0)
}

/// ζ = 1: a defective matrix.
pub(crate) fn critically_damped() -> Problem {
    let difficulty = "a double pole: no basis of eigenvectors";
    oscillator("critically damped oscillator", difficulty, 1.0, 10.0)
}

/// ζ = 5: two rates a factor of 98 apart.
pub(crate) fn overdamped() -> Problem {
    oscillator("overdamped oscillator", "a fast and a slow decay", 5.0, 20.0)
}

/// A body that moves freely: `x′ = v`, `v′ = 0`.
pub(crate) fn free_motion() -> Problem {
    let system = Parts {
        unknowns: differential(&["position", "velocity"]),
        jacobian: &[(0, 1, 1.0)],
        input_matrix: &[],
        waveforms: Vec::new(),
        initial: vec![1.0, -0.5],
    }
    .build();
    Problem {
        name: "free motion",
        difficulty: "a singular matrix, rows without entries",
        system,
        t_end: 10.0 * TIME_SCALE,
        stiff: false,
        solution: Box::new(|t| vec![1.0 - 0.5 * t, -0.5]),
    }
}

fn oscillator(name: &'static str, difficulty: &'static str, zeta: f64, t_end: f64) -> Problem {
    let velocity = 0.5;
    let system = Parts {
        unknowns: differential(&["position", "velocity"]),
        jacobian: &[(0, 1, 1.0), (1, 0, -1.0), (1, 1, -2.0 * zeta)],
        input_matrix: &[],
        waveforms: Vec::new(),
        initial: vec![1.0, velocity],
    }
    .build();
    let solution = move |t: f64| {
        // x = c + (v + ζ) s with the two fundamental solutions e^(−ζt) (cos, sin/ω).
        let b = velocity + zeta;
        if (zeta - 1.0).abs() < 1e-12 {
            let decay = (-t).exp();
            return vec![(1.0 + b * t) * decay, (b - 1.0 - b * t) * decay];
        }
        if zeta < 1.0 {
            let omega = (1.0 - zeta * zeta).sqrt();
            let decay = (-zeta * t).exp();
            let (sin, cos) = (omega * t).sin_cos();
            let x = decay * (cos + b / omega * sin);
            return vec![x, decay * (b * cos - omega * sin) - zeta * x];
        }
        let root = (zeta * zeta - 1.0).sqrt();
        let (slow, fast) = (-1.0 / (zeta + root), -zeta - root);
        let (p, q) = ((velocity - fast) / (2.0 * root), (slow - velocity) / (2.0 * root));
        let (p, q) = (p * (slow * t).exp(), q * (fast * t).exp());
        vec![p + q, slow * p + fast * q]
    };
    Problem {
        name,
        difficulty,
        system,
        t_end: t_end * TIME_SCALE,
        stiff: false,
        solution: Box::new(solution),
    }
}
