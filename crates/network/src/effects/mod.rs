//! The register of effects: what acts on a network besides its elements, and only if asked for.

/// What an effect on one element says of that.
macro_rules! on_element {
    () => {
        fn target(&self) -> Option<&str> {
            Some(&self.element)
        }

        fn on(&self, element: &str) -> Option<Arc<dyn Effect>> {
            Some(Arc::new(Self { element: element.to_owned(), ..self.clone() }))
        }
    };
}

mod face;
mod gravity;
mod separation;
mod site;
mod stop;

#[cfg(test)]
mod tests;

use std::{any::Any, sync::Arc};

pub use face::{Face, Touch};
pub use gravity::{Gravity, GravityStart};
pub use separation::Separation;
pub use stop::Stop;

pub use crate::network::Effect;
use crate::{
    network::Situation,
    parameters::{Kind, Registered},
};

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
