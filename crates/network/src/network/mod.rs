//! Networks: nodes, elements between them, loads and effects.

mod effect;
mod situation;

use std::sync::Arc;

use dashpot_dae::Waveform;
use dashpot_units::STANDARD_GRAVITY;

pub(crate) use self::situation::frequency;
pub use self::{
    effect::{Effect, Influence},
    situation::{ImpactScales, Situation},
};
use crate::{
    layers::{Layers, Piece},
    model::Model,
};

/// A node of one network.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NodeId(pub(crate) usize);

impl NodeId {
    /// Position of the node in the network's order, which is also that of
    /// [`Assembly::nodes`](crate::Assembly::nodes).
    pub fn index(self) -> usize {
        self.0
    }
}

/// A point with one displacement.
#[derive(Debug, Clone, PartialEq)]
pub struct Node {
    /// Its name.
    pub name: String,
    /// Its mass `m` \[kg\], ≥ 0.
    pub mass: f64,
    /// What rules its motion.
    pub support: Support,
    /// How a free mass begins; a node with a start speed is an impactor.
    pub start: Start,
    /// Where a free mass begins \[m\], in displacements: positive towards the support. What is between it and
    /// others is deformed then, springs at once and dashpots that are in a row with them not yet.
    pub position: f64,
}

/// What rules the motion of a node.
#[derive(Debug, Clone, PartialEq)]
pub enum Support {
    /// The forces on it.
    Free,
    /// Nothing moves it.
    Fixed,
    /// Its displacement \[m\] is this function of time \[s\].
    Prescribed(Waveform),
}

/// How a free mass begins.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Start {
    /// Without speed.
    Rest,
    /// With a velocity \[m/s\], positive towards the support.
    Velocity(f64),
    /// With a fall from the height `h` \[m\], ≥ 0. Where gravity is on and pulls towards the support, and
    /// all elements at the node have it as their first end and never pull, it begins at rest at the height
    /// h above touch, and falls. Everywhere else it begins at touch at t = 0 with the speed √(2 g h); `g`
    /// is the absolute value of that of the gravity effect, or standard gravity where it is off.
    Drop(f64),
}

impl Node {
    /// A free node of the given mass \[kg\] at rest; 0 makes it massless.
    pub fn mass(name: impl Into<String>, mass: f64) -> Self {
        Self { name: name.into(), mass, support: Support::Free, start: Start::Rest, position: 0.0 }
    }

    /// A free massless node.
    pub fn massless(name: impl Into<String>) -> Self {
        Self::mass(name, 0.0)
    }

    /// A node that nothing moves.
    pub fn fixed(name: impl Into<String>) -> Self {
        Self { support: Support::Fixed, ..Self::mass(name, 0.0) }
    }

    /// A node whose displacement \[m\] is a given function of time \[s\].
    pub fn prescribed(name: impl Into<String>, motion: Waveform) -> Self {
        Self { support: Support::Prescribed(motion), ..Self::mass(name, 0.0) }
    }

    /// The same node with a start velocity \[m/s\]: an impactor.
    #[must_use]
    pub fn moving(self, velocity: f64) -> Self {
        Self { start: Start::Velocity(velocity), ..self }
    }

    /// The same node at the end of a fall from `height` \[m\]: an impactor.
    #[must_use]
    pub fn dropped(self, height: f64) -> Self {
        Self { start: Start::Drop(height), ..self }
    }

    /// The same node, beginning at `position` \[m\].
    #[must_use]
    pub fn at(self, position: f64) -> Self {
        Self { position, ..self }
    }

    /// Whether the node starts with a speed of its own.
    pub fn is_impactor(&self) -> bool {
        self.start != Start::Rest
    }
}

/// A model between two nodes.
#[derive(Debug, Clone)]
pub struct Connection {
    /// Its name.
    pub name: String,
    /// Its ends, the impactor's side first.
    pub between: [NodeId; 2],
    /// Its law.
    pub model: Model,
    /// Thickness \[m\] of the pad that it stands for, where it is one: deformation beyond it is warned of.
    pub thickness: Option<f64>,
    /// Area \[m²\] of the pad that it stands for, where it is known.
    pub area: Option<f64>,
    /// Branches of its model that are pads with a size of their own, each looked at for itself.
    pub pads: Vec<InnerPad>,
    /// The layers with mass that it is made of, where it is; its model is that of the pad as if it
    /// had no mass. They are cut into segments when the network is compiled.
    pub layers: Option<Layers>,
    /// Nodes between the branches of the model, one fewer than branches of a series; none where
    /// nothing hangs on the places between them.
    pub(crate) through: Vec<NodeId>,
    /// The pieces of layers that each branch of the model stands for, or of the model itself where
    /// nothing hangs between its branches; none before the layers are resolved.
    pub(crate) pieces: Vec<Vec<Piece>>,
    /// Time \[s\] in which a wave crosses the thickest segment of the layers; 0 before they are resolved, and where no
    /// wave travels.
    pub(crate) passage: f64,
}

