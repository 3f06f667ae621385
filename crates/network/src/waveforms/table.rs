//! Table of values over time.

use dashpot_dae::{Given, Piece, Waveform};

use super::{WaveformKind, before, pieces};
use crate::{choices, parameters, parameters::InvalidParameter};

choices! {
    /// What a table is before its first and after its last point.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Outside {
        /// The value of the nearest point.
        Hold = "hold",
        /// Zero: it jumps to its first value, and from its last.
        Zero = "zero",
        /// Nothing: a run that is longer is refused.
        Error = "error",
    }
}

parameters! {
    /// Straight lines through given points. Two points at one time are a jump.
    ///
    /// | symbol | field     | unit         | range                             |
    /// |--------|-----------|--------------|-----------------------------------|
    /// | `t_i`  | `points`  | s            | in order; two the same are a jump |
    /// | `u_i`  | `points`  | N, m or m/s² | finite                            |
    /// |        | `outside` |              | `hold`, `zero` or `error`         |
    ///
    /// Before its first and after its last point it holds the value there for ever, is zero, or is not to be
    /// used. Where nothing is said it holds, and a run that reaches beyond the points is warned of what that
    /// means: of a force or an acceleration that is not zero there; of a displacement that is not zero before
    /// its first point, so that the run begins with it, or that is still moving at its last one, so that it
    /// stops dead. A displacement that has come to rest may well be held, so that is not told.
    ///
    /// # Limits
    ///
    /// It has a kink at each point, which a motion must not have at a node with mass. Between points nothing is known
    /// but a straight line, so a measured curve needs as many points as its bends ask for; no filter is applied to it.
    ///
    /// # References
    ///
    /// Linear interpolation; there is no law to cite.
    #[derive(Debug, Clone, PartialEq)]
    pub struct Table: "table",
        "straight lines through points [time, value], or from a CSV file; equal times: a jump"
    {
        /// points [time, value] in order of time, for instance [["0 ms", "0 N"], …]
        pub points: Vec<(f64, f64)> = TimeTable;
        /// before the first and after the last point: its value for ever (`hold`), zero, or no run so long (`error`)
        pub outside: Option<Outside> = Choice(Outside::WORDS),
            follows "`hold`, with a warning where that matters";
    }
    sample { points: vec![(0.0, 0.0), (0.5, 2.0), (0.5, 1.0), (1.0, 0.0)], outside: None }
}

impl Table {
    /// The table of these points, of which nothing is said about what holds beyond.
    pub fn of(points: Vec<(f64, f64)>) -> Self {
        Self { points, outside: None }
    }
}

impl WaveformKind for Table {
    fn of_valid(&self) -> Result<Waveform, InvalidParameter> {
        if let Some(point) = self.points.iter().find(|p| !(p.0.is_finite() && p.1.is_finite())) {
            return Err(InvalidParameter::new("points", "finite", format!("{point:?}")));
        }
        let Some((&(first_time, first), &(last_time, last))) =
            self.points.first().zip(self.points.last())
        else {
            return Err(InvalidParameter::new("points", "one point or more", "empty"));
        };
        if let Some(pair) = self.points.windows(2).find(|pair| pair[0].0 > pair[1].0) {
            let found = format!("{} s before {} s", pair[0].0, pair[1].0);
            return Err(InvalidParameter::new("points", "in order of time", found));
        }
        let held = |value: f64| if self.outside == Some(Outside::Zero) { 0.0 } else { value };
        let quiet = Piece { start: before(first_time), value: held(first), ..Piece::default() };
        let mut parts = vec![quiet];
        for pair in self.points.windows(2).filter(|pair| pair[0].0 < pair[1].0) {
            let slope = (pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0);
            parts.push(Piece { start: pair[0].0, value: pair[0].1, slope, ..Piece::default() });
        }
        parts.push(Piece { start: last_time, value: held(last), ..Piece::default() });
        let is_strict = self.outside == Some(Outside::Error);
        let given =
            Given { from: first_time, to: last_time, integrals: 0, is_strict, is_formula: false };
        let waveform = pieces("points", last_time, parts)?;
        let is_told = matches!(self.outside, Some(Outside::Hold | Outside::Zero));
        Ok(if is_told { waveform } else { waveform.given_at(given) })
    }
}
