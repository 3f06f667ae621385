//! What is to be said about a measure, as data.

use std::fmt;

use crate::wording::quantity;

/// What is to be said about a measure.
#[derive(Debug, Clone, PartialEq)]
pub enum Note {
    /// The impact has no end within the run.
    StillInContact,
    /// The contact force pulls from the start, so there is no impact.
    PullsFromTheStart,
    /// There is no contact force.
    NeverLoaded,
    /// The window lies outside the run.
    OutsideTheRun,
    /// The run ends within the window.
    RunEndsBefore,
    /// The window has no length.
    NoLength,
    /// The window is shorter than the time that counts.
    WindowTooShort,
    /// The node has no mass, or is held fixed.
    Massless,
    /// The thickness of the element is not known.
    NoThickness,
    /// The area of the element is not known.
    NoArea,
    /// The force is that of a rigid link in a loop of rigid links.
    NoForce,
    /// The velocity is not a function of time.
    NoVelocity,
    /// There is no node of this name.
    NoNode(String),
    /// The node of this name is not accelerated.
    NotAccelerated(String),
    /// The element touches no impactor.
    NoImpactor,
    /// The ends of the element meet without speed.
    NoApproach,
    /// Masses meet and part at once.
    PartsAtOnce,
    /// The model is not linear, or cannot deform.
    NotLinear,
    /// The model is too stiff for so long a run.
    TooStiff,
    /// The value rises until its window ends.
    StillRising,
    /// The peak is one in tension.
    InTension,
    /// The peak is one in elongation.
    InElongation,
    /// It occurs in this layer, and so deep below the first face \[m\].
    InLayer(String, f64),
    /// It occurs in the branch of this path.
    InBranch(String),
    /// A part would have to be thinner than nothing.
    Crushed,
    /// It is infinite, because speeds jump at this time \[s\].
    Infinite(f64),
    /// The value is beyond the range of double precision.
    BeyondRange,
    /// It has a value at some tolerances only.
    ComesAndGoes,
    /// The signal changes its sign, and of its magnitude the value would be this, in the unit of the measure.
    LargerByMagnitude(f64),
    /// Not determined: it hangs on what is not followed.
    NotFollowed,
    /// Not determined: its error, in this unit, would be this.
    LargeError(f64, &'static str),
    /// Not determined: the force of a slider is so from one time to another \[s\].
    IdleSlider(f64, f64),
    /// What a measure of one's own has to say.
    Other {
        /// In one word that stays the same.
        code: &'static str,
        /// In words.
        text: String,
    },
}

impl Note {
    /// What kind of note it is, in one word that stays the same.
    pub fn code(&self) -> &'static str {
        match self {
            Self::StillInContact => "still-in-contact",
            Self::PullsFromTheStart => "pulls-from-the-start",
            Self::NeverLoaded => "never-loaded",
            Self::OutsideTheRun => "outside-the-run",
            Self::RunEndsBefore => "run-ends-before",
            Self::NoLength => "no-length",
            Self::WindowTooShort => "window-too-short",
            Self::Massless => "massless",
            Self::NoThickness => "no-thickness",
            Self::NoArea => "no-area",
            Self::NoForce => "no-force",
            Self::NoVelocity => "no-velocity",
            Self::NoNode(_) => "no-node",
            Self::NotAccelerated(_) => "not-accelerated",
            Self::NoImpactor => "no-impactor",
            Self::NoApproach => "no-approach",
            Self::PartsAtOnce => "parts-at-once",
            Self::NotLinear => "not-linear",
            Self::TooStiff => "too-stiff",
            Self::StillRising => "still-rising",
            Self::InTension => "in-tension",
            Self::InElongation => "in-elongation",
            Self::InLayer(..) => "in-layer",
            Self::InBranch(_) => "in-branch",
            Self::Crushed => "crushed",
            Self::Infinite(_) => "infinite",
            Self::BeyondRange => "beyond-range",
            Self::ComesAndGoes => "comes-and-goes",
            Self::LargerByMagnitude(_) => "larger-by-magnitude",
            Self::NotFollowed => "not-followed",
            Self::LargeError(..) => "large-error",
            Self::IdleSlider(..) => "idle-slider",
            Self::Other { code, .. } => code,
        }
    }

    /// Whether it says where a value occurs, or which way it points.
    pub fn is_place(&self) -> bool {
        matches!(self, Self::InTension | Self::InElongation | Self::InLayer(..) | Self::InBranch(_))
    }

    /// Several ones in words.
    pub fn joined(notes: &[Self]) -> String {
        notes.iter().map(Self::to_string).collect::<Vec<_>>().join("; ")
    }
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = match self {
            Self::StillInContact => "still in contact at the end of the run",
            Self::PullsFromTheStart => "the contact force pulls from the start",
            Self::NeverLoaded => "there is never a contact force",
            Self::OutsideTheRun => "the window lies outside the run",
            Self::RunEndsBefore => "the run ends before the window does",
            Self::NoLength => "the window has no length",
            Self::WindowTooShort => "the window is shorter than the time that counts",
            Self::Massless => "the node has no mass, or is held fixed",
            Self::NoThickness => "its thickness is not known: give it a `thickness` or `layers`",
            Self::NoArea => "its area is not known: give it `thickness` and `area`, or `layers`",
            Self::NoForce => "the force is undetermined in a loop of rigid links",
            Self::NoVelocity => "the velocity of this massless node jumps with the loads' rates",
            Self::NoNode(node) => return write!(f, "there is no node `{node}`"),
            Self::NotAccelerated(node) => return write!(f, "`{node}` is not accelerated"),
            Self::NoImpactor => "it touches no impactor",
            Self::NoApproach => "the ends meet without speed",
            Self::PartsAtOnce => "masses meet and part at once",
            Self::NotLinear => "its model is not linear, or cannot deform",
            Self::TooStiff => "its model is too stiff for so long a run",
            Self::StillRising => "still rising at the end of its window",
            Self::InTension => "in tension",
            Self::InElongation => "in elongation",
            Self::InLayer(layer, depth) => {
                let depth = quantity(*depth, "m");
                return write!(f, "in the layer {layer}, {depth} below the first face");
            }
            Self::InBranch(path) => return write!(f, "in {path}"),
            Self::Crushed => "pressed in by more than its thickness",
            Self::Infinite(time) => {
                return write!(f, "infinite (speed jumps at {})", quantity(*time, "s"));
            }
            Self::BeyondRange => "beyond the range of double precision",
            Self::ComesAndGoes => "it has a value at some tolerances only",
            Self::LargerByMagnitude(value) => {
                let value = quantity(*value, "s");
                let value = value.trim_end_matches(" s");
                return write!(
                    f,
                    "it swings back, which takes from this: of its magnitude {value}"
                );
            }
            Self::NotFollowed => "not determined: it hangs on what is not followed",
            Self::LargeError(error, unit) => {
                return write!(f, "not determined: its error would be {}", quantity(*error, unit));
            }
            Self::IdleSlider(from, to) => {
                let [from, to] = [from, to].map(|time| quantity(*time, "s"));
                return write!(
                    f,
                    "not determined: the force of a slider is so from {from} to {to}"
                );
            }
            Self::Other { text, .. } => text,
        };
        write!(f, "{text}")
    }
}
