//! Partial modelling of many networks that are much alike.

use std::{
    collections::BTreeMap,
    sync::Arc,
    time::{Duration, Instant},
};

use dashpot_dae::Observer;
use dashpot_network::{Detail, Network};

use super::{
    Cost, Neglected, PutBack, charged,
    trial::{Candidate, Trial, candidates, is_cancelled, settle, solve_without},
};
use crate::{RunError, RunReport, SolveSettings};

/// The least number of points at which a sweep is checked, if it has as many.
const LEAST: usize = 3;

/// The runs of a sweep, and what was left out of them.
#[derive(Debug)]
pub struct PartialSweep {
    /// One for each network, in their order. At points that were checked, errors include what was left out.
    pub runs: Vec<Result<RunReport, RunError>>,
    /// What was left out of all of them, the largest influence at the first point first.
    pub left_out: Vec<Neglected>,
    /// What stayed although its estimate was below the bound.
    pub put_back: Vec<PutBack>,
    /// Positions of the networks that were solved with and without it, rising.
    pub checked: Vec<usize>,
    /// The measure that moves the most at any of those.
    pub worst: Option<Cost>,
    /// What it saved.
    pub saving: Saving,
}

/// What a sweep took, and what it would have taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Saving {
    /// Runs in all, those of the verification included.
    pub solves: usize,
    /// Wall-clock time of the whole sweep, its verification included.
    pub wall: Duration,
    /// Wall-clock time of the sweep in full, from the mean of the points that were solved in full.
    pub wall_in_full: Duration,
}

/// What is left out of many networks, and what finding that out has yielded.
#[derive(Debug)]
pub(crate) struct Decision {
    found: Vec<Candidate>,
    /// What stayed although its estimate was below the bound.
    pub(crate) put_back: Vec<PutBack>,
    worst: Option<Cost>,
    solves: usize,
    /// Wall-clock times of the runs in full.
    in_full: Vec<Duration>,
    /// The networks that were solved with and without it, rising.
    checked: Vec<usize>,
    /// What is reported of the networks that were solved, by their positions.
    runs: BTreeMap<usize, Result<RunReport, RunError>>,
}

impl Decision {
    /// What is left out.
    pub(crate) fn details(&self) -> Vec<Detail> {
        self.found.iter().map(|own| own.detail).collect()
    }

    /// The same in words.
    pub(crate) fn left_out(&self) -> Vec<Neglected> {
        self.found.iter().cloned().map(Neglected::from).collect()
    }

    /// The measure that moves the most at any of the networks that were checked.
    pub(crate) fn worst(&self) -> Option<Cost> {
        self.worst.clone()
    }

    /// Solutions so far.
    pub(crate) fn solves(&self) -> usize {
        self.solves
    }

    /// The networks that were solved with and without it, rising.
    pub(crate) fn checked(&self) -> impl Iterator<Item = usize> + '_ {
        self.checked.iter().copied()
    }

    /// What `count` runs in full would take.
    pub(crate) fn wall_in_full(&self, count: usize) -> Duration {
        of_all(&self.in_full, count)
    }
}

/// Finds what may be left out of all of these networks, as [`sweep`] does, by solving those at the positions `points`
/// with and without it. Errors: what is wrong with the settings, and that the observer has cancelled a run.
pub(crate) fn decide(
    networks: &[Network],
    points: &[usize],
    settings: &SolveSettings,
    observer: &mut dyn Observer,
) -> Result<Decision, RunError> {
    settings.validate()?;
    let bound = settings.accuracy.neglect_below.unwrap_or(0.0);
    let mut found = common(networks, settings.duration, bound);
    let mut put_back = match networks.first() {
        Some(network) => Candidate::needed(&mut found, network, settings),
        None => Vec::new(),
    };
    let (mut checked, mut trials, mut runs) = (Vec::new(), Vec::new(), BTreeMap::new());
    for &at in if found.is_empty() { &[] } else { points } {
        match trial(&networks[at], settings, observer) {
            Ok(trial) => {
                checked.push(at);
                trials.push(trial);
            }
            Err(error) if is_cancelled(&error) => return Err(error),
            Err(error) => {
                runs.insert(at, Err(error));
            }
        }
    }
    if trials.is_empty() {
        found.clear();
    }
    let settled = settle(&mut found, &mut put_back, &mut trials, bound, observer)?;
    let worst = settled.iter().filter_map(|own| own.2.worst()).cloned();
    let worst = worst.reduce(Cost::larger);
    let solves = runs.len() + trials.iter().map(|trial| trial.solves).sum::<usize>();
    let in_full: Vec<Duration> = trials.iter().map(|trial| trial.own).collect();
    let mut settled = settled.into_iter();
    for (&at, Trial { full, .. }) in checked.iter().zip(trials) {
        let run = match settled.next() {
            Some((run, ..)) => charged(run, &full),
            None => full,
        };
        runs.insert(at, Ok(run));
    }
    Ok(Decision { found, put_back, worst, solves, in_full, checked, runs })
}

