//! What can be wrong with a network.

use std::fmt;

use dashpot_rheology::MOST_LEVELS;
use thiserror::Error;

use crate::parameters::InvalidParameter;

/// The part of a network that an error is about.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Subject {
    /// A node, by name.
    Node(String),
    /// A connection, by name, and the path of the part within its model (empty for the whole).
    Element {
        /// Name of the connection.
        name: String,
        /// Names of the branches that lead to the part.
        path: Vec<String>,
    },
    /// A load, by name.
    Load(String),
    /// An effect, by its word.
    Effect(&'static str),
    /// An effect on one element, by its word and the element's name.
    EffectOn(&'static str, String),
}

/// Why a network cannot be turned into a system.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum NetworkError {
    /// Two things of one family have the same name.
    #[error("there are two {family} named `{name}`")]
    DuplicateName {
        /// `nodes`, `elements` or `loads`.
        family: &'static str,
        /// The name.
        name: String,
        /// The second one.
        subject: Subject,
    },
    /// A parameter is out of its range.
    #[error("{invalid}")]
    Invalid {
        /// What it belongs to.
        subject: Subject,
        /// Parameter, range and value.
        invalid: InvalidParameter,
    },
    /// A model that nests too deeply.
    #[error("the model of `{element}` nests more than {MOST_LEVELS} levels deep")]
    TooDeep {
        /// The element.
        element: String,
    },
    /// Both ends of an element are one node.
    #[error("both ends of `{element}` are at `{node}`")]
    BothEndsAtOneNode {
        /// The element.
        element: String,
        /// The node.
        node: String,
    },
    /// A massless node that no element touches.
    #[error("`{node}` has no mass and no element holds it: its motion is undetermined")]
    IsolatedNode {
        /// The node.
        node: String,
    },
    /// Massless nodes whose place follows from nothing.
    #[error(
        "the place of {} is undetermined: massless, and no spring or dashpot ties {} to a mass, \
         a fixed node or a prescribed motion",
        quoted(.nodes),
        if .nodes.len() == 1 { "it" } else { "them" }
    )]
    Undetermined {
        /// The nodes, by name.
        nodes: Vec<String>,
    },
    /// Massless nodes whose place follows from nothing while contacts are open.
    #[error(
        "while its contacts are open, the place of {} is undetermined: it has no mass, and nothing \
         else tells where it is; let the pad part at one end only, give it a `face` with mass, or \
         put a dashpot beside what may go slack",
        quoted(.nodes)
    )]
    Loose {
        /// The nodes, by name.
        nodes: Vec<String>,
    },
    /// A mass is asked to start with a speed that it cannot have.
    #[error("`{node}` has a start speed but {reason}")]
    StartSpeed {
        /// The node.
        node: String,
        /// Why it cannot have one.
        reason: &'static str,
    },
    /// Rigidly linked nodes are asked to move differently.
    #[error("`{first}` and `{second}` are rigidly linked, but {difference}")]
    ContradictingMotions {
        /// One node.
        first: String,
        /// The other node.
        second: String,
        /// How their motions contradict each other.
        difference: &'static str,
    },
    /// A prescribed displacement jumps across dashpots only.
    #[error(
        "the motion of `{node}` jumps at {time} s, and only dashpots lead from it to `{other}`: \
         the force would be infinite; give the jump a rise time"
    )]
    StepAcrossDashpots {
        /// The node that jumps.
        node: String,
        /// Where the dashpots lead.
        other: String,
        /// When \[s\].
        time: f64,
    },
    /// A prescribed displacement jumps in a network with contacts.
    #[error(
        "the motion of `{node}` jumps at {time} s, and it may jump through a contact: give the jump a \
         rise time"
    )]
    StepThroughContact {
        /// The node that jumps.
        node: String,
        /// When \[s\].
        time: f64,
    },
    /// A run reaches beyond a table that must not be used there.
    #[error(
        "the table of {} `{name}` is given from {from} s to {to} s, and the run lasts from 0 s to \
         {duration} s: its `outside = \"error\"` forbids that; let the run end with the table, or write \
         \"hold\" or \"zero\"",
        if *.is_load { "the load" } else { "the motion of" }
    )]
    OutsideTable {
        /// The load, or the node that is moved.
        name: String,
        /// Whether it is a load.
        is_load: bool,
        /// Time of the first point \[s\].
        from: f64,
        /// Time of the last point \[s\].
        to: f64,
        /// Length of the run \[s\].
        duration: f64,
    },
    /// The prescribed motion of a mass asks for an infinite force.
    #[error(
        "the motion of `{node}` {fault} at {time} s, and {} mass: the force would be infinite; \
         prescribe the motion of a node without mass, or one that is smooth",
        bearer(.node, .heavy)
    )]
    MotionOfMass {
        /// The node.
        node: String,
        /// What has the mass: the node, or one that moves with it.
        heavy: String,
        /// `jumps` or `has a kink`.
        fault: &'static str,
        /// When \[s\].
        time: f64,
    },
    /// A weight or load that nothing holds cannot start in balance.
    #[error(
        "{} cannot start in balance: no spring carries the load to a fixed or prescribed node; \
         choose `start = \"unloaded\"`",
        quoted(.nodes)
    )]
    NoBalance {
        /// The nodes that would sink, by name.
        nodes: Vec<String>,
    },
    /// An effect acts on an element that the network does not have.
    #[error("`{effect}.{element}` acts on no element: there is none named `{element}`")]
    NoElement {
        /// Word of the effect.
        effect: &'static str,
        /// The element.
        element: String,
    },
    /// An effect acts at a node that is no end of its element.
    #[error(
        "`{effect}.{element}` is at `{node}`, but `{element}` is between `{}` and `{}`",
        .ends[0],
        .ends[1]
    )]
    NotAnEnd {
        /// Word of the effect.
        effect: &'static str,
        /// The element.
        element: String,
        /// The node.
        node: String,
        /// The nodes at the element's ends.
        ends: [String; 2],
    },
    /// A face is to have mass at another end than the one that separates.
    #[error(
        "`face.{element}` is at `{face}`, but `separation.{element}` opens at `{separation}`: \
         they are to be at one node"
    )]
    TwoFaces {
        /// The element.
        element: String,
        /// The node on whose side the mass is.
        face: String,
        /// The node at which the element opens.
        separation: String,
    },
    /// A stop whose depth is not known.
    #[error("`stop.{element}` has no `at`, and `{element}` has no thickness from which it follows")]
    NoDepth {
        /// The element.
        element: String,
    },
    /// The force in a closed contact, a slider that sticks or a rigid link follows from nothing.
    #[error(
        "the force in `{element}` is undetermined: another rigid way leads around it; give one of \
         the parts a stiffness"
    )]
    UndeterminedForce {
        /// Path of the part.
        element: String,
    },
    /// The rate of a part that switches follows from unknowns that have no rate.
    #[error(
        "how fast `{element}` deforms does not follow from its neighbours: put a dashpot beside a \
         part that it is in series with"
    )]
    UndeterminedRate {
        /// Path of the part.
        element: String,
    },
    /// All that moves a network that switches is so small that it cannot be divided by.
    #[error(
        "nothing moves by enough to be solved for: where a network switches, speeds, forces and \
         motions may not all be as small as this; {what} is {value:e} {unit}, and one over that is \
         beyond the range of numbers"
    )]
    TooFaint {
        /// What is too small.
        what: &'static str,
        /// Its value.
        value: f64,
        /// Its unit.
        unit: &'static str,
    },
    /// A number became too large or too small for double precision.
    #[error("the constants of the network are too far apart: {what} is {value:e} in {unit}")]
    OutOfScale {
        /// What left the range.
        what: &'static str,
        /// Its value.
        value: f64,
        /// Its unit.
        unit: &'static str,
    },
}

