//! Half-sine pulse.

use std::f64::consts::PI;

use dashpot_dae::{Piece, Waveform};

use super::{WaveformKind, before, pieces};
use crate::{parameters, parameters::InvalidParameter};

parameters! {
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
    pub struct HalfSine: "half-sine", "one arch of a sine, `peak` high and `duration` long" {
        /// largest value [N, m or m/s^2]
        pub peak: f64 = Amplitude;
        /// length of the pulse [s], positive
        pub duration: f64 = Quantity(Dimension::TIME), range Positive;
        /// when the pulse begins [s]
        pub start: f64 = Quantity(Dimension::TIME), default "0 s";
    }
    sample { peak: 2.0, duration: 0.5, start: 0.25 }
}

impl WaveformKind for HalfSine {
    fn of_valid(&self) -> Result<Waveform, InvalidParameter> {
        let quiet = Piece { start: before(self.start), ..Piece::default() };
        let arch = Piece { start: self.start, sine: self.peak, omega: PI / self.duration, ..quiet };
        let after = Piece { start: self.start + self.duration, ..quiet };
        pieces("duration", self.duration, vec![quiet, arch, after])
    }
}
