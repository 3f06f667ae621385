//! The network around a model: what drives it, and what is read off it.

use dashpot_network::{Model, Network, Node, first_nonlinear};

use super::{
    history::{Drive, History},
    perturbation::perturbed,
};

/// Name of the connection that a model becomes.
pub(super) const NAME: &str = "model";

/// Models in a row between a massless head and the ground, and what is read off them.
#[derive(Debug)]
pub(super) struct Rig<'a> {
    chain: Vec<(&'static str, Model)>,
    drive: Drive,
    history: &'a History,
    /// Names of the outputs that are read.
    pub(super) outputs: Vec<String>,
}

impl<'a> Rig<'a> {
    /// A rig for `model`; its one output is the deformation under a given force, or the force under
    /// a given deformation.
    pub(super) fn new(model: &Model, drive: Drive, history: &'a History) -> Self {
        let output = match drive {
            Drive::Force => format!("{NAME}.deformation"),
            Drive::Deformation => format!("{NAME}.force"),
        };
        Self { chain: vec![(NAME, model.clone())], drive, history, outputs: vec![output] }
    }

    /// A rig for models in a row, from the head on; its outputs are their deformations.
    pub(super) fn chain(
        chain: Vec<(&'static str, Model)>,
        drive: Drive,
        history: &'a History,
    ) -> Self {
        let outputs = chain.iter().map(|(name, _)| format!("{name}.deformation")).collect();
        Self { chain, drive, history, outputs }
    }

    /// The same rig with the models [`perturbed`].
    pub(super) fn perturbed(&self, seed: u64) -> Self {
        let chain =
            self.chain.iter().map(|(name, model)| (*name, perturbed(model, seed))).collect();
        Self { chain, outputs: self.outputs.clone(), ..*self }
    }

    /// Whether any of the models is not linear.
    pub(super) fn is_nonlinear(&self) -> bool {
        self.chain.iter().any(|(_, model)| first_nonlinear(model).is_some())
    }

    pub(super) fn history(&self) -> &History {
        self.history
    }

    /// The network; `None` where the corners of the history cannot be told apart.
    pub(super) fn network(&self) -> Option<Network> {
        let waveform = self.history.waveform()?;
        let mut network = Network::new();
        let head = match self.drive {
            Drive::Force => {
                let head = network.add_node(Node::massless("head"));
                network.add_load("force", head, waveform);
                head
            }
            Drive::Deformation => network.add_node(Node::prescribed("head", waveform)),
        };
        let mut from = head;
        for (at, (name, model)) in self.chain.iter().enumerate() {
            let to = if at + 1 < self.chain.len() {
                network.add_node(Node::massless(format!("behind {name}")))
            } else {
                network.ground()
            };
            network.connect(*name, from, to, model.clone());
            from = to;
        }
        Some(network)
    }
}
