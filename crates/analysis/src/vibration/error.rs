//! Why there is no steady oscillation.

use dashpot_dae::frequency::FrequencyError;
use dashpot_network::NetworkErrors;
use thiserror::Error;

/// Why a network cannot be looked at over frequency.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum VibrationError {
    /// The network cannot be turned into a system.
    #[error(transparent)]
    Network(#[from] NetworkErrors),
    /// An element does not answer to a sine with a sine.
    #[error("{part} is not linear ({law}): what is shaken in a sine does not answer with one")]
    NotLinear {
        /// The element or the effect, in words.
        part: String,
        /// Its law, in words.
        law: String,
    },
    /// Nothing keeps a contact closed.
    #[error(
        "nothing presses `{contact}` together at rest, so it parts in every oscillation: what is \
         shaken in a sine does not answer with one"
    )]
    Loose {
        /// The contact.
        contact: String,
    },
    /// A stop bears force at rest.
    #[error(
        "`{stop}` is reached at rest, so it is met in every oscillation: what is shaken in a sine \
         does not answer with one"
    )]
    OnStop {
        /// The stop.
        stop: String,
    },
    /// It cannot be told how the network rests under its weights.
    #[error("how it rests under its weights cannot be told: {error}")]
    Rest {
        /// Why, in words.
        error: String,
    },
    /// The equations cannot be solved over frequency.
    #[error(transparent)]
    Frequency(#[from] FrequencyError),
    /// It has not been said what shakes the network.
    #[error(
        "{} drives the network; {}",
        if *.loads_and_motions == 0 { "neither a load nor a motion" } else { "more than one load or motion" },
        choices(.known)
    )]
    NoDrive {
        /// Loads and given motions that there are.
        loads_and_motions: usize,
        /// What can drive: loads, and nodes that are moved or fixed.
        known: Vec<String>,
    },
    /// There is no such load, and no such node that is moved or fixed.
    #[error("`{name}` is no load, and no node that is moved or fixed; {}", there_is(.known))]
    UnknownDrive {
        /// What was asked for.
        name: String,
        /// What there is.
        known: Vec<String>,
    },
    /// A load on what is held.
    #[error("`{load}` pushes against `{node}`, which is held: nothing moves")]
    LoadOnSupport {
        /// The load.
        load: String,
        /// Its node.
        node: String,
    },
    /// There is no such node to be looked at.
    #[error("`{name}` is no {sought}; {}", there_is(.known))]
    UnknownNode {
        /// What was asked for.
        name: String,
        /// `node that can move`, or `support`.
        sought: &'static str,
        /// What there is.
        known: Vec<String>,
    },
    /// Nothing answers to the drive.
    #[error("there is no {sought} to which anything could be transmitted")]
    NothingToSee {
        /// `mass that can move`, or `support`.
        sought: &'static str,
    },
    /// A setting is out of its range.
    #[error("`{setting}` must be {range}, but it is {value}")]
    InvalidSetting {
        /// The setting.
        setting: &'static str,
        /// Its range in words.
        range: &'static str,
        /// What was given.
        value: f64,
    },
    /// The oscillation has no limit, or cannot be told.
    #[error("there is no steady oscillation at {frequency} Hz: nothing damps it there")]
    Unbounded {
        /// The frequency \[Hz\].
        frequency: f64,
    },
}

/// What there is, in words.
fn there_is(known: &[String]) -> String {
    match known {
        [] => "there is none".to_owned(),
        [only] => format!("there is only `{only}`"),
        several => format!("there are {}", several.join(", ")),
    }
}

/// What can drive, in words.
fn choices(known: &[String]) -> String {
    if known.is_empty() {
        "there is nothing to shake: no load, and no node that is moved or held".to_owned()
    } else {
        format!("name the drive: {}", known.join(", "))
    }
}