/// Solves many networks that differ in numbers only, without what matters less than the bound of
/// the accuracy in each of them.
///
/// Candidates are what is below the bound by estimate in every network. They are verified at
/// `√n` points of `n`, three at least, spread evenly over the sweep from its first to its last one:
/// what moves a measure by more than the bound at one of them stays everywhere. All other points are
/// solved once. Without a bound every network is solved once, in full.
///
/// # Errors
///
/// What is wrong with the settings, and that the observer has cancelled a run. Other failures stand among the runs.
pub fn sweep(
    networks: &[Network],
    settings: &SolveSettings,
    observer: &mut dyn Observer,
) -> Result<PartialSweep, RunError> {
    let started = Instant::now();
    let mut decision = decide(networks, &spread(networks.len()), settings, observer)?;
    let details = decision.details();
    let left_out = decision.left_out();
    let mut runs = std::mem::take(&mut decision.runs);
    for (at, network) in networks.iter().enumerate() {
        if runs.contains_key(&at) {
            continue;
        }
        let begun = Instant::now();
        let run = solve_without(network, &details, settings, observer);
        decision.solves += 1;
        if details.is_empty() {
            decision.in_full.push(begun.elapsed());
        }
        match run {
            Err(error) if is_cancelled(&error) => return Err(error),
            run => runs.insert(at, run),
        };
    }
    let wall_in_full = decision.wall_in_full(networks.len());
    let saving = Saving { solves: decision.solves, wall: started.elapsed(), wall_in_full };
    let Decision { put_back, checked, worst, .. } = decision;
    let runs = runs.into_values().collect();
    Ok(PartialSweep { runs, left_out, put_back, checked, worst, saving })
}

/// Solves a network in full.
fn trial<'n>(
    network: &'n Network,
    settings: &'n SolveSettings,
    observer: &mut dyn Observer,
) -> Result<Trial<'n>, RunError> {
    let assembly = Arc::new(network.compile(settings.duration)?);
    Trial::of(network, &assembly, settings, observer)
}

/// What `count` runs take that last as long as these on average.
fn of_all(times: &[Duration], count: usize) -> Duration {
    let number = |count: usize| u32::try_from(count).unwrap_or(u32::MAX);
    let sum: Duration = times.iter().sum();
    sum.saturating_mul(number(count)).checked_div(number(times.len())).unwrap_or_default()
}

/// What is a candidate in every network, with its influence in the first one.
fn common(networks: &[Network], duration: f64, bound: f64) -> Vec<Candidate> {
    let mut all = networks.iter().map(|network| candidates(network, duration, bound));
    let mut common = all.next().unwrap_or_default();
    for others in all {
        let is_same = |own: &Candidate, other: &Candidate| {
            other.detail == own.detail && other.name == own.name
        };
        common.retain(|own| others.iter().any(|other| is_same(own, other)));
    }
    common
}

/// Positions that are spread evenly over `count`.
pub(crate) fn spread(count: usize) -> Vec<usize> {
    let root = count.isqrt();
    let wanted = if root * root < count { root + 1 } else { root };
    let wanted = wanted.max(LEAST).min(count);
    let last = wanted.saturating_sub(1).max(1);
    (0..wanted).map(|at| at * count.saturating_sub(1) / last).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_spread_from_the_first_to_the_last() {
        assert_eq!(spread(0), [] as [usize; 0]);
        assert_eq!(spread(1), [0]);
        assert_eq!(spread(2), [0, 1]);
        assert_eq!(spread(9), [0, 4, 8]);
        assert_eq!(spread(100), [0, 11, 22, 33, 44, 55, 66, 77, 88, 99]);
    }
}
