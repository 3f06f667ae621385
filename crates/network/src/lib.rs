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
mod linear_model;
pub mod memory;
mod network;
pub mod parameters;
pub mod phases;
pub mod shifts;
mod warning;
pub mod waveforms;

pub use assembly::{
    Assembly, ConnectionOutputs, DriveOutputs, NodeOutputs, PadOutputs, PrimitiveOutputs,
    SegmentOutputs, SegmentPlace, Source,
};
pub use compile::{
    HeldTable, Unsaid,
    parametric::{Instance, ParametricSystem},
    phased::{IdleSlider, PhasedNetwork, PhasedPart},
};
pub use effects::Effect;
pub use elements::Element;
pub use error::{NetworkError, NetworkErrors, Subject};
pub use influence::{Detail, Influence, Situation};
pub use linear_model::{first_nonlinear, is_linear, linear_model, model_of, primitive};
pub use network::{Connection, InnerPad, Load, Model, Network, Node, NodeId, Start, Support, part};
pub use warning::{Front, NetworkWarning};
