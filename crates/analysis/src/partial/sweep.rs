//! Partial modelling of many networks that are much alike.

use std::{
    sync::Arc,
    time::{Duration, Instant},
};

use dashpot_dae::Observer;
use dashpot_network::{Detail, Network};

use super::{
    Candidate, Cost, Neglected, PutBack, candidates,
    trial::{Trial, is_cancelled, settle, solve_without},
    words,
};
use crate::{RunError, RunReport, SolveSettings, solve_assembly};

/// The least number of points at which a sweep is checked, if it has as many.
const LEAST: usize = 3;

/// The runs of a sweep, and what was left out of them.
#[derive(Debug)]
pub struct PartialSweep {
    /// One for each network, in their order. At points that were checked, errors include what was
    /// left out.
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
/// What is wrong with the settings, and the failure of a full run at a point of the verification.
/// Failures at other points stand among the runs.
pub fn sweep(
    networks: &[Network],
    settings: &SolveSettings,
    observer: &mut dyn Observer,
) -> Result<PartialSweep, RunError> {
    settings.validate()?;
    let started = Instant::now();
    let bound = settings.accuracy.neglect_below;
    let mut found = bound.map_or_else(Vec::new, |bound| common(networks, settings, bound));
    let mut put_back = Candidate::needed(&mut found);
    let checked = if found.is_empty() { Vec::new() } else { spread(networks.len()) };
    let mut trials = Vec::new();
    for &at in &checked {
        let assembly = Arc::new(networks[at].compile(settings.duration)?);
        trials.push(Trial::of(&networks[at], &assembly, settings, observer)?);
    }
    let bound = bound.unwrap_or(0.0);
    let settled = settle(&mut found, &mut put_back, &mut trials, bound, observer)?;
    let worst = settled.iter().filter_map(|own| own.2.worst()).cloned();
    let worst = worst.reduce(Cost::larger);

    let mut solves: usize = trials.iter().map(|trial| trial.solves).sum();
    let mut in_full: Vec<Duration> = trials.iter().map(|trial| trial.own).collect();
    let mut known = Vec::new();
    if settled.is_empty() {
        known.extend(trials.into_iter().map(|trial| trial.full));
    } else {
        let pairs = settled.into_iter().zip(trials);
        known.extend(pairs.map(|((run, _, compared), trial)| compared.charged(run, &trial.full)));
    }
    let details: Vec<Detail> = found.iter().map(|own| own.detail).collect();
    let mut known = checked.iter().copied().zip(known).peekable();
    let mut runs = Vec::with_capacity(networks.len());
    for (at, network) in networks.iter().enumerate() {
        if let Some((_, run)) = known.next_if(|own| own.0 == at) {
            runs.push(Ok(run));
            continue;
        }
        let begun = Instant::now();
        let run = if details.is_empty() {
            in_one(network, settings, observer)
        } else {
            solve_without(network, &details, settings, observer)
        };
        solves += 1;
        if details.is_empty() {
            in_full.push(begun.elapsed());
        }
        match run {
            Err(error) if is_cancelled(&error) => return Err(error),
            run => runs.push(run),
        }
    }
    let saving = Saving {
        solves,
        wall: started.elapsed(),
        wall_in_full: mean(&in_full).mul_f64(networks.len() as f64),
    };
    let left_out = found.into_iter().map(Neglected::from).collect();
    Ok(PartialSweep { runs, left_out, put_back, checked, worst, saving })
}

fn in_one(
    network: &Network,
    settings: &SolveSettings,
    observer: &mut dyn Observer,
) -> Result<RunReport, RunError> {
    let assembly = Arc::new(network.compile(settings.duration)?);
    solve_assembly(&assembly, &words(network), settings, observer)
}

fn mean(times: &[Duration]) -> Duration {
    let sum: Duration = times.iter().sum();
    sum.checked_div(u32::try_from(times.len()).unwrap_or(u32::MAX)).unwrap_or_default()
}

/// What is a candidate in every network, with its influence in the first one.
fn common(networks: &[Network], settings: &SolveSettings, bound: f64) -> Vec<Candidate> {
    let mut all = networks.iter().map(|network| candidates(network, settings, bound));
    let Some(mut common) = all.next() else { return Vec::new() };
    for others in all {
        common.retain_mut(|own| {
            let is_same = |other: &&Candidate| other.detail == own.detail && other.name == own.name;
            let Some(other) = others.iter().find(is_same) else { return false };
            own.obstacle = own.obstacle.take().or_else(|| other.obstacle.clone());
            true
        });
    }
    common
}

/// Positions that are spread evenly over `count`.
fn spread(count: usize) -> Vec<usize> {
    let wanted = (1..).find(|root| root * root >= count).unwrap_or(count);
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
