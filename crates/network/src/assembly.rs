//! A network turned into a system, and where its quantities are found there.

use std::sync::Arc;

use dashpot_dae::System;

use crate::{
    compile::{HeldTable, phased::PhasedNetwork},
    network::PadOutputs,
    outputs::{ConnectionOutputs, DriveOutputs, NodeOutputs, PrimitiveOutputs},
    warning::NetworkWarning,
};

/// A network compiled to a [`System`], with an index of its outputs.
///
/// Every `usize` here is an index into [`System::outputs`].
#[derive(Debug, Clone)]
pub struct Assembly {
    /// The equations.
    pub system: System,
    /// One entry for each node, in the network's order.
    pub nodes: Vec<NodeOutputs>,
    /// One entry for each connection, in the network's order.
    pub connections: Vec<ConnectionOutputs>,
    /// The springs and dashpots that take part, connection by connection.
    pub primitives: Vec<PrimitiveOutputs>,
    /// What does work on the network from outside: loads, body forces, prescribed motions.
    pub drives: Vec<DriveOutputs>,
    /// What effects have put at elements, one entry for each element that has anything.
    pub pads: Vec<PadOutputs>,
    /// What is odd but not wrong.
    pub warnings: Vec<NetworkWarning>,
    /// Tables of time that hold a value within the run although nobody says so.
    pub held: Vec<HeldTable>,
    /// The phases of what switches, where anything does; [`system`](Self::system) is then that of the first ones.
    pub switching: Option<Arc<PhasedNetwork>>,
}

impl Assembly {
    /// Whether any of its masses starts with a speed of its own.
    pub fn has_impactor(&self) -> bool {
        self.nodes.iter().any(NodeOutputs::is_impactor)
    }

    /// The connection of the given name.
    pub fn connection(&self, name: &str) -> Option<&ConnectionOutputs> {
        self.connections.iter().find(|connection| connection.name == name)
    }

    /// The node of the given name.
    pub fn node(&self, name: &str) -> Option<&NodeOutputs> {
        self.nodes.iter().find(|node| node.name == name)
    }

    /// What effects have put at the element of this position.
    pub fn pad(&self, element: usize) -> Option<&PadOutputs> {
        self.pads.iter().find(|pad| pad.element == element)
    }

    /// The element whose face the connection of this position links, and what else is there.
    pub fn pad_behind(&self, contact: usize) -> Option<&PadOutputs> {
        self.pads.iter().find(|pad| pad.contact == Some(contact))
    }

    /// Position of the connection of the given name.
    pub fn position(&self, connection: &str) -> Option<usize> {
        self.connections.iter().position(|own| own.name == connection)
    }

    /// Position of the connection that the primitive of this position is part of.
    pub fn owner(&self, primitive: usize) -> Option<usize> {
        let at =
            self.connections.partition_point(|connection| connection.primitives.end <= primitive);
        (at < self.connections.len()).then_some(at)
    }

    /// The output of the given name, for instance `padding.force`.
    pub fn output(&self, name: &str) -> Option<usize> {
        self.system.outputs.find(name)
    }
}
