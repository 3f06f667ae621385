//! The register of composites: models that are made from a description of a few numbers.

mod fibre;
mod kelvin_chain;
mod note;
mod prony;
mod spectrum;

pub use fibre::{BoxFibre, ListFibre, LogNormalFibre, PowerLawFibre};
pub use kelvin_chain::KelvinChain;
pub use note::CompositeNote;
pub use prony::Prony;

use crate::{
    Model,
    parameters::{Dimension, InvalidParameter, Kind, Registered},
};

/// A model made from a description, with what is to be said about it.
#[derive(Debug, Clone)]
pub struct Composed {
    /// The model.
    pub model: Model,
    /// What the reader of the description is told besides: an error that was reached, a range, an
    /// order that was changed; `None` where the model is just what was described.
    pub note: Option<CompositeNote>,
    /// Time up to which the model stands for its description \[s\]; `None` for any time.
    pub until: Option<f64>,
}

/// A kind of model that a few parameters describe as a whole.
///
/// A composite may compute as much as it likes, but the same values always give the same model,
/// its names included. It consists of springs, dashpots and rigid links with valid constants.
/// Where it only comes near to what is described, its note says how near and in which range.
pub trait CompositeKind: Kind {
    /// Dimension of amplitudes: what stands beside the times in
    /// [`TimeTable`](crate::parameters::ParameterKind::TimeTable)s.
    const AMPLITUDE: Dimension;

    /// The model that is described.
    ///
    /// # Errors
    ///
    /// [`InvalidParameter`] when a field is out of range, or when a constant of the model does not
    /// fit into double precision.
    fn compose(&self) -> Result<Composed, InvalidParameter>;
}

const fn composite<C: CompositeKind>() -> Registered<Composed, Dimension> {
    Registered::new::<C>(|values| C::from_values(values)?.compose(), C::AMPLITUDE)
}

/// Every composite, with the dimension beside its times. **A new kind is registered here.**
pub static COMPOSITES: &[Registered<Composed, Dimension>] = &[
    composite::<Prony>(),
    composite::<KelvinChain>(),
    composite::<ListFibre>(),
    composite::<LogNormalFibre>(),
    composite::<BoxFibre>(),
    composite::<PowerLawFibre>(),
];

#[cfg(test)]
mod tests;
