//! A mass under a force.

use super::{Parts, Problem, TIME_SCALE, differential, waveform};
use crate::{Piece, Waveform};

/// `x″ + 0.4 x′ + x = sin 2t` from rest.
pub(crate) fn driven_by_sine() -> Problem {
    let force = waveform(vec![Piece { sine: 1.0, omega: 2.0, ..Piece::default() }]);
    let system = body(0.4, 1.0, force);
    let solution = |t: f64| {
        // Stationary part a sin 2t + b cos 2t, with (1 − 4) a − 0.8 b = 1 and 0.8 a − 3 b = 0.
        let (a, b) = (-3.0 / 9.64, -0.8 / 9.64);
        let (zeta, omega) = (0.2_f64, 0.96_f64.sqrt());
        let (c, d) = (-b, (-2.0 * a - zeta * b) / omega);
        let (sin, cos) = (2.0 * t).sin_cos();
        let (s, k) = (omega * t).sin_cos();
        let decay = (-zeta * t).exp();
        let free = decay * (c * k + d * s);
        let free_rate = decay * omega * (d * k - c * s) - zeta * free;
        vec![a * sin + b * cos + free, 2.0 * (a * cos - b * sin) + free_rate]
    };
    Problem {
        name: "oscillator driven by a sine",
        difficulty: "a right-hand side that depends on time",
        system,
        t_end: 15.0 * TIME_SCALE,
        stiff: false,
        solution: Box::new(solution),
    }
}

/// `x″ + x = u(t)` from rest, with a force that rises, rests, jumps and falls.
pub(crate) fn driven_by_table() -> Problem {
    /// Start, value and slope of each piece.
    const TABLE: [(f64, f64, f64); 4] =
        [(0.0, 0.0, 1.0), (1.0, 1.0, 0.0), (2.5, 3.0, -2.0), (4.0, 0.0, 0.0)];
    let piece = |&(start, value, slope): &(f64, f64, f64)| Piece {
        start,
        value,
        slope,
        ..Piece::default()
    };
    let system = body(0.0, 1.0, waveform(TABLE.iter().map(piece).collect()));
    let solution = |t: f64| {
        // Every jump a and change of slope b at τ adds a (1 − cos s) + b (s − sin s), s = t − τ.
        let (mut x, mut v) = (0.0, 0.0);
        let mut before = (0.0, 0.0, 0.0);
        for &(start, value, slope) in TABLE.iter().filter(|row| row.0 <= t) {
            let jump = value - (before.1 + before.2 * (start - before.0));
            let bend = slope - before.2;
            let (sin, cos) = (t - start).sin_cos();
            x += jump * (1.0 - cos) + bend * (t - start - sin);
            v += jump * sin + bend * (1.0 - cos);
            before = (start, value, slope);
        }
        vec![x, v]
    };
    Problem {
        name: "oscillator driven by a table",
        difficulty: "kinks and a jump of the force",
        system,
        t_end: 8.0 * TIME_SCALE,
        stiff: false,
        solution: Box::new(solution),
    }
}

/// A free mass that is struck by a force of 10⁶ for the time 10⁻⁶ in the middle of a long rest.
pub(crate) fn struck_by_pulse() -> Problem {
    /// Start of the pulse, its duration and its height.
    const PULSE: (f64, f64, f64) = (500.0, 1e-6, 1e6);
    let (start, duration, height) = PULSE;
    let pieces = vec![
        Piece::default(),
        Piece { start, value: height, ..Piece::default() },
        Piece { start: start + duration, ..Piece::default() },
    ];
    let system = body(0.0, 0.0, waveform(pieces));
    let solution = move |t: f64| {
        // The end of the pulse is rounded to the resolution of time.
        let length = (start + duration) - start;
        let pushed = (t - start).clamp(0.0, length);
        let after = (t - start - length).max(0.0);
        let v = height * pushed;
        vec![0.5 * v * pushed + v * after, v]
    };
    Problem {
        name: "mass struck by a pulse",
        difficulty: "all that happens, happens in a billionth of the run",
        system,
        t_end: 1000.0 * TIME_SCALE,
        stiff: false,
        solution: Box::new(solution),
    }
}

/// `x″ + damping x′ + stiffness x = force` from rest.
fn body(damping: f64, stiffness: f64, force: Waveform) -> crate::System {
    Parts {
        unknowns: differential(&["position", "velocity"]),
        jacobian: &[(0, 1, 1.0), (1, 0, -stiffness), (1, 1, -damping)],
        input_matrix: &[(1, 0, 1.0)],
        waveforms: vec![force],
        initial: vec![0.0, 0.0],
    }
    .build()
}
