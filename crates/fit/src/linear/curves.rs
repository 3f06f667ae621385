//! Records beside what was fitted to them, row by row.

use nalgebra::DVector;

use super::{
    problem::Problem,
    record::{Column, Kind, Record},
};

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

/// All rows with what the fewest branches and the nearest network leave of them.
pub(super) fn curves(
    records: &[Record],
    problem: &Problem,
    [floor, few]: [&DVector<f64>; 2],
    halves: Option<&DVector<f64>>,
) -> Vec<FittedCurve> {
    let weights: Vec<f64> = problem.weights().collect();
    let columns = records.iter().flat_map(Record::columns);
    let each = problem.parts().zip(columns).map(|((record, rows), Column { kind, places, .. })| {
        let is_curve = matches!(kind, Kind::Relaxation | Kind::Creep);
        let row = |(row, at): (usize, f64)| FittedRow {
            at,
            measured: problem.target[row] / weights[row],
            model: (problem.target[row] + few[row]) / weights[row],
            floor: (problem.target[row] + floor[row]) / weights[row],
            half: halves.filter(|_| is_curve).map(|own| own[row] / weights[row]),
        };
        FittedCurve { record, kind, rows: rows.zip(places).map(row).collect() }
    });
    each.collect()
}
