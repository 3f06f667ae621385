//! The register of effects: what acts on a network besides its elements, and only if asked for.

mod face;
mod gravity;
mod separation;
mod site;
mod stop;

#[cfg(test)]
mod tests;

use std::{any::Any, fmt::Debug, sync::Arc};

use dashpot_dae::Waveform;
pub use face::{Face, Touch};
pub use gravity::{Gravity, GravityStart};
pub use separation::Separation;
pub use stop::Stop;

use crate::{
    Influence, Network, NetworkError, NodeId, Situation, layers,
    parameters::{InvalidParameter, Parameter, Value},
};

/// Something that acts on a network without being a two-terminal law.
///
/// An effect states only what it does; the defaults do nothing and cost nothing.
pub trait Effect: Any + Debug + Send + Sync {
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

    /// Name of the element that it acts on, where it acts on one.
    fn target(&self) -> Option<&str> {
        None
    }

    /// Whether it puts nodes and elements into the network; those on one element do.
    fn rewrites(&self) -> bool {
        self.target().is_some()
    }

    /// Puts the nodes and elements that the effect is made of into the network.
    ///
    /// # Errors
    ///
    /// [`NetworkError`] where the network has no place for them.
    fn rewrite(&self, _network: &mut Network) -> Result<(), NetworkError> {
        Ok(())
    }

    /// The dimensionless numbers that measure how much it matters; none where the scales do not
    /// tell. The effect need not be one of the network.
    fn influences(&self, _situation: &Situation<'_>) -> Vec<Influence> {
        Vec::new()
    }

    /// Keeps what else of the network rests on the effect, which is about to be left out of it.
    fn leave(&self, _network: &mut Network) {}

    /// Checks the parameters.
    ///
    /// # Errors
    ///
    /// [`InvalidParameter`] for the first one out of its range.
    fn validate(&self) -> Result<(), InvalidParameter>;

    /// The parameters' values in the order of [`EffectKind::PARAMETERS`].
    fn values(&self) -> Vec<Value>;
}

impl dyn Effect {
    /// The effect as one of the kind `E`, if it is one.
    pub fn of_kind<E: EffectKind>(&self) -> Option<&E> {
        (self as &dyn Any).downcast_ref()
    }
}

/// What an effect kind says about itself.
pub trait EffectKind: Effect + Sized + 'static {
    /// Word for the effect in scenes.
    const KIND: &'static str;
    /// One line for a list.
    const SUMMARY: &'static str;
    /// Its parameters.
    const PARAMETERS: &'static [Parameter];
    /// Whether it acts on one element, `effects.<kind>.<element>` in scenes; else on the network.
    const PER_ELEMENT: bool = false;

    /// What it would be with its defaults in a network in which it is off: on each element that an
    /// impactor strikes, where it acts on one. None where nothing about it is known.
    fn would_be(_situation: &Situation<'_>) -> Vec<Self> {
        Vec::new()
    }

    /// The effect on `target`, the element's name where it acts on one, with these values, one for
    /// each of [`PARAMETERS`](Self::PARAMETERS).
    ///
    /// # Errors
    ///
    /// [`InvalidParameter`] when a value is out of range.
    fn from_values(target: &str, values: &[Value]) -> Result<Self, InvalidParameter>;

    /// A valid example.
    fn sample() -> Self;
}

/// Sees every effect kind.
pub trait EffectVisitor {
    /// Called once for each kind.
    fn visit<E: EffectKind>(&mut self);
}

/// Shows every effect kind to `visitor`. **A new kind is registered here**, behind those whose
/// rewriting it builds on.
pub fn visit_effects(visitor: &mut impl EffectVisitor) {
    visitor.visit::<Gravity>();
    visitor.visit::<Separation>();
    visitor.visit::<Face>();
    visitor.visit::<Stop>();
}

/// Whether [`rewrite`] puts anything into a network.
pub(crate) fn rewrites(network: &Network) -> bool {
    network.effects.iter().any(|effect| effect.rewrites())
        || network.connections.iter().any(|own| own.layers.is_some())
}

/// Puts into a network the masses of its layers and all that its effects are made of, in the order
/// of the register.
///
/// # Errors
///
/// [`NetworkError`] of the first layers that cannot be resolved, or of the first effect that has no
/// place in the network.
pub(crate) fn rewrite(network: &mut Network) -> Result<(), NetworkError> {
    struct Order(Vec<&'static str>);
    impl EffectVisitor for Order {
        fn visit<E: EffectKind>(&mut self) {
            self.0.push(E::KIND);
        }
    }
    let mut order = Order(Vec::new());
    visit_effects(&mut order);
    let mut effects: Vec<Arc<dyn Effect>> =
        network.effects.iter().filter(|effect| effect.rewrites()).map(Arc::clone).collect();
    effects.sort_by_key(|effect| order.0.iter().position(|kind| *kind == effect.kind()));
    layers::resolve(network)?;
    for effect in effects {
        effect.rewrite(network)?;
    }
    Ok(())
}
