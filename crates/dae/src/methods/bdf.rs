//! Variable-order backward differentiation.

use diffsol::{
    BdfState, DefaultDenseMatrix, OdeSolverState, VectorRef, matrix::MatrixRef,
    ode_solver::state::StateCommon,
};

use super::stepping::{Algebra, Polynomial, Problem, Scheme, Stop, Walk};

/// Backward differentiation of order 1 to 5 with variable steps, on the system as it stands:
/// algebraic unknowns need no elimination, stiffness no small steps.
///
/// Its dense output in a step is the polynomial of the step's order through the ends of the last
/// steps, so that nothing but these ends is kept.
///
/// On lightly damped oscillations it loses energy: of ζ = 10⁻⁴ over 1000 periods 5 % at a tolerance
/// of 10⁻⁶, and nearly all at 10⁻⁴.
///
/// Shampine and Reichelt, The MATLAB ODE suite, SIAM J. Sci. Comput. 18 (1997) 1–22.
#[derive(Debug, Clone, Copy, Default)]
pub struct Bdf;

impl Scheme for Bdf {
    const KIND: &'static str = "bdf";
    const SUMMARY: &'static str =
        "backward differentiation of variable order: for every system, large and stiff ones too";
    const HIGHEST: u8 = 5;
    const ORDER: usize = 1;
    // Where its steps are few it works at order 4 or 5, which give 4/5 and 5/6.
    const FALL: f64 = 0.85;

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
        let solver = problem.bdf_solver::<M::Factor>(BdfState::new_from_common(state))?;
        walk.steps(solver, Polynomial::History, 0)
    }
}
