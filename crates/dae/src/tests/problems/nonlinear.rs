//! A mass or a joint under a law that is not linear.

use std::sync::Arc;

use super::{Parts, Problem, SCALE, TIME_SCALE, differential, jacobi::jacobi, waveform};
use crate::{Argument, Characteristic, LinearForm, Piece, System, Term, UnknownKind, Waveform};

/// A law of one quantity.
#[derive(Debug, Clone, Copy)]
pub(super) struct Law {
    /// Value of a dimensionless quantity.
    pub(super) value: fn(f64) -> f64,
    /// Slope of the value.
    pub(super) slope: fn(f64) -> f64,
}

impl Characteristic for Law {
    fn value(&self, [quantity, _]: [f64; 2]) -> f64 {
        (self.value)(quantity / SCALE)
    }

    fn slopes(&self, [quantity, _]: [f64; 2]) -> [f64; 2] {
        [(self.slope)(quantity / SCALE) / SCALE, 0.0]
    }
}

/// The term `law(unknowns·y + inputs·w)` of a row. Its law speaks of quantities in units of 1, so that
/// no scale may be left out.
pub(super) fn term(row: usize, law: Law, unknowns: &[(usize, f64)], inputs: LinearForm) -> Term {
    let unknowns = LinearForm::sum(unknowns.to_vec());
    let argument = Argument { scale: SCALE, unknowns, inputs };
    Term { row, factor: 1.0, law: Arc::new(law), arguments: [argument, Argument::default()] }
}

/// A mass under one force, `v′ = −f` and `0 = linear part − f + law`.
pub(super) fn mass_under(force: &[(usize, usize, f64)], term: Term, initial: [f64; 2]) -> System {
    let mut unknowns = differential(&["position", "velocity", "force"]);
    unknowns[2].1 = UnknownKind::Algebraic;
    let mut jacobian = vec![(0, 1, 1.0), (1, 2, -1.0), (2, 2, -1.0)];
    jacobian.extend(force);
    let parts = Parts {
        unknowns,
        jacobian: &jacobian,
        input_matrix: &[],
        waveforms: Vec::new(),
        initial: vec![initial[0], initial[1], 0.0],
    };
    System { terms: vec![term], ..parts.build() }
}

/// A mass on a spring `f = x + x³`, let go at `x = 1`: `x = cn(√2 t | ¼)`.
pub(crate) fn cubic_spring() -> Problem {
    let law = Law { value: |x| x * x * x, slope: |x| 3.0 * x * x };
    let cubic = term(2, law, &[(0, 1.0)], LinearForm::zero());
    let solution = |t: f64| {
        let omega = 2.0_f64.sqrt();
        let [sn, cn, dn] = jacobi(omega * t, 0.25);
        vec![cn, -omega * sn * dn, cn + cn * cn * cn]
    };
    Problem {
        name: "mass on a cubic spring",
        difficulty: "a tangent that changes, over several periods",
        system: mass_under(&[(2, 0, 1.0)], cubic, [1.0, 0.0]),
        t_end: 10.0 * TIME_SCALE,
        stiff: false,
        solution: Box::new(solution),
    }
}

/// A mass that a dashpot `f = v |v|` slows down: `v = v₀/(1 + v₀ t)`.
pub(crate) fn quadratic_dashpot() -> Problem {
    const BEGIN: f64 = 2.0;
    let law = Law { value: |v| v * v.abs(), slope: |v| 2.0 * v.abs() };
    let drag = term(2, law, &[(1, 1.0)], LinearForm::zero());
    let solution = |t: f64| {
        let v = BEGIN / (1.0 + BEGIN * t);
        vec![(BEGIN * t).ln_1p(), v, v * v]
    };
    Problem {
        name: "mass on a quadratic dashpot",
        difficulty: "damping that dies out",
        system: mass_under(&[], drag, [0.0, BEGIN]),
        t_end: 10.0 * TIME_SCALE,
        stiff: false,
        solution: Box::new(solution),
    }
}

