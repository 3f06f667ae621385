//! A network turned into a system, and where its quantities are found there.

use std::{ops::Range, sync::Arc};

use dashpot_dae::System;

use crate::{HeldTable, NetworkWarning, NodeId, PhasedNetwork, elements::Element};

/// A network compiled to a [`System`], with an index of its outputs.
///
/// Every `usize` here is an index into [`System::outputs`].
#[derive(Debug, Clone)]
pub struct Assembly {
    /// The equations.
    pub system: System,
    /// One entry for each node, in the network's order.
    pub nodes: Vec<NodeOutputs>,
    /// One entry for each connection, in the network's order.
    pub connections: Vec<ConnectionOutputs>,
    /// The springs and dashpots that take part, connection by connection.
    pub primitives: Vec<PrimitiveOutputs>,
    /// What does work on the network from outside: loads, body forces, prescribed motions.
    pub drives: Vec<DriveOutputs>,
    /// What effects have put at elements, one entry for each element that has anything.
    pub pads: Vec<PadOutputs>,
    /// What is odd but not wrong.
    pub warnings: Vec<NetworkWarning>,
    /// Tables of time that hold a value within the run although nobody says so.
    pub held: Vec<HeldTable>,
    /// The phases of what switches, where anything does; [`system`](Self::system) is then that of
    /// the first ones.
    pub switching: Option<Arc<PhasedNetwork>>,
}

/// Outputs of a node.
#[derive(Debug, Clone, PartialEq)]
pub struct NodeOutputs {
    /// Its name.
    pub name: String,
    /// Its own mass \[kg\].
    pub mass: f64,
    /// Its start velocity \[m/s\], where it is an impactor.
    pub start_velocity: Option<f64>,
    /// How long it falls freely from rest before it touches anything \[s\]; 0 where it begins at touch.
    pub fall: f64,
    /// Number of the body that it belongs to: nodes with one number are rigidly linked.
    pub body: usize,
    /// Whether the forces on it rule its motion.
    pub free: bool,
    /// Displacement \[m\].
    pub position: usize,
    /// Velocity \[m/s\]. `None` at a massless node whose velocity jumps with the loads' rates.
    pub velocity: Option<usize>,
    /// What an accelerometer reads \[m/s²\]: the sum of the contact forces over the mass, so
    /// free fall is 0. `None` at massless nodes.
    pub acceleration: Option<usize>,
}

impl NodeOutputs {
    /// Whether the node is a free mass that starts with a speed of its own.
    pub fn is_impactor(&self) -> bool {
        self.free && self.mass > 0.0 && self.start_velocity.is_some()
    }
}

/// Outputs of a connection.
#[derive(Debug, Clone, PartialEq)]
pub struct ConnectionOutputs {
    /// Its name.
    pub name: String,
    /// Its ends.
    pub between: [NodeId; 2],
    /// Thickness \[m\], where it is a pad.
    pub thickness: Option<f64>,
    /// Whether it can never deform: it is a rigid link, or rigid links join its ends.
    pub is_rigid: bool,
    /// Whether its law has no tension, so that its force is never below zero.
    pub never_pulls: bool,
    /// Force \[N\], positive in compression. `None` for a rigid link in a loop of rigid links,
    /// where it is undetermined.
    pub force: Option<usize>,
    /// Force \[N\] that it passes on at its second end: [`force`](Self::force), but for what the
    /// masses of its layers take or give.
    pub transmitted: Option<usize>,
    /// Deformation \[m\], positive in compression.
    pub deformation: usize,
    /// Deformation rate \[m/s\]; `None` where it follows from algebraic unknowns that are kept.
    pub rate: Option<usize>,
    /// Its primitives in [`Assembly::primitives`].
    pub primitives: Range<usize>,
    /// The parts of a pad whose stress and strain are looked at: of layers all that deform, from the
    /// first face to the second; else the whole pad where its thickness is known, and all branches
    /// with a thickness of their own. None for other elements.
    pub segments: Vec<SegmentOutputs>,
    /// Whether it is made of layers.
    pub has_layers: bool,
}

/// What effects have put at an element.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PadOutputs {
    /// The element, in [`Assembly::connections`].
    pub element: usize,
    /// The node in [`Assembly::nodes`] that is an end of the element in place of that which it lies
    /// at, where it has such a face.
    pub face: Option<usize>,
    /// The connection between the face and that node: a contact, or a rigid link.
    pub contact: Option<usize>,
    /// The connection beside the element that is its stop.
    pub stop: Option<usize>,
}

