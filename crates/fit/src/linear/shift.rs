//! Clocks: how much later an answer was written down than what was done, as a nuisance of the fit.

use super::{
    certainty::{End, Range, range, tolerated},
    floor::{Dense, Misfit},
    problem::Problem,
    record::Record,
};

/// A clock may be off by so many steps of a record.
const MOST_STEPS: f64 = 2.0;
/// Shifts that are tried either way at first.
const TRIED: i32 = 8;
/// Halvings of the distance between shifts.
const HALVINGS: usize = 6;
/// Shifts on each side at which ranges are looked at as well.
const AROUND: i32 = 4;
/// The slowest branch that ranges allow for, in multiples of the longest time.
const SLOWEST: f64 = 10.0;

/// The shifts at which the floor is lowest, one record after the other.
pub(super) fn nearest(records: &[Record]) -> Vec<f64> {
    let mut shifts = vec![0.0; records.len()];
    for (at, record) in records.iter().enumerate().filter(|own| own.1.has_history()) {
        let step = record.range().0;
        let floor = |shift: f64| {
            let problem = Problem::of(std::slice::from_ref(record), &[shift]);
            Misfit::of_vector(&Dense::of(&problem).minimum().residual).rms
        };
        let mut width = MOST_STEPS * step / f64::from(TRIED);
        let mut best = (floor(0.0), 0.0);
        for tried in (-TRIED..=TRIED).filter(|own| *own != 0) {
            let shift = f64::from(tried) * width;
            best = lower(best, (floor(shift), shift));
        }
        for _ in 0..HALVINGS {
            width *= 0.5;
            let (low, high) = (best.1 - width, best.1 + width);
            best = lower(lower(best, (floor(low), low)), (floor(high), high));
        }
        shifts[at] = best.1;
    }
    shifts
}

fn lower(best: (f64, f64), own: (f64, f64)) -> (f64, f64) {
    if own.0 < best.0 { own } else { best }
}

/// A shift that lowers the floor by less than this part is none, and so is one from a floor of rounding alone.
const LOWERS: f64 = 0.02;
const ROUNDING: f64 = 1e-9;

/// Whether shifted clocks bring the nearest network nearer to the rows.
pub(super) fn is_nearer(shifted: Misfit, unshifted: Misfit) -> bool {
    unshifted.rms > ROUNDING && shifted.rms < (1.0 - LOWERS) * unshifted.rms
}

/// The slowest branch that ranges allow for \[s\].
pub(super) fn slowest(problem: &Problem) -> f64 {
    SLOWEST * problem.range.1
}

/// The ranges of both ends of the spectrum, with all shifts that keep within the noise.
///
/// A spring that rows come to rest at is told from a branch of ten times their length; one that they are still on the
/// way to is not. How fast a branch is is free.
pub(super) fn ranges(
    records: &[Record],
    (shifts, are_free): (&[f64], bool),
    problem: &Problem,
    ends: [End; 2],
) -> [Range; 2] {
    let slowest = slowest(problem);
    let dense = Dense::until(problem, slowest);
    let tolerated = tolerated(problem, &dense.minimum());
    let mut others: Vec<Dense> = Vec::new();
    for (at, record) in records.iter().enumerate().filter(|own| own.1.has_history()) {
        let step = record.range().0 / f64::from(AROUND);
        for tried in (-AROUND..=AROUND).filter(|own| *own != 0 && are_free) {
            let mut shifts = shifts.to_vec();
            shifts[at] += f64::from(tried) * step;
            others.push(Dense::until(&Problem::of(records, &shifts), slowest));
        }
    }
    ends.map(|end| {
        let own =
            range(&dense, end, tolerated).unwrap_or(Range { value: 0.0, low: 0.0, high: None });
        others.iter().filter_map(|other| range(other, end, tolerated)).fold(own, Range::joined)
    })
}
