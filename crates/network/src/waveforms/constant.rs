//! Constant, from a time on.

use dashpot_dae::{Piece, Waveform};

use super::{WaveformKind, pieces};
use crate::{parameters, parameters::InvalidParameter};

parameters! {
    /// A constant that is switched on: `u(t) = u₀` for `t ≥ t₀`, 0 before.
    ///
    /// | symbol | field   | unit         | range                    |
    /// |--------|---------|--------------|--------------------------|
    /// | `u₀`   | `value` | N, m or m/s² | finite                   |
    /// | `t₀`   | `start` | s            | finite, 0 where left out |
    ///
    /// # Limits
    ///
    /// It jumps where it is switched on, which a motion must not do at a node with mass.
    ///
    /// # References
    ///
    /// `harris2002` in `docs/references.bib`, chapter 8: the step.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct Constant: "constant", "u = value from `start` on, 0 before (a step if start > 0)" {
        /// the value [N, m or m/s^2]
        pub value: f64 = Amplitude;
        /// when it is switched on [s]
        pub start: f64 = Quantity(Dimension::TIME), default "0 s";
    }
    sample { value: 1.0, start: 0.25 }
}

impl WaveformKind for Constant {
    fn of_valid(&self) -> Result<Waveform, InvalidParameter> {
        if self.start <= 0.0 {
            return Ok(Waveform::constant(self.value));
        }
        let on = Piece { start: self.start, value: self.value, ..Piece::default() };
        pieces("start", self.start, vec![Piece::default(), on])
    }
}
