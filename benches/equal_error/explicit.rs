//! The explicit methods of the crate `ode_solvers`, with its own defaults.

use ode_solvers::{DVector, Dop853, Dopri5, System, dop_shared::IntegrationError};

use super::by_hand::{ByHand, Job};

/// By how much a run goes beyond its end, so that rounding does not cost the last sample.
const BEYOND: f64 = 1e-9;

/// Equations in the crate's form.
struct Equations<'a>(&'a dyn ByHand);

impl System<f64, DVector<f64>> for Equations<'_> {
    fn system(&self, _time: f64, state: &DVector<f64>, rates: &mut DVector<f64>) {
        self.0.rates(state.as_slice(), rates.as_mut_slice());
    }
}

/// Dormand and Prince's method of order 5 at this many equal steps of time.
pub(crate) fn dopri5(problem: &dyn ByHand, samples: u32) -> Job<'_> {
    Box::new(move |rtol| {
        let (far, every) = times(problem, samples);
        let start = DVector::from_vec(problem.start());
        let mut solver = Dopri5::new(Equations(problem), 0.0, far, every, start, rtol, rtol);
        let ended = solver.integrate().map(drop);
        sampled(problem, samples, ended, solver.y_out())
    })
}

/// Dormand and Prince's method of order 8 at this many equal steps of time.
pub(crate) fn dop853(problem: &dyn ByHand, samples: u32) -> Job<'_> {
    Box::new(move |rtol| {
        let (far, every) = times(problem, samples);
        let start = DVector::from_vec(problem.start());
        let mut solver = Dop853::new(Equations(problem), 0.0, far, every, start, rtol, rtol);
        let ended = solver.integrate().map(drop);
        sampled(problem, samples, ended, solver.y_out())
    })
}

/// The end of a run, and the time between two samples.
fn times(problem: &dyn ByHand, samples: u32) -> (f64, f64) {
    (problem.end() * (1.0 + BEYOND), problem.end() / f64::from(samples))
}

fn sampled(
    problem: &dyn ByHand,
    samples: u32,
    ended: Result<(), IntegrationError>,
    states: &[DVector<f64>],
) -> Result<Vec<f64>, String> {
    ended.map_err(|error| error.to_string())?;
    let found: Vec<f64> =
        states.iter().skip(1).map(|state| problem.observed(&|at| state[at])).collect();
    let samples = samples as usize;
    found.get(..samples).map(<[f64]>::to_vec).ok_or_else(|| "samples are missing".to_owned())
}
