//! The derivatives of a system's unknowns at its start.

use crate::{Output, SolveError, System, methods::derivatives as recursion};

/// The time derivatives of all unknowns and inputs of a [`System`] at `t = 0`, with respect to
/// dimensionless time; the first index is the order, from 0 on.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Derivatives {
    /// `values[k][i]`: the `k`-th derivative of unknown `i`, dimensionless.
    pub values: Vec<Vec<f64>>,
    /// The same recursion on absolute values: `Σ |terms|` instead of `Σ terms`. A value is lost in
    /// rounding where it is below some `ε` times its magnitude.
    pub magnitudes: Vec<Vec<f64>>,
    /// `inputs[k][j]`: the `k`-th derivative of input `j`, dimensionless.
    pub inputs: Vec<Vec<f64>>,
    /// The magnitudes of the inputs' derivatives.
    pub input_magnitudes: Vec<Vec<f64>>,
}

/// The derivatives of orders 0 to `order` of all unknowns of `system` at `t = 0`, on the pieces of the
/// waveforms that hold from there on.
///
/// The differential entries of `state` are kept; the algebraic ones are a first guess, and those that
/// satisfy the balances take their place. The differential unknowns' derivatives of each order follow
/// from the last order, those of the algebraic unknowns from the differentiated balances.
///
/// For linear systems all orders are exact up to rounding. Terms that are not linear enter with their
/// slopes at the state: then orders up to 2 of the differential unknowns and up to 1 of the algebraic
/// ones are exact, all higher ones lack what the curvature of the laws adds. Where a law has a kink its
/// own slope there counts; where it is infinite, that of a narrow secant.
///
/// # Examples
///
/// ```
/// use dashpot_dae::{derivatives, problems};
///
/// // x″ + 0.2 x′ + x = 0, x(0) = 1, x′(0) = 0.5.
/// let system = problems::underdamped().system;
/// let found = derivatives(&system, &system.initial, 2)?;
/// assert_eq!(found.values[1][0], 0.5);
/// assert!((found.values[2][0] + 1.1).abs() < 1e-15);
/// # Ok::<(), dashpot_dae::SolveError>(())
/// ```
///
/// # Errors
///
/// [`SolveError::NotApplicable`] where the balances do not determine their unknowns,
/// [`SolveError::Inconsistent`] where no values that satisfy them are found, and
/// [`SolveError::NotFinite`] for numbers that are not finite.
///
/// # Panics
///
/// When `state` has not as many entries as there are unknowns.
pub fn derivatives(
    system: &System,
    state: &[f64],
    order: usize,
) -> Result<Derivatives, SolveError> {
    assert_eq!(state.len(), system.len(), "the state must have one entry for each unknown");
    recursion(system, state, order)
}

impl Derivatives {
    /// The `k`-th derivative of an output with respect to dimensionless time, and its magnitude, both
    /// in the output's unit.
    ///
    /// # Panics
    ///
    /// When `k` is beyond the highest order, or `output` is one of another system.
    pub fn output(&self, output: Output<'_>, k: usize) -> (f64, f64) {
        let Output { scale, unknowns, inputs, .. } = output;
        let value = unknowns.at(&self.values[k]) + inputs.at(&self.inputs[k]);
        let magnitude = unknowns.magnitude_at(&self.magnitudes[k])
            + inputs.magnitude_at(&self.input_magnitudes[k]);
        (scale * value, scale.abs() * magnitude)
    }
}

#[cfg(test)]
mod tests;
