//! The register of driving functions: forces on nodes, and displacements or accelerations of nodes,
//! as functions of time.

mod chirp;
mod constant;
mod formula;
mod half_sine;
mod haversine;
mod ramp;
mod recognized;
mod sine;
mod table;
mod trapezoid;

pub use chirp::Chirp;
pub use constant::Constant;
use dashpot_dae::Waveform;
pub use formula::Formula;
pub use half_sine::HalfSine;
pub use haversine::Haversine;
pub use ramp::Ramp;
pub use recognized::Recognized;
pub use sine::Sine;
pub use table::{Outside, Table};
pub use trapezoid::Trapezoid;

use crate::parameters::{InvalidParameter, Kind, Registered};

/// A kind of driving function.
pub trait WaveformKind: Kind {
    /// The function as pieces, in SI units.
    ///
    /// # Errors
    ///
    /// [`InvalidParameter`] when a field is out of range.
    fn waveform(&self) -> Result<Waveform, InvalidParameter> {
        self.validate()?;
        self.of_valid()
    }

    /// The same where all fields are in their ranges.
    ///
    /// # Errors
    ///
    /// [`InvalidParameter`] for times that cannot be told apart in double precision.
    fn of_valid(&self) -> Result<Waveform, InvalidParameter>;
}

const fn function<W: WaveformKind>() -> Registered<Waveform> {
    Registered::new::<W>(|values| W::from_values(values)?.waveform(), ())
}

/// Every driving function. **A new kind is registered here.**
pub static WAVEFORMS: &[Registered<Waveform>] = &[
    function::<Constant>(),
    function::<Ramp>(),
    function::<Sine>(),
    function::<HalfSine>(),
    function::<Haversine>(),
    function::<Trapezoid>(),
    function::<Chirp>(),
    function::<Table>(),
    function::<Formula>(),
];

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
