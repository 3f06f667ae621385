//! Models expanded into primitives between joints.

use std::{collections::HashMap, ops::Range, sync::Arc};

use dashpot_rheology::{MOST_LEVELS, Tree};

use super::size::Size;
use crate::{
    Network,
    elements::{Element, Law},
    model::Model,
    network::Connection,
    phases::{Phase, PhaseLaw, Phases, Watched},
};

/// A spring, dashpot or rigid link between two joints.
#[derive(Debug, Clone)]
pub(crate) struct Primitive {
    /// Its path, for instance `padding.maxwell.spring`.
    pub(crate) name: Arc<str>,
    pub(crate) element: Arc<dyn Element>,
    /// The element as it stands in the model; `element` may be that of a phase.
    pub(crate) origin: Arc<dyn Element>,
    pub(crate) law: Law,
    /// Whether it is a rigid link in the model.
    pub(crate) is_link: bool,
    /// The deformation that a rigid link keeps \[m\].
    pub(crate) held: f64,
    /// A force that it puts on its ends whatever they do \[N\].
    pub(crate) push: f64,
    /// What it bears of the force of a slider that stands for it and others beside it.
    pub(crate) share: Option<Share>,
    /// Its ends; joints below the number of nodes are the nodes themselves.
    pub(crate) ends: [usize; 2],
}

impl Primitive {
    /// Stiffness \[N/m\] and damping \[N s/m\] that stand for it in the structure of a network.
    pub(crate) fn slopes(&self) -> [f64; 2] {
        match self.law {
            Law::Spring(stiffness) => [stiffness, 0.0],
            Law::Dashpot(damping) => [0.0, damping],
            Law::Nonlinear { stiffness, damping } => [stiffness, damping],
            Law::Rigid | Law::Phased => [0.0, 0.0],
        }
    }

    /// Whether it switches.
    pub(crate) fn is_phased(&self) -> bool {
        self.origin.phases().is_some()
    }

    /// Whether its rate is of interest in a network that switches: something is dissipated by it, or watches it.
    pub(crate) fn needs_rate(&self) -> bool {
        match self.origin.law() {
            Law::Dashpot(_) => true,
            Law::Nonlinear { damping, .. } => damping > 0.0,
            Law::Phased => self.origin.phases().is_some_and(|own| {
                (0..own.names().len()).any(|index| {
                    let exits = own.exits(Phase { index, memory: 0.0 });
                    exits.iter().any(|exit| exit.watched == Watched::Rate)
                })
            }),
            Law::Spring(_) | Law::Rigid => false,
        }
    }

    /// Whether its law is solved as that of [`Element::reflected`].
    pub(crate) fn is_reflected(&self) -> bool {
        self.is_nonlinear() && self.element.reflected(0.0, 1.0).is_some()
    }

    /// Whether the slope of its law over the rate may vanish.
    pub(crate) fn may_be_flat(&self) -> bool {
        let at_rest = self.element.reflected(0.0, 1.0);
        self.is_nonlinear()
            && self.slopes()[1] > 0.0
            && at_rest.is_none_or(|at_rest| at_rest[1] < 0.0)
    }

    /// Whether the law is not linear.
    pub(crate) fn is_nonlinear(&self) -> bool {
        matches!(self.law, Law::Nonlinear { .. })
    }
}

/// How the primitives of a connection are composed; children stand side by side after their parent.
#[derive(Debug, Clone)]
pub(crate) enum Shape {
    Leaf(usize),
    Series(Range<usize>),
    Parallel(Range<usize>),
    /// In a row with masses between them, so that their forces differ.
    Row(Range<usize>),
}

impl Shape {
    /// The primitive, where the shape is one.
    pub(crate) fn leaf(&self) -> Option<usize> {
        if let Self::Leaf(primitive) = self { Some(*primitive) } else { None }
    }
}

