//! Equations as one writes them by hand, and diffsol's solver on them.

use diffsol::{
    DefaultDenseMatrix, DenseMatrix, DiffsolError, FaerSparseLU, FaerSparseMat, LinearSolver,
    Matrix, NalgebraLU, NalgebraMat, OdeBuilder, OdeSolverMethod, Vector, VectorRef,
    matrix::MatrixRef,
};

/// States up to which dense matrices are used.
const DENSE_UP_TO: usize = 40;

/// An initial-value problem in dimensionless numbers of about one.
pub(crate) trait ByHand {
    /// The states at time 0.
    fn start(&self) -> Vec<f64>;
    /// The time at which it ends.
    fn end(&self) -> f64;
    /// The rates of the states.
    fn rates(&self, state: &[f64], rates: &mut [f64]);
    /// The change of the rates with a change of the states.
    fn slopes(&self, state: &[f64], change: &[f64], rates: &mut [f64]);
    /// What is compared, in SI units, from the states by their numbers.
    fn observed(&self, state: &dyn Fn(usize) -> f64) -> f64;
}

/// A way to solve a problem at a tolerance, which yields what is compared at all times.
pub(crate) type Job<'a> = Box<dyn FnMut(f64) -> Result<Vec<f64>, String> + 'a>;

/// Backward differentiation by diffsol at `times`, absolute tolerances being those relative ones.
///
/// With sparse matrices their pattern is found beforehand.
pub(crate) fn bdf<'a, P: ByHand + ?Sized>(
    problem: &'a P,
    times: &'a [f64],
) -> Result<Job<'a>, String> {
    if problem.start().len() <= DENSE_UP_TO {
        return Ok(Box::new(move |rtol| {
            prepared::<_, NalgebraMat<f64>, NalgebraLU<f64>>(problem, times)
                .and_then(|mut job| job(rtol))
                .map_err(|error| error.to_string())
        }));
    }
    let job = prepared::<_, FaerSparseMat<f64>, FaerSparseLU<f64>>(problem, times);
    let mut job = job.map_err(|error| error.to_string())?;
    Ok(Box::new(move |rtol| job(rtol).map_err(|error| error.to_string())))
}

/// A job whose errors are still diffsol's.
type Prepared<'a> = Box<dyn FnMut(f64) -> Result<Vec<f64>, DiffsolError> + 'a>;

fn prepared<'a, P, M, S>(problem: &'a P, times: &'a [f64]) -> Result<Prepared<'a>, DiffsolError>
where
    P: ByHand + ?Sized,
    M: Matrix<T = f64> + 'a,
    M::V: DefaultDenseMatrix<T = f64, C = M::C>,
    S: LinearSolver<M>,
    for<'v> &'v M::V: VectorRef<M::V>,
    for<'m> &'m M: MatrixRef<M>,
{
    let states = problem.start().len();
    let mut built = OdeBuilder::<M>::new()
        .rhs_implicit(
            move |state: &[f64], _p: &[f64], _t, rates: &mut [f64]| problem.rates(state, rates),
            move |state: &[f64], _p: &[f64], _t, change: &[f64], rates: &mut [f64]| {
                problem.slopes(state, change, rates);
            },
        )
        .init(
            move |_p: &[f64], _t, state: &mut [f64]| state.copy_from_slice(&problem.start()),
            states,
        )
        .build()?;
    Ok(Box::new(move |rtol| {
        built.rtol = rtol;
        built.atol = M::V::from_element(states, rtol, M::C::default());
        let mut solver = built.bdf::<S>()?;
        let (found, _) = solver.solve_dense(times)?;
        let observed = |at| problem.observed(&|state| found.get_index(state, at));
        Ok((0..times.len()).map(observed).collect())
    }))
}
