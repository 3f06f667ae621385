//! The register of effects: what acts on a network besides its elements, and only if asked for.

mod face;
mod gravity;
mod separation;
mod site;
mod stop;

#[cfg(test)]
mod tests;

use std::{any::Any, sync::Arc};

use dashpot_dae::Waveform;
pub use face::{Face, Touch};
pub use gravity::{Gravity, GravityStart};
pub use separation::Separation;
pub use stop::Stop;

use crate::{
    Influence, Network, NetworkError, NodeId, Situation, layers,
    parameters::{Described, Kind, Registered},
};

/// Something that acts on a network without being a two-terminal law.
///
/// An effect states only what it does; the defaults do nothing and cost nothing.
pub trait Effect: Any + Described {
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

    /// The same on the element of this name; `None` for what acts on no element.
    fn on(&self, _element: &str) -> Option<Arc<dyn Effect>> {
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
}

impl dyn Effect {
    /// The effect as one of the kind `E`, if it is one.
    pub fn of_kind<E: EffectKind>(&self) -> Option<&E> {
        (self as &dyn Any).downcast_ref()
    }
}

/// What an effect kind says about itself.
pub trait EffectKind: Effect + Kind {
    /// Whether it acts on one element, `effects.<kind>.<element>` in scenes; else on the network.
    const PER_ELEMENT: bool = false;

    /// What it would be with its defaults in a network in which it is off: on each element that an
    /// impactor strikes, where it acts on one. None where nothing about it is known.
    fn would_be(_situation: &Situation<'_>) -> Vec<Self> {
        Vec::new()
    }
}

/// What the register says of an effect besides how it is made.
#[derive(Debug, Clone, Copy)]
pub struct EffectTraits {
    /// [`EffectKind::PER_ELEMENT`].
    pub is_per_element: bool,
    /// [`EffectKind::would_be`].
    pub would_be: fn(&Situation<'_>) -> Vec<Arc<dyn Effect>>,
}

/// An effect in the register. What acts on an element is made on that of its example, and then put
/// [`on`](Effect::on) its own.
pub type EffectEntry = Registered<Arc<dyn Effect>, EffectTraits>;

const fn effect<E: EffectKind>() -> EffectEntry {
    let would_be = |situation: &Situation<'_>| {
        E::would_be(situation).into_iter().map(|own| Arc::new(own) as Arc<dyn Effect>).collect()
    };
    let about = EffectTraits { is_per_element: E::PER_ELEMENT, would_be };
    Registered::new::<E>(|values| Ok(Arc::new(E::from_values(values)?)), about)
}

/// Every effect kind. **A new kind is registered here**, behind those whose rewriting it builds on.
pub static EFFECTS: &[EffectEntry] =
    &[effect::<Gravity>(), effect::<Separation>(), effect::<Face>(), effect::<Stop>()];

/// Whether [`rewrite`] puts anything into a network.
pub(crate) fn rewrites(network: &Network) -> bool {
    network.effects.iter().any(|effect| effect.rewrites())
        || network.connections.iter().any(|connection| connection.layers.is_some())
}

/// Puts into a network the masses of its layers and all that its effects are made of, in the order
/// of the register.
///
/// # Errors
///
/// [`NetworkError`] of the first layers that cannot be resolved, or of the first effect that has no
/// place in the network.
pub(crate) fn rewrite(network: &mut Network) -> Result<(), NetworkError> {
    let mut effects: Vec<Arc<dyn Effect>> =
        network.effects.iter().filter(|effect| effect.rewrites()).map(Arc::clone).collect();
    effects.sort_by_key(|effect| EFFECTS.iter().position(|own| own.word == effect.kind()));
    layers::resolve(network)?;
    for effect in effects {
        effect.rewrite(network)?;
    }
    Ok(())
}