/// A mass that a dashpot `f = v/√(|v| + δ)`, `δ = 1/16`, slows down: nearly a root, linear in the end.
///
/// With `w = √(v + δ)` and `d = √δ` the time is `t = [2 w + d ln((w − d)/(w + d))]` from `w` to its
/// value at the begin, and the path `⅔ w³` in the same bounds.
pub(crate) fn root_dashpot() -> Problem {
    /// The root of δ.
    const D: f64 = 0.25;
    let law = Law {
        value: |v| v / (v.abs() + D * D).sqrt(),
        slope: |v| (0.5 * v.abs() + D * D) / (v.abs() + D * D).powf(1.5),
    };
    let drag = term(2, law, &[(1, 1.0)], LinearForm::zero());
    let solution = |t: f64| {
        let begin = (1.0 + D * D).sqrt();
        // In s = ln(w − d) the time is convex, so that Newton's method only falls from the begin on.
        let time = |s: f64| 2.0 * (D + s.exp()) + D * (s - (2.0 * D + s.exp()).ln());
        let slope = |s: f64| 2.0 * s.exp() + 2.0 * D * D / (2.0 * D + s.exp());
        let from = -(begin + D).ln();
        let mut s = from;
        for _ in 0..100 {
            let step = (time(s) - time(from) + t) / slope(s);
            s -= step;
            if step.abs() <= 1e-16 * s.abs() {
                break;
            }
        }
        let w = D + s.exp();
        let v = s.exp() * (s.exp() + 2.0 * D);
        vec![2.0 / 3.0 * (begin.powi(3) - w.powi(3)), v, v / w]
    };
    Problem {
        name: "mass on a dashpot of power one half",
        difficulty: "a law that is ever steeper down to a small linear core",
        system: mass_under(&[], drag, [0.0, 1.0]),
        t_end: 3.0 * TIME_SCALE,
        stiff: false,
        solution: Box::new(solution),
    }
}

/// A spring `f = z|z|`, a linear spring `f = 2 y` and a dashpot `f = x′` in series at joints without
/// mass, suddenly stretched by 1.5 together: the force stands in its own law,
/// `0 = z|z| − f` with `z = 1.5 − x − f/2`, and `1/z − ln z = t + 1`.
pub(crate) fn springs_in_series() -> Problem {
    let solution = |t: f64| {
        // s = ln z from e^(−s) − s = t + 1, whose left side is convex: from the left Newton's method
        // only rises.
        let mut s = -t;
        for _ in 0..100 {
            let step = ((-s).exp() - s - t - 1.0) / ((-s).exp() + 1.0);
            s += step;
            if step.abs() < 1e-16 {
                break;
            }
        }
        let z = s.exp();
        vec![1.5 - z - 0.5 * z * z, z * z]
    };
    Problem {
        name: "springs and dashpot in series",
        difficulty: "a force that stands in its own law, with a first guess far off",
        system: quadratic_maxwell(0.5, Waveform::constant(1.5)),
        t_end: 8.0 * TIME_SCALE,
        stiff: false,
        solution: Box::new(solution),
    }
}

/// A spring `f = z|z|` and a dashpot `f = x′` in series, pulled by `u = 2 t` until `t = 1`, held, and
/// pulled by 1 more at `t = 2`: `z′ = u′ − z²`.
///
/// It is not in the list of [`all`](super::all) problems: between the ends of its steps
/// [`Esdirk34`](crate::methods::Esdirk34) follows an algebraic unknown that is driven with a lower
/// order than its own, linear or not.
pub(crate) fn pulled_spring() -> Problem {
    let stretch = waveform(vec![
        Piece { slope: 2.0, ..Piece::default() },
        Piece { start: 1.0, value: 2.0, ..Piece::default() },
        Piece { start: 2.0, value: 3.0, ..Piece::default() },
    ]);
    let solution = |t: f64| {
        let root = 2.0_f64.sqrt();
        let pulled = |s: f64| root * (root * s).tanh();
        let held = |z: f64, s: f64| z / (1.0 + z * s);
        let (u, z) = if t < 1.0 {
            (2.0 * t, pulled(t))
        } else if t < 2.0 {
            (2.0, held(pulled(1.0), t - 1.0))
        } else {
            (3.0, held(held(pulled(1.0), 1.0) + 1.0, t - 2.0))
        };
        vec![u - z, z * z]
    };
    Problem {
        name: "pulled quadratic spring",
        difficulty: "a law that is driven, with a kink and a jump",
        system: quadratic_maxwell(0.0, stretch),
        t_end: 4.0 * TIME_SCALE,
        stiff: false,
        solution: Box::new(solution),
    }
}

