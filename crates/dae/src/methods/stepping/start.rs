//! The start of a span: problem, state and first step.

use diffsol::{
    Context as _, DiffsolError, OdeSolverOptions, OdeSolverProblem, StateRefMut, Vector,
    ode_solver::{problem::InitialConditionSolverOptions, state::StateCommon},
};

use super::{
    algebra::{Algebra, DENSE_UP_TO, Slice},
    balance::{Balance, Imbalance},
    equations::Equations,
    newton::consistent,
};
use crate::{Run, System, UnknownKind};

/// The problem that an integrator solves.
pub(in crate::methods) type Problem<'s, M> = OdeSolverProblem<Equations<'s, M>>;

/// Newton failures and rejected steps in a row after which an integrator gives up. A span may be
/// long, and a first step far too large: the step size is what ends hopeless runs.
const PATIENCE: usize = 10_000;

/// Smallest step in parts of the span. Time is counted from the span's start, so that first steps far below the
/// resolution of absolute time are meaningful; later, a step that the time in the span cannot resolve ends the run.
const SMALLEST_STEP: f64 = 1e-30;
/// The same in parts of the shortest time in the equations, where that is shorter still.
const SMALLEST_SHARE: f64 = 1e-8;
/// Shortest step of all, well within the range of full precision.
const SHORTEST: f64 = 1e-300;

/// Largest first step in parts of the time in which a driving function goes and comes back: a longer one
/// may see nothing of a pulse that is zero where it begins and ends.
const OF_SWING: f64 = 1.0 / 32.0;
/// The tolerance down to which it is that.
const COARSE: f64 = 1e-4;

/// The first step that is guessed where nothing moves yet, and the tolerance for which it is taken as it is.
const GUESS: (f64, f64) = (1e-4, 1e-12);

/// Part of the tolerance below which the estimate of the first step takes unknowns and slopes as none.
const LEAST: f64 = 1e-5;

/// Tightest tolerance that the Newton iterations can meet.
const TIGHTEST: f64 = 1e-14;

/// The problem of a whole run; each span enters it anew.
pub(super) fn problem<'s, M: Algebra>(
    system: &'s System,
    run: &Run,
) -> Result<Problem<'s, M>, DiffsolError> {
    let rtol = tolerance(run.rtol, system.len());
    let context = M::C::default();
    let mut atol = vec![rtol; system.len()];
    atol.iter_mut().zip(&run.tolerance_scaling).for_each(|(atol, size)| *atol *= size);
    let atol = context.vector_from_vec(atol);
    Ok(OdeSolverProblem {
        eqn: Equations::new(system)?,
        rtol,
        atol,
        t0: 0.0,
        h0: 1.0,
        integrate_out: false,
        sens_rtol: None,
        sens_atol: None,
        out_rtol: None,
        out_atol: None,
        param_rtol: None,
        param_atol: None,
        ic_options: InitialConditionSolverOptions::default(),
        ode_options: OdeSolverOptions {
            max_nonlinear_solver_failures: PATIENCE,
            max_error_test_failures: PATIENCE,
            ..OdeSolverOptions::default()
        },
    })
}

/// The integrator's tolerance in a system of `size` unknowns, see the [module](super).
fn tolerance(rtol: f64, size: usize) -> f64 {
    if size <= DENSE_UP_TO {
        return rtol;
    }
    let share = DENSE_UP_TO as f64 / size as f64;
    (rtol * share.sqrt()).max(TIGHTEST.min(rtol))
}

