//! The register of effects: what acts on a network besides its elements, and only if asked for.

mod gravity;

use std::fmt::Debug;

use dashpot_dae::Waveform;
pub use gravity::{Gravity, GravityStart};

use crate::{
    Network, NodeId,
    parameters::{InvalidParameter, Parameter, Value},
};

/// Something that acts on a network without being a two-terminal law.
///
/// An effect states only what it does; the defaults do nothing and cost nothing.
pub trait Effect: Debug + Send + Sync {
    /// Word for the effect, for instance `gravity`.
    fn kind(&self) -> &'static str;

    /// Body forces on nodes \[N\] as functions of time \[s\], positive towards the support. An
    /// accelerometer on the node does not feel them.
    fn body_forces(&self, _network: &Network) -> Vec<(NodeId, Waveform)> {
        Vec::new()
    }

    /// Whether parts without start speed begin in balance under the forces of the effects.
    fn starts_in_balance(&self) -> bool {
        false
    }

    /// Gravitational acceleration that the effect brings \[m/s²\], for heights of fall.
    fn gravity(&self) -> Option<f64> {
        None
    }

    /// Checks the parameters.
    ///
    /// # Errors
    ///
    /// [`InvalidParameter`] for the first one out of its range.
    fn validate(&self) -> Result<(), InvalidParameter>;

    /// The parameters' values in the order of [`EffectKind::PARAMETERS`].
    fn values(&self) -> Vec<Value>;
}

/// What an effect kind says about itself.
pub trait EffectKind: Effect + Sized + 'static {
    /// Word for the effect in scenes.
    const KIND: &'static str;
    /// One line for a list.
    const SUMMARY: &'static str;
    /// Its parameters.
    const PARAMETERS: &'static [Parameter];

    /// The effect with these values, one for each of [`PARAMETERS`](Self::PARAMETERS).
    ///
    /// # Errors
    ///
    /// [`InvalidParameter`] when a value is out of range.
    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter>;

    /// A valid example.
    fn sample() -> Self;
}

/// Sees every effect kind.
pub trait EffectVisitor {
    /// Called once for each kind.
    fn visit<E: EffectKind>(&mut self);
}

/// Shows every effect kind to `visitor`. **A new kind is registered here.**
pub fn visit_effects(visitor: &mut impl EffectVisitor) {
    visitor.visit::<Gravity>();
}