/// A branch of the model of a connection that is a pad with a size of its own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InnerPad {
    /// Which branch: its number among all branches and parts of the model, in the order in which
    /// [`Tree::fold`](dashpot_rheology::Tree::fold) is done with them, so that each has its own branches before it.
    pub at: usize,
    /// Thickness \[m\], > 0.
    pub thickness: f64,
    /// Area \[m²\], > 0, where it is known.
    pub area: Option<f64>,
}

impl Connection {
    /// Whether its law has no tension at the end 0 or 1 of [`between`](Self::between): the force
    /// there goes through an element that [never pulls](crate::Element::never_pulls).
    pub fn never_pulls(&self, end: usize) -> bool {
        let own = self.model.branches();
        let at_end = if end == 0 { own.first() } else { own.last() };
        // Behind a mass the force is another one.
        let model = at_end.filter(|_| !self.through.is_empty());
        model.map_or(&self.model, |branch| &branch.tree).fold(
            |element| element.never_pulls(),
            |node, parts: Vec<bool>| {
                if node.is_series() {
                    parts.contains(&true)
                } else {
                    !parts.is_empty() && !parts.contains(&false)
                }
            },
        )
    }
}

/// A force on a node.
#[derive(Debug, Clone, PartialEq)]
pub struct Load {
    /// Its name.
    pub name: String,
    /// Where it acts.
    pub node: NodeId,
    /// The force \[N\] as a function of time \[s\], positive towards the support.
    pub force: Waveform,
}

/// What effects have put at an element.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PadOutputs {
    /// The element, in [`Assembly::connections`](crate::Assembly::connections).
    pub element: usize,
    /// The node in [`Assembly::nodes`](crate::Assembly::nodes) that is an end of the element in place of that which it lies
    /// at, where it has such a face.
    pub face: Option<usize>,
    /// The connection between the face and that node: a contact, or a rigid link.
    pub contact: Option<usize>,
    /// The connection beside the element that is its stop.
    pub stop: Option<usize>,
}

/// Start velocity \[m/s\] of a node under the network's gravity.
pub(crate) fn start_velocity(network: &Network, start: Start) -> f64 {
    match start {
        Start::Rest => 0.0,
        Start::Velocity(velocity) => velocity,
        Start::Drop(height) => {
            let gravity = network.effects.iter().find_map(|effect| effect.gravity());
            (2.0 * gravity.unwrap_or(STANDARD_GRAVITY).abs() * height).sqrt()
        }
    }
}

/// Nodes, elements between them, loads and effects.
///
/// # Examples
///
/// ```
/// use dashpot_network::{Network, Node, dashpot, spring};
///
/// let mut network = Network::new();
/// let head = network.add_node(Node::mass("head", 10.0).moving(10.0));
/// let ground = network.ground();
/// network.connect("padding", head, ground, spring(2e7) | dashpot(4e3)).thickness = Some(0.02);
/// let assembly = network.compile(0.02)?;
/// assert_eq!(assembly.system.states(), 2);
/// # Ok::<(), dashpot_network::NetworkErrors>(())
/// ```
#[derive(Debug, Clone)]
pub struct Network {
    pub(crate) nodes: Vec<Node>,
    pub(crate) connections: Vec<Connection>,
    pub(crate) loads: Vec<Load>,
    pub(crate) effects: Vec<Arc<dyn Effect>>,
    /// What its effects have put into it.
    pub(crate) pads: Vec<PadOutputs>,
}

impl Default for Network {
    fn default() -> Self {
        Self::new()
    }
}

impl Network {
    /// A network that has only the fixed node `ground`.
    pub fn new() -> Self {
        Self {
            nodes: vec![Node::fixed("ground")],
            connections: Vec::new(),
            loads: Vec::new(),
            effects: Vec::new(),
            pads: Vec::new(),
        }
    }

    /// The fixed node that every network has.
    pub fn ground(&self) -> NodeId {
        NodeId(0)
    }