/// `x′ = f` and `0 = z|z| − f` with `z = u − x − compliance·f`.
fn quadratic_maxwell(compliance: f64, stretch: Waveform) -> System {
    let law = Law { value: |z| z * z.abs(), slope: |z| 2.0 * z.abs() };
    let mut unknowns = differential(&["dashpot", "force"]);
    unknowns[1].1 = UnknownKind::Algebraic;
    let parts = Parts {
        unknowns,
        jacobian: &[(0, 1, 1.0), (1, 1, -1.0)],
        input_matrix: &[],
        waveforms: vec![stretch],
        initial: vec![0.0, 0.0],
    };
    let spring = term(1, law, &[(0, -1.0), (1, -compliance)], LinearForm::term(0, 1.0));
    System { terms: vec![spring], ..parts.build() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Run, Silent, SolveError,
        methods::{Auto, Bdf, Dop853, Esdirk34, Exact, Method, TrBdf2, Tsit45},
        tests::problems::solitary_wave,
    };

    #[test]
    fn a_law_is_driven_through_kinks_and_jumps() {
        let problem = pulled_spring();
        let end = problem.t_end / problem.system.time_scale;
        let times: Vec<f64> = (0..=400).map(|k| end * f64::from(k) / 400.0).collect();
        let error = |method: &dyn Method, rtol: f64, unknown: usize| {
            let run = Run::to(problem.t_end).with_rtol(rtol);
            let trajectory = method.integrate(&problem.system, &run, &mut Silent).unwrap();
            let samples = trajectory.dense.sample(&problem.system, &times);
            let rows = samples.chunks_exact(2).zip(&times);
            rows.map(|(row, t)| (row[unknown] - problem.exact(t * TIME_SCALE)[unknown]).abs())
                .fold(0.0, f64::max)
        };
        // A method of order q has a global error like the power q/(q + 1) of the tolerance; see the
        // problem for the last one.
        let slopes: [(&dyn Method, [f64; 2]); 4] = [
            (&Bdf, [0.7, 0.7]),
            (&TrBdf2, [0.62, 0.62]),
            (&Esdirk34, [0.7, 0.5]),
            (&Dop853, [0.7, 0.7]),
        ];
        for (method, slopes) in slopes {
            for (unknown, least) in slopes.into_iter().enumerate() {
                let [coarse, fine] = [1e-5, 1e-9].map(|rtol| error(method, rtol, unknown));
                let slope = (coarse / fine).log10() / 4.0;
                let what = format!("{} {unknown}: {coarse:e} {fine:e} {slope}", method.name());
                assert!(coarse < 2e-3 && (slope > least || coarse < 1e-12), "{what}");
            }
        }
    }

    #[test]
    fn methods_that_cannot_follow_laws_say_so() {
        let reason = |method: &dyn Method, problem: &Problem| match method
            .applies(&problem.system, &Run::to(problem.t_end))
        {
            Err(SolveError::NotApplicable { reason, .. }) => reason,
            other => panic!("{other:?}"),
        };
        assert_eq!(reason(&Exact, &cubic_spring()), "one of its parts is not linear");
        assert_eq!(reason(&Exact, &solitary_wave()), "35 of its parts are not linear");
        let explicit = "it is explicit, and 1 of the unknowns follow from balances; `bdf` can";
        assert_eq!(reason(&Tsit45, &cubic_spring()), explicit);
        let chosen = Auto.applies(&cubic_spring().system, &Run::to(1.0)).unwrap();
        assert!(chosen.contains("`dop853`") && chosen.contains("not linear"), "{chosen}");
    }
}
