//! The register of time–temperature shifts: modifiers that multiply every time of a model.

mod arrhenius;
mod model;
mod wlf;

use std::fmt::Debug;

pub use arrhenius::Arrhenius;
pub use model::shifted;
pub use wlf::Wlf;

use crate::parameters::{InvalidParameter, Parameter, Value};

/// A kind of time–temperature shift.
///
/// A model measured at one temperature is that of another when all its times, and so all its
/// dashpot constants, are multiplied by one factor `a_T`: 1 at the reference temperature, below 1
/// where it is warmer. Stiffnesses are kept: the factor `b_T` of the literature is 1.
pub trait ShiftKind: Debug + Sized + 'static {
    /// Word for the kind in scenes.
    const KIND: &'static str;
    /// One line for a list: law and unit.
    const SUMMARY: &'static str;
    /// Its parameters.
    const PARAMETERS: &'static [Parameter];

    /// The shift with these values, one for each of [`PARAMETERS`](Self::PARAMETERS).
    ///
    /// # Errors
    ///
    /// [`InvalidParameter`] when a value is out of range.
    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter>;

    /// The parameters' values in the order of [`PARAMETERS`](Self::PARAMETERS).
    fn values(&self) -> Vec<Value>;

    /// The factor `a_T` \[1\], positive and finite, by which all times are multiplied.
    ///
    /// # Errors
    ///
    /// [`InvalidParameter`] when a field is out of range, or when the factor does not fit into
    /// double precision.
    fn factor(&self) -> Result<f64, InvalidParameter>;

    /// A valid example.
    fn sample() -> Self;
}

/// Sees every kind of shift.
pub trait ShiftVisitor {
    /// Called once for each kind.
    fn visit<S: ShiftKind>(&mut self);
}

/// Shows every kind of shift to `visitor`. **A new kind is registered here.**
pub fn visit_shifts(visitor: &mut impl ShiftVisitor) {
    visitor.visit::<Wlf>();
    visitor.visit::<Arrhenius>();
}

#[cfg(test)]
mod tests;
