//! Details that a network can be without.

use crate::{
    Connection, Influence, Network, NodeId, Situation, Support, effects, elements::Rigid,
    model::stiffness::Stiffness, part,
};

/// A detail of a network that it can be without: another network that is simpler.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Detail {
    /// The effect of this position in [`Network::effects`]. Without it the network is that whose effect is off.
    Effect(usize),
    /// The mass of the layers of the connection of this position in [`Network::connections`].
    /// Without it they have no density.
    Inertia(usize),
    /// The motion of this mass, which fixed nodes hold. Without it the support is rigid.
    Compliance(NodeId),
}

impl Detail {
    /// All details of a network, effects first.
    pub fn all(network: &Network) -> Vec<Self> {
        let effects = (0..network.effects.len()).map(Self::Effect);
        let layered = |connection: &Connection| {
            connection.layers.as_ref().is_some_and(|own| own.mass() > 0.0)
        };
        let layers = network.connections.iter().enumerate().filter(|(_, own)| layered(own));
        let supported = network.nodes().map(|(id, _)| id).filter(|&id| is_supported(network, id));
        effects
            .chain(layers.map(|(at, _)| Self::Inertia(at)))
            .chain(supported.map(Self::Compliance))
            .collect()
    }

    /// What it is called, for instance `gravity`, `face.padding`, `inertia of padding`, `compliance of panel`.
    pub fn name(self, network: &Network) -> String {
        match self {
            Self::Effect(at) => {
                let effect = &network.effects[at];
                let target = effect.target().map(|own| format!(".{own}")).unwrap_or_default();
                format!("{}{target}", effect.kind())
            }
            Self::Inertia(at) => format!("inertia of {}", network.connections[at].name),
            Self::Compliance(id) => format!("compliance of {}", network.node(id).name),
        }
    }

    /// The dimensionless numbers that measure how much it matters; none where the scales do not tell.
    pub fn influences(self, situation: &Situation<'_>) -> Vec<Influence> {
        let network = situation.network;
        let found = match self {
            Self::Effect(at) => network.effects[at].influences(situation),
            Self::Inertia(at) => inertia(situation, &network.connections[at]),
            Self::Compliance(id) => compliance(situation, id),
        };
        found.into_iter().filter(|own| !own.value.is_nan()).collect()
    }
}

impl Network {
    /// The network without these details of it.
    ///
    /// # Panics
    ///
    /// When a detail is one of another, larger network.
    #[must_use]
    pub fn without(&self, details: &[Detail]) -> Self {
        let mut network = self.clone();
        for detail in details {
            match *detail {
                Detail::Effect(at) => self.effects[at].leave(&mut network),
                Detail::Inertia(at) => {
                    let layers = network.connections[at].layers.iter_mut();
                    layers.flat_map(|layer| &mut layer.all).for_each(|layer| layer.density = 0.0);
                }
                Detail::Compliance(id) => {
                    let holds = |own: &&mut Connection| is_held_by(self, own, id);
                    if let Some(connection) = network.connections.iter_mut().find(holds) {
                        connection.model = part(Rigid);
                    }
                }
            }
        }
        let mut at = 0;
        network.effects.retain(|_| {
            at += 1;
            !details.contains(&Detail::Effect(at - 1))
        });
        network
    }
}

/// Whether a connection holds a node at a fixed one.
fn is_held_by(network: &Network, connection: &Connection, id: NodeId) -> bool {
    let is_fixed = |end: NodeId| network.node(end).support == Support::Fixed;
    let [a, b] = connection.between;
    (a == id && is_fixed(b)) || (b == id && is_fixed(a))
}

/// The connections that hold a node at fixed ones.
fn supports(network: &Network, id: NodeId) -> impl Iterator<Item = &Connection> {
    network.connections.iter().filter(move |connection| is_held_by(network, connection, id))
}

/// Whether a node is a mass that springs hold at a fixed node, and nothing more is made of those.
fn is_supported(network: &Network, id: NodeId) -> bool {
    let node = network.node(id);
    let is_mass = node.support == Support::Free && node.mass > 0.0 && !node.is_impactor();
    let is_loaded = network.loads.iter().any(|load| load.node == id);
    let is_plain = |connection: &Connection| {
        let targeted =
            |effect: &dyn effects::Effect| effect.target() == Some(connection.name.as_str());
        connection.layers.is_none()
            && !network.effects.iter().any(|effect| targeted(effect.as_ref()))
    };
    is_mass
        && !is_loaded
        && supports(network, id).next().is_some()
        && supports(network, id).all(is_plain)
}

/// The time that a wave takes through a pad, over that of the impact.
fn inertia(situation: &Situation<'_>, connection: &Connection) -> Vec<Influence> {
    let (Some(layers), Some(impact)) = (&connection.layers, &situation.impact) else {
        return Vec::new();
    };
    let omega = impact.time().recip();
    let transits = layers.all.iter().filter_map(|layer| layer.wave(omega));
    let transit: f64 = transits.map(|wave| wave.transit).sum();
    vec![Influence::new("Σ L/c · √(K/m1)", transit * omega)]
}

/// The displacement of a support that is struck over that of the impactor, `γ/(1 + α + β)` in the groups of the thesis.
fn compliance(situation: &Situation<'_>, id: NodeId) -> Vec<Influence> {
    let Some(impact) = &situation.impact else { return Vec::new() };
    let (network, passage) = (situation.network, impact.passage());
    let is_struck = situation.struck().any(|own| own.between.contains(&id));
    if !is_struck {
        return Vec::new();
    }
    let mass = network.node(id).mass;
    let at_impact =
        |connection: &Connection| Stiffness::of(&connection.model, passage.recip()).size();
    let held: f64 = supports(network, id).map(at_impact).sum();
    let (gamma, held) = (impact.mass / mass, passage * passage * held / mass);
    let formula = "γ/(1 + J² |K3*|/m3)";
    vec![Influence::new(formula, gamma / (1.0 + held))]
}
