//! Masses on springs of exponential law.

use super::{
    Parts, Problem, TIME_SCALE, differential,
    nonlinear::{Law, term},
};
use crate::{LinearForm, System, UnknownKind, Waveform};

/// A solitary wave that runs along 34 masses on 35 springs `f = e^y − 1` between two walls, far from
/// both: `f_n = β² sech²(κ (n − 16) − β t)` with `β = sinh κ`.
///
/// Toda, Theory of nonlinear lattices (1989), section 2.4. What the walls cut off is below rounding.
pub(crate) fn solitary_wave() -> Problem {
    const MASSES: usize = 34;
    const SPRINGS: usize = MASSES + 1;
    const KAPPA: f64 = 1.2;
    let names = |of: &str, from: usize, count: usize| -> Vec<String> {
        (from..from + count).map(|n| format!("{of} {n}")).collect()
    };
    let labels =
        [names("position", 1, MASSES), names("velocity", 1, MASSES), names("force", 1, SPRINGS)]
            .concat();
    let mut unknowns = differential(&labels.iter().map(String::as_str).collect::<Vec<_>>());
    let (position, force) = (|n: usize| n - 1, |n: usize| 2 * MASSES + n - 1);
    let velocity = |n: usize| MASSES + n - 1;
    let law = Law { value: f64::exp_m1, slope: f64::exp };
    let (mut entries, mut terms) = (Vec::new(), Vec::new());
    for n in 1..=SPRINGS {
        unknowns[force(n)].1 = UnknownKind::Algebraic;
        entries.push((force(n), force(n), -1.0));
        let (mut ends, mut walls) = (Vec::new(), LinearForm::zero());
        if n == 1 {
            walls = LinearForm::term(0, 1.0);
        } else {
            ends.push((position(n - 1), 1.0));
        }
        if n == SPRINGS {
            walls = LinearForm::term(1, -1.0);
        } else {
            ends.push((position(n), -1.0));
            entries.push((position(n), velocity(n), 1.0));
            entries.push((velocity(n), force(n), 1.0));
            entries.push((velocity(n), force(n + 1), -1.0));
        }
        terms.push(term(force(n), law, &ends, walls));
    }
    let beta = KAPPA.sinh();
    let solution = move |t: f64| {
        let phase = |n: usize| KAPPA * (n as f64 - 16.0) - beta * t;
        let position = |n: usize| log_cosh(phase(n)) - log_cosh(phase(n + 1));
        let velocity = |n: usize| beta * (phase(n + 1).tanh() - phase(n).tanh());
        let force = |n: usize| (beta / phase(n).cosh()).powi(2);
        let masses = (1..=MASSES).map(position).chain((1..=MASSES).map(velocity));
        masses.chain((1..=SPRINGS).map(force)).collect()
    };
    let mut initial: Vec<f64> = solution(0.0);
    initial[2 * MASSES..].fill(0.0);
    let parts = Parts {
        unknowns,
        jacobian: &entries,
        input_matrix: &[],
        waveforms: vec![Waveform::constant(KAPPA), Waveform::constant(-KAPPA)],
        initial,
    };
    Problem {
        name: "solitary wave",
        difficulty: "many laws in sparse matrices, no damping",
        system: System { terms, ..parts.build() },
        t_end: 2.0 * TIME_SCALE,
        stiff: false,
        solution: Box::new(solution),
    }
}

/// `ln cosh x` without overflow, but for a constant.
fn log_cosh(x: f64) -> f64 {
    x.abs() + (-2.0 * x.abs()).exp().ln_1p()
}
