//! CVODE of an installed SUNDIALS, with a banded matrix.

use std::env;

use dashpot_cvode::{Banded, Cvode, Slopes};

use super::{by_hand::ByHand, by_hand::Job, problems::Problem};

/// Names the shared library of CVODE.
const PLACE: &str = "DASHPOT_CVODE";

/// The library that the environment names; `None` where it names none.
pub(crate) fn installed() -> Result<Option<Cvode>, String> {
    env::var_os(PLACE).map(|path| Cvode::open(path.as_ref())).transpose()
}

/// What is said where there is none.
pub(crate) fn missing() -> String {
    format!("not measured: {PLACE} names no libsundials_cvode")
}

/// Equations in the form of the interface.
struct Equations<'a> {
    by_hand: &'a dyn ByHand,
    reach: (usize, usize),
}

impl Banded for Equations<'_> {
    fn start(&self) -> Vec<f64> {
        self.by_hand.start()
    }

    fn reach(&self) -> (usize, usize) {
        self.reach
    }

    fn rates(&self, state: &[f64], rates: &mut [f64]) {
        self.by_hand.rates(state, rates);
    }

    fn slopes(&self, state: &[f64], change: &[f64], rates: &mut [f64]) {
        self.by_hand.slopes(state, change, rates);
    }
}

/// Backward differentiation at `times` with the problem's own slopes, if they are banded. Absolute tolerances
/// are those relative ones.
pub(crate) fn job<'a>(cvode: Cvode, problem: &'a Problem, times: &'a [f64]) -> Option<Job<'a>> {
    let (by_hand, reach) = (&*problem.by_hand, problem.band?);
    Some(Box::new(move |rtol| {
        let mut found = Vec::with_capacity(times.len());
        let mut see = |state: &[f64]| found.push(by_hand.observed(&|at| state[at]));
        cvode.solve(&Equations { by_hand, reach }, Slopes::Own, rtol, times, &mut see)?;
        Ok(found)
    }))
}
