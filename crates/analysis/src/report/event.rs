//! What happens in a run, as data.

use std::fmt;

use serde::{Serialize, Serializer, ser::SerializeStruct};

use crate::{Stop, wording::quantity};

/// Something that happened.
#[derive(Debug, Clone, PartialEq)]
pub struct EventReport {
    /// When \[s\].
    pub time: f64,
    /// Its absolute error \[s\], as that of a measure: a bound, or from further solutions; infinite where the event comes
    /// and goes with the tolerance, `None` where nothing is known of it.
    pub error: Option<f64>,
    /// What.
    pub what: Event,
    /// Whether it ended the run.
    pub stops: bool,
}

/// What happens in a run.
#[derive(Debug, Clone, PartialEq)]
pub enum Event {
    /// A condition that was asked for is met.
    Condition {
        /// The condition.
        stop: Stop,
        /// SI unit of its level.
        unit: &'static str,
    },
    /// The force of an element that nothing lets part turns to tension.
    Tension {
        /// The element.
        element: String,
    },
    /// A node meets an element from which it can part.
    Meets {
        /// The node, and the element.
        sides: [String; 2],
        /// Whether they have met before.
        again: bool,
        /// The impulse with which they meet, where masses do.
        collision: Option<Collision>,
    },
    /// A node leaves an element.
    Leaves {
        /// The node, and the element.
        sides: [String; 2],
    },
    /// A contact closes.
    Closes {
        /// The contact.
        contact: String,
        /// Whether it has been closed before.
        again: bool,
        /// The impulse with which masses meet in it, where they do.
        collision: Option<Collision>,
    },
    /// A contact opens.
    Opens {
        /// The contact.
        contact: String,
    },
    /// Masses meet in a contact that was closed, or that opens again at once.
    Impact {
        /// The contact.
        contact: String,
        /// The impulse.
        collision: Collision,
    },
    /// An impulse goes through a closed contact.
    PassesOn {
        /// The contact.
        contact: String,
        /// The impulse \[N s\].
        impulse: f64,
    },
    /// Another element changes its phase.
    Phase {
        /// The element, or its path.
        part: String,
        /// Word for the phase.
        phase: &'static str,
    },
}

/// An impulse with which masses meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Collision {
    /// The impulse \[N s\].
    pub impulse: f64,
    /// The kinetic energy that it loses \[J\].
    pub lost: f64,
}

impl Event {
    /// What kind of event it is, in one word that stays the same.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Condition { .. } => "condition-met",
            Self::Tension { .. } => "tension",
            Self::Meets { .. } => "meets",
            Self::Leaves { .. } => "leaves",
            Self::Closes { .. } => "closes",
            Self::Opens { .. } => "opens",
            Self::Impact { .. } => "impact",
            Self::PassesOn { .. } => "passes-on",
            Self::Phase { .. } => "phase",
        }
    }
}

impl Serialize for EventReport {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut object = serializer.serialize_struct("EventReport", 4)?;
        object.serialize_field("time", &self.time)?;
        object.serialize_field("error", &self.error)?;
        object.serialize_field("what", &self.what.to_string())?;
        object.serialize_field("code", self.what.code())?;
        object.end()
    }
}

impl fmt::Display for Collision {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (impulse, lost) = (quantity(self.impulse, "N s"), quantity(self.lost, "J"));
        write!(f, "impact of {impulse}, which loses {lost}")
    }
}

impl fmt::Display for Event {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let told = |collision: &Option<Collision>| {
            collision.map_or(String::new(), |collision| format!(": {collision}"))
        };
        let again = |again: &bool| if *again { " again" } else { "" };
        match self {
            Self::Condition { stop, unit } => write!(f, "{}", stop.text(unit)),
            Self::Tension { element } => write!(f, "{element} force turns to tension"),
            Self::Meets { sides: [node, element], again: is_again, collision } => {
                write!(f, "{node} meets the {element}{}{}", again(is_again), told(collision))
            }
            Self::Leaves { sides: [node, element] } => write!(f, "{node} leaves the {element}"),
            Self::Closes { contact, again: is_again, collision } => {
                write!(f, "{contact} closes{}{}", again(is_again), told(collision))
            }
            Self::Opens { contact } => write!(f, "{contact} opens"),
            Self::Impact { contact, collision } => write!(f, "{contact}: {collision}"),
            Self::PassesOn { contact, impulse } => {
                write!(f, "{contact} passes on {}", quantity(*impulse, "N s"))
            }
            Self::Phase { part, phase } => write!(f, "{part}: {phase}"),
        }
    }
}
