//! Networks with the nodes and elements that their effects and layers are made of.

use std::{borrow::Cow, sync::Arc};

use crate::{
    effects::EFFECTS,
    error::{NetworkError, NetworkErrors},
    network::{Effect, Network},
    segments::resolve,
};

/// Whether [`rewrite`] puts anything into a network.
fn rewrites(network: &Network) -> bool {
    network.effects.iter().any(|effect| effect.rewrites())
        || network.connections.iter().any(|connection| connection.layers.is_some())
}

/// Puts into a network the masses of its layers and all that its effects are made of, in the order of the register.
/// Errors: [`NetworkError`] of the first layers that cannot be resolved, or of the first effect that has no place in
/// the network.
pub(crate) fn rewrite(network: &mut Network) -> Result<(), NetworkError> {
    let mut effects: Vec<Arc<dyn Effect>> =
        network.effects.iter().filter(|effect| effect.rewrites()).map(Arc::clone).collect();
    effects.sort_by_key(|effect| EFFECTS.iter().position(|own| own.word == effect.kind()));
    resolve(network)?;
    for effect in effects {
        effect.rewrite(network)?;
    }
    Ok(())
}

impl Network {
    /// The network with the nodes and elements that its effects and layers put into it, as it is compiled.
    ///
    /// # Errors
    ///
    /// What keeps an effect or a layer from having a place in the network.
    pub fn with_effects(&self) -> Result<Cow<'_, Self>, NetworkErrors> {
        if !rewrites(self) {
            return Ok(Cow::Borrowed(self));
        }
        let mut network = self.clone();
        rewrite(&mut network)?;
        Ok(Cow::Owned(network))
    }
}
