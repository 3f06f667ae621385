//! Where the quantities of a network are found in its system.
//!
//! Every `usize` here is an index into [`System::outputs`](dashpot_dae::System::outputs).

use std::{ops::Range, sync::Arc};

use crate::{elements::Element, network::NodeId};

/// Outputs of a node.
#[derive(Debug, Clone, PartialEq)]
pub struct NodeOutputs {
    /// Its name.
    pub name: String,
    /// Its own mass \[kg\].
    pub mass: f64,
    /// Its start velocity \[m/s\], where it is an impactor: of one that is dropped that at touch.
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
    /// Its primitives in [`Assembly::primitives`](crate::Assembly::primitives).
    pub primitives: Range<usize>,
    /// The parts of a pad whose stress and strain are looked at: of layers all that deform, from the
    /// first face to the second; else the whole pad where its thickness is known, and all branches
    /// with a thickness of their own. None for other elements.
    pub segments: Vec<SegmentOutputs>,
    /// Whether it is made of layers.
    pub has_layers: bool,
    /// Time \[s\] in which a wave crosses the thickest segment of the layers; 0 where none travels.
    pub passage: f64,
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
    pub name: Arc<str>,
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
    /// Number of the node that it acts on, in [`Assembly::nodes`](crate::Assembly::nodes).
    pub node: usize,
    /// Force that it puts on its node \[N\].
    pub force: usize,
    /// Velocity of that node \[m/s\]. `None` at a massless node in a network that switches: it is not
    /// known in all phases.
    pub velocity: Option<usize>,
    /// Times \[s\] at which a prescribed displacement jumps; the work done there is the jump of the stored energy.
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
