//! Partial modelling: what matters little is left out, and what that costs is measured.
//!
//! An effect is a candidate where each of its dimensionless numbers ([`Influence`](dashpot_network::Influence)) is
//! below the bound; one without a number is none. An estimate proves nothing, so the network is solved with and without
//! all candidates together, and every measure that both have is compared. Where one moves by more than the bound, each
//! candidate is left out alone. Those that exceed the bound by themselves are put back, and where the rest still does
//! so together, one after the other, the largest first. The last comparison is always that of the network which is
//! reported.
//!
//! A single run becomes no cheaper by this: it takes two solutions or more in place of one. A
//! [`sweep`] is checked at some of its points only.

mod sweep;
mod trial;

#[cfg(test)]
mod tests;

use std::sync::Arc;

use dashpot_dae::Observer;
use dashpot_network::{Assembly, Detail, Network};

pub use self::sweep::{PartialSweep, Saving, sweep};
pub(crate) use self::sweep::{decide, spread};
use self::trial::{Candidate, Trial, candidates, settle};
pub use crate::report::partial::{Cost, Neglected, Partial, PutBack, Verification, Why};
use crate::{MeasureReport, RunError, RunReport, SolveSettings};

/// Solves a network that is compiled already without what is shown to move no measure by more than
/// `bound`; and what that is. The errors of measures include what was left out.
/// Errors: as [`solve_assembly`](crate::solve_assembly).
pub(crate) fn reduced(
    network: &Network,
    assembly: &Arc<Assembly>,
    settings: &SolveSettings,
    bound: f64,
    observer: &mut dyn Observer,
) -> Result<(RunReport, Vec<Detail>), RunError> {
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
    Ok((report, details))
}

/// A network's measures with and without something.
#[derive(Debug, Clone)]
pub(super) struct Comparison {
    /// One for each measure that both have.
    pub(super) costs: Vec<Cost>,
    /// Measures of what does not exist without it.
    pub(super) unreported: Vec<String>,
}

impl Comparison {
    /// Compares a run with that of a reduced network.
    pub(super) fn of(full: &RunReport, reduced: &RunReport) -> Self {
        let (mut costs, mut unreported) = (Vec::new(), Vec::new());
        let others = reduced.by_key();
        for measure in &full.measures {
            let target = measure.target.as_str();
            match others.get(measure.key.as_str()) {
                Some(other) => costs.push(cost(measure, other)),
                None if exists(reduced, target) => costs.push(infinite(measure)),
                None => unreported.push(measure.key.clone()),
            }
        }
        Self { costs, unreported }
    }

    /// The measure that moves the most.
    pub(super) fn worst(&self) -> Option<&Cost> {
        self.costs.iter().max_by(|one, other| one.most().total_cmp(&other.most()))
    }

    /// Whether no measure moves by more than the bound, however the errors lie.
    pub(super) fn is_within(&self, bound: f64) -> bool {
        self.costs.iter().all(|cost| cost.most() <= bound)
    }
}

/// The reduced run with the errors of its measures widened by what was left out.
pub(super) fn charged(mut reduced: RunReport, full: &RunReport) -> RunReport {
    let others = full.by_key();
    for measure in &mut reduced.measures {
        let Some(opposite) = others.get(measure.key.as_str()) else { continue };
        if let (Some(value), Some(right), Some(error)) =
            (measure.value, opposite.value, opposite.error)
        {
            // The difference from the value that is known to be this good.
            measure.error = Some((value - right).abs() + error);
        }
    }
    reduced
}

/// Whether the network of a run has a node or element of this name.
fn exists(report: &RunReport, name: &str) -> bool {
    report.assembly.node(name).is_some() || report.assembly.connection(name).is_some()
}

fn infinite(measure: &MeasureReport) -> Cost {
    Cost { measure: measure.key.clone(), relative: f64::INFINITY, uncertainty: 0.0 }
}

/// Part of its size below which a value is the small remainder of something larger.
const REMAINDER: f64 = 0.05;

/// What a move of a measure is a part of: its value or, where that is next to nothing, a part of its size.
fn scale(measure: &MeasureReport) -> f64 {
    measure.value.map_or(0.0, f64::abs).max(REMAINDER * measure.size)
}

fn cost(full: &MeasureReport, reduced: &MeasureReport) -> Cost {
    let size = scale(full).max(scale(reduced));
    let (difference, errors) = match (full.value, reduced.value) {
        (Some(one), Some(other)) => {
            let errors = full.error.unwrap_or(0.0) + reduced.error.unwrap_or(0.0);
            ((one - other).abs(), errors)
        }
        (None, None) => (0.0, 0.0),
        _ => return infinite(full),
    };
    let over_size = |amount: f64| if amount > 0.0 { amount / size } else { 0.0 };
    Cost {
        measure: full.key.clone(),
        relative: over_size(difference),
        uncertainty: over_size(errors),
    }
}
