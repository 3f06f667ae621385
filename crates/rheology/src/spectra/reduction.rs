//! The fewest Kelvin–Voigt elements that keep a stated error.

use thiserror::Error;

use super::{Retardation, Spectrum, exchange::Levelled, kinds::Sum, target::Target};

/// The most elements that a reduction tries.
pub const MOST_BRANCHES: usize = 60;

/// The smallest error that a reduction can be asked for: below it, the digits of a double do not
/// suffice to tell the best sum.
pub const SMALLEST_ERROR: f64 = 1e-8;

/// The least difference of `ln t` over a range: closer times are one for rounded numbers.
const SHORTEST_RANGE: f64 = 1e-6;

/// A sum of Kelvin–Voigt elements in the place of a spectrum, and what it is worth.
#[derive(Debug, Clone, PartialEq)]
pub struct Reduced {
    /// The elements, by rising retardation time.
    pub branches: Vec<Retardation>,
    /// Bound of the relative error of the creep function, everywhere in the range of time.
    pub error: f64,
    /// An error that no sum with one element less goes below, whatever its times and compliances; 0
    /// where none is proved. A sum of no elements has the error 1.
    pub one_less: f64,
    /// Whether it is proved that no sum with fewer elements keeps the error that was asked for.
    pub is_fewest: bool,
}

/// Why a spectrum could not be reduced.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum ReductionError {
    /// The range of time is none.
    #[error(
        "the creep must be kept from a positive time to a later one, but they are {start} s and {end} s"
    )]
    Range {
        /// Start of the range \[s\].
        start: f64,
        /// End of the range \[s\].
        end: f64,
    },
    /// The error asked for cannot be worked with.
    #[error("the error must be from {SMALLEST_ERROR:e} to below 1, but it is {error}")]
    Error {
        /// The relative error asked for.
        error: f64,
    },
    /// The creep function underflows or is not finite in the range.
    #[error("the creep at {time:e} s is {creep:e} m/N, and no relative error can be told there")]
    NoCreep {
        /// The end of the range \[s\].
        time: f64,
        /// The creep there \[m/N\].
        creep: f64,
    },
    /// No sum that was tried keeps the error.
    #[error(
        "up to {MOST_BRANCHES} Kelvin elements were tried; the smallest error reached is \
         {reached:.2e} (elements: {branches}), not {error:e}"
    )]
    NotReached {
        /// Elements of the best sum.
        branches: usize,
        /// Its relative error.
        reached: f64,
        /// The relative error asked for.
        error: f64,
    },
}

/// Finds the fewest elements whose creep `R_n` keeps `|R_n(t)/R(t) − 1| ≤ error` for all `t` in
/// `range` \[s\], and the best sum of so many.
///
/// The error reached is a bound over the whole range, not a maximum over samples. For rising n, the maximum is made as
/// small as n elements can: the deviation then alternates 2n + 1 times at one level. The functions `1 − e^(−t/λ)` are a
/// Chebyshev system on t > 0, so that two different sums of n elements agree at 2n − 1 times at most. A sum with a
/// smaller deviation than another at all of its 2n + 1 alternations would agree with it 2n times; so none has, and n
/// elements are proved not to suffice where the least of the alternations is above the error asked for.
///
/// # Errors
///
/// A range that is not positive and rising, an error out of \[[`SMALLEST_ERROR`], 1), a creep that
/// underflows, and an error that [`MOST_BRANCHES`] elements do not keep.
///
/// # Examples
///
/// ```
/// use dashpot_rheology::spectra::{LogNormal, reduce};
///
/// let felt = LogNormal::new(5e-8, 2e-4, 1.0)?;
/// let reduced = reduce(&felt, [1e-5, 1e-1], 1e-3)?;
/// assert!(reduced.error <= 1e-3 && reduced.one_less > 1e-3 && reduced.is_fewest);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # References
///
/// D. Braess, *Nonlinear Approximation Theory*, Springer 1986, chapters VI and VII.
pub fn reduce(
    spectrum: &dyn Spectrum,
    range: [f64; 2],
    error: f64,
) -> Result<Reduced, ReductionError> {
    let [start, end] = range;
    if !(start > 0.0 && end.is_finite() && end.ln() - start.ln() > SHORTEST_RANGE) {
        return Err(ReductionError::Range { start, end });
    }
    if !(SMALLEST_ERROR..1.0).contains(&error) {
        return Err(ReductionError::Error { error });
    }
    for time in range {
        let creep = spectrum.creep(time);
        if !(creep >= f64::MIN_POSITIVE && creep.is_finite()) {
            return Err(ReductionError::NoCreep { time, creep });
        }
    }
    let target = Target::new(spectrum, start.ln(), end.ln());
    let mut one_less = 1.0;
    let mut is_fewest = true;
    let mut before: Option<Levelled> = None;
    let mut reached = (0, f64::INFINITY);
    for count in 1..=MOST_BRANCHES {
        if let Some(branches) = spectrum.branches().filter(|branches| branches.len() <= count) {
            let branches = branches.to_vec();
            return Ok(Reduced { branches, error: 0.0, one_less, is_fewest });
        }
        let best = match before {
            None => Levelled::single(&target),
            Some(before) => Levelled::with_one_more(&before, &target),
        };
        let kept = target.bound(&best.sum);
        if kept <= error {
            let branches = elements(&best.sum, spectrum.compliance());
            return Ok(Reduced { branches, error: kept, one_less, is_fewest });
        }
        if kept < reached.1 {
            reached = (count, kept);
        }
        one_less = least_possible(&target, &best);
        is_fewest &= one_less > error;
        before = Some(best);
    }
    let (branches, reached) = reached;
    Err(ReductionError::NotReached { branches, reached, error })
}

/// What no sum of so many elements can go below, from the alternations of the best one found.
fn least_possible(target: &Target<'_>, best: &Levelled) -> f64 {
    let mut least = f64::INFINITY;
    let mut before = 0.0;
    for place in &best.places {
        let share = target.share(*place);
        let deviation = (best.sum.share(*place) - share) / share;
        if deviation * before > 0.0 {
            return 0.0;
        }
        before = deviation;
        // Both functions are known to some 1e-14.
        least = least.min(deviation.abs() - 1e-13);
    }
    if best.places.is_empty() { 0.0 } else { least.max(0.0) }
}

fn elements(sum: &Sum, compliance: f64) -> Vec<Retardation> {
    sum.terms
        .iter()
        .map(|(time, strength)| Retardation {
            time: time.exp(),
            compliance: compliance * strength.exp(),
        })
        .collect()
}
