//! From network to system.
//!
//! Models are expanded into primitives between joints ([`expand`]), rigid links merge joints into bodies ([`bodies`]),
//! and the graph says which bodies have rates of their own and which follow from balances ([`structure`]). Bodies are
//! counted from each other along springs and dashpots ([`tree`]). Balances are solved by star–mesh elimination
//! ([`mesh`]), never by subtracting from a diagonal, and rows have twice the digits of a double ([`row`]) until they
//! are complete. They are in SI; `system` rounds them and makes them dimensionless.

mod accelerometers;
mod assemble;
mod balance;
mod beyond;
pub(crate) mod bodies;
mod constraint_forces;
mod dashpots;
mod drives;
pub(crate) mod expand;
mod incidence;
mod inner_pads;
mod laws;
mod mesh;
mod motion;
mod nonlinear_forces;
mod outputs;
pub(crate) mod parametric;
mod parts;
pub(crate) mod phased;
mod rates;
mod review;
mod row;
mod scales;
mod segments;
mod sides;
pub(crate) mod size;
mod springs;
mod structure;
mod system;
mod transfer;
mod tree;
mod unknowns;
pub(crate) mod validate;

#[cfg(test)]
mod tests;

use std::sync::Arc;

pub use self::beyond::{HeldTable, Unsaid};
use self::{assemble::assemble, expand::Expansion, size::Size};
use crate::{assembly::Assembly, error::NetworkErrors, network::Network};

impl Network {
    /// Turns the network into a dimensionless, semi-explicit system of index 1 for a run of
    /// `duration` \[s\].
    ///
    /// # Errors
    ///
    /// All that is wrong with the network, by name: [`NetworkErrors`] of its names and numbers, or
    /// else of its topology.
    pub fn compile(&self, duration: f64) -> Result<Assembly, NetworkErrors> {
        let network = self.with_effects()?;
        let expansion = Expansion::of(&network);
        let faults = validate::faults(&network, &expansion);
        if !faults.is_empty() {
            return Err(NetworkErrors(faults));
        }
        let held = beyond::held(self, duration)?;
        let expansion = expansion.of_size(Size::of(&network, duration));
        let (parts, pads) = (expansion.phased(), network.pads.clone());
        let (mut compiled, switching) = if parts.is_empty() {
            (assemble(&network, &expansion, duration)?, None)
        } else {
            let (first, phased) =
                phased::compile(network.into_owned(), expansion, parts, duration)?;
            (first, Some(Arc::new(phased)))
        };
        compiled.warnings.extend(crate::segments::warnings(self, duration));
        Ok(Assembly {
            system: compiled.system,
            nodes: compiled.nodes,
            connections: compiled.connections,
            primitives: compiled.primitives,
            drives: compiled.drives,
            pads,
            warnings: compiled.warnings,
            held,
            switching,
        })
    }
}
