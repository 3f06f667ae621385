//! Table of values over time.

use dashpot_dae::{Piece, Waveform};

use super::{WaveformKind, before, pieces};
use crate::parameters::{InvalidParameter, Parameter, ParameterKind, Value};

/// Straight lines through given points; before the first and after the last point the function
/// keeps that point's value. Two points at one time are a jump.
///
/// | symbol | field    | unit         | range                             |
/// |--------|----------|--------------|-----------------------------------|
/// | `t_i`  | `points` | s            | in order; two the same are a jump |
/// | `u_i`  | `points` | N, m or m/s² | finite                            |
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
}

impl WaveformKind for Table {
    const KIND: &'static str = "table";
    const SUMMARY: &'static str =
        "straight lines through points [time, value], or those of a CSV file; equal times: a jump";
    const PARAMETERS: &'static [Parameter] = &[Parameter::required(
        "table",
        ParameterKind::TimeTable,
        "points [time, value] in order of time, for instance [[\"0 ms\", \"0 N\"], …], or the name \
         of a CSV file",
    )];

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        let Some(Value::Table(points)) = values.first() else {
            return Err(InvalidParameter::new("table", "a list of points", "missing"));
        };
        let table = Self { points: points.clone() };
        table.waveform().map(|_| table)
    }

    fn values(&self) -> Vec<Value> {
        vec![Value::Table(self.points.clone())]
    }

    fn waveform(&self) -> Result<Waveform, InvalidParameter> {
        if let Some(point) = self.points.iter().find(|p| !(p.0.is_finite() && p.1.is_finite())) {
            return Err(InvalidParameter::new("table", "finite", format!("{point:?}")));
        }
        let Some((&(first_time, first), &(last_time, last))) =
            self.points.first().zip(self.points.last())
        else {
            return Err(InvalidParameter::new("table", "one point or more", "empty"));
        };
        if let Some(pair) = self.points.windows(2).find(|pair| pair[0].0 > pair[1].0) {
            let found = format!("{} s before {} s", pair[0].0, pair[1].0);
            return Err(InvalidParameter::new("table", "in order of time", found));
        }
        let quiet = Piece { start: before(first_time), value: first, ..Piece::default() };
        let mut parts = vec![quiet];
        for pair in self.points.windows(2).filter(|pair| pair[0].0 < pair[1].0) {
            let slope = (pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0);
            parts.push(Piece { start: pair[0].0, value: pair[0].1, slope, ..Piece::default() });
        }
        parts.push(Piece { start: last_time, value: last, ..Piece::default() });
        pieces("table", last_time, parts)
    }

    fn sample() -> Self {
        Self { points: vec![(0.0, 0.0), (0.5, 2.0), (0.5, 1.0), (1.0, 0.0)] }
    }
}
