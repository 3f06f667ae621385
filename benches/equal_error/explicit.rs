//! The explicit methods of the crate `ode_solvers`, with its own defaults.

use ode_solvers::{DVector, Dop853, Dopri5, SVector, System};

use super::by_hand::{ByHand, Job};

/// By how much a run goes beyond its end, so that rounding does not cost the last sample.
const BEYOND: f64 = 1e-9;

/// Equations in the crate's form.
struct Equations<'a>(&'a dyn ByHand);

macro_rules! states {
    ($($vector:ty),*) => {$(
        impl System<f64, $vector> for Equations<'_> {
            fn system(&self, _time: f64, state: &$vector, rates: &mut $vector) {
                self.0.rates(state.as_slice(), rates.as_mut_slice());
            }
        }
    )*};
}

states!(SVector<f64, 2>, SVector<f64, 6>, SVector<f64, 32>, DVector<f64>);

macro_rules! solve {
    ($solver:ident, $vector:ty, $problem:expr, $samples:expr) => {
        Box::new(move |rtol| {
            let far = $problem.end() * (1.0 + BEYOND);
            let every = $problem.end() / f64::from($samples);
            let start = <$vector>::from_column_slice(&$problem.start());
            let equations = Equations($problem);
            let mut solver = $solver::new(equations, 0.0, far, every, start, rtol, rtol);
            solver.integrate().map_err(|error| error.to_string())?;
            let states = solver.y_out().iter().skip(1);
            let found: Vec<f64> = states.map(|own| $problem.observed(&|at| own[at])).collect();
            let samples = $samples as usize;
            found.get(..samples).map(<[f64]>::to_vec).ok_or("samples are missing".to_owned())
        })
    };
}

macro_rules! method {
    ($(#[$doc:meta])* $name:ident, $solver:ident) => {
        $(#[$doc])*
        ///
        /// States are on the stack where the problem is one of the small ones, as one writes it by hand.
        pub(crate) fn $name(problem: &dyn ByHand, samples: u32) -> Job<'_> {
            match problem.start().len() {
                2 => solve!($solver, SVector<f64, 2>, problem, samples),
                6 => solve!($solver, SVector<f64, 6>, problem, samples),
                32 => solve!($solver, SVector<f64, 32>, problem, samples),
                _ => solve!($solver, DVector<f64>, problem, samples),
            }
        }
    };
}

method! {
    /// Dormand and Prince's method of order 5 at this many equal steps of time.
    dopri5, Dopri5
}
method! {
    /// Dormand and Prince's method of order 8 at this many equal steps of time.
    dop853, Dop853
}
