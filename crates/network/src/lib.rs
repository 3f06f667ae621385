//! Networks of springs, dashpots and masses, and their compilation to systems.
//!
//! # Sign convention
//!
//! One axis. Displacements, velocities and forces on nodes are positive from the impactor towards
//! the support. An element between `a` and `b` has the deformation `y = x_a − x_b`, positive in
//! compression, and a force that is positive when it pushes its ends apart.

mod assembly;
mod compile;
pub mod composites;
pub mod driving_point;
pub mod effects;
pub mod elements;
mod error;
pub mod influence;
pub mod layers;
pub mod memory;
mod model;
mod network;
mod outputs;
pub mod parameters;
mod rewrite;
pub mod segments;
pub mod shifts;
mod warning;
pub mod waveforms;

pub use assembly::Assembly;
pub use compile::{
    HeldTable, Unsaid,
    parametric::{CurveRow, Instance, ParametricSystem},
    phased::{IdleSlider, PhasedNetwork, PhasedPart},
};
pub use elements::{Element, phases};
pub use error::{NetworkError, NetworkErrors, Subject};
pub use influence::Detail;
pub use model::{
    Model, dashpot, first_nonlinear, is_linear, linear_model, model_of, part, primitive, spring,
};
pub use network::{
    Connection, Effect, ImpactScales, Influence, InnerPad, Load, Network, Node, NodeId, PadOutputs,
    Situation, Start, Support,
};
pub use outputs::{
    ConnectionOutputs, DriveOutputs, NodeOutputs, PrimitiveOutputs, SegmentOutputs, SegmentPlace,
    Source,
};
pub use warning::{Front, NetworkWarning};
