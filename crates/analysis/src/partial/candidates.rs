//! What may be left out, by estimate.

use dashpot_network::{Detail, Influence, Network, Situation};

use super::{Cost, Neglected, PutBack, Why};
use crate::{RunError, SolveSettings, reported_measures};

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
    fn from(own: Candidate) -> Self {
        Self { effect: own.name, influence: own.influence, alone: own.alone }
    }
}
