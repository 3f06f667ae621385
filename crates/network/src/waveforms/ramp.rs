//! Ramp.

use dashpot_dae::{Piece, Waveform};

use super::{WaveformKind, before, pieces};
use crate::{
    elements::number,
    parameters::{Dimension, InvalidParameter, Parameter, ParameterKind, Value, finite, positive},
};

/// A straight rise: 0 until `t₀`, then `u(t) = u₀ (t − t₀)/T` until `t₀ + T`, then `u₀`.
///
/// | symbol | field    | unit         | range                    |
/// |--------|----------|--------------|--------------------------|
/// | `u₀`   | `height` | N, m or m/s² | finite                   |
/// | `T`    | `rise`   | s            | > 0                      |
/// | `t₀`   | `start`  | s            | finite, 0 where left out |
///
/// # Limits
///
/// It has kinks at both ends of the rise, which a motion must not have at a node with mass.
///
/// # References
///
/// `harris2002` in `docs/references.bib`, chapter 8: the step with a linear rise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ramp {
    /// The final value \[N, m or m/s²\].
    pub height: f64,
    /// The rise time \[s\], positive.
    pub rise: f64,
    /// When it begins \[s\].
    pub start: f64,
}

impl WaveformKind for Ramp {
    const KIND: &'static str = "ramp";
    const SUMMARY: &'static str = "linear from 0 to `height` within `rise`, then constant";
    const PARAMETERS: &'static [Parameter] = &[
        Parameter::required("height", ParameterKind::Amplitude, "final value [N, m or m/s^2]"),
        Parameter::required(
            "rise",
            ParameterKind::Quantity(Dimension::TIME),
            "rise time [s], positive",
        ),
        Parameter::optional(
            "start",
            ParameterKind::Quantity(Dimension::TIME),
            "0 s",
            "when the rise begins [s]",
        ),
    ];

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        let ramp = Self {
            height: number(values, 0, "height")?,
            rise: number(values, 1, "rise")?,
            start: number(values, 2, "start")?,
        };
        positive("rise", ramp.rise).map(|()| ramp)
    }

    fn values(&self) -> Vec<Value> {
        [self.height, self.rise, self.start].map(Value::Number).into()
    }

    fn waveform(&self) -> Result<Waveform, InvalidParameter> {
        finite("height", self.height)?;
        positive("rise", self.rise)?;
        finite("start", self.start)?;
        let quiet = Piece { start: before(self.start), ..Piece::default() };
        let rising = Piece { start: self.start, slope: self.height / self.rise, ..quiet };
        let after = Piece { start: self.start + self.rise, value: self.height, ..quiet };
        pieces("rise", self.rise, vec![quiet, rising, after])
    }

    fn sample() -> Self {
        Self { height: 2.0, rise: 0.5, start: 0.25 }
    }
}
