//! The choice among candidates.

use serde::Serialize;

use crate::network::{Kind, NetworkFit, Test};

/// A candidate that is farther than the nearest by no more than this part is as near.
const AS_NEAR: f64 = 0.1;

/// How near a candidate comes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Candidate {
    /// How many numbers it has.
    pub numbers: usize,
    /// What it leaves of the tests that it was fitted to, in parts of their peaks.
    pub error: f64,
    /// What it leaves of tests when it is fitted to the others; `None` where there is one only.
    pub held_out: Option<f64>,
}

impl Candidate {
    /// That of a fit with so many numbers.
    pub fn of(fit: &NetworkFit, tests: &[Test]) -> Self {
        let scale = |at: usize| match tests[at].kind {
            Kind::Modulus => 1.0,
            _ => fit.tests[at].measured_peak.abs(),
        };
        let mean = |of: &dyn Fn(usize) -> Option<f64>| {
            let squares = (0..tests.len()).map(|at| Some((of(at)? / scale(at)).powi(2)));
            let sum: Option<f64> = squares.sum();
            sum.map(|own| (own / tests.len() as f64).sqrt())
        };
        let held_out = mean(&|at| Some(fit.tests[at].held_out?.rms));
        let error = mean(&|at| Some(fit.tests[at].rms)).unwrap_or(f64::INFINITY);
        Self { numbers: fit.numbers.len(), error, held_out }
    }
}

/// What candidates are judged by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Basis {
    /// What is left of tests that were held out.
    HeldOut,
    /// What is left of the tests, which may be so much of their peaks.
    Stated(f64),
}

/// What is said of a candidate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// It has the fewest numbers of those that are near enough.
    Chosen,
    /// It is near enough, with no fewer numbers.
    NotNeeded,
    /// It leaves more than one of fewer numbers, which is a limit of it: its search ended elsewhere than at its minimum, or
    /// that lies beyond the bounds.
    NotConverged,
    /// Another is nearer.
    TooFar,
    /// It could not be fitted.
    NotFitted,
}

/// The choice among candidates.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// What they were judged by.
    pub basis: Basis,
    /// Which one was chosen; `None` where none could be fitted.
    pub chosen: Option<usize>,
    /// Whether it is as near as was stated.
    pub is_near: bool,
    /// Of each.
    pub verdicts: Vec<Verdict>,
}

/// Chooses by held-out tests where there are some, else by an error that may be left; of candidates that are as near,
/// that with the fewest numbers. Those without a fit are `None`. Each has those of fewer numbers as limits, as forms have
/// ([`KNOWN`](super::KNOWN)).
///
/// # Examples
///
/// ```
/// use dashpot_fit::among::{Candidate, Verdict, choose};
///
/// let own = |numbers, error, held_out| Some(Candidate { numbers, error, held_out: Some(held_out) });
/// // Two more numbers are nearer to what they were fitted to, and not to what they were not.
/// let all = [own(1, 0.2, 0.25), own(3, 0.02, 0.03), own(5, 0.01, 0.029), None];
/// let choice = choose(&all, 0.01);
/// assert_eq!(choice.chosen, Some(1));
/// let right = [Verdict::TooFar, Verdict::Chosen, Verdict::NotNeeded, Verdict::NotFitted];
/// assert_eq!(choice.verdicts, right);
/// ```
pub fn choose(candidates: &[Option<Candidate>], stated: f64) -> Choice {
    let is_held_out = candidates.iter().flatten().all(|own| own.held_out.is_some());
    let basis = if is_held_out { Basis::HeldOut } else { Basis::Stated(stated) };
    let error = |own: &Candidate| match own.held_out {
        Some(held_out) if is_held_out => held_out,
        _ => own.error,
    };
    let nearest = candidates.iter().flatten().map(error).fold(f64::INFINITY, f64::min);
    let allowed = match basis {
        Basis::Stated(stated) if nearest <= stated => stated,
        _ => nearest * (1.0 + AS_NEAR),
    };
    let is_allowed = |own: &Candidate| error(own) <= allowed;
    let near = candidates.iter().enumerate().filter_map(|(at, own)| Some((at, (*own)?)));
    let near = near.filter(|own| is_allowed(&own.1));
    let order = |own: &Candidate| (own.numbers, error(own));
    let first = near.min_by(|one, other| {
        let ((few, left), (many, right)) = (order(&one.1), order(&other.1));
        few.cmp(&many).then(left.total_cmp(&right))
    });
    let chosen = first.map(|own| own.0);
    let is_beaten = |own: &Candidate| {
        let mut fewer = candidates.iter().flatten().filter(|less| less.numbers < own.numbers);
        fewer.any(|less| own.error > less.error * (1.0 + AS_NEAR))
    };
    let verdict = |(at, own): (usize, &Option<Candidate>)| match own {
        None => Verdict::NotFitted,
        Some(_) if Some(at) == chosen => Verdict::Chosen,
        Some(own) if is_beaten(own) => Verdict::NotConverged,
        Some(own) if is_allowed(own) => Verdict::NotNeeded,
        Some(_) => Verdict::TooFar,
    };
    Choice {
        basis,
        chosen,
        is_near: !matches!(basis, Basis::Stated(stated) if nearest > stated),
        verdicts: candidates.iter().enumerate().map(verdict).collect(),
    }
}

