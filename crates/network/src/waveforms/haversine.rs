//! Haversine pulse.

use std::f64::consts::TAU;

use dashpot_dae::{Piece, Waveform};

use super::{WaveformKind, before, pieces};
use crate::{parameters, parameters::InvalidParameter};

parameters! {
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
    pub struct Haversine: "haversine",
        "u = peak/2 (1 - cos(2 pi s/duration)), one smooth pulse, s from `start`"
    {
        /// largest value [N, m or m/s^2]
        pub peak: f64 = Amplitude;
        /// length of the pulse [s], positive
        pub duration: f64 = Quantity(Dimension::TIME), range Positive;
        /// when the pulse begins [s]
        pub start: f64 = Quantity(Dimension::TIME), default "0 s";
    }
    sample { peak: 2.0, duration: 0.5, start: 0.25 }
}

impl WaveformKind for Haversine {
    fn of_valid(&self) -> Result<Waveform, InvalidParameter> {
        let quiet = Piece { start: before(self.start), ..Piece::default() };
        let (half, omega) = (0.5 * self.peak, TAU / self.duration);
        let wave = Piece { start: self.start, value: half, cosine: -half, omega, ..quiet };
        let after = Piece { start: self.start + self.duration, ..quiet };
        pieces("duration", self.duration, vec![quiet, wave, after])
    }
}
