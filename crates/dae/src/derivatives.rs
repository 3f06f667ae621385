//! The derivatives of a system's unknowns at its start.

use crate::Output;

/// The time derivatives of all unknowns and inputs of a [`System`](crate::System) at `t = 0`, with respect to
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
