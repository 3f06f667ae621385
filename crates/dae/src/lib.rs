//! The narrow waist of `dashpot`: linear differential–algebraic systems in, trajectories out.
//!
//! A [`System`] is `M ẏ = J y + B w(t)` with `M = diag(1…1, 0…0)`, dimensionless, with named unknowns and named
//! outputs. A [`Method`] integrates it to a [`Trajectory`], which yields every output as a [`Signal`]: a piecewise
//! polynomial in SI units whose extrema, crossings and integrals are those of the continuous solution, not of samples.

mod budget;
mod error;
pub mod events;
mod exact;
pub mod frequency;
pub mod methods;
mod outputs;
mod pieces;
mod run;
mod signal;
pub mod switching;
mod system;
mod trajectory;
mod waveform;

pub use budget::Budget;
pub use dashpot_numerics::{FormRef, LinearForm};
pub use error::SolveError;
pub use events::{Direction, Event, Guard};
pub use exact::Shared;
pub use methods::{Method, MethodKind, derivatives};
pub use outputs::{Output, OutputName, Outputs};
pub use run::{Digest, Jump, Keep, Observer, Part, Product, Progress, Run, Silent};
pub use signal::{Crossing, Extremum, Panel, Signal};
pub use switching::{IntervalEnd, ModeInterval, PredictedEvent, Switching};
pub use system::{
    Argument, Characteristic, Derivatives, Input, Linear, System, Term, Unknown, UnknownKind,
};
pub use trajectory::{Dense, Outcome, Statistics, Switch, Trajectory};
pub use waveform::{Given, Piece, Waveform};

#[cfg(test)]
mod tests;
