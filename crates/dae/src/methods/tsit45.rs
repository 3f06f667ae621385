//! An explicit Runge–Kutta method of order 5.

use diffsol::{
    DefaultDenseMatrix, OdeSolverState, RkState, VectorRef, matrix::MatrixRef,
    ode_solver::state::StateCommon,
};

use super::stepping::{Algebra, Polynomial, Problem, Scheme, Stop, Walk};
use crate::System;

/// Degree of the dense output in a step.
const DEGREE: usize = 4;

/// Tsitouras' explicit method of order 5 with an embedded one of order 4. Stiffness forces it to
/// small steps, and it cannot solve algebraic unknowns; it is a check on the implicit methods that
/// shares nothing with them.
///
/// Its dense output in a step is a polynomial of degree 4.
///
/// Tsitouras, Runge–Kutta pairs of order 5(4), Comput. Math. Appl. 62 (2011) 770–775.
#[derive(Debug, Clone, Copy, Default)]
pub struct Tsit45;

impl Scheme for Tsit45 {
    const KIND: &'static str = "tsit45";
    const SUMMARY: &'static str = "explicit, order 5: an independent check where nothing is stiff";
    const HIGHEST: u8 = 5;
    const ORDER: usize = 4;
    // The step is controlled by the error of order 4, while the solution is of order 5.
    const FALL: f64 = 1.0;

    fn suits(system: &System) -> Result<&'static str, String> {
        match system.algebraic() {
            0 => Ok("every unknown has a rate of its own"),
            algebraic => Err(format!(
                "it is explicit, and {algebraic} of the unknowns follow from balances; `bdf` can"
            )),
        }
    }

    fn span<M>(
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
        let solver = problem.tsit45_solver(RkState::new_from_common(state))?;
        walk.steps(solver, Polynomial::Inner(DEGREE), 0)
    }
}
