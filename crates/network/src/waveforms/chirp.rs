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

/// A sine whose frequency changes linearly from `f₀` to `f₁` within `T` and stays at `f₁`:
/// `u(t) = a sin(2π (f₀ s + ½ (f₁ − f₀) s²/T))` with `s = t − t₀` for `0 ≤ s ≤ T`, 0 before. Value and
/// rate go on without a jump where the sweep ends.
///
/// | symbol | field       | unit         | range                    |
/// |--------|-------------|--------------|--------------------------|
/// | `a`    | `amplitude` | N, m or m/s² | finite                   |
/// | `f₀`   | `from`      | Hz           | ≥ 0                      |
/// | `f₁`   | `to`        | Hz           | ≥ 0; not both are 0      |
/// | `T`    | `duration`  | s            | > 0                      |
/// | `t₀`   | `start`     | s            | finite, 0 where left out |
///
/// # Limits
///
/// The exact method cannot follow it; the stepping methods can. As an acceleration of a support it
/// is refused: its displacement has no closed form in pieces of this kind. The frequency rises in
/// equal steps in equal times, while the sweeps of standards double it in equal times. A sweep that
/// is fast against the decay of a resonance passes it before the answer is steady.
///
/// # References
///
/// `iec60068-2-6` in `docs/references.bib` for sweeps as tests.
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
