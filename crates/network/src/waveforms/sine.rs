//! Sine.

use std::f64::consts::TAU;

use dashpot_dae::{Piece, Waveform};

use super::{WaveformKind, pieces};
use crate::{
    elements::number,
    parameters::{Dimension, InvalidParameter, Parameter, ParameterKind, Value, finite, positive},
};

/// A sine, `u(t) = a sin(2π f t + φ)`, at all times.
///
/// | symbol | field       | unit         | range                    |
/// |--------|-------------|--------------|--------------------------|
/// | `a`    | `amplitude` | N, m or m/s² | finite                   |
/// | `f`    | `frequency` | Hz           | > 0                      |
/// | `φ`    | `phase`     | rad          | finite, 0 where left out |
///
/// # Limits
///
/// It is there at `t = 0` already, without a rise. So what it drives answers to its beginning as
/// well, until that has died away; what follows alone is the steady response.
///
/// # References
///
/// `iec60068-2-6` in `docs/references.bib`: vibration by a sine of fixed frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sine {
    /// The amplitude \[N, m or m/s²\].
    pub amplitude: f64,
    /// The frequency \[Hz\], positive.
    pub frequency: f64,
    /// The phase at `t = 0` \[rad\].
    pub phase: f64,
}

impl WaveformKind for Sine {
    const KIND: &'static str = "sine";
    const SUMMARY: &'static str = "u = amplitude sin(2 pi frequency t + phase)";
    const PARAMETERS: &'static [Parameter] = &[
        Parameter::required("amplitude", ParameterKind::Amplitude, "amplitude [N, m or m/s^2]"),
        Parameter::required(
            "frequency",
            ParameterKind::Quantity(Dimension::FREQUENCY),
            "frequency [Hz], positive",
        ),
        Parameter::optional(
            "phase",
            ParameterKind::Quantity(Dimension::NUMBER),
            "0",
            "phase at t = 0 [rad]",
        ),
    ];

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        let sine = Self {
            amplitude: number(values, 0, "amplitude")?,
            frequency: number(values, 1, "frequency")?,
            phase: number(values, 2, "phase")?,
        };
        positive("frequency", sine.frequency).map(|()| sine)
    }

    fn values(&self) -> Vec<Value> {
        [self.amplitude, self.frequency, self.phase].map(Value::Number).into()
    }

    fn waveform(&self) -> Result<Waveform, InvalidParameter> {
        finite("amplitude", self.amplitude)?;
        positive("frequency", self.frequency)?;
        finite("phase", self.phase)?;
        let (sin, cos) = self.phase.sin_cos();
        let wave = Piece {
            sine: self.amplitude * cos,
            cosine: self.amplitude * sin,
            omega: TAU * self.frequency,
            ..Piece::default()
        };
        pieces("frequency", self.frequency, vec![wave])
    }

    fn sample() -> Self {
        Self { amplitude: 3.0, frequency: 2.0, phase: 0.5 }
    }
}
