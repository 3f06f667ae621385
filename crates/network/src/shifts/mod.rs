//! The register of time–temperature shifts: modifiers that multiply every time of a model.

mod arrhenius;
mod model;
mod wlf;

pub use arrhenius::Arrhenius;
pub use model::shifted;
pub use wlf::Wlf;

use crate::parameters::{InvalidParameter, Kind, Registered};

/// A kind of time–temperature shift.
///
/// A model measured at one temperature is that of another when all its times, and so all its
/// dashpot constants, are multiplied by one factor `a_T`: 1 at the reference temperature, below 1
/// where it is warmer. Stiffnesses are kept: the factor `b_T` of the literature is 1.
pub trait ShiftKind: Kind {
    /// The factor `a_T` \[1\], positive and finite, by which all times are multiplied.
    ///
    /// # Errors
    ///
    /// [`InvalidParameter`] when a field is out of range, or when the factor does not fit into
    /// double precision.
    fn factor(&self) -> Result<f64, InvalidParameter>;
}

const fn shift<S: ShiftKind>() -> Registered<f64> {
    Registered::new::<S>(|values| S::from_values(values)?.factor(), ())
}

/// Every shift, as the factor that it makes. **A new kind is registered here.**
pub static SHIFTS: &[Registered<f64>] = &[shift::<Wlf>(), shift::<Arrhenius>()];

#[cfg(test)]
mod tests;
