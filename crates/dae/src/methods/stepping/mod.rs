//! The step-by-step methods: one adapter to the integrators of `diffsol`, shared by all of them.
//!
//! What each smooth span of a run needs is prepared here: consistent values and slopes, the first step, limits relative
//! to the span. Between two breakpoints of the driving functions an integrator runs freely; each of its steps is kept
//! as a polynomial. No type of `diffsol` leaves this module and the methods' own files.
//!
//! # Error control
//!
//! The integrators keep the root mean square of `error / (rtol · |y| + rtol · n)` over all unknowns
//! below one, with their [sizes](crate::Run::tolerance_scaling) n, mostly 1. Up to 30 unknowns `rtol` is the run's. Beyond, the mean would dilute what
//! happens in a small part of a large system, so that `rtol` shrinks with `√(30/n)`: one unknown
//! alone then has as much to say as in a system of 30.
//!
//! Terms that are not linear are under the same control: their values are unknowns of their own. A
//! kink of a law is not located; where it matters to the tolerance, the steps across it are rejected
//! until they are small enough. Where all laws that determine a place are flat at once, no step is.

mod algebra;
mod balance;
mod banded;
mod elimination;
mod equations;
mod explicit;
mod factor;
mod failure;
mod newton;
mod ordering;
mod recursion;
mod spans;
mod stack;
mod start;
mod terms;
mod walk;

pub(super) use explicit::is_stiff;
pub use recursion::derivatives;

use std::fmt::Debug;

use diffsol::{
    BdfState, DefaultDenseMatrix, DiffsolError, OdeSolverState, RkState, Tableau, VectorRef,
    matrix::MatrixRef, ode_solver::state::StateCommon,
};

use self::{
    algebra::{Algebra, Slice},
    spans::integrate,
    start::Problem,
    walk::{Polynomial, Walk},
};
use crate::{Method, MethodKind, Observer, Run, SolveError, System, Trajectory};

/// Most unknowns of a system that is solved by an explicit method.
pub(super) const MOST_EXPLICIT: usize = 100;
/// The same where it is linear and has no balances: a slope costs no more than the entries of its matrix.
pub(super) const MOST_LINEAR: usize = 500;

/// What tells one step-by-step method from another; all else of [`Method`] is the same for all.
pub(super) trait Scheme: Debug + Default + Send + Sync + 'static {
    /// Name of the method on the command line.
    const KIND: &'static str;
    /// What it is good for, in one line.
    const SUMMARY: &'static str;
    const INTEGRATOR: Integrator;
    /// Its highest order.
    const HIGHEST: u8;
    /// Its order at the start, from which the first step is estimated.
    const ORDER: usize;
    /// See [`Method::fall`].
    const FALL: f64 = super::FALL;

    /// Why it is a fit for `system`, or why it cannot solve it.
    fn suits(_system: &System) -> Result<&'static str, String> {
        Ok("it solves every system")
    }
}

/// What takes the steps: integrators of `diffsol`, and one of ours.
#[derive(Debug, Clone, Copy)]
pub(super) enum Integrator {
    /// Backward differentiation of variable order.
    Bdf,
    /// A diagonally implicit Runge–Kutta method of these coefficients, with a dense output of this
    /// degree. Its first stage is explicit: the dense output takes its slope for that of the start.
    Implicit(fn() -> Tableau<f64>, usize),
    /// An explicit Runge–Kutta method, as above.
    Explicit(fn() -> Tableau<f64>, usize),
    /// Ours: an explicit Runge–Kutta method of order 8 that solves the balances at every stage.
    Dop853,
}

impl Integrator {
    /// The order of its first step, where that is not for the method to say: backward differentiation begins
    /// with 1, also where it goes on for a method of a higher order.
    fn order(self) -> Option<usize> {
        matches!(self, Self::Bdf).then_some(1)
    }

    /// Integrates one span of `problem` from `state`, handing every step to `walk`.
    ///
    /// The dense output in a step of backward differentiation is the polynomial through the ends of the last
    /// steps, so that nothing but these is kept; that of the others has a degree.
    fn span<M>(
        self,
        problem: &Problem<'_, M>,
        state: StateCommon<M::V>,
        walk: &mut Walk<'_>,
    ) -> Result<(), Stop>
    where
        M: Algebra,
        M::V: DefaultDenseMatrix<T = f64, C = M::C>,
        for<'v> &'v M::V: VectorRef<M::V>,
        for<'m> &'m M: MatrixRef<M>,
    {
        match self {
            Self::Bdf => {
                let begin = BdfState::new_from_common(state);
                walk.steps(problem.bdf_solver::<M::Factor>(begin)?, Polynomial::History, 0)
            }
            Self::Implicit(tableau, degree) => {
                let begin: RkState<M::V> = RkState::new_from_common(state);
                let solver = problem.sdirk_solver::<M::Factor, _>(begin, tableau())?;
                walk.steps(solver, Polynomial::Inner(degree), 1)
            }
            Self::Explicit(tableau, degree) => {
                let begin: RkState<M::V> = RkState::new_from_common(state);
                let solver = problem.explicit_rk_solver(begin, tableau())?;
                walk.steps(solver, Polynomial::Inner(degree), 0)
            }
            Self::Dop853 => {
                let tolerance = (problem.rtol, problem.atol.slice());
                explicit::span(walk, state.y.slice(), state.h, tolerance)
            }
        }
    }
}

impl<S: Scheme> Method for S {
    fn name(&self) -> &'static str {
        S::KIND
    }

    fn summary(&self) -> &'static str {
        S::SUMMARY
    }

    fn fall(&self) -> f64 {
        S::FALL
    }

    fn applies(&self, system: &System, _run: &Run) -> Result<String, SolveError> {
        match S::suits(system) {
            Ok(why) => Ok(why.to_owned()),
            Err(reason) => Err(SolveError::NotApplicable { method: S::KIND, reason }),
        }
    }

    fn integrate(
        &self,
        system: &System,
        run: &Run,
        observer: &mut dyn Observer,
    ) -> Result<Trajectory, SolveError> {
        self.applies(system, run)?;
        integrate::<S>(system, run, observer)
    }
}

impl<S: Scheme> MethodKind for S {
    const KIND: &'static str = S::KIND;
    const ORDER: Option<u8> = Some(S::HIGHEST);
}

/// Why a span ended early.
#[derive(Debug)]
pub(super) enum Stop {
    /// A guard stopped the run.
    Guard,
    /// The integrator failed, before it could be asked where.
    Integrator(DiffsolError),
    /// The integrator takes no further step from this time in the span, where the unknowns are the walk's.
    Stuck {
        /// The time, dimensionless and from the start of the span.
        at: f64,
        /// What it says.
        error: SolveError,
    },
    /// The run failed.
    Failed(SolveError),
}

impl From<DiffsolError> for Stop {
    fn from(error: DiffsolError) -> Self {
        Self::Integrator(error)
    }
}

impl From<SolveError> for Stop {
    fn from(error: SolveError) -> Self {
        Self::Failed(error)
    }
}
