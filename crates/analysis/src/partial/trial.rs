//! What may be left out by estimate, and networks with and without it.

use std::{
    sync::Arc,
    time::{Duration, Instant},
};

use dashpot_dae::{Observer, SolveError};
use dashpot_network::{Assembly, Detail, Influence, Network, Situation};

use super::{Comparison, Cost, Neglected, PutBack, Why};
use crate::{
    Contact, RunError, RunReport, SolveSettings, reported_measures,
    run::{solve_assembly, words},
};

/// Something whose influence is below the bound by estimate.
#[derive(Debug, Clone)]
pub(super) struct Candidate {
    pub(super) detail: Detail,
    pub(super) name: String,
    /// The largest of its numbers.
    pub(super) influence: Influence,
    /// What it costs by itself, once that is known.
    pub(super) alone: Option<Cost>,
}

/// The candidates of a network, the largest influence first.
pub(super) fn candidates(network: &Network, duration: f64, bound: f64) -> Vec<Candidate> {
    let situation = Situation::of(network, duration);
    let small = |detail: Detail| {
        let largest = Influence::largest(detail.influences(&situation))?;
        (largest.value < bound).then(|| Candidate {
            detail,
            name: detail.name(network),
            influence: largest,
            alone: None,
        })
    };
    let mut found: Vec<Candidate> = Detail::all(network).into_iter().filter_map(small).collect();
    found.sort_by(|one, other| other.influence.value.total_cmp(&one.influence.value));
    found
}

/// What keeps a run from being asked of the network without these details.
fn obstacle(network: &Network, details: &[Detail], settings: &SolveSettings) -> Option<RunError> {
    let assembly = match network.without(details).compile(settings.duration) {
        Ok(assembly) => assembly,
        Err(errors) => return Some(errors.into()),
    };
    reported_measures(&assembly, settings).err()
}

impl Candidate {
    /// Takes those out that cannot be left out of a run of the network, and says why.
    pub(super) fn needed(
        found: &mut Vec<Self>,
        network: &Network,
        settings: &SolveSettings,
    ) -> Vec<PutBack> {
        let mut needed = Vec::new();
        let all: Vec<Detail> = found.iter().map(|own| own.detail).collect();
        if obstacle(network, &all, settings).is_none() {
            return needed;
        }
        found.retain(|own| match obstacle(network, &[own.detail], settings) {
            Some(error) => {
                needed.push(own.put_back(Why::Fails(error)));
                false
            }
            None => true,
        });
        needed
    }

    pub(super) fn put_back(&self, why: Why) -> PutBack {
        PutBack { effect: self.name.clone(), influence: self.influence.clone(), why }
    }
}

impl From<Candidate> for Neglected {
    fn from(candidate: Candidate) -> Self {
        Self { effect: candidate.name, influence: candidate.influence, alone: candidate.alone }
    }
}

/// A network that was solved in full, to be solved again without some of its details.
pub(super) struct Trial<'n> {
    network: &'n Network,
    settings: &'n SolveSettings,
    pub(super) full: RunReport,
    /// Wall-clock time of the full solution.
    pub(super) own: Duration,
    /// Runs so far.
    pub(super) solves: usize,
    /// Wall-clock time of those.
    pub(super) wall: Duration,
}

/// A run without some details, how long it took, and how it compares with the full one.
pub(super) type Reduced = (RunReport, Duration, Comparison);

impl<'n> Trial<'n> {
    /// Solves the network in full.
    pub(super) fn of(
        network: &'n Network,
        assembly: &Arc<Assembly>,
        settings: &'n SolveSettings,
        observer: &mut dyn Observer,
    ) -> Result<Self, RunError> {
        let started = Instant::now();
        let full = solve_assembly(assembly, &words(network), settings, observer)?;
        let own = started.elapsed();
        Ok(Self { network, settings, full, own, solves: 1, wall: own })
    }

    /// Solves the network without these details; `Err` within where that is no answer.
    /// Errors: where the observer has cancelled the run.
    fn without(
        &mut self,
        details: &[Detail],
        observer: &mut dyn Observer,
    ) -> Result<Result<Reduced, Why>, RunError> {
        let started = Instant::now();
        let report = solve_without(self.network, details, self.settings, observer);
        let taken = started.elapsed();
        self.solves += 1;
        self.wall += taken;
        match report {
            Err(error) if is_cancelled(&error) => Err(error),
            Err(error) => Ok(Err(Why::Fails(error))),
            Ok(report) => {
                if let Some(pulls) = pulls(&self.full, &report) {
                    return Ok(Err(pulls));
                }
                let comparison = Comparison::of(&self.full, &report);
                Ok(Ok((report, taken, comparison)))
            }
        }
    }
}

