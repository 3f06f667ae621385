//! Trapezoidal pulse.

use dashpot_dae::{Piece, Waveform};

use super::{WaveformKind, before, pieces};
use crate::{parameters, parameters::InvalidParameter};

parameters! {
    /// A pulse with a flat top: from 0 at `start` in a straight line to `peak` within `rise`, `peak` for
    /// `hold`, and in a straight line back to 0 within `fall`.
    ///
    /// | symbol | field   | unit         | range                        |
    /// |--------|---------|--------------|------------------------------|
    /// | `u₀`   | `peak`  | N, m or m/s² | finite                       |
    /// |        | `rise`  | s            | ≥ 0                          |
    /// |        | `hold`  | s            | ≥ 0                          |
    /// |        | `fall`  | s            | ≥ 0; the three are not all 0 |
    /// | `t₀`   | `start` | s            | finite, 0 where left out     |
    ///
    /// A rise or fall of zero is a jump: a rectangular pulse has both, a sawtooth one of them and no `hold`.
    ///
    /// # Limits
    ///
    /// It has kinks where its straight lines meet, and jumps where a rise or fall is zero. A motion
    /// must have neither at a node with mass.
    ///
    /// # References
    ///
    /// `iec60068-2-27` in `docs/references.bib`: the trapezoidal pulse, and the saw-tooth with its peak at the end.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct Trapezoid: "trapezoid",
        "linear from 0 to `peak` within `rise`, constant for `hold`, back to 0 within `fall`",
        checked by Self::check
    {
        /// flat top [N, m or m/s^2]
        pub peak: f64 = Amplitude;
        /// rise time [s], zero or positive; zero is a jump
        pub rise: f64 = Quantity(Dimension::TIME), range NonNegative;
        /// time at the top [s], zero or positive
        pub hold: f64 = Quantity(Dimension::TIME), range NonNegative;
        /// fall time [s], zero or positive; zero is a jump
        pub fall: f64 = Quantity(Dimension::TIME), range NonNegative;
        /// when the pulse begins [s]
        pub start: f64 = Quantity(Dimension::TIME), default "0 s";
    }
    sample { peak: 2.0, rise: 0.125, hold: 0.25, fall: 0.375, start: 0.25 }
}

impl Trapezoid {
    /// Whether it has any length.
    fn check(&self) -> Result<(), InvalidParameter> {
        if [self.rise, self.hold, self.fall].iter().all(|length| *length == 0.0) {
            return Err(InvalidParameter::new("hold", "positive where `rise` and `fall` are 0", 0));
        }
        Ok(())
    }
}

impl WaveformKind for Trapezoid {
    fn of_valid(&self) -> Result<Waveform, InvalidParameter> {
        let mut parts = vec![Piece { start: before(self.start), ..Piece::default() }];
        let mut start = self.start;
        // The lengths are those that the rounded times have, so that the lines meet.
        for (length, from, to) in [
            (self.rise, 0.0, self.peak),
            (self.hold, self.peak, self.peak),
            (self.fall, self.peak, 0.0),
        ] {
            if length == 0.0 {
                continue;
            }
            let end = start + length;
            let slope = (to - from) / (end - start);
            parts.push(Piece { start, value: from, slope, ..Piece::default() });
            start = end;
        }
        parts.push(Piece { start, ..Piece::default() });
        let lengths = [("rise", self.rise), ("hold", self.hold), ("fall", self.fall)];
        let shortest =
            lengths.into_iter().filter(|length| length.1 > 0.0).min_by(|a, b| a.1.total_cmp(&b.1));
        let (name, length) = shortest.unwrap_or(("hold", self.hold));
        pieces(name, length, parts)
    }
}