/// A network as joints and primitives.
#[derive(Debug, Clone, Default)]
pub(crate) struct Expansion {
    /// Number of joints: the nodes, then those inside of models.
    pub(crate) joints: usize,
    pub(crate) primitives: Vec<Primitive>,
    /// Whether it is one phase of a network that switches.
    pub(crate) switches: bool,
    /// How large the motion is, where that is known.
    pub(crate) size: Option<Size>,
    /// For each connection its shape, the root first.
    pub(crate) shapes: Vec<Box<[Shape]>>,
    /// For each joint inside of a model the name of its connection; `None` for nodes.
    pub(crate) owners: Vec<Option<String>>,
}

/// Whether the name of a connection says already what its only element is: `padding.contact`.
fn says(name: &str, kind: &str) -> bool {
    name.rsplit_once('.').is_some_and(|(_, end)| end == kind)
}

/// Longest path that is written out in full; deeper parts are named by their number.
pub(super) const LONGEST_PATH: usize = 160;

/// Where a model of a connection is expanded.
struct Site {
    ends: [usize; 2],
    path: String,
    /// Its place among the shapes.
    shape: usize,
    /// Compositions around it.
    levels: usize,
}

impl Expansion {
    pub(crate) fn of(network: &Network) -> Self {
        let nodes = network.nodes.len();
        let mut expansion = Self { joints: nodes, owners: vec![None; nodes], ..Self::default() };
        for connection in &network.connections {
            let shape = expansion.shapes_of(connection);
            expansion.shapes.push(shape);
        }
        share(&mut expansion.primitives);
        expansion
    }

    /// The same expansion for runs of this size.
    pub(crate) fn of_size(mut self, size: Size) -> Self {
        for primitive in self.primitives.iter_mut().filter(|primitive| primitive.is_nonlinear()) {
            primitive.law = size.law(primitive.element.as_ref());
        }
        self.size = Some(size);
        self
    }

    /// The primitives that switch, by their numbers.
    pub(crate) fn phased(&self) -> Vec<usize> {
        (0..self.primitives.len()).filter(|&at| self.primitives[at].law == Law::Phased).collect()
    }

    /// The same expansion with each of these primitives in a phase.
    pub(crate) fn in_phases(&self, parts: &[usize], phases: &[Phase]) -> Self {
        let mut copy = self.clone();
        copy.switches = true;
        for (&part, &phase) in parts.iter().zip(phases) {
            let primitive = &mut copy.primitives[part];
            let Some(own) = primitive.element.phases() else { continue };
            match own.law(phase) {
                PhaseLaw::Open => primitive.law = Law::Spring(0.0),
                PhaseLaw::Held(deformation) => {
                    primitive.law = Law::Rigid;
                    primitive.held = deformation;
                }
                PhaseLaw::Force(force) => {
                    primitive.law = Law::Spring(0.0);
                    // The part of it that is its own is what its law says.
                    primitive.push = force / primitive.share.map_or(1.0, |share| share.part);
                }
                PhaseLaw::Element(element) => {
                    primitive.law = match &self.size {
                        Some(size) => size.law(element.as_ref()),
                        None => element.law(),
                    };
                    primitive.push = element.push();
                    primitive.element = element;
                }
            }
        }
        copy
    }

    /// The same for balances at rest: what has one law of the deformation has the whole of it.
    pub(crate) fn at_rest(&self, parts: &[usize], phases: &[Phase]) -> Self {
        let mut copy = self.in_phases(parts, phases);
        for &part in parts {
            let primitive = &mut copy.primitives[part];
            if let Some(law) = primitive.origin.phases().and_then(Phases::at_rest) {
                (primitive.law, primitive.push) = (law, 0.0);
                primitive.element = Arc::clone(&primitive.origin);
            }
        }
        copy
    }

    fn shapes_of(&mut self, connection: &Connection) -> Box<[Shape]> {
        let mut shapes = vec![Shape::Series(0..0)];
        let ends = connection.between.map(|id| id.0);
        let root = Site { ends, path: connection.name.clone(), shape: 0, levels: 0 };
        self.expand(connection, &connection.model, root, &mut shapes);
        shapes.into_boxed_slice()
    }

