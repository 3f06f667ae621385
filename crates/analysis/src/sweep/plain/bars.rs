//! How far off what is read off the steps of an impact may be: solutions at falling tolerances.

use super::stepped::{Course, Stepped};

/// Tolerances in parts of the accuracy that is wanted.
pub(crate) const TOLERANCES: [f64; 4] = [1e-1, 1e-3, 1e-5, 1e-7];
/// Solutions are no coarser than for this accuracy: of few steps two have about the same ones, and their difference
/// tells nothing.
const LOOSEST: f64 = 1e-3;
const FINEST: f64 = 1e-13;
/// What is doubted of each value, in parts of the largest relative difference of two solutions: one of them may
/// agree by chance.
const DOUBT: f64 = 0.1;
/// What rounding leaves, in parts of a value.
const ROUNDING: f64 = 1e-12;

/// The last of some solutions.
#[derive(Debug)]
pub(crate) struct Found<const N: usize> {
    pub(crate) values: Vec<f64>,
    /// How far off each value may be.
    pub(crate) errors: Vec<f64>,
    pub(crate) course: Course<N>,
    /// The largest relative difference from the solution before, in parts of the error that one [estimates by itself](Course::relative_error).
    pub(crate) ratio: f64,
    /// The values of the solution before with what their errors are parts of, and what it estimates by itself.
    pub(crate) before: (Vec<[f64; 2]>, f64),
    /// How many solutions there were besides.
    pub(crate) others: usize,
}

/// The tolerance of this number for values that are to be so accurate.
pub(crate) fn tolerance(level: usize, accuracy: f64) -> f64 {
    (TOLERANCES[level] * accuracy.min(LOOSEST)).max(FINEST)
}

/// Solves at these tolerances, the first two of them at least, until the errors of what is read `suffice`; each value,
/// with what its error is a part of, differs from that before by its error, or less where two agree by chance: then it is
/// that of its own steps. `None` where a solution is not of the plain kind, or none suffices.
pub(crate) fn with_bars<const N: usize>(
    stepped: &Stepped<'_, N>,
    tolerances: &[f64],
    read: &dyn Fn(&Course<N>) -> Vec<[f64; 2]>,
    suffice: &dyn Fn(&[f64], &[f64]) -> bool,
) -> Option<Found<N>> {
    let mut tolerances = tolerances.iter().copied();
    let first = stepped.follow(tolerances.next()?)?;
    let (mut before, mut estimate) = (read(&first), first.relative_error());
    for (others, rtol) in (1..).zip(tolerances) {
        let course = stepped.follow(rtol)?;
        let own = read(&course);
        let both = || own.iter().zip(&before);
        let differences = || both().map(|([value, unit], old)| ((value - old[0]).abs(), *unit));
        let most = differences().map(|(off, unit)| off / unit).fold(0.0, f64::max);
        let (ratio, own_error) = (most / estimate, course.relative_error());
        let bar = |(off, unit): (f64, f64)| off + (DOUBT * most + own_error + ROUNDING) * unit;
        let errors: Vec<f64> = differences().map(bar).collect();
        let values: Vec<f64> = own.iter().map(|[value, _]| *value).collect();
        if suffice(&values, &errors) {
            return Some(Found {
                values,
                errors,
                course,
                ratio,
                before: (before, estimate),
                others,
            });
        }
        (before, estimate) = (own, own_error);
    }
    None
}
