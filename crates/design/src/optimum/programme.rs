//! Smooth programmes with bounds and inequalities: the only file that names the optimiser.

use std::{cell::RefCell, convert::Infallible};

use basin::{
    BoxBounds, ConstraintDescription, ConstraintJacobian, ConstraintSet, ConstraintSolveError,
    Constraints, CostFunction, DenseMatrix, Executor, Gradient, NoLinearConstraints,
    NoNonlinearBlock, NonlinearBlock, NonlinearBlocks, NonlinearInequalityValues,
    SelectedFirstOrderState, Slsqp, State,
};

/// What is to be made least, and what may not be above zero.
pub(super) trait Programme {
    /// The aim, and behind it what may not be above zero; not a number where there are none.
    fn values(&self, unknowns: &[f64]) -> Vec<f64>;

    /// The derivatives of each with respect to the unknowns.
    fn slopes(&self, unknowns: &[f64]) -> Vec<Vec<f64>>;
}

/// Where a search ended.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Found {
    pub(super) unknowns: Vec<f64>,
    /// The aim, and behind it what may not be above zero.
    pub(super) values: Vec<f64>,
}

/// Steps of one search.
const MOST_STEPS: u64 = 100;
/// Change of the aim, of unknowns in parts of their bounds, and excess, at which a search ends.
const ACCURACY: f64 = 1e-12;

/// Sequential least squares between 0 and 1 in each unknown; `None` where the start has no values.
pub(super) fn least(programme: &dyn Programme, start: &[f64]) -> Option<Found> {
    let values = programme.values(start);
    if !values.iter().all(|own| own.is_finite()) {
        return None;
    }
    let (lower, upper) = (vec![0.0; start.len()], vec![1.0; start.len()]);
    let known = RefCell::default();
    let bounded = Bounded { programme, lower, upper, count: values.len() - 1, known };
    let solver = Slsqp::new().with_absolute_accuracy_tolerance(ACCURACY);
    let state = SelectedFirstOrderState::new(start.to_vec());
    let own = Executor::new(bounded, solver, state).max_iter(MOST_STEPS).run().ok()?;
    let unknowns = own.state.param().clone();
    let values = programme.values(&unknowns);
    Some(Found { unknowns, values })
}

/// What was evaluated last: aim and inequalities are asked for one after the other.
#[derive(Default)]
struct Known {
    values: (Vec<f64>, Vec<f64>),
    slopes: (Vec<f64>, Vec<Vec<f64>>),
}

/// The programme as the optimiser wants it.
struct Bounded<'p> {
    programme: &'p dyn Programme,
    lower: Vec<f64>,
    upper: Vec<f64>,
    /// Inequalities.
    count: usize,
    known: RefCell<Known>,
}

impl Bounded<'_> {
    fn values(&self, unknowns: &[f64]) -> Vec<f64> {
        let mut known = self.known.borrow_mut();
        if known.values.0 != unknowns {
            known.values = (unknowns.to_vec(), self.programme.values(unknowns));
        }
        known.values.1.clone()
    }

    fn slopes(&self, unknowns: &[f64]) -> Vec<Vec<f64>> {
        let mut known = self.known.borrow_mut();
        if known.slopes.0 != unknowns {
            known.slopes = (unknowns.to_vec(), self.programme.slopes(unknowns));
        }
        known.slopes.1.clone()
    }
}

impl Constraints for Bounded<'_> {
    type Set = ConstraintSet<
        BoxBounds<Vec<f64>>,
        NoLinearConstraints,
        NonlinearBlocks<NoNonlinearBlock, NonlinearBlock>,
    >;

    fn constraints(&self) -> <Self::Set as ConstraintDescription>::Borrowed<'_> {
        ConstraintSet::new()
            .with_bounds(BoxBounds::new(Some(&self.lower), Some(&self.upper)))
            .with_nonlinear_inequalities(self.count)
    }
}

impl CostFunction for Bounded<'_> {
    type Param = Vec<f64>;
    type Output = f64;
    type Error = Infallible;

    fn cost(&self, unknowns: &Vec<f64>) -> Result<f64, Infallible> {
        Ok(self.values(unknowns)[0])
    }
}

impl Gradient for Bounded<'_> {
    type Gradient = Vec<f64>;

    fn gradient(&self, unknowns: &Vec<f64>) -> Result<Vec<f64>, Infallible> {
        Ok(self.slopes(unknowns)[0].clone())
    }
}

impl NonlinearInequalityValues for Bounded<'_> {
    type Param = Vec<f64>;
    type Values = Vec<f64>;
    type Error = Infallible;

    fn nonlinear_inequalities(
        &self,
        unknowns: &Vec<f64>,
    ) -> Result<Vec<f64>, ConstraintSolveError<Infallible>> {
        Ok(self.values(unknowns)[1..].to_vec())
    }
}

impl ConstraintJacobian for Bounded<'_> {
    type Param = Vec<f64>;
    type Jacobian = DenseMatrix;
    type Error = Infallible;

    fn constraint_jacobian(
        &self,
        unknowns: &Vec<f64>,
    ) -> Result<DenseMatrix, ConstraintSolveError<Infallible>> {
        let slopes = self.slopes(unknowns);
        Ok(DenseMatrix::from_row_slice(self.count, unknowns.len(), &slopes[1..].concat()))
    }
}