/// Akaike's criterion with its correction for few samples, less the lowest, and how many samples it counts: rows that
/// follow each other count for fewer, as they do in the candidate that leaves least, whose residuals are nearest to
/// noise. `None` of candidates without a fit, and where unknowns are too many for so few samples.
///
/// Source: C. M. Hurvich, C.-L. Tsai, Biometrika 76 (1989) 297–307.
pub fn information(fits: &[Option<&NetworkFit>], tests: &[Test]) -> (Vec<Option<f64>>, f64) {
    let rows = |own: &NetworkFit| own.tests.iter().map(|own| own.rows).sum::<usize>() as f64;
    let correlation = fits.iter().flatten().map(|own| own.correlation);
    let correlation = correlation.fold(f64::INFINITY, f64::min).max(1.0);
    let count = fits.iter().flatten().next().map_or(0.0, |own| rows(own)) / correlation;
    let own: usize = tests.iter().map(Test::unknowns).sum();
    let criterion = |fit: &NetworkFit| {
        // With the variance of each test as one more unknown.
        let unknowns = (fit.numbers.len() + own + tests.len()) as f64;
        let left = fit
            .tests
            .iter()
            .map(|own| own.rows as f64 / correlation * own.mean_square.max(f64::MIN_POSITIVE).ln());
        let corrected = 2.0 * unknowns * count / (count - unknowns - 1.0);
        (count > unknowns + 1.0).then(|| left.sum::<f64>() + corrected)
    };
    let all: Vec<Option<f64>> = fits.iter().map(|own| criterion((*own)?)).collect();
    let least = all.iter().flatten().copied().fold(f64::INFINITY, f64::min);
    (all.iter().map(|own| own.map(|own| own - least)).collect(), count)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn own(numbers: usize, error: f64) -> Candidate {
        Candidate { numbers, error, held_out: None }
    }

    #[test]
    fn a_single_test_is_judged_by_the_error_that_may_be_left() {
        let all = [own(1, 0.3), own(3, 0.009), own(5, 0.001)].map(Some);
        let choice = choose(&all, 0.01);
        assert_eq!(
            (choice.chosen, choice.basis, choice.is_near),
            (Some(1), Basis::Stated(0.01), true)
        );
        assert_eq!(choice.verdicts[2], Verdict::NotNeeded);
        // Where none is near enough the nearest is taken, with the fewest numbers.
        let choice = choose(&all, 1e-4);
        assert_eq!((choice.chosen, choice.is_near), (Some(2), false));
        assert_eq!(choose(&[None], 0.01).chosen, None);
        // One that leaves more than its limit has not converged.
        let choice = choose(&[own(2, 0.039), own(3, 0.045), own(5, 0.041)].map(Some), 0.01);
        let right = [Verdict::Chosen, Verdict::NotConverged, Verdict::NotNeeded];
        assert_eq!(choice.verdicts, right);
    }
}
