//! What happens in a run, as data.

use serde::{Serialize, Serializer, ser::SerializeMap};
use thiserror::Error;

use super::serialized::serialized;
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

dashpot_units::words! {
    /// What happens in a run.
    #[derive(Debug, Clone, PartialEq, Error)]
    pub enum Event, pub fn code(&self) {
        /// A condition that was asked for is met.
        #[error("{}", .stop.text(unit))]
        Condition {
            /// The condition.
            stop: Stop,
            /// SI unit of its level.
            unit: &'static str,
        } = "condition-met",
        /// The force of an element that nothing lets part turns to tension.
        #[error("{element} force turns to tension")]
        Tension {
            /// The element.
            element: String,
        } = "tension",
        /// A node meets an element from which it can part.
        #[error("{} meets the {}{}", .sides[0], .sides[1], met(*.again, *.collision))]
        Meets {
            /// The node, and the element.
            sides: [String; 2],
            /// Whether they have met before.
            again: bool,
            /// The impulse with which they meet, where masses do.
            collision: Option<Collision>,
        } = "meets",
        /// A node leaves an element.
        #[error("{} leaves the {}", .sides[0], .sides[1])]
        Leaves {
            /// The node, and the element.
            sides: [String; 2],
        } = "leaves",
        /// A contact closes.
        #[error("{contact} closes{}", met(*.again, *.collision))]
        Closes {
            /// The contact.
            contact: String,
            /// Whether it has been closed before.
            again: bool,
            /// The impulse with which masses meet in it, where they do.
            collision: Option<Collision>,
        } = "closes",
        /// A contact opens.
        #[error("{contact} opens")]
        Opens {
            /// The contact.
            contact: String,
        } = "opens",
        /// Masses meet in a contact that was closed, or that opens again at once.
        #[error("{contact}: {collision}")]
        Impact {
            /// The contact.
            contact: String,
            /// The impulse.
            collision: Collision,
        } = "impact",
        /// An impulse goes through a closed contact.
        #[error("{contact} passes on {}", quantity(*.impulse, "N s"))]
        PassesOn {
            /// The contact.
            contact: String,
            /// The impulse \[N s\].
            impulse: f64,
        } = "passes-on",
        /// Another element changes its phase.
        #[error("{part}: {phase}")]
        Phase {
            /// The element, or its path.
            part: String,
            /// Word for the phase.
            phase: &'static str,
        } = "phase",
    }
}

/// An impulse with which masses meet.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error("impact of {}, which loses {}", quantity(*.impulse, "N s"), quantity(*.lost, "J"))]
pub struct Collision {
    /// The impulse \[N s\].
    pub impulse: f64,
    /// The kinetic energy that it loses \[J\].
    pub lost: f64,
}

serialized!(EventReport, own => {
    "time" => own.time,
    "error" => own.error,
    "what" => own.what.to_string(),
    "code" => own.what.code(),
});

/// How masses meet, behind what else is said of that.
fn met(again: bool, collision: Option<Collision>) -> String {
    let again = if again { " again" } else { "" };
    again.to_owned() + &collision.map_or(String::new(), |own| format!(": {own}"))
}
