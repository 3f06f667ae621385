//! Chirp: a sine whose frequency rises or falls.

use std::f64::consts::TAU;

use dashpot_dae::{Piece, Waveform};

use super::{WaveformKind, before, pieces};
use crate::{
    elements::number,
    parameters::{
        Dimension, InvalidParameter, Parameter, ParameterKind, Value, finite, non_negative,
        positive,
    },
};

/// A sine whose frequency changes linearly from `from` to `to` within `duration` and stays at `to`:
/// `u(t) = amplitude · sin(2π (from s + ½ (to − from) s²/duration))` with `s = t − start` for
/// `0 ≤ s ≤ duration`, 0 before. Value and rate go on without a jump where the sweep ends.
///
/// The exact method cannot follow it; the stepping methods can.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Chirp {
    /// The amplitude \[N, m or m/s²\].
    pub amplitude: f64,
    /// The frequency at the start \[Hz\], zero or positive.
    pub from: f64,
    /// The frequency at the end \[Hz\], zero or positive; not both are zero.
    pub to: f64,
    /// How long the frequency changes \[s\], positive.
    pub duration: f64,
    /// When it begins \[s\].
    pub start: f64,
}

impl Chirp {
    fn check(&self) -> Result<(), InvalidParameter> {
        non_negative("from", self.from)?;
        non_negative("to", self.to)?;
        if self.from == 0.0 && self.to == 0.0 {
            return Err(InvalidParameter::new("to", "positive where `from` is 0", 0));
        }
        positive("duration", self.duration)
    }
}

impl WaveformKind for Chirp {
    const KIND: &'static str = "chirp";
    const SUMMARY: &'static str =
        "sine whose frequency goes linearly from `from` to `to` within `duration`, then stays";
    const PARAMETERS: &'static [Parameter] = &[
        Parameter::required("amplitude", ParameterKind::Amplitude, "amplitude [N, m or m/s^2]"),
        Parameter::required(
            "from",
            ParameterKind::Quantity(Dimension::FREQUENCY),
            "frequency at the start [Hz], zero or positive",
        ),
        Parameter::required(
            "to",
            ParameterKind::Quantity(Dimension::FREQUENCY),
            "frequency at the end [Hz], zero or positive",
        ),
        Parameter::required(
            "duration",
            ParameterKind::Quantity(Dimension::TIME),
            "how long the frequency changes [s], positive",
        ),
        Parameter::optional(
            "start",
            ParameterKind::Quantity(Dimension::TIME),
            "0 s",
            "when it begins [s]",
        ),
    ];

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        let chirp = Self {
            amplitude: number(values, 0, "amplitude")?,
            from: number(values, 1, "from")?,
            to: number(values, 2, "to")?,
            duration: number(values, 3, "duration")?,
            start: number(values, 4, "start")?,
        };
        chirp.check().map(|()| chirp)
    }

    fn values(&self) -> Vec<Value> {
        [self.amplitude, self.from, self.to, self.duration, self.start].map(Value::Number).into()
    }

    fn waveform(&self) -> Result<Waveform, InvalidParameter> {
        finite("amplitude", self.amplitude)?;
        finite("start", self.start)?;
        self.check()?;
        let quiet = Piece { start: before(self.start), ..Piece::default() };
        let end = self.start + self.duration;
        let length = end - self.start;
        let (omega, sweep) = (TAU * self.from, TAU * (self.to - self.from) / length);
        let swept = Piece { start: self.start, sine: self.amplitude, omega, sweep, ..quiet };
        let (sin, cos) = ((omega + 0.5 * sweep * length) * length).sin_cos();
        let steady = Piece {
            start: end,
            sine: self.amplitude * cos,
            cosine: self.amplitude * sin,
            omega: TAU * self.to,
            ..quiet
        };
        pieces("duration", self.duration, vec![quiet, swept, steady])
    }

    fn sample() -> Self {
        Self { amplitude: 3.0, from: 1.0, to: 4.0, duration: 0.5, start: 0.25 }
    }
}
