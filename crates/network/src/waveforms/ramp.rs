//! Ramp.

use dashpot_dae::{Piece, Waveform};

use super::{WaveformKind, before, pieces};
use crate::{parameters, parameters::InvalidParameter};

parameters! {
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
    pub struct Ramp: "ramp", "linear from 0 to `height` within `rise`, then constant" {
        /// final value [N, m or m/s^2]
        pub height: f64 = Amplitude;
        /// rise time [s], positive
        pub rise: f64 = Quantity(Dimension::TIME), range Positive;
        /// when the rise begins [s]
        pub start: f64 = Quantity(Dimension::TIME), default "0 s";
    }
    sample { height: 2.0, rise: 0.5, start: 0.25 }
}

impl WaveformKind for Ramp {
    fn of_valid(&self) -> Result<Waveform, InvalidParameter> {
        let quiet = Piece { start: before(self.start), ..Piece::default() };
        let rising = Piece { start: self.start, slope: self.height / self.rise, ..quiet };
        let after = Piece { start: self.start + self.rise, value: self.height, ..quiet };
        pieces("rise", self.rise, vec![quiet, rising, after])
    }
}
