//! What each effect of a network adds to its equations, and how much it matters.

use std::sync::Arc;

use dashpot_dae::{Observer, System, switching::Switching};
use dashpot_network::{
    Assembly, Detail, Effect, Influence, Network, Situation,
    effects::{EFFECTS, EffectEntry},
};

use crate::{Partial, SolveSettings, SystemReport, solve_partial};

/// The size of a compiled network.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SystemSize {
    /// Unknowns.
    pub unknowns: usize,
    /// Combinations of phases; as many as fit into the number.
    pub modes: usize,
    /// Entries of the matrices at the start.
    pub entries: usize,
    /// Guards at the start.
    pub guards: usize,
}

impl SystemSize {
    /// Counts what a network was compiled to.
    pub fn of(assembly: &Assembly) -> Self {
        let entries = |system: &System| system.jacobian.nnz() + system.input_matrix.nnz();
        let unknowns = assembly.system.len();
        let Some(phased) = &assembly.switching else {
            return Self { unknowns, modes: 1, entries: entries(&assembly.system), guards: 0 };
        };
        let first = phased.first(0.0).ok();
        let system = first.as_ref().map_or(&assembly.system, |interval| interval.system.as_ref());
        Self {
            unknowns,
            modes: SystemReport::of(assembly).modes,
            entries: entries(system),
            guards: first.as_ref().map_or(0, |interval| interval.guards.len()),
        }
    }
}

/// Whether an effect takes part in a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EffectState {
    /// It does.
    On,
    /// The network does not have it.
    Off,
    /// It is [left out](Partial::left_out), because it matters less than is asked for.
    LeftOut,
    /// It was to be left out, and is [not](Partial::put_back).
    PutBack,
}

/// What contributes.
#[derive(Debug, Clone)]
pub enum Contributor {
    /// An effect of the network.
    Effect(Arc<dyn Effect>),
    /// A kind of effects that the network has not, with its summary.
    Kind(&'static str),
    /// Something else that may be left out.
    Other(Detail),
}

/// What an effect, or another detail of a network, adds to it.
#[derive(Debug, Clone)]
pub struct Contribution {
    /// What it is called, for instance `stop.padding`.
    pub name: String,
    /// Whether it takes part.
    pub state: EffectState,
    /// The size of the network with it and without it, where both can be compiled; with the defaults
    /// of one that is off.
    pub sizes: Option<[SystemSize; 2]>,
    /// The largest of its dimensionless numbers.
    pub influence: Option<Influence>,
    /// What it is.
    pub contributor: Contributor,
}

/// All that is on, and all effects that are off, in the order of the register; of one kind at most
/// `most`. Where the accuracy has a bound for what may be left out, it takes a run to tell what is.
pub fn contributions(
    network: &Network,
    assembly: &Arc<Assembly>,
    settings: &SolveSettings,
    most: usize,
    observer: &mut dyn Observer,
) -> Vec<Contribution> {
    let situation = Situation::of(network, settings.duration);
    let full = SystemSize::of(assembly);
    let is_partial = settings.accuracy.neglect_below.is_some();
    let report = is_partial.then(|| solve_partial(network, assembly, settings, observer).ok());
    let partial = report.flatten().and_then(|report| report.partial);
    let details: Vec<(Detail, Option<Influence>)> = Detail::all(network)
        .into_iter()
        .map(|detail| (detail, Influence::largest(detail.influences(&situation))))
        .collect();
    let on = |(detail, influence): &(Detail, Option<Influence>)| {
        let name = detail.name(network);
        let without = compiled(&network.without(&[*detail]), settings.duration);
        Contribution {
            state: state(&name, partial.as_ref()),
            sizes: without.map(|without| [full, without]),
            influence: influence.clone(),
            name,
            contributor: match detail {
                Detail::Effect(at) => Contributor::Effect(Arc::clone(&network.effects()[*at])),
                other => Contributor::Other(*other),
            },
        }
    };
    let mut all = Vec::new();
    for kind in EFFECTS {
        let is_own = |detail: &Detail| matches!(detail, Detail::Effect(at) if network.effects()[*at].kind() == kind.word);
        let before = all.len();
        all.extend(details.iter().filter(|detail| is_own(&detail.0)).take(most).map(on));
        if all.len() == before {
            all.extend(off(kind, network, &situation, (full, most)));
        }
    }
    let others = details
        .iter()
        .filter(|(detail, influence)| influence.is_some() && !matches!(detail, Detail::Effect(_)));
    all.extend(others.take(most).map(on));
    all
}

fn compiled(network: &Network, duration: f64) -> Option<SystemSize> {
    network.compile(duration).ok().map(|assembly| SystemSize::of(&assembly))
}

/// An effect that is off, with what it would add, or alone where it has no defaults.
fn off(
    kind: &EffectEntry,
    network: &Network,
    situation: &Situation<'_>,
    (full, most): (SystemSize, usize),
) -> Vec<Contribution> {
    let (word, contributor) = (kind.word, Contributor::Kind(kind.summary));
    let alone = Contribution {
        name: word.to_owned(),
        state: EffectState::Off,
        sizes: None,
        influence: None,
        contributor,
    };
    let would_be = (kind.about.would_be)(situation);
    if would_be.is_empty() {
        return vec![alone];
    }
    let would_be = would_be.iter().take(most).map(|effect| {
        let mut with = network.clone();
        with.add_shared_effect(Arc::clone(effect));
        let target = effect.target().map(|own| format!(".{own}")).unwrap_or_default();
        Contribution {
            name: format!("{word}{target}"),
            sizes: compiled(&with, situation.duration).map(|with| [with, full]),
            influence: Influence::largest(effect.influences(situation)),
            ..alone.clone()
        }
    });
    would_be.collect()
}

fn state(name: &str, partial: Option<&Partial>) -> EffectState {
    let Some(partial) = partial else { return EffectState::On };
    if partial.left_out.iter().any(|own| own.effect == name) {
        EffectState::LeftOut
    } else if partial.put_back.iter().any(|own| own.effect == name) {
        EffectState::PutBack
    } else {
        EffectState::On
    }
}