    /// Adds a node. Names are checked when the network is compiled.
    pub fn add_node(&mut self, node: Node) -> NodeId {
        self.nodes.push(node);
        NodeId(self.nodes.len() - 1)
    }

    /// Puts a model between two nodes of this network, the impactor's side first.
    pub fn connect(
        &mut self,
        name: impl Into<String>,
        from: NodeId,
        to: NodeId,
        model: impl Into<Model>,
    ) -> &mut Connection {
        let at = self.connections.len();
        self.connections.push(Connection {
            name: name.into(),
            between: [from, to],
            model: model.into(),
            thickness: None,
            area: None,
            pads: Vec::new(),
            layers: None,
            through: Vec::new(),
            pieces: Vec::new(),
            passage: 0.0,
        });
        &mut self.connections[at]
    }

    /// Puts a pad of layers between two nodes of this network, the impactor's side first.
    pub fn connect_layers(
        &mut self,
        name: impl Into<String>,
        from: NodeId,
        to: NodeId,
        layers: Layers,
    ) -> &mut Connection {
        let connection = self.connect(name, from, to, layers.model());
        connection.thickness = Some(layers.thickness());
        connection.layers = Some(layers);
        connection
    }

    /// Puts another model in the place of that of a connection, by its position. A pad of layers
    /// becomes one that has no mass, and inner pads are forgotten.
    ///
    /// # Panics
    ///
    /// When there are not so many connections.
    pub fn set_model(&mut self, connection: usize, model: Model) {
        let connection = &mut self.connections[connection];
        connection.model = model;
        connection.pads.clear();
        connection.layers = None;
    }

    /// Lets a force \[N\] act on a node.
    pub fn add_load(&mut self, name: impl Into<String>, node: NodeId, force: Waveform) {
        self.loads.push(Load { name: name.into(), node, force });
    }

    /// Switches an effect on.
    pub fn add_effect(&mut self, effect: impl Effect + 'static) {
        self.effects.push(Arc::new(effect));
    }

    /// Switches on an effect that is shared with others.
    pub fn add_shared_effect(&mut self, effect: Arc<dyn Effect>) {
        self.effects.push(effect);
    }

    /// All nodes, `ground` first.
    pub fn nodes(&self) -> impl Iterator<Item = (NodeId, &Node)> {
        self.nodes.iter().enumerate().map(|(at, node)| (NodeId(at), node))
    }

    /// A node of this network.
    ///
    /// # Panics
    ///
    /// When the id belongs to another, larger network.
    pub fn node(&self, id: NodeId) -> &Node {
        &self.nodes[id.0]
    }

    /// The same, to be changed.
    ///
    /// # Panics
    ///
    /// When the id belongs to another, larger network.
    pub fn node_mut(&mut self, id: NodeId) -> &mut Node {
        &mut self.nodes[id.0]
    }

    /// All nodes but `ground`, to be changed.
    pub fn nodes_mut(&mut self) -> &mut [Node] {
        &mut self.nodes[1..]
    }

    /// The node of the given name.
    pub fn node_named(&self, name: &str) -> Option<NodeId> {
        self.nodes.iter().position(|node| node.name == name).map(NodeId)
    }

    /// The models between nodes.
    pub fn connections(&self) -> &[Connection] {
        &self.connections
    }

    /// The same, to be changed.
    pub fn connections_mut(&mut self) -> &mut [Connection] {
        &mut self.connections
    }

    /// What effects have put at the element of this position; see [`with_effects`](Self::with_effects).
    pub fn pad(&self, element: usize) -> Option<&PadOutputs> {
        self.pads.iter().find(|pad| pad.element == element)
    }

    /// The same, to be put there.
    pub(crate) fn pad_mut(&mut self, element: usize) -> &mut PadOutputs {
        let at = self.pads.iter().position(|pad| pad.element == element).unwrap_or_else(|| {
            self.pads.push(PadOutputs { element, face: None, contact: None, stop: None });
            self.pads.len() - 1
        });
        &mut self.pads[at]
    }

    /// The forces on nodes.
    pub fn loads(&self) -> &[Load] {
        &self.loads
    }

    /// The same, to be changed.
    pub fn loads_mut(&mut self) -> &mut Vec<Load> {
        &mut self.loads
    }

    /// The effects that are on.
    pub fn effects(&self) -> &[Arc<dyn Effect>] {
        &self.effects
    }

    /// The same, to be changed.
    pub fn effects_mut(&mut self) -> &mut Vec<Arc<dyn Effect>> {
        &mut self.effects
    }
}
