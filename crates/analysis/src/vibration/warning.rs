//! What should be known of a response, as data.

use std::{f64::consts::TAU, fmt};

use dashpot_dae::frequency::MOST_UNKNOWNS;
use serde::{Serializer, ser::SerializeMap};

use super::{Drive, DriveKind, Limit, LimitKind, Onset};
use crate::wording::quantity;

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
