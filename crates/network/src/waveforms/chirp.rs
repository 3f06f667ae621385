//! Chirp: a sine whose frequency rises or falls.

use std::f64::consts::TAU;

use dashpot_dae::{Piece, Waveform};

use super::{WaveformKind, before, pieces};
use crate::{parameters, parameters::InvalidParameter};

parameters! {
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
    pub struct Chirp: "chirp",
        "sine whose frequency goes linearly from `from` to `to` within `duration`, then stays",
        checked by Self::check
    {
        /// amplitude [N, m or m/s^2]
        pub amplitude: f64 = Amplitude;
        /// frequency at the start [Hz], zero or positive
        pub from: f64 = Quantity(Dimension::FREQUENCY), range NonNegative;
        /// frequency at the end [Hz], zero or positive
        pub to: f64 = Quantity(Dimension::FREQUENCY), range NonNegative;
        /// how long the frequency changes [s], positive
        pub duration: f64 = Quantity(Dimension::TIME), range Positive;
        /// when it begins [s]
        pub start: f64 = Quantity(Dimension::TIME), default "0 s";
    }
    sample { amplitude: 3.0, from: 1.0, to: 4.0, duration: 0.5, start: 0.25 }
}

impl Chirp {
    /// Whether it has any frequency.
    fn check(&self) -> Result<(), InvalidParameter> {
        if self.from == 0.0 && self.to == 0.0 {
            return Err(InvalidParameter::new("to", "positive where `from` is 0", 0));
        }
        Ok(())
    }
}

impl WaveformKind for Chirp {
    fn of_valid(&self) -> Result<Waveform, InvalidParameter> {
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
}