    /// Expands a model of `whole`; what is nested too deeply, and refused, stays empty.
    fn expand(&mut self, whole: &Connection, model: &Model, site: Site, shapes: &mut Vec<Shape>) {
        let Site { ends, path, shape, levels } = site;
        if let Tree::Part(element) = model {
            shapes[shape] = Shape::Leaf(self.primitives.len());
            let is_whole = shape == 0 && !says(&path, element.kind());
            let name = if is_whole { format!("{path}.{}", element.kind()) } else { path };
            let law = element.law();
            self.primitives.push(Primitive {
                name: name.into(),
                element: Arc::clone(element),
                origin: Arc::clone(element),
                is_link: law == Law::Rigid,
                law,
                held: 0.0,
                push: 0.0,
                share: None,
                ends,
            });
            return;
        }
        if levels == MOST_LEVELS {
            return;
        }
        let (branches, in_series) = (model.branches(), model.is_series());
        let children = shapes.len()..shapes.len() + branches.len();
        shapes.resize(children.end, Shape::Series(0..0));
        shapes[shape] = match in_series {
            true if shape == 0 && !whole.through.is_empty() => Shape::Row(children.clone()),
            true => Shape::Series(children.clone()),
            false => Shape::Parallel(children.clone()),
        };
        let mut left = ends[0];
        let last = branches.len().saturating_sub(1);
        let mut sites = Vec::with_capacity(branches.len());
        for (at, (branch, shape)) in branches.iter().zip(children).enumerate() {
            let right = match whole.through.get(at) {
                _ if !in_series || at == last => ends[1],
                Some(node) if levels == 0 => node.0,
                _ => self.joint(&whole.name),
            };
            let ends = if in_series { [left, right] } else { ends };
            let path = self.path(&path, &whole.name, &branch.name);
            sites.push(Site { ends, path, shape, levels: levels + 1 });
            left = right;
        }
        for (branch, site) in branches.iter().zip(sites) {
            self.expand(whole, &branch.tree, site, shapes);
        }
    }

    fn joint(&mut self, connection: &str) -> usize {
        self.owners.push(Some(connection.to_owned()));
        self.joints += 1;
        self.joints - 1
    }

    fn path(&self, parent: &str, connection: &str, branch: &str) -> String {
        if parent.len() > LONGEST_PATH {
            format!("{connection}.….{branch}-{}", self.primitives.len() + self.joints)
        } else {
            format!("{parent}.{branch}")
        }
    }
}

/// The part of another primitive's force that is one's own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Share {
    /// Number of the primitive that stands for all of them.
    pub(crate) of: usize,
    /// The part of its whole force; the sign is that of the direction.
    pub(crate) part: f64,
}

impl Share {
    /// The sign of the direction.
    pub(crate) fn sign(self) -> f64 {
        1.0_f64.copysign(self.part)
    }
}

/// Lets the first of all sliders between the same joints stand for them. While they stick, how they
/// share the force is not determined by Coulomb's law; it is shared as when they slide, in
/// proportion to the forces at which they do, so that they let go together.
fn share(primitives: &mut [Primitive]) {
    let mut groups: HashMap<[usize; 2], Vec<(usize, f64)>> = HashMap::new();
    for (at, primitive) in primitives.iter().enumerate() {
        let [a, b] = primitive.ends;
        if let Some(capacity) = primitive.origin.phases().and_then(Phases::capacity)
            && a != b
        {
            groups.entry([a.min(b), a.max(b)]).or_default().push((at, capacity));
        }
    }
    for group in groups.into_values().filter(|own| own.len() > 1) {
        let whole: f64 = group.iter().map(|own| own.1).sum();
        let of = group[0].0;
        let ends = primitives[of].ends;
        for (at, capacity) in group {
            let sign = if primitives[at].ends == ends { 1.0 } else { -1.0 };
            primitives[at].share = Some(Share { of, part: sign * capacity / whole });
            if at != of {
                primitives[at].law = Law::Spring(0.0);
            }
        }
    }
}
