//! Records beside what was fitted to them, row by row.

use nalgebra::DVector;

use super::{certainty::Band, problem::Problem, record::Record};

/// What rows of a record tell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// The modulus after a step, over time \[s\].
    Relaxation,
    /// The compliance after a step, over time \[s\].
    Creep,
    /// The storage modulus over the angular frequency \[rad/s\].
    Storage,
    /// The loss modulus over the angular frequency \[rad/s\].
    Loss,
    /// What answers to a history, over time \[s\].
    Answer,
}

/// A row beside what was fitted to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FittedRow {
    /// Time \[s\] or angular frequency \[rad/s\].
    pub at: f64,
    /// What was measured.
    pub measured: f64,
    /// What the fewest branches say.
    pub model: f64,
    /// What the nearest network says, of those whose times the records determine.
    pub floor: f64,
    /// Half of the width of the 95 % band of the model; `None` where none is known.
    pub half: Option<f64>,
}

/// The rows of one kind of a record.
#[derive(Debug, Clone, PartialEq)]
pub struct FittedCurve {
    /// The number of the record.
    pub record: usize,
    /// What they tell.
    pub kind: Kind,
    /// The rows, in their order.
    pub rows: Vec<FittedRow>,
}

impl Record {
    /// The kinds of its rows, in the order of the channels that a problem makes of it.
    fn kinds(&self) -> &'static [Kind] {
        match self {
            Self::Relaxation(_) => &[Kind::Relaxation],
            Self::Creep(_) => &[Kind::Creep],
            Self::Storage(_) => &[Kind::Storage],
            Self::Loss(_) => &[Kind::Loss],
            Self::Oscillation(_) => &[Kind::Storage, Kind::Loss],
            Self::Strained(_) | Self::Stressed(_) => &[Kind::Answer],
        }
    }

    /// Times, or angular frequencies.
    fn places(&self) -> Vec<f64> {
        match self {
            Self::Relaxation(rows) | Self::Creep(rows) | Self::Storage(rows) | Self::Loss(rows) => {
                rows.iter().map(|own| own.0).collect()
            }
            Self::Oscillation(rows) | Self::Strained(rows) | Self::Stressed(rows) => {
                rows.iter().map(|own| own[0]).collect()
            }
        }
    }
}

/// All rows with what the fewest branches and the nearest network leave of them.
pub(super) fn curves(
    records: &[Record],
    problem: &Problem,
    [floor, few]: [&DVector<f64>; 2],
    band: Option<&Band>,
) -> Vec<FittedCurve> {
    let weights: Vec<f64> = problem.weights().collect();
    let kinds = records.iter().flat_map(|own| own.kinds().iter().map(move |kind| (own, *kind)));
    let each = problem.parts().zip(kinds).map(|((record, rows), (own, kind))| {
        let is_curve = matches!(kind, Kind::Relaxation | Kind::Creep);
        let row = |(row, at): (usize, f64)| FittedRow {
            at,
            measured: problem.target[row] / weights[row],
            model: (problem.target[row] + few[row]) / weights[row],
            floor: (problem.target[row] + floor[row]) / weights[row],
            half: band.filter(|_| is_curve).map(|own| own.at(at).1),
        };
        FittedCurve { record, kind, rows: rows.zip(own.places()).map(row).collect() }
    });
    each.collect()
}
