//! What shakes a network.

use std::f64::consts::TAU;

use dashpot_dae::{Piece, Waveform};
use dashpot_network::{Assembly, Network, NodeId, Support};

use super::VibrationError;

/// How a drive acts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum DriveKind {
    /// A node moves in a given way; its amplitude is in m.
    Motion,
    /// A force pushes a node; its amplitude is in N.
    Load,
}

impl DriveKind {
    /// SI unit of the amplitude.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Motion => "m",
            Self::Load => "N",
        }
    }
}

/// What shakes a network: a load, or a node that is moved.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Drive {
    /// Name of the load, or of the node.
    pub name: String,
    /// How it acts.
    pub kind: DriveKind,
    /// The node on which it acts.
    pub node: String,
}

/// Whatever can drive a network: its loads, its nodes with given motions, and its fixed nodes.
pub fn drives(network: &Network) -> Vec<Drive> {
    let loads = network.loads().iter().map(|load| Drive {
        name: load.name.clone(),
        kind: DriveKind::Load,
        node: network.node(load.node).name.clone(),
    });
    let held = |is_moved: bool| {
        network.nodes().filter(move |(id, node)| {
            let is_used =
                network.connections().iter().any(|connection| connection.between.contains(id));
            match node.support {
                Support::Prescribed(_) => is_moved,
                Support::Fixed => !is_moved && is_used,
                Support::Free => false,
            }
        })
    };
    let motions = held(true).chain(held(false)).map(|(_, node)| Drive {
        name: node.name.clone(),
        kind: DriveKind::Motion,
        node: node.name.clone(),
    });
    loads.chain(motions).collect()
}

/// The drive of this name; without a name the only load or given motion that there is.
pub(super) fn chosen(network: &Network, name: Option<&str>) -> Result<Drive, VibrationError> {
    let all = drives(network);
    let known = || all.iter().map(|own| own.name.clone()).collect();
    if let Some(name) = name {
        let found = all.iter().find(|own| own.name == name).cloned();
        let unknown = || VibrationError::UnknownDrive { name: name.to_owned(), known: known() };
        return found.ok_or_else(unknown);
    }
    let is_own = |drive: &&Drive| {
        let node = network.node_named(&drive.node).map(|id| network.node(id));
        drive.kind == DriveKind::Load
            || node.is_some_and(|node| matches!(node.support, Support::Prescribed(_)))
    };
    let own: Vec<&Drive> = all.iter().filter(is_own).collect();
    match own[..] {
        [only] => Ok(only.clone()),
        _ => Err(VibrationError::NoDrive { loads_and_motions: own.len(), known: known() }),
    }
}

/// The network in which nothing but `drive` acts, a sine of the amplitude 1 N or 1 m; `assembly` is what it compiles
/// to as it is.
pub(super) fn driven(
    network: &Network,
    assembly: &Assembly,
    drive: &Drive,
    node: NodeId,
    duration: f64,
) -> Result<Network, VibrationError> {
    let wave = Piece { sine: 1.0, omega: TAU / duration, ..Piece::default() };
    let invalid = VibrationError::InvalidSetting {
        setting: "duration",
        range: "positive and finite",
        value: duration,
    };
    let sine = Waveform::new(vec![wave]).filter(|_| duration > 0.0).ok_or(invalid)?;
    let body = |id: NodeId| assembly.nodes[id.index()].body;
    let mut driven = network.clone();
    for (id, own) in network.nodes() {
        // Nodes that are rigidly linked move as one.
        let is_moved = drive.kind == DriveKind::Motion && body(id) == body(node);
        match &own.support {
            Support::Free => {}
            _ if is_moved => driven.node_mut(id).support = Support::Prescribed(sine.clone()),
            Support::Fixed => {}
            Support::Prescribed(_) => {
                driven.node_mut(id).support = Support::Prescribed(Waveform::constant(0.0));
            }
        }
    }
    let loads = driven.loads_mut();
    loads.retain(|load| drive.kind == DriveKind::Load && load.name == drive.name);
    loads.iter_mut().for_each(|load| load.force = sine.clone());
    Ok(driven)
}
