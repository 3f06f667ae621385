//! A network until what strikes it is let go.

use std::borrow::Cow;

use dashpot_dae::Waveform;

use crate::{
    Network, NodeId,
    compile::{
        bodies::{Bodies, Role},
        expand::Expansion,
    },
    elements::Law,
    phases::{PhaseLaw, Phases, Watched},
};

/// A network with what its effects put into it, each contact in its first phase.
pub(super) struct FirstPhases<'n> {
    pub(super) network: Cow<'n, Network>,
    pub(super) expansion: Expansion,
    /// Constant forces on its nodes \[N\].
    pub(super) forces: Vec<(NodeId, f64)>,
    /// The primitives that open.
    opening: Vec<usize>,
}

impl<'n> FirstPhases<'n> {
    /// `None` where more acts on it than constant forces, or something switches but contacts that are closed at first.
    pub(super) fn of(network: &'n Network) -> Option<Self> {
        if !network.loads.is_empty() {
            return None;
        }
        let mut forces = Vec::new();
        for effect in network.effects() {
            for (node, force) in effect.body_forces(network) {
                forces.push((node, constant(&force)?));
            }
        }
        let network = network.with_effects().ok()?;
        let expansion = Expansion::of(&network);
        let opening = expansion.phased();
        let first = |&at: &usize| {
            let phases = expansion.primitives[at].element.phases()?;
            opens(phases).then(|| phases.first(0.0))
        };
        let phases: Vec<_> = opening.iter().map(first).collect::<Option<_>>()?;
        let expansion =
            if opening.is_empty() { expansion } else { expansion.in_phases(&opening, &phases) };
        Some(Self { network, expansion, forces, opening })
    }

    /// Whether anything opens.
    pub(super) fn opens(&self) -> bool {
        !self.opening.is_empty()
    }

    /// Whether all that opens joins a face without mass to the body that strikes.
    pub(super) fn opens_at(&self, bodies: &Bodies, struck: usize) -> bool {
        let joined = self.opening.iter().all(|&at| {
            let ends = self.expansion.primitives[at].ends;
            ends.iter().all(|&joint| bodies.of_joint[joint] == struck)
        });
        let body = &bodies.all[struck];
        let mut nodes = body.joints.iter().filter_map(|&joint| self.network.nodes.get(joint));
        let is_alone = nodes.all(|node| node.is_impactor() || node.mass == 0.0);
        joined && (self.opening.is_empty() || is_alone && matches!(body.role, Role::Mass(_)))
    }

    /// Whether all forces act on bodies with mass, or on what is fixed; others would sag, or be in balance.
    pub(super) fn forces_act_on_masses(&self, bodies: &Bodies) -> bool {
        self.forces.iter().all(|force| match bodies.all[bodies.of_joint[force.0.0]].role {
            Role::Mass(_) | Role::Fixed => true,
            Role::Massless | Role::Prescribed(_) => false,
        })
    }

    pub(super) fn law(&self, primitive: usize) -> Option<Law> {
        let own = &self.expansion.primitives[primitive];
        (own.push == 0.0 && own.share.is_none() && own.held == 0.0).then_some(own.law)
    }
}

/// Whether it is closed at first, and opens where its force falls to zero.
fn opens(phases: &dyn Phases) -> bool {
    let first = phases.first(0.0);
    let exits = phases.exits(first);
    matches!(phases.law(first), PhaseLaw::Held(_))
        && exits
            .iter()
            .all(|exit| exit.watched == Watched::Force && exit.level == 0.0 && !exit.rising)
}

/// The value of a function of time that has one only.
fn constant(force: &Waveform) -> Option<f64> {
    let [piece] = force.pieces() else { return None };
    piece.is_constant(0).then(|| piece.derivative(0, 0.0))
}
