//! What a network is made of.

use std::collections::BTreeMap;

use dashpot_network::{
    Network,
    parameters::{Dimension, InvalidParameter},
};

use super::walk::{Visit, walk};

/// A parameter of a network.
#[derive(Debug, Clone, PartialEq)]
pub struct Quantity {
    /// Its name, for instance `padding.maxwell.spring`.
    pub name: String,
    /// Its dimension.
    pub dimension: Dimension,
    /// Its value, in SI units.
    pub value: f64,
}

/// All parameters of a network, and its structure.
///
/// A height of fall counts by the speed at touch. The duration of the run is no parameter of the
/// network.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Inventory {
    /// The parameters, in the order of nodes, elements, loads and effects.
    pub quantities: Vec<Quantity>,
    /// What is no number, by name: kinds, words, what stands between what.
    pub structure: BTreeMap<String, String>,
}

impl Inventory {
    /// The parameters and the structure of a network.
    ///
    /// # Errors
    ///
    /// A value of the network that is out of range.
    pub fn of(network: &Network) -> Result<Self, InvalidParameter> {
        let mut inventory = Self::default();
        walk(network, &mut inventory)?;
        Ok(inventory)
    }

    /// The parameter of this name.
    pub fn quantity(&self, name: &str) -> Option<&Quantity> {
        self.quantities.iter().find(|quantity| quantity.name == name)
    }

    /// The names of all that there is.
    pub(super) fn names(&self) -> Vec<&str> {
        let words = self.structure.keys().map(String::as_str);
        let mut names: Vec<&str> =
            self.quantities.iter().map(|quantity| quantity.name.as_str()).chain(words).collect();
        names.sort_unstable();
        names
    }
}

impl Visit for Inventory {
    fn quantity(&mut self, name: &str, dimension: Dimension, value: f64) -> f64 {
        self.quantities.push(Quantity { name: name.to_owned(), dimension, value });
        value
    }

    fn word(&mut self, name: &str, word: &str) {
        self.structure.insert(name.to_owned(), word.to_owned());
    }
}

/// The network with another value of one parameter.
///
/// # Errors
///
/// A value that is out of range.
pub(super) fn with_value(
    network: &Network,
    name: &str,
    value: f64,
) -> Result<Network, InvalidParameter> {
    struct Put<'n>(&'n str, f64);
    impl Visit for Put<'_> {
        fn quantity(&mut self, name: &str, _dimension: Dimension, value: f64) -> f64 {
            if name == self.0 { self.1 } else { value }
        }
    }
    walk(network, &mut Put(name, value))
}
