//! Why there is no steady oscillation, and what should be known of one.

use std::{f64::consts::TAU, fmt};

use dashpot_dae::frequency::MOST_UNKNOWNS;
use dashpot_network::{Assembly, Network, NetworkErrors, elements::Law, first_nonlinear};
use dashpot_units::nearest;
use serde::{Serializer, ser::SerializeMap};
use thiserror::Error;

use super::{Drive, DriveKind, Limit, LimitKind, Onset};
use crate::wording::quantity;

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
    /// It does not come to rest under its weights.
    #[error(
        "it does not come to rest under its weights, which press a contact together or towards a \
         stop: let springs carry them"
    )]
    Rest,
    /// It was asked to end.
    #[error("it was asked to end")]
    Cancelled,
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
    #[error("`{name}` is no load, and no node that is moved or fixed; {}", there_is(.name, .known))]
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
    #[error("`{name}` is no {sought}; {}", there_is(.name, .known))]
    UnknownNode {
        /// What was asked for.
        name: String,
        /// `node that can move`, `support`, or `quantity`.
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
    /// The highest frequency is not above the lowest.
    #[error("the highest frequency, {high} Hz, must be above the lowest, {low} Hz")]
    EmptyRange {
        /// The lowest frequency \[Hz\].
        low: f64,
        /// The highest \[Hz\].
        high: f64,
    },
    /// The oscillation has no limit, or cannot be told.
    #[error("there is no steady oscillation at {frequency} Hz: nothing damps it there")]
    Unbounded {
        /// The frequency \[Hz\].
        frequency: f64,
    },
}

/// What there is in place of `name`, in words.
fn there_is(name: &str, known: &[String]) -> String {
    let near = nearest(name, known.iter().map(String::as_str));
    let meant = near.map(|near| format!("did you mean `{near}`? ")).unwrap_or_default();
    match known {
        [] => "there is none".to_owned(),
        [only] => format!("there is only `{only}`"),
        several => format!("{meant}there are {}", several.join(", ")),
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

/// Refuses a network with a part that is not linear, by the name of that part.
pub(super) fn require_linear(network: &Network) -> Result<(), VibrationError> {
    for connection in network.connections() {
        if let Some(element) = first_nonlinear(&connection.model) {
            return Err(VibrationError::NotLinear {
                part: format!("the element `{}`", connection.name),
                law: element.kind().to_owned(),
            });
        }
    }
    Ok(())
}

/// The same for what the network was compiled to, where an effect may have put in more: by the name of that element.
pub(super) fn require_linear_system(assembly: &Assembly) -> Result<(), VibrationError> {
    if assembly.system.terms.is_empty() && assembly.switching.is_none() {
        return Ok(());
    }
    let is_linear = |law: Law| matches!(law, Law::Spring(_) | Law::Dashpot(_) | Law::Rigid);
    let found = assembly.connections.iter().find_map(|connection| {
        let mut own = assembly.primitives.get(connection.primitives.clone())?.iter();
        let primitive = own.find(|primitive| !is_linear(primitive.element.law()))?;
        Some((format!("the element `{}`", connection.name), primitive.element.kind().to_owned()))
    });
    let (part, law) = found.unwrap_or_else(|| ("the scene".to_owned(), "its equations".to_owned()));
    Err(VibrationError::NotLinear { part, law })
}

/// What is wrong with a steady oscillation as a picture of the scene, or with a sweep.
#[derive(Debug, Clone, PartialEq)]
pub enum VibrationWarning {
    /// A contact would part, or a stop be reached.
    Exceeded {
        /// Which.
        limit: Limit,
        /// The frequency \[Hz\].
        frequency: f64,
        /// The amplitude of what is limited \[N or m\].
        amplitude: f64,
    },
    /// A pad would be pressed in by more than its thickness.
    PressedThrough {
        /// The pad.
        element: String,
    },
    /// A limit is reached somewhere in a sweep.
    Onset {
        /// Where first.
        onset: Onset,
        /// What shakes the network.
        drive: Drive,
    },
    /// The network is too large for its natural frequencies to be known.
    ManyUnknowns,
}

impl VibrationWarning {
    /// What kind of warning it is, in one word that stays the same.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Exceeded { limit, .. } => match limit.kind {
                LimitKind::Parting => "parts",
                LimitKind::Stop => "stop-reached",
            },
            Self::PressedThrough { .. } => "pressed-through",
            Self::Onset { onset, .. } => match onset.limit.kind {
                LimitKind::Parting => "parts-first",
                LimitKind::Stop => "stop-reached-first",
            },
            Self::ManyUnknowns => "many-unknowns",
        }
    }
}

/// Warnings in words, and their codes, as entries of an object.
pub(super) fn serialize<S: Serializer>(
    warnings: &[VibrationWarning],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    let texts: Vec<String> = warnings.iter().map(VibrationWarning::to_string).collect();
    let codes: Vec<&str> = warnings.iter().map(VibrationWarning::code).collect();
    let mut object = serializer.serialize_map(Some(2))?;
    object.serialize_entry("warnings", &texts)?;
    object.serialize_entry("warning_codes", &codes)?;
    object.end()
}

impl fmt::Display for VibrationWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Exceeded { limit, frequency, amplitude } => {
                let (name, frequency) = (&limit.name, quantity(*frequency, "Hz"));
                let [swing, reserve] =
                    [*amplitude, limit.reserve].map(|own| quantity(own, limit.kind.unit()));
                match limit.kind {
                    LimitKind::Parting => write!(
                        f,
                        "`{name}` parts at {frequency}: its force would swing by {swing}, and only \
                         {reserve} press it together at rest; these amplitudes do not hold"
                    ),
                    LimitKind::Stop => write!(
                        f,
                        "`{name}` is reached at {frequency}: the deformation would swing by {swing}, \
                         and {reserve} are left at rest; these amplitudes do not hold"
                    ),
                }
            }
            Self::PressedThrough { element } => {
                write!(f, "`{element}` would be pressed together by more than its thickness")
            }
            Self::Onset { onset: Onset { limit, frequency, amplitude }, drive } => {
                let what = match limit.kind {
                    LimitKind::Parting => "parts",
                    LimitKind::Stop => "is reached",
                };
                let omega = TAU * frequency;
                let size = match drive.kind {
                    DriveKind::Load => quantity(*amplitude, "N"),
                    DriveKind::Motion => format!(
                        "{} ({})",
                        quantity(*amplitude, "m"),
                        quantity(amplitude * omega * omega, "m/s^2")
                    ),
                };
                write!(
                    f,
                    "`{}` {what} first at {}, where `{}` swings by more than {size}; the ratios hold \
                     below that",
                    limit.name,
                    quantity(*frequency, "Hz"),
                    drive.name
                )
            }
            Self::ManyUnknowns => write!(
                f,
                "the network has more than {MOST_UNKNOWNS} unknowns: resonances that are very \
                 narrow may be missed"
            ),
        }
    }
}
