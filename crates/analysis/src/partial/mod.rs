//! Partial modelling: what matters little is left out, and what that costs is measured.
//!
//! An effect is a candidate where each of its dimensionless numbers
//! ([`Influence`](dashpot_network::Influence)) is below the bound; one without a number is none. An
//! estimate proves nothing, so the network is solved with and without all candidates together, and
//! every measure that both have is compared. Where one moves by more than the bound, each candidate
//! is left out alone. Those that exceed the bound by themselves are put back, and where the rest
//! still does so together, one after the other, the largest first. The last comparison is always
//! that of the network which is reported.
//!
//! A single run becomes no cheaper by this: it takes two solutions or more in place of one. A
//! [`sweep`] is checked at some of its points only.

mod cost;
mod sweep;
mod trial;

#[cfg(test)]
mod tests;

use std::sync::Arc;

use dashpot_dae::Observer;
use dashpot_network::{Assembly, Detail, Network};

pub use self::sweep::{PartialSweep, Saving, sweep};
pub(crate) use self::sweep::{decide, spread};
use self::{
    cost::charged,
    trial::{Candidate, Trial, candidates, settle},
};
pub use crate::report::partial::{Cost, Neglected, Partial, PutBack, Verification, Why};
use crate::{RunError, RunReport, SolveSettings};

/// Solves a network that is compiled already without what is shown to move no measure by more than
/// `bound`; and what that is. The errors of measures include what was left out.
///
/// # Errors
///
/// As [`solve_assembly`](crate::solve_assembly).
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
