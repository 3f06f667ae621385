//! Table of values over time.

use dashpot_dae::{Given, Piece, Waveform};

use super::{WaveformKind, before, pieces};
use crate::parameters::{InvalidParameter, Parameter, ParameterKind, Value};

/// What a table is before its first and after its last point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outside {
    /// The value of the nearest point.
    Hold,
    /// Zero: it jumps to its first value, and from its last.
    Zero,
    /// Nothing: a run that is longer is refused.
    Error,
}

impl Outside {
    const ALL: [(Self, &'static str); 3] =
        [(Self::Hold, "hold"), (Self::Zero, "zero"), (Self::Error, "error")];
    /// The words in scenes.
    const WORDS: &'static [&'static str] = &["hold", "zero", "error"];

    fn word(self) -> &'static str {
        Self::ALL.iter().find(|own| own.0 == self).map_or("hold", |own| own.1)
    }
}

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
/// It has a kink at each point, which a motion must not have at a node with mass. Between points
/// nothing is known but a straight line, so a measured curve needs as many points as its bends ask
/// for; no filter is applied to it.
///
/// # References
///
/// Linear interpolation; there is no law to cite.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Time \[s\] and value \[N, m or m/s²\], in order of time.
    pub points: Vec<(f64, f64)>,
    /// What it is beyond them; `None` holds, and is told where that matters.
    pub outside: Option<Outside>,
}

impl Table {
    /// The table of these points, of which nothing is said about what holds beyond.
    pub fn of(points: Vec<(f64, f64)>) -> Self {
        Self { points, outside: None }
    }
}

impl WaveformKind for Table {
    const KIND: &'static str = "table";
    const SUMMARY: &'static str =
        "straight lines through points [time, value], or from a CSV file; equal times: a jump";
    const PARAMETERS: &'static [Parameter] = &[
        Parameter::required(
            "points",
            ParameterKind::TimeTable,
            "points [time, value] in order of time, for instance [[\"0 ms\", \"0 N\"], …], or the \
             name of a CSV file",
        ),
        Parameter::following(
            "outside",
            ParameterKind::Choice(Outside::WORDS),
            "`hold`, with a warning where that matters",
            "before the first and after the last point: its value for ever (`hold`), zero, or no run \
             so long (`error`)",
        ),
    ];

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        let Some(Value::Table(points)) = values.first() else {
            return Err(InvalidParameter::new("points", "a list of points", "missing"));
        };
        let outside = match values.get(1) {
            Some(Value::Word(word)) => Outside::ALL.iter().find(|own| own.1 == word),
            _ => None,
        };
        let table = Self { points: points.clone(), outside: outside.map(|own| own.0) };
        table.waveform().map(|_| table)
    }

    fn values(&self) -> Vec<Value> {
        let outside = self.outside.map(|own| Value::Word(own.word().to_owned()));
        vec![Value::Table(self.points.clone()), outside.unwrap_or(Value::LeftOut)]
    }

    fn waveform(&self) -> Result<Waveform, InvalidParameter> {
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
        let given = Given { from: first_time, to: last_time, integrals: 0, is_strict };
        let waveform = pieces("points", last_time, parts)?;
        let is_told = matches!(self.outside, Some(Outside::Hold | Outside::Zero));
        Ok(if is_told { waveform } else { waveform.given_at(given) })
    }

    fn sample() -> Self {
        Self::of(vec![(0.0, 0.0), (0.5, 2.0), (0.5, 1.0), (1.0, 0.0)])
    }
}