/// The first element that pulls in the reduced run, where it parts in the full one.
fn pulls(full: &RunReport, reduced: &RunReport) -> Option<Why> {
    let parts = |element: &str| {
        full.contacts.iter().any(|contact| contact.element == element && !contact.is_glued)
    };
    let pulling = reduced.contacts.iter().find(|contact| {
        contact.is_glued
            && contact.impact.contact == Contact::Released
            && contact.impact.end < reduced.trajectory.t_end
            && parts(&contact.element)
    })?;
    Some(Why::Pulls { element: pulling.element.clone(), time: pulling.impact.end })
}

/// Solves a network without these details of it.
pub(super) fn solve_without(
    network: &Network,
    details: &[Detail],
    settings: &SolveSettings,
    observer: &mut dyn Observer,
) -> Result<RunReport, RunError> {
    let reduced = network.without(details);
    let assembly = Arc::new(reduced.compile(settings.duration)?);
    solve_assembly(&assembly, &words(&reduced), settings, observer)
}

/// Whether nobody wants the run any more.
pub(super) fn is_cancelled(error: &RunError) -> bool {
    matches!(error, RunError::Solve(SolveError::Cancelled { .. }))
}

/// Puts candidates back until none of the trials is moved by more than the bound, and returns each trial's run without
/// those that remain; nothing where none does. Errors: where the observer has cancelled a run.
pub(super) fn settle(
    candidates: &mut Vec<Candidate>,
    put_back: &mut Vec<PutBack>,
    trials: &mut [Trial<'_>],
    bound: f64,
    observer: &mut dyn Observer,
) -> Result<Vec<Reduced>, RunError> {
    let mut first = true;
    'again: while !candidates.is_empty() {
        let details: Vec<Detail> = candidates.iter().map(|candidate| candidate.detail).collect();
        let mut passed = Vec::new();
        for trial in &mut *trials {
            let why = match trial.without(&details, observer)? {
                Ok(reduced) if reduced.2.is_within(bound) => {
                    passed.push(reduced);
                    continue;
                }
                Ok((_, _, comparison)) => comparison.worst().cloned().map(Why::Moves),
                Err(why) => Some(why),
            };
            let Some(why) = why else { continue };
            if candidates.len() > 1 && std::mem::take(&mut first) {
                apart(candidates, put_back, trial, bound, observer)?;
                // Where each of them passes by itself, it is their sum that does not.
                if candidates.len() < details.len() {
                    continue 'again;
                }
            }
            let costs = candidates.iter().map(Candidate::known_cost);
            let largest = costs.enumerate().max_by(|one, other| one.1.total_cmp(&other.1));
            let back = candidates.remove(largest.map_or(0, |(at, _)| at));
            put_back.push(back.put_back(why));
            continue 'again;
        }
        if let [only] = candidates.as_mut_slice() {
            only.alone =
                passed.iter().filter_map(|own| own.2.worst()).cloned().reduce(Cost::larger);
        }
        return Ok(passed);
    }
    Ok(Vec::new())
}

/// Leaves each candidate out alone, and puts those back that exceed the bound by themselves, the largest first.
fn apart(
    candidates: &mut Vec<Candidate>,
    put_back: &mut Vec<PutBack>,
    trial: &mut Trial<'_>,
    bound: f64,
    observer: &mut dyn Observer,
) -> Result<(), RunError> {
    let mut failed = Vec::new();
    let mut kept = Vec::new();
    for mut candidate in candidates.drain(..) {
        match trial.without(&[candidate.detail], observer)? {
            Ok((_, _, comparison)) => {
                let is_within = comparison.is_within(bound);
                candidate.alone = comparison.worst().cloned();
                match candidate.alone.clone().filter(|_| !is_within) {
                    Some(cost) => failed.push((cost.most(), candidate.put_back(Why::Moves(cost)))),
                    None => kept.push(candidate),
                }
            }
            Err(why) => failed.push((f64::INFINITY, candidate.put_back(why))),
        }
    }
    failed.sort_by(|one, other| other.0.total_cmp(&one.0));
    put_back.extend(failed.into_iter().map(|(_, own)| own));
    *candidates = kept;
    Ok(())
}

impl Candidate {
    /// What it moves by itself, or as long as that is not known what is estimated.
    fn known_cost(&self) -> f64 {
        self.alone.as_ref().map_or(self.influence.value, Cost::most)
    }
}
