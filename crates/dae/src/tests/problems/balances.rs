//! A Maxwell element, spring and dashpot of strength 1 in series, stretched by `u(t)`: the dashpot's
//! deformation `x′ = f`, and the force from the balance `0 = u − x − f`.

use super::{Parts, Problem, TIME_SCALE, differential, waveform};
use crate::{Piece, UnknownKind, Waveform};

/// A sudden stretch that is held: `f = e^(−t)`.
pub(crate) fn maxwell_relaxation() -> Problem {
    maxwell(
        "Maxwell relaxation",
        "an algebraic unknown of index 1",
        Waveform::constant(1.0),
        vec![0.0, 1.0],
        |t| vec![1.0 - (-t).exp(), (-t).exp()],
    )
}

/// Stretched at t = 0, let go at t = 1, stretched twice as far at t = 1.5.
pub(crate) fn maxwell_under_steps() -> Problem {
    let steps = [(0.0, 1.0), (1.0, -1.0), (1.5, 2.0)];
    let mut value = 0.0;
    let piece = |&(start, step): &(f64, f64)| {
        value += step;
        Piece { start, value, ..Piece::default() }
    };
    maxwell(
        "Maxwell element under steps",
        "an algebraic unknown that jumps",
        waveform(steps.iter().map(piece).collect()),
        vec![0.0, 1.0],
        move |t| {
            let begun = steps.iter().filter(|step| step.0 <= t);
            let (mut stretch, mut force) = (0.0, 0.0);
            for (start, step) in begun {
                stretch += step;
                force += step * (start - t).exp();
            }
            vec![stretch - force, force]
        },
    )
}

fn maxwell(
    name: &'static str,
    difficulty: &'static str,
    stretch: Waveform,
    initial: Vec<f64>,
    solution: impl Fn(f64) -> Vec<f64> + Send + Sync + 'static,
) -> Problem {
    let mut unknowns = differential(&["dashpot", "force"]);
    unknowns[1].1 = UnknownKind::Algebraic;
    let system = Parts {
        unknowns,
        jacobian: &[(0, 1, 1.0), (1, 0, -1.0), (1, 1, -1.0)],
        input_matrix: &[(1, 0, 1.0)],
        waveforms: vec![stretch],
        initial,
    }
    .build();
    Problem {
        name,
        difficulty,
        system,
        t_end: 5.0 * TIME_SCALE,
        stiff: false,
        solution: Box::new(solution),
    }
}
