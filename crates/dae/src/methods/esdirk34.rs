//! A diagonally implicit Runge–Kutta method of order 3.

use diffsol::{
    DefaultDenseMatrix, OdeSolverState, RkState, VectorRef, matrix::MatrixRef,
    ode_solver::state::StateCommon,
};

use super::stepping::{Algebra, Polynomial, Problem, Scheme, Stop, Walk};

/// Degree of the dense output in a step.
const DEGREE: usize = 3;

/// ESDIRK34, a one-step method of order 3 with four stages: it restarts without loss and damps stiff
/// parts at once, but light oscillations as well: at ζ = 10⁻⁴ a tolerance of 10⁻⁴ loses all of their
/// energy within 1000 periods.
///
/// Its dense output in a step is the cubic through the values and slopes at both ends. That of an
/// algebraic unknown needs the unknown's slope at the start of a span, which the adapter provides.
///
/// Jørgensen, Kristensen and Thomsen, A family of ESDIRK integration methods, arXiv 1803.01613.
#[derive(Debug, Clone, Copy, Default)]
pub struct Esdirk34;

impl Scheme for Esdirk34 {
    const KIND: &'static str = "esdirk34";
    const SUMMARY: &'static str =
        "order 3, one step at a time: for frequent switching with strong damping";
    const HIGHEST: u8 = 3;
    const ORDER: usize = 3;

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
        let solver = problem.esdirk34_solver::<M::Factor>(RkState::new_from_common(state))?;
        walk.steps(solver, Polynomial::Inner(DEGREE), 1)
    }
}
