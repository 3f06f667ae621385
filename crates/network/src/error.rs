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
///
/// Nodes, elements and loads stand by their names, parts by their paths; times are in s.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum NetworkError {
    /// Two things of one family have the same name.
    #[error("there are two {family} named `{name}`")]
    DuplicateName {
        /// `nodes`, `elements` or `loads`.
        family: &'static str,
        name: String,
        subject: Subject,
    },
    /// A parameter is out of its range.
    #[error("{invalid}")]
    Invalid { subject: Subject, invalid: InvalidParameter },
    /// A model that nests too deeply.
    #[error("the model of `{element}` nests more than {MOST_LEVELS} levels deep")]
    TooDeep { element: String },
    /// Both ends of an element are one node.
    #[error("both ends of `{element}` are at `{node}`")]
    BothEndsAtOneNode { element: String, node: String },
    /// A massless node that no element touches.
    #[error("`{node}` has no mass and no element holds it: its motion is undetermined")]
    IsolatedNode { node: String },
    /// Massless nodes whose place follows from nothing.
    #[error(
        "the place of {} is undetermined: massless, and no spring or dashpot ties {} to a mass, \
         a fixed node or a prescribed motion",
        quoted(.nodes),
        if .nodes.len() == 1 { "it" } else { "them" }
    )]
    Undetermined { nodes: Vec<String> },
    /// Massless nodes whose place follows from nothing while contacts are open.
    #[error(
        "while its contacts are open, the place of {} is undetermined: it has no mass, and nothing \
         else tells where it is; let the pad part at one end only, give it a `face` with mass, or \
         put a dashpot beside what may go slack",
        quoted(.nodes)
    )]
    Loose { nodes: Vec<String> },
    /// A mass is asked to start with a speed that it cannot have.
    #[error("`{node}` has a start speed but {reason}")]
    StartSpeed { node: String, reason: &'static str },
    /// A node is asked to begin at a place where it cannot.
    #[error("`{node}` begins at a `position` of its own, but {reason}")]
    StartPosition { node: String, reason: &'static str },
    /// Rigidly linked nodes are asked to move differently.
    #[error("`{first}` and `{second}` are rigidly linked, but {difference}")]
    ContradictingMotions { first: String, second: String, difference: &'static str },
    /// A prescribed displacement jumps across dashpots only.
    #[error(
        "the motion of `{node}` jumps at {time} s, and only dashpots lead from it to `{other}`: \
         the force would be infinite; give the jump a rise time"
    )]
    StepAcrossDashpots { node: String, other: String, time: f64 },
    /// A prescribed displacement jumps in a network with contacts.
    #[error(
        "the motion of `{node}` jumps at {time} s, and it may jump through a contact: give the jump a \
         rise time"
    )]
    StepThroughContact { node: String, time: f64 },
    /// A run reaches beyond a table that must not be used there.
    #[error(
        "the table of {} `{name}` is given from {from} s to {to} s, and the run lasts from 0 s to \
         {duration} s: its `outside = \"error\"` forbids that; let the run end with the table, or write \
         \"hold\" or \"zero\"",
        if *.is_load { "the load" } else { "the motion of" }
    )]
    OutsideTable { name: String, is_load: bool, from: f64, to: f64, duration: f64 },
    /// The prescribed motion of a mass asks for an infinite force.
    #[error(
        "the motion of `{node}` {fault} at {time} s, and {} mass: the force would be infinite; \
         prescribe the motion of a node without mass, or one that is smooth",
        bearer(.node, .heavy)
    )]
    MotionOfMass {
        node: String,
        /// What has the mass: the node, or one that moves with it.
        heavy: String,
        /// `jumps` or `has a kink`.
        fault: &'static str,
        time: f64,
    },
    /// A weight or load that nothing holds cannot start in balance.
    #[error(
        "{} cannot start in balance: no spring carries the load to a fixed or prescribed node; \
         choose `start = \"unloaded\"`",
        quoted(.nodes)
    )]
    NoBalance { nodes: Vec<String> },
    /// An effect acts on an element that the network does not have.
    #[error("`{effect}.{element}` acts on no element: there is none named `{element}`")]
    NoElement { effect: &'static str, element: String },
    /// An effect acts at a node that is no end of its element.
    #[error(
        "`{effect}.{element}` is at `{node}`, but `{element}` is between `{}` and `{}`",
        .ends[0],
        .ends[1]
    )]
    NotAnEnd { effect: &'static str, element: String, node: String, ends: [String; 2] },
    /// A face is to have mass at another end than the one that separates.
    #[error(
        "`face.{element}` is at `{face}`, but `separation.{element}` opens at `{separation}`: \
         they are to be at one node"
    )]
    TwoFaces { element: String, face: String, separation: String },
    /// A stop whose depth is not known.
    #[error("`stop.{element}` has no `at`, and `{element}` has no thickness from which it follows")]
    NoDepth { element: String },
    /// The force in a closed contact, a slider that sticks or a rigid link follows from nothing.
    #[error(
        "the force in `{element}` is undetermined: another rigid way leads around it; give one of \
         the parts a stiffness"
    )]
    UndeterminedForce { element: String },
    /// The rate of a part that switches follows from unknowns that have no rate.
    #[error(
        "how fast `{element}` deforms does not follow from its neighbours: put a dashpot beside a \
         part that it is in series with"
    )]
    UndeterminedRate { element: String },
    /// All that moves a network that switches is so small that it cannot be divided by.
    #[error(
        "nothing moves by enough to be solved for: where a network switches, speeds, forces and \
         motions may not all be as small as this; {what} is {value:e} {unit}, and one over that is \
         beyond the range of numbers"
    )]
    TooFaint { what: &'static str, value: f64, unit: &'static str },
    /// A number became too large or too small for double precision.
    #[error("the constants of the network are too far apart: {what} is {value:e} in {unit}")]
    OutOfScale { what: &'static str, value: f64, unit: &'static str },
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
            | Self::StartPosition { node: name, .. }
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
