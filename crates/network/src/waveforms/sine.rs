//! Sine.

use std::f64::consts::TAU;

use dashpot_dae::{Piece, Waveform};

use super::{WaveformKind, pieces};
use crate::{parameters, parameters::InvalidParameter};

parameters! {
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
    pub struct Sine: "sine", "u = amplitude sin(2 pi frequency t + phase)" {
        /// amplitude [N, m or m/s^2]
        pub amplitude: f64 = Amplitude;
        /// frequency [Hz], positive
        pub frequency: f64 = Quantity(Dimension::FREQUENCY), range Positive;
        /// phase at t = 0 [rad]
        pub phase: f64 = Quantity(Dimension::NUMBER), default "0", range Angle;
    }
    sample { amplitude: 3.0, frequency: 2.0, phase: 0.5 }
}

impl WaveformKind for Sine {
    fn of_valid(&self) -> Result<Waveform, InvalidParameter> {
        let (sin, cos) = self.phase.sin_cos();
        let wave = Piece {
            sine: self.amplitude * cos,
            cosine: self.amplitude * sin,
            omega: TAU * self.frequency,
            ..Piece::default()
        };
        pieces("frequency", self.frequency, vec![wave])
    }
}