/// Enters a span of the given start and length and returns the consistent state there; `state` receives its values.
pub(super) fn enter<M: Algebra>(
    problem: &mut Problem<'_, M>,
    mut balance: Option<&mut Balance<M>>,
    (start, length): (f64, f64),
    order: usize,
    state: &mut [f64],
) -> Result<StateCommon<M::V>, Imbalance> {
    let smallest = smallest_step(problem.eqn.fastest(), length);
    problem.ode_options.min_timestep = smallest;
    problem.eqn.enter(start, state);
    let mut slopes = vec![0.0; state.len()];
    if let Some(balance) = &mut balance {
        consistent(balance, &problem.eqn, state)?;
        problem.eqn.enter(start, state);
    }
    problem.eqn.evaluate(0.0, state, &mut slopes);
    let context = M::C::default();
    // The estimate of the first step must not see slopes of algebraic unknowns, as the residuals
    // that it compares them with are none.
    for (slope, unknown) in slopes.iter_mut().zip(&problem.eqn.system().unknowns) {
        if unknown.kind == UnknownKind::Algebraic {
            *slope = 0.0;
        }
    }
    let empty = || M::V::zeros(0, context.clone());
    let mut common = StateCommon {
        y: context.vector_from_vec(state.to_vec()),
        dy: context.vector_from_vec(slopes.clone()),
        g: empty(),
        dg: empty(),
        s: empty(),
        ds: empty(),
        sg: empty(),
        dsg: empty(),
        t: 0.0,
        h: problem.h0,
    };
    let StateCommon { y, dy, g, dg, s, ds, sg, dsg, t, h } = &mut common;
    let mut view = StateRefMut { y, dy, g, dg, s, ds, sg, dsg, t, h };
    view.set_step_size(problem.h0, &problem.atol, problem.rtol, &problem.eqn, order);
    // What is small beside its slope limits the estimate by the time in which it would double, at whatever tolerance.
    let size = |own: &M::V| own.squared_norm(view.y, &problem.atol, problem.rtol).sqrt();
    let (own, slope) = (size(view.y), size(view.dy));
    if own.min(slope) >= LEAST {
        *view.h = view.h.min(own / slope * share(problem.rtol, order));
    }
    if let Some(balance) = balance {
        balance.slopes(1, &problem.eqn, state, &mut slopes)?;
        common.dy.slice_mut().copy_from_slice(&slopes);
    }
    let (guess, tolerance) = GUESS;
    if common.h >= 0.99 * guess && is_at_rest(state, &problem.atol) {
        common.h = guess * (problem.rtol / tolerance).powf(0.25);
    }
    let swing = problem.eqn.system().shortest_swing((start, start + length));
    let longest =
        swing.map_or(length, |swing| length.min(OF_SWING * swing * share(problem.rtol, order)));
    // Extreme slopes make the estimate zero, or no number.
    common.h = common.h.min(longest).max(smallest);
    Ok(common)
}

/// By what a first step of a method of this order shrinks with the tolerance where something else than the
/// tolerance limits it. Its error is that of its order and stays in the solution: where no smaller step is asked
/// for, it would be the same at all tolerances.
fn share(rtol: f64, order: usize) -> f64 {
    let power = u32::try_from(order + 1).map_or(1.0, |own| f64::from(own).recip());
    (rtol / COARSE).powf(power).min(1.0)
}

/// The smallest step in a span of this length where the largest coefficient of the equations is
/// `fastest`: what is stiffer than any span is long begins with steps of its own.
fn smallest_step(fastest: f64, length: f64) -> f64 {
    let usual = SMALLEST_STEP * length;
    let own = SMALLEST_SHARE / fastest;
    if own < usual { own.max(SHORTEST).min(usual) } else { usual }
}

/// Whether no unknown is far enough from zero for the first step to be estimated from it. It would be one
/// and the same guess for all tolerances then; and where nothing ever grows beyond the tolerance, so would
/// be all steps, and the differences of solutions, which error bars are taken from, would be none.
fn is_at_rest<V: Slice>(state: &[f64], atol: &V) -> bool {
    state.iter().zip(atol.slice()).all(|(value, atol)| value.abs() < LEAST * atol)
}

#[cfg(test)]
mod tests {
    use crate::{
        Method, Run, Silent, Waveform,
        methods::{Bdf, Esdirk34, TrBdf2},
        tests::problems,
    };

    #[test]
    fn first_steps_of_what_is_small_beside_its_slope_shrink_with_the_tolerance() {
        let mut system = problems::driven_by_sine().system;
        system.waveforms = vec![Waveform::constant(1.0)];
        system.initial.iter_mut().for_each(|own| *own = 1e-5);
        let run = Run::to(system.time_scale);
        let first = |method: &dyn Method, rtol: f64| {
            let run = run.clone().with_rtol(rtol);
            let trajectory = method.integrate(&system, &run, &mut Silent).unwrap();
            trajectory.signal(&system, 0).panels[0].length()
        };
        for (method, order) in [(&Bdf as &dyn Method, 1.0), (&TrBdf2, 2.0), (&Esdirk34, 3.0)] {
            let [coarse, fine] = [1e-4, 1e-8].map(|rtol| first(method, rtol));
            let expected = 1e-4_f64.powf(1.0 / (order + 1.0));
            assert!(fine < 1.5 * expected * coarse, "{}: {coarse:e} {fine:e}", method.name());
        }
    }

    #[test]
    fn steps_of_what_never_grows_beyond_the_tolerance_follow_the_tolerance_all_the_same() {
        // A force of 10⁻¹² of what the scales are made for.
        let mut system = problems::driven_by_sine().system;
        system.waveforms = vec![Waveform::constant(1e-12)];
        let end = 3.0 * system.time_scale;
        let place = |rtol: f64| {
            let run = Run::to(end).with_rtol(rtol);
            let trajectory = Bdf.integrate(&system, &run, &mut Silent).unwrap();
            trajectory.dense.sample(&system, &[3.0])[0]
        };
        let places = [1e-4, 1e-5, 1e-6].map(place);
        assert!(places.windows(2).all(|pair| (pair[0] / pair[1] - 1.0).abs() > 1e-6), "{places:?}");
    }
}
