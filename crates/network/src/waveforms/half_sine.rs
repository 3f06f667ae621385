//! Half-sine pulse.

use std::f64::consts::PI;

use dashpot_dae::{Piece, Waveform};

use super::{WaveformKind, before, pieces};
use crate::{
    elements::number,
    parameters::{Dimension, InvalidParameter, Parameter, ParameterKind, Value, finite, positive},
};

/// One arch of a sine: `u(t) = u₀ sin(π (t − t₀)/T)` for `t₀ ≤ t ≤ t₀ + T`, 0 elsewhere.
///
/// | symbol | field      | unit         | range                    |
/// |--------|------------|--------------|--------------------------|
/// | `u₀`   | `peak`     | N, m or m/s² | finite                   |
/// | `T`    | `duration` | s            | > 0                      |
/// | `t₀`   | `start`    | s            | finite, 0 where left out |
///
/// # Limits
///
/// It has kinks at both ends, which a motion must not have at a node with mass. What a shock table
/// makes of it differs from it within the tolerances of the standard.
///
/// # References
///
/// `iec60068-2-27` in `docs/references.bib`: the half-sine pulse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfSine {
    /// The peak \[N, m or m/s²\].
    pub peak: f64,
    /// The duration \[s\], positive.
    pub duration: f64,
    /// When it begins \[s\].
    pub start: f64,
}

impl WaveformKind for HalfSine {
    const KIND: &'static str = "half-sine";
    const SUMMARY: &'static str = "one arch of a sine, `peak` high and `duration` long";
    const PARAMETERS: &'static [Parameter] = &[
        Parameter::required("peak", ParameterKind::Amplitude, "largest value [N, m or m/s^2]"),
        Parameter::required(
            "duration",
            ParameterKind::Quantity(Dimension::TIME),
            "length of the pulse [s], positive",
        ),
        Parameter::optional(
            "start",
            ParameterKind::Quantity(Dimension::TIME),
            "0 s",
            "when the pulse begins [s]",
        ),
    ];

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        let pulse = Self {
            peak: number(values, 0, "peak")?,
            duration: number(values, 1, "duration")?,
            start: number(values, 2, "start")?,
        };
        positive("duration", pulse.duration).map(|()| pulse)
    }

    fn values(&self) -> Vec<Value> {
        [self.peak, self.duration, self.start].map(Value::Number).into()
    }

    fn waveform(&self) -> Result<Waveform, InvalidParameter> {
        finite("peak", self.peak)?;
        positive("duration", self.duration)?;
        finite("start", self.start)?;
        let quiet = Piece { start: before(self.start), ..Piece::default() };
        let arch = Piece { start: self.start, sine: self.peak, omega: PI / self.duration, ..quiet };
        let after = Piece { start: self.start + self.duration, ..quiet };
        pieces("duration", self.duration, vec![quiet, arch, after])
    }

    fn sample() -> Self {
        Self { peak: 2.0, duration: 0.5, start: 0.25 }
    }
}
