//! Constant, from a time on.

use dashpot_dae::{Piece, Waveform};

use super::{WaveformKind, pieces};
use crate::{
    elements::number,
    parameters::{Dimension, InvalidParameter, Parameter, ParameterKind, Value, finite},
};

/// A constant that is switched on: `u(t) = u₀` for `t ≥ t₀`, 0 before.
///
/// | symbol | field   | unit         | range                    |
/// |--------|---------|--------------|--------------------------|
/// | `u₀`   | `value` | N, m or m/s² | finite                   |
/// | `t₀`   | `start` | s            | finite, 0 where left out |
///
/// # Limits
///
/// It jumps where it is switched on, which a motion must not do at a node with mass.
///
/// # References
///
/// `harris2002` in `docs/references.bib`, chapter 8: the step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constant {
    /// The value \[N, m or m/s²\].
    pub value: f64,
    /// When it begins \[s\].
    pub start: f64,
}

impl WaveformKind for Constant {
    const KIND: &'static str = "constant";
    const SUMMARY: &'static str = "u = value from `start` on, 0 before (a step if start > 0)";
    const PARAMETERS: &'static [Parameter] = &[
        Parameter::required("value", ParameterKind::Amplitude, "the value [N, m or m/s^2]"),
        Parameter::optional(
            "start",
            ParameterKind::Quantity(Dimension::TIME),
            "0 s",
            "when it is switched on [s]",
        ),
    ];

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        Ok(Self { value: number(values, 0, "value")?, start: number(values, 1, "start")? })
    }

    fn values(&self) -> Vec<Value> {
        vec![Value::Number(self.value), Value::Number(self.start)]
    }

    fn waveform(&self) -> Result<Waveform, InvalidParameter> {
        finite("value", self.value)?;
        finite("start", self.start)?;
        if self.start <= 0.0 {
            return Ok(Waveform::constant(self.value));
        }
        let on = Piece { start: self.start, value: self.value, ..Piece::default() };
        pieces("start", self.start, vec![Piece::default(), on])
    }

    fn sample() -> Self {
        Self { value: 1.0, start: 0.25 }
    }
}
