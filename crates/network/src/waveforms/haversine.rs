//! Haversine pulse.

use std::f64::consts::TAU;

use dashpot_dae::{Piece, Waveform};

use super::{WaveformKind, before, pieces};
use crate::{
    elements::number,
    parameters::{Dimension, InvalidParameter, Parameter, ParameterKind, Value, finite, positive},
};

/// One wave of a cosine that stands on zero: `u(t) = ½ u₀ (1 − cos(2π (t − t₀)/T))` for
/// `t₀ ≤ t ≤ t₀ + T`, 0 elsewhere.
///
/// | symbol | field      | unit         | range                    |
/// |--------|------------|--------------|--------------------------|
/// | `u₀`   | `peak`     | N, m or m/s² | finite                   |
/// | `T`    | `duration` | s            | > 0                      |
/// | `t₀`   | `start`    | s            | finite, 0 where left out |
///
/// Unlike a half-sine it begins and ends without a kink. Its mean is `u₀/2`.
///
/// # Limits
///
/// Its second derivative jumps at both ends.
///
/// # References
///
/// `harris2002` in `docs/references.bib`, chapter 8, where it is the versed-sine pulse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Haversine {
    /// The peak \[N, m or m/s²\].
    pub peak: f64,
    /// The duration \[s\], positive.
    pub duration: f64,
    /// When it begins \[s\].
    pub start: f64,
}

impl WaveformKind for Haversine {
    const KIND: &'static str = "haversine";
    const SUMMARY: &'static str =
        "u = peak/2 (1 - cos(2 pi s/duration)), one smooth pulse, s from `start`";
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
        let (half, omega) = (0.5 * self.peak, TAU / self.duration);
        let wave = Piece { start: self.start, value: half, cosine: -half, omega, ..quiet };
        let after = Piece { start: self.start + self.duration, ..quiet };
        pieces("duration", self.duration, vec![quiet, wave, after])
    }

    fn sample() -> Self {
        Self { peak: 2.0, duration: 0.5, start: 0.25 }
    }
}