/// Outputs of a part of a pad in which force and strain are the same all over.
#[derive(Debug, Clone, PartialEq)]
pub struct SegmentOutputs {
    /// What it is of the pad.
    pub place: SegmentPlace,
    /// Thickness \[m\], > 0.
    pub thickness: f64,
    /// Area \[m²\], > 0, where it is known.
    pub area: Option<f64>,
    /// Force \[N\], positive in compression. `None` where it is undetermined.
    pub force: Option<usize>,
    /// Deformation \[m\], positive in compression.
    pub deformation: usize,
}

/// What a segment is of its pad.
#[derive(Debug, Clone, PartialEq)]
pub enum SegmentPlace {
    /// All of it.
    Whole,
    /// A part of a layer.
    Layer {
        /// Name of the layer.
        name: String,
        /// Depth of the middle of the segment below the first face of the pad \[m\].
        depth: f64,
    },
    /// A branch of its model.
    Branch {
        /// Path of the branch, for instance `padding.top`.
        path: String,
    },
}

/// Outputs of a spring or dashpot.
#[derive(Debug, Clone)]
pub struct PrimitiveOutputs {
    /// Path, for instance `padding.maxwell.spring`.
    pub name: String,
    /// The law.
    pub element: Arc<dyn Element>,
    /// Force \[N\].
    pub force: usize,
    /// Deformation \[m\].
    pub deformation: usize,
    /// Deformation rate \[m/s\]; dashpots always have it.
    pub rate: Option<usize>,
}

/// Something that does work on the network from outside.
#[derive(Debug, Clone, PartialEq)]
pub struct DriveOutputs {
    /// What it is, for instance `gravity on head`.
    pub name: String,
    /// What kind of work it does.
    pub source: Source,
    /// Number of the node that it acts on, in [`Assembly::nodes`].
    pub node: usize,
    /// Force that it puts on its node \[N\].
    pub force: usize,
    /// Velocity of that node \[m/s\]. `None` at a massless node in a network that switches: it is not
    /// known in all phases.
    pub velocity: Option<usize>,
    /// Times \[s\] at which a prescribed displacement jumps; the work done there is the jump of
    /// the stored energy.
    pub jumps: Vec<f64>,
}

/// What does work on a network from outside.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source {
    /// A force that is given as a function of time.
    Load,
    /// A force that an effect of this word puts on masses.
    Effect(&'static str),
    /// What holds a node on its given way.
    Motion,
}

impl PrimitiveOutputs {
    /// Its path without the word of its kind, where that is the end: what it stands for alone.
    pub fn place(&self) -> &str {
        place(&self.name, self.element.kind())
    }
}

/// The path of a primitive without the word `kind` at its end.
pub(crate) fn place<'n>(name: &'n str, kind: &str) -> &'n str {
    name.strip_suffix(kind).and_then(|own| own.strip_suffix('.')).unwrap_or(name)
}

impl Assembly {
    /// Whether any of its masses starts with a speed of its own.
    pub fn has_impactor(&self) -> bool {
        self.nodes.iter().any(NodeOutputs::is_impactor)
    }

    /// The connection of the given name.
    pub fn connection(&self, name: &str) -> Option<&ConnectionOutputs> {
        self.connections.iter().find(|connection| connection.name == name)
    }

    /// The node of the given name.
    pub fn node(&self, name: &str) -> Option<&NodeOutputs> {
        self.nodes.iter().find(|node| node.name == name)
    }

    /// What effects have put at the element of this position.
    pub fn pad(&self, element: usize) -> Option<&PadOutputs> {
        self.pads.iter().find(|pad| pad.element == element)
    }

    /// The element whose face the connection of this position links, and what else is there.
    pub fn pad_behind(&self, contact: usize) -> Option<&PadOutputs> {
        self.pads.iter().find(|pad| pad.contact == Some(contact))
    }

    /// Position of the connection of the given name.
    pub fn position(&self, connection: &str) -> Option<usize> {
        self.connections.iter().position(|own| own.name == connection)
    }

    /// Position of the connection that the primitive of this position is part of.
    pub fn owner(&self, primitive: usize) -> Option<usize> {
        let at =
            self.connections.partition_point(|connection| connection.primitives.end <= primitive);
        (at < self.connections.len()).then_some(at)
    }

    /// The output of the given name, for instance `padding.force`.
    pub fn output(&self, name: &str) -> Option<usize> {
        self.system.outputs.find(name)
    }
}