impl NetworkError {
    /// The part that the error is about.
    pub fn subject(&self) -> Option<Subject> {
        let node = |name: &String| Some(Subject::Node(name.clone()));
        match self {
            Self::DuplicateName { subject, .. } | Self::Invalid { subject, .. } => {
                Some(subject.clone())
            }
            Self::BothEndsAtOneNode { element, .. } | Self::TooDeep { element } => {
                Some(Subject::Element { name: element.clone(), path: Vec::new() })
            }
            Self::IsolatedNode { node: name }
            | Self::StartSpeed { node: name, .. }
            | Self::ContradictingMotions { second: name, .. }
            | Self::MotionOfMass { node: name, .. }
            | Self::StepThroughContact { node: name, .. }
            | Self::StepAcrossDashpots { node: name, .. }
            | Self::OutsideTable { name, is_load: false, .. } => node(name),
            Self::Undetermined { nodes } | Self::Loose { nodes } | Self::NoBalance { nodes } => {
                nodes.first().and_then(node)
            }
            Self::NoElement { effect, element } | Self::NotAnEnd { effect, element, .. } => {
                Some(Subject::EffectOn(effect, element.clone()))
            }
            Self::TwoFaces { element, .. } => Some(Subject::EffectOn("face", element.clone())),
            Self::NoDepth { element } => Some(Subject::EffectOn("stop", element.clone())),
            Self::UndeterminedForce { element } | Self::UndeterminedRate { element } => {
                let mut path = element.split('.').map(str::to_owned);
                let name = path.next().unwrap_or_default();
                Some(Subject::Element { name, path: path.collect() })
            }
            Self::OutsideTable { name, is_load: true, .. } => Some(Subject::Load(name.clone())),
            Self::OutOfScale { .. } | Self::TooFaint { .. } => None,
        }
    }
}

/// All that is wrong with a network; at least one error.
#[derive(Debug, Clone, PartialEq)]
pub struct NetworkErrors(pub Vec<NetworkError>);

impl fmt::Display for NetworkErrors {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (at, error) in self.0.iter().enumerate() {
            if at > 0 {
                writeln!(formatter)?;
            }
            write!(formatter, "{error}")?;
        }
        Ok(())
    }
}

impl std::error::Error for NetworkErrors {}

impl From<NetworkError> for NetworkErrors {
    fn from(error: NetworkError) -> Self {
        Self(vec![error])
    }
}

/// What has the mass that a given motion moves.
fn bearer(node: &str, heavy: &str) -> String {
    if node == heavy {
        format!("{node} has")
    } else {
        format!("`{heavy}`, which moves with it, has")
    }
}

fn quoted(names: &[String]) -> String {
    const SHOWN: usize = 5;
    let text =
        names.iter().take(SHOWN).map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
    match names.len().checked_sub(SHOWN) {
        None | Some(0) => text,
        Some(more) => format!("{text} and {more} more"),
    }
}
