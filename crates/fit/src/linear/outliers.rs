//! Rows that stand apart from their neighbours and from every network whose times the records determine.

use nalgebra::DVector;

use super::problem::Problem;

/// A row stands apart by so many standard deviations of the noise.
const APART: f64 = 6.0;
/// It stands apart by so many steps between its neighbours.
const GROWTH: f64 = 4.0;
/// The noise is that of so many rows on each side.
const AROUND: usize = 12;
/// No more than this part of the rows is left out.
const MOST: f64 = 0.05;
/// A channel with fewer rows does not tell its noise.
const FEWEST: usize = 10;
/// The median of the magnitude of a normal deviate.
const MEDIAN: f64 = 0.6745;

/// A row that was not counted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outlier {
    /// The row of the record, from 0.
    pub row: usize,
    /// How far above the fitted curve its value is, below where negative, in parts of it.
    pub off: f64,
}

/// The rows of a problem that are further than `stated` from what is left of them, and apart from both neighbours
/// however these lie: each with the number of its record. Of several in one channel those that are nearly as far as
/// the farthest, as that draws the others along.
pub(super) fn outliers(problem: &Problem, left: &DVector<f64>, stated: f64) -> Vec<(usize, usize)> {
    let mut all = Vec::new();
    for (record, rows) in problem.parts() {
        let own = &left.as_slice()[rows];
        if own.len() < FEWEST {
            continue;
        }
        // That of the rows around, where others may scatter less.
        let noise = |at: usize| {
            let rows = &own[at.saturating_sub(AROUND)..(at + AROUND).min(own.len())];
            let mut steps: Vec<f64> = rows.windows(2).map(|two| (two[1] - two[0]).abs()).collect();
            steps.sort_by(f64::total_cmp);
            steps[steps.len() / 2] / (MEDIAN * std::f64::consts::SQRT_2)
        };
        let apart = |at: usize| {
            let mean = |own: &[f64]| own.iter().sum::<f64>() / own.len() as f64;
            let (before, after) = (&own[at.saturating_sub(2)..at], &own[at + 1..]);
            let sides = [before, &after[..after.len().min(2)]].into_iter();
            let sides = sides.filter(|side| !side.is_empty()).map(|side| own[at] - mean(side));
            let (low, high) = sides.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), own| {
                (low.min(own), high.max(own))
            });
            if low > 0.0 { low } else { (-high).max(0.0) }
        };
        // A smooth misfit grows from row to row as well.
        let beside = |at: usize| {
            let step =
                |from: usize| own.get(from).zip(own.get(from + 1)).map(|two| (two.1 - two.0).abs());
            let steps = [at.checked_sub(2), Some(at + 1)].into_iter().flatten().filter_map(step);
            steps.fold(0.0, f64::max)
        };
        let is_far = |at: usize| {
            own[at].abs() > stated && apart(at) > f64::max(APART * noise(at), GROWTH * beside(at))
        };
        let far: Vec<(usize, f64)> =
            (0..own.len()).filter(|at| is_far(*at)).map(|at| (at, apart(at))).collect();
        let farthest = far.iter().fold(0.0, |most: f64, own| most.max(own.1));
        all.extend(far.iter().filter(|own| own.1 > 0.5 * farthest).map(|own| (record, own.0)));
    }
    all
}

/// Whether so many rows of a record may be left out.
pub(super) fn may_be_left_out(count: usize, rows: usize) -> bool {
    count as f64 <= (MOST * rows as f64).max(1.0)
}
