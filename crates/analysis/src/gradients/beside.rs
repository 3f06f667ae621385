//! A derivative from a run and the solutions beside it.

use super::{Derivative, NoDerivative, neighbours::Neighbour, stencil::Stencil};

/// The largest error of a derivative, relative to the larger of the measure and its change with the number, in parts of
/// the accuracy wanted of the measure; of exact solutions and of others.
const LARGEST_ERROR: [f64; 2] = [1e-2, 10.0];

/// The relative error of a root, twice the true one, up to which a solution to each side is enough.
const SURE: f64 = 2e-8;

/// A run, itself as its neighbours are solved, and these.
pub(super) struct Beside<'a> {
    pub(super) run: &'a Neighbour,
    pub(super) here: &'a Neighbour,
    /// A step below and above the number.
    pub(super) sides: &'a [Neighbour; 2],
    /// Half a step.
    pub(super) near: Option<&'a [Neighbour; 2]>,
    pub(super) number: f64,
    /// The step in parts of the number.
    pub(super) step: f64,
    /// The relative error of solutions by a stepping method; `None` of the exact one.
    pub(super) steps_error: Option<f64>,
}

impl Beside<'_> {
    /// The derivative of a value.
    pub(super) fn derivative(&self, at: usize, accuracy: f64) -> Result<Derivative, NoDerivative> {
        let stencil = self.stencil(at)?;
        let (here, number) = (stencil.values[1], stencil.number);
        let slope = stencil.slope();
        let scale = stencil.scale(slope.value);
        let relative_error = if scale > 0.0 { slope.error * number / scale } else { 0.0 };
        let is_by_steps = self.steps_error.is_some();
        if relative_error <= LARGEST_ERROR[usize::from(is_by_steps)] * accuracy {
            return Ok(Derivative {
                value: slope.value,
                error: slope.error,
                elasticity: (here != 0.0).then(|| slope.value * self.number / here),
                relative_error,
            });
        }
        Err(self.none(match slope.sides {
            Some([below, above]) => NoDerivative::TwoSlopes { below, above },
            None => NoDerivative::Unsettled { relative_error },
        }))
    }

    /// Whether three values may be so near a graze that they tell too little of the slope.
    pub(super) fn is_near_a_graze(&self, at: usize) -> bool {
        self.stencil(at).is_ok_and(|own| own.error_of_root() > SURE)
    }

    /// A value at the number and beside it.
    fn stencil(&self, at: usize) -> Result<Stencil, NoDerivative> {
        let is_exact = self.steps_error.is_none();
        let here = self.here.value(at).map_err(|reason| NoDerivative::NoValue { reason })?;
        let of = |own: &Neighbour| {
            own.value(at).map_err(|reason| self.none(NoDerivative::NoNeighbour { reason }))
        };
        let [below, above] = self.sides.each_ref().map(of);
        let inner = match self.near.map(|own| own.each_ref().map(of)) {
            Some([below, above]) => Some([below?, above?]),
            None => None,
        };
        let noise = self.run.error(at).filter(|_| is_exact).unwrap_or(0.0);
        let (number, sign) = (self.number.abs(), self.number.signum());
        let [one, other] = if sign > 0.0 { [below?, above?] } else { [above?, below?] };
        let inner = inner.map(|[one, other]| if sign > 0.0 { [one, other] } else { [other, one] });
        let (step, common) = (self.step, self.steps_error.unwrap_or(0.0));
        let values = [one, here, other];
        Ok(Stencil { number, step, values, inner, noise, common })
    }

    /// Why there is none: other events, or what else it may be.
    fn none(&self, other: NoDerivative) -> NoDerivative {
        let mut beside = self.sides.iter().chain(self.near.into_iter().flatten());
        let is_other = beside.any(|own| own.is_solved() && !own.passes_the_same(self.here));
        if is_other { NoDerivative::EventsChange } else { other }
    }
}
