//! Partial modelling: what matters little is left out, and what that costs is measured.
//!
//! An effect is a candidate where each of its dimensionless numbers
//! ([`Influence`]) is below the bound; one without a number is none. An
//! estimate proves nothing, so the network is solved with and without all candidates together, and
//! every measure that both have is compared. Where one moves by more than the bound, each candidate
//! is left out alone. Those that exceed the bound by themselves are put back, and where the rest
//! still does so together, one after the other, the largest first. The last comparison is always
//! that of the network which is reported.
//!
//! A single run becomes no cheaper by this: it takes two solutions or more in place of one. A
//! [`sweep`] is checked at some of its points only.

pub mod contribution;
pub(crate) mod segmentation;

mod candidates;
mod cost;
mod sweep;
mod trial;

#[cfg(test)]
mod tests;

use std::{sync::Arc, time::Duration};

use dashpot_dae::Observer;
use dashpot_network::{Assembly, Detail, Influence, Network};

pub(crate) use self::sweep::{decide, spread};
use self::{
    candidates::{Candidate, candidates},
    cost::{Comparison, charged},
    trial::{Trial, settle},
};
pub use self::{
    cost::Cost,
    sweep::{PartialSweep, Saving, sweep},
};
use crate::{RunError, RunReport, SolveSettings, solve_assembly};

/// What was left out of a run, and what it cost.
#[derive(Debug, Clone, PartialEq)]
pub struct Partial {
    /// The bound: the part of its value, or of a twentieth of its size, by which a measure may move.
    pub bound: f64,
    /// What was left out, the largest influence first.
    pub left_out: Vec<Neglected>,
    /// What stayed although its estimate was below the bound.
    pub put_back: Vec<PutBack>,
    /// How far each measure is moved by all that was left out together; none where nothing was.
    pub costs: Vec<Cost>,
    /// Measures of things that only what was left out brings, and that nobody asked for.
    pub unreported: Vec<String>,
    /// What finding this out took.
    pub verification: Verification,
}

/// An effect that was left out.
#[derive(Debug, Clone, PartialEq)]
pub struct Neglected {
    /// What it is called, for instance `gravity` or `inertia of padding`.
    pub effect: String,
    /// The largest of its dimensionless numbers.
    pub influence: Influence,
    /// The measure that it moves the most by itself, where it was left out alone.
    pub alone: Option<Cost>,
}

/// An effect that stayed although its estimate was below the bound.
#[derive(Debug, Clone, PartialEq)]
pub struct PutBack {
    /// What it is called.
    pub effect: String,
    /// The largest of its dimensionless numbers.
    pub influence: Influence,
    /// Why it stayed.
    pub why: Why,
}

/// Why an effect stayed.
#[derive(Debug, Clone, PartialEq)]
pub enum Why {
    /// By itself, or with what else was left out, it moves this measure by more than the bound.
    Moves(Cost),
    /// What is asked of the run does not exist without it, or the run fails.
    Fails(RunError),
    /// An element that can part would pull, as if glued.
    Pulls {
        /// Its name.
        element: String,
        /// From when on \[s\].
        time: f64,
    },
}

/// Work beyond the solution that is reported.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Verification {
    /// Further runs, each with its own error estimates.
    pub solves: usize,
    /// Wall-clock time of those.
    pub wall: Duration,
}

impl Partial {
    /// The measure that what was left out moves the most.
    pub fn worst(&self) -> Option<&Cost> {
        self.costs.iter().max_by(|one, other| one.most().total_cmp(&other.most()))
    }
}

/// Solves a network that is compiled already; where the accuracy has a bound for what may be left
/// out, without what is shown to matter less. Otherwise as [`solve_assembly`], without any further
/// solution.
///
/// The errors of measures include what was left out, and what the segments of layers make of them:
/// the latter takes one further solution.
///
/// # Errors
///
/// As [`solve_assembly`].
pub fn solve_partial(
    network: &Network,
    assembly: &Arc<Assembly>,
    settings: &SolveSettings,
    observer: &mut dyn Observer,
) -> Result<RunReport, RunError> {
    let Some(bound) = settings.accuracy.neglect_below else {
        let report = solve_assembly(assembly, &words(network), settings, observer)?;
        return segmentation::charged(network, report, settings, observer);
    };
    settings.validate()?;
    let mut found = candidates(network, settings.duration, bound);
    let mut trial = Trial::of(network, assembly, settings, observer)?;
    let mut put_back = Candidate::needed(&mut found, network, settings);
    let trials = std::slice::from_mut(&mut trial);
    let settled = settle(&mut found, &mut put_back, trials, bound, observer)?;
    let details: Vec<Detail> = found.iter().map(|own| own.detail).collect();
    let mut partial = Partial {
        bound,
        left_out: found.into_iter().map(Neglected::from).collect(),
        put_back,
        costs: Vec::new(),
        unreported: Vec::new(),
        verification: Verification::default(),
    };
    let (solves, wall) = (trial.solves, trial.wall);
    let (mut report, own) = match settled.into_iter().next() {
        Some((reduced, own, comparison)) => {
            let report = charged(reduced, &trial.full);
            (partial.costs, partial.unreported) = (comparison.costs, comparison.unreported);
            (report, own)
        }
        None => (trial.full, trial.own),
    };
    partial.verification = Verification { solves: solves - 1, wall: wall.saturating_sub(own) };
    report.partial = Some(partial);
    segmentation::charged(&network.without(&details), report, settings, observer)
}

/// The words of the effects that are on.
pub(crate) fn words(network: &Network) -> Vec<&'static str> {
    network.effects().iter().map(|effect| effect.kind()).collect()
}
