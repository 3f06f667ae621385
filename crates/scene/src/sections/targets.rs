//! What measures may be asked of: elements, nodes, and what effects and layers put beside them.

use std::cell::OnceCell;

use dashpot_analysis::Family;
use dashpot_network::Network;

use super::Reading;
use crate::text::{document::Item, source::Place};

/// The elements and nodes that a report shows by name.
pub(crate) struct Targets<'r, 'd> {
    reading: &'r Reading<'d>,
    network: &'r Network,
    /// Names that are not in the text, once one is asked for; none where the effects have no place
    /// in the network.
    made: OnceCell<Option<Vec<(String, Family)>>>,
}

impl<'r, 'd> Targets<'r, 'd> {
    /// Those of the scene in `reading`, whose effects are those of `network`.
    pub(crate) fn new(reading: &'r Reading<'d>, network: &'r Network) -> Self {
        Self { reading, network, made: OnceCell::new() }
    }

    /// Whether a name is that of an element or a node, with an error where it is neither.
    pub(super) fn family(&self, name: &str, place: Place) -> Option<Family> {
        let reading = self.reading;
        if reading.elements.contains_key(name) {
            return Some(Family::Element);
        }
        if reading.nodes.contains_key(name) {
            return Some(Family::Node);
        }
        // What is wrong with the effects is told when the network is compiled.
        let made = self.made()?;
        if let Some((_, family)) = made.iter().find(|own| own.0 == name) {
            return Some(*family);
        }
        let known = reading.elements.keys().chain(reading.nodes.keys()).copied();
        let known = known.chain(made.iter().map(|own| own.0.as_str()));
        reading.unknown("element or node", name, place, known);
        None
    }

    /// Checks that a text names a node.
    pub(super) fn node(&self, item: &Item) -> Option<()> {
        let made = item.text().and_then(|name| {
            self.made()?.iter().find(|own| own.0 == name && own.1 == Family::Node)
        });
        if made.is_some() { Some(()) } else { self.reading.node(item).map(|_| ()) }
    }

    /// Whether a name is one that effects or layers bring.
    pub(super) fn is_made(&self, name: &str) -> bool {
        self.made().is_some_and(|made| made.iter().any(|own| own.0 == name))
    }

    fn made(&self) -> Option<&[(String, Family)]> {
        let names = || {
            let network = self.network.with_effects().ok()?;
            let reading = self.reading;
            let elements = network.connections().iter().map(|connection| &connection.name);
            let elements = elements.filter(|name| !reading.elements.contains_key(name.as_str()));
            let nodes = network.nodes().map(|(_, own)| &own.name);
            let nodes = nodes.filter(|name| !reading.nodes.contains_key(name.as_str()));
            let elements = elements.map(|name| (name.clone(), Family::Element));
            Some(elements.chain(nodes.map(|name| (name.clone(), Family::Node))).collect())
        };
        self.made.get_or_init(names).as_deref()
    }
}
