//! What can go wrong with a run.

use dashpot_dae::SolveError;
use dashpot_network::NetworkErrors;
use dashpot_units::nearest;
use thiserror::Error;

use crate::{Leak, Note, SliderFault};

/// Why a run has no report.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum RunError {
    /// The network cannot be turned into a system.
    #[error(transparent)]
    Network(#[from] NetworkErrors),
    /// The method did not deliver a trajectory.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// No method that `auto` turns to gets through.
    #[error("{error}{}", fail_too(.others))]
    NoneGetsThrough {
        /// What became of the first one.
        error: SolveError,
        /// The others.
        others: Vec<&'static str>,
    },
    /// A comparison of methods would take more work than it may.
    #[error(
        "`{method}` is given up at {time:.3e} s: with it the comparison takes more work than it may, that \
         of {most} steps in all; make the run shorter"
    )]
    TooMuchWork {
        /// The method's name.
        method: &'static str,
        /// Time reached \[s\].
        time: f64,
        /// The limit, in steps.
        most: usize,
    },
    /// The network takes more memory than a run may.
    #[error(
        "{parts} parts with {unknowns} unknowns take some {} GB to be solved, and a run may take {}; join \
         parts that are alike, or use fewer masses",
        gigabytes(*.bytes),
        gigabytes(*.limit)
    )]
    TooMuchMemory {
        /// Springs, dashpots and the like.
        parts: u64,
        /// Unknowns.
        unknowns: u64,
        /// What they take, foreseen \[B\].
        bytes: u64,
        /// What they may take \[B\].
        limit: u64,
    },
    /// There is no such method.
    #[error("unknown method `{name}`; known methods: {}", .known.join(", "))]
    UnknownMethod {
        /// What was asked for.
        name: String,
        /// What there is.
        known: Vec<&'static str>,
    },
    /// A measure is asked of something that does not exist.
    #[error(
        "`{kind}` is asked of `{target}`, but there is no such {family}; known: {}",
        .known.join(", ")
    )]
    UnknownTarget {
        /// The measure's word.
        kind: &'static str,
        /// What it is asked of.
        target: String,
        /// `element` or `node`.
        family: &'static str,
        /// Names of that family.
        known: Vec<String>,
    },
    /// A measure that an accuracy is asked of, or a cost, and that is not reported.
    #[error("`{key}` is not among the measures that are reported")]
    UnknownMeasure {
        /// What was asked for.
        key: String,
        /// What is reported.
        known: Vec<String>,
    },
    /// A measure that there is not.
    #[error("there is no measure `{key}`")]
    NoMeasure {
        /// What was asked for.
        key: String,
        /// What is reported.
        known: Vec<String>,
    },
    /// The run is to stop at a level of an output that does not exist.
    #[error(
        "the run is to stop by `{output}`, but there is no such output; known: {}",
        .known.join(", ")
    )]
    UnknownOutput {
        /// What was asked for.
        output: String,
        /// What there is.
        known: Vec<String>,
    },
    /// A setting is out of its range.
    #[error("`{setting}` must be {range}, but it is {value}")]
    InvalidSetting {
        /// The setting, or the measure whose accuracy it is.
        setting: String,
        /// Its range in words.
        range: &'static str,
        /// What was given.
        value: f64,
    },
    /// A part of a large solution was asked for that had not been kept.
    #[error(
        "not all of so large a solution is kept, and what was left out is needed: {}",
        .outputs.join(", ")
    )]
    NotKept {
        /// Names of the outputs.
        outputs: Vec<String>,
    },
    /// The energies have no numbers.
    #[error("the energies of the run are beyond the range of double precision")]
    BeyondRange,
    /// Energy appeared or vanished.
    #[error(
        "the solution of `{method}` cannot be trusted: {} of the energy turned over {}{}",
        crate::wording::percent(.closure.abs()),
        if *.closure > 0.0 { "is missing" } else { "is too much" },
        .leak.as_ref().map_or(String::new(), |leak| format!(", {leak}"))
    )]
    EnergyLost {
        /// The method that was used.
        method: &'static str,
        /// The part of the energy turned over that is missing; negative if there is too much.
        closure: f64,
        /// When and where, as far as that can be told.
        leak: Option<Leak>,
    },
    /// A dry slider did what none can.
    #[error("the solution of `{method}` cannot be trusted: {fault}")]
    Slider {
        /// The method that was used.
        method: &'static str,
        /// What, where and when.
        fault: SliderFault,
    },
}

/// Why a report has no value of a measure.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum NoValue {
    /// It does not report it.
    #[error("`{key}` is not among the measures that are reported{}", meant(.near))]
    Unknown {
        /// What was asked for.
        key: String,
        /// What is reported of the same element or node, or else in all, the nearest first.
        near: Vec<String>,
    },
    /// It is infinite, undefined or not determined.
    #[error("`{key}` has no value: {}", Note::joined(.notes))]
    Undefined {
        /// The measure.
        key: String,
        /// Why.
        notes: Vec<Note>,
    },
}

impl NoValue {
    /// That `known` do not have `key`.
    pub(crate) fn unknown(key: &str, known: &[&str]) -> Self {
        let target = key.rsplit_once('.').map_or(key, |own| own.0);
        let mut near: Vec<&str> = known
            .iter()
            .copied()
            .filter(|own| own.rsplit_once('.').is_some_and(|own| own.0 == target))
            .collect();
        if near.is_empty() {
            near.extend(known);
        }
        if let Some(nearest) = nearest(key, near.iter().copied()) {
            near.sort_by_key(|own| *own != nearest);
        }
        Self::Unknown { key: key.to_owned(), near: near.into_iter().map(str::to_owned).collect() }
    }
}

/// Measures that a message names.
const SHOWN: usize = 6;

fn meant(near: &[String]) -> String {
    let shown: Vec<String> = near.iter().take(SHOWN).map(|own| format!("`{own}`")).collect();
    match (shown.is_empty(), near.len() > SHOWN) {
        (true, _) => String::new(),
        (false, more) => {
            format!("; did you mean {}{}?", shown.join(", "), if more { ", …" } else { "" })
        }
    }
}

fn gigabytes(bytes: u64) -> String {
    let tenths = bytes.div_ceil(100_000_000);
    format!("{}.{}", tenths / 10, tenths % 10)
}

/// That other methods fail as well, if there are any.
fn fail_too(others: &[&str]) -> String {
    match others {
        [] => String::new(),
        [one] => format!("; `{one}` fails, too"),
        all => format!("; {} fail, too", listed(all)),
    }
}

/// The words in a sentence.
fn listed(words: &[&str]) -> String {
    let quoted: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
    quoted.join(" and ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_measure_that_is_not_reported_finds_the_nearest_ones() {
        let known = ["head.peak-acceleration", "pad.peak-deformation", "pad.peak-force"];
        let says = |key: &str| NoValue::unknown(key, &known).to_string();
        let all = says("pad.peak-forse");
        assert!(all.ends_with("; did you mean `pad.peak-force`, `pad.peak-deformation`?"), "{all}");
        assert!(says("pat.peak-force").contains("mean `pad.peak-force`, `head."));
        assert!(NoValue::unknown("a.b", &[]).to_string().ends_with("reported"));
    }
}
