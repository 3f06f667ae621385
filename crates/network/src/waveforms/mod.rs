//! The register of driving functions: forces on nodes, and displacements or accelerations of nodes,
//! as functions of time.

mod chirp;
mod constant;
mod half_sine;
mod haversine;
mod ramp;
mod recognized;
mod sine;
mod table;
mod trapezoid;

use std::fmt::Debug;

pub use chirp::Chirp;
pub use constant::Constant;
use dashpot_dae::Waveform;
pub use half_sine::HalfSine;
pub use haversine::Haversine;
pub use ramp::Ramp;
pub use recognized::Recognized;
pub use sine::Sine;
pub use table::{Outside, Table};
pub use trapezoid::Trapezoid;

use crate::parameters::{InvalidParameter, Parameter, Value};

/// A kind of driving function.
pub trait WaveformKind: Debug + Sized + 'static {
    /// Word for the kind in scenes.
    const KIND: &'static str;
    /// One line for a list: law and unit.
    const SUMMARY: &'static str;
    /// Its parameters; a kind with one required parameter takes the value alone.
    const PARAMETERS: &'static [Parameter];

    /// The function with these values, one for each of [`PARAMETERS`](Self::PARAMETERS).
    ///
    /// # Errors
    ///
    /// [`InvalidParameter`] when a value is out of range.
    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter>;

    /// The parameters' values in the order of [`PARAMETERS`](Self::PARAMETERS).
    fn values(&self) -> Vec<Value>;

    /// The function as pieces, in SI units.
    ///
    /// # Errors
    ///
    /// [`InvalidParameter`] when a field is out of range.
    fn waveform(&self) -> Result<Waveform, InvalidParameter>;

    /// A valid example.
    fn sample() -> Self;
}

/// Sees every kind of driving function.
pub trait WaveformVisitor {
    /// Called once for each kind.
    fn visit<W: WaveformKind>(&mut self);
}

/// Shows every kind of driving function to `visitor`. **A new kind is registered here.**
pub fn visit_waveforms(visitor: &mut impl WaveformVisitor) {
    visitor.visit::<Constant>();
    visitor.visit::<Ramp>();
    visitor.visit::<Sine>();
    visitor.visit::<HalfSine>();
    visitor.visit::<Haversine>();
    visitor.visit::<Trapezoid>();
    visitor.visit::<Chirp>();
    visitor.visit::<Table>();
}

/// A time before `start` and before 0, for the piece that holds until then.
fn before(start: f64) -> f64 {
    start.min(0.0) - 1.0 - start.abs()
}

/// The waveform of `pieces`; if their starts cannot be told apart in double precision, an error that
/// blames `parameter`.
fn pieces(
    parameter: &'static str,
    found: f64,
    pieces: Vec<dashpot_dae::Piece>,
) -> Result<Waveform, InvalidParameter> {
    const RANGE: &str = "finite, and long enough to tell its ends apart in double precision";
    Waveform::new(pieces).ok_or_else(|| InvalidParameter::new(parameter, RANGE, found))
}

#[cfg(test)]
mod tests;
