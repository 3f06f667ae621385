//! Models expanded into primitives between joints.

use std::sync::Arc;

use dashpot_rheology::Tree;

use crate::{
    Network,
    elements::{Element, Law},
    network::Model,
};

/// A spring, dashpot or rigid link between two joints.
#[derive(Debug, Clone)]
pub(crate) struct Primitive {
    /// Its path, for instance `padding.maxwell.spring`.
    pub(crate) name: String,
    pub(crate) element: Arc<dyn Element>,
    pub(crate) law: Law,
    /// Its ends; joints below the number of nodes are the nodes themselves.
    pub(crate) ends: [usize; 2],
}

/// How the primitives of a connection are composed; children stand after their parent.
#[derive(Debug, Clone)]
pub(crate) enum Shape {
    Leaf(usize),
    Series(Vec<usize>),
    Parallel(Vec<usize>),
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
    /// For each connection its shape, the root first.
    pub(crate) shapes: Vec<Vec<Shape>>,
    /// For each joint inside of a model the name of its connection; `None` for nodes.
    pub(crate) owners: Vec<Option<String>>,
}

/// Longest path that is written out in full; deeper parts are named by their number.
const LONGEST_PATH: usize = 160;

struct Pending<'a> {
    model: &'a Model,
    ends: [usize; 2],
    path: String,
    shape: usize,
}

impl Expansion {
    pub(crate) fn of(network: &Network) -> Self {
        let nodes = network.nodes.len();
        let mut expansion = Self { joints: nodes, owners: vec![None; nodes], ..Self::default() };
        for connection in &network.connections {
            let shape = expansion.expand(
                &connection.name,
                &connection.model,
                connection.between.map(|id| id.0),
            );
            expansion.shapes.push(shape);
        }
        expansion
    }

    /// Without recursion, because nesting has no limit.
    fn expand(&mut self, connection: &str, model: &Model, ends: [usize; 2]) -> Vec<Shape> {
        let mut shapes = vec![Shape::Series(Vec::new())];
        let root = Pending { model, ends, path: connection.to_owned(), shape: 0 };
        let mut stack = vec![root];
        while let Some(Pending { model, ends, path, shape }) = stack.pop() {
            match model {
                Tree::Part(element) => {
                    shapes[shape] = Shape::Leaf(self.primitives.len());
                    let is_whole = shape == 0;
                    let name = if is_whole { format!("{path}.{}", element.kind()) } else { path };
                    let law = element.law();
                    self.primitives.push(Primitive {
                        name,
                        element: Arc::clone(element),
                        law,
                        ends,
                    });
                }
                Tree::Series(branches) | Tree::Parallel(branches) => {
                    let in_series = matches!(model, Tree::Series(_));
                    let children: Vec<usize> =
                        (shapes.len()..shapes.len() + branches.len()).collect();
                    shapes.resize(shapes.len() + branches.len(), Shape::Series(Vec::new()));
                    let mut left = ends[0];
                    let last = branches.len().saturating_sub(1);
                    let mut pending = Vec::with_capacity(branches.len());
                    for (at, branch) in branches.iter().enumerate() {
                        let right =
                            if in_series && at < last { self.joint(connection) } else { ends[1] };
                        pending.push(Pending {
                            model: &branch.tree,
                            ends: if in_series { [left, right] } else { ends },
                            path: self.path(&path, connection, &branch.name),
                            shape: children[at],
                        });
                        left = right;
                    }
                    stack.extend(pending.into_iter().rev());
                    shapes[shape] =
                        if in_series { Shape::Series(children) } else { Shape::Parallel(children) };
                }
            }
        }
        shapes
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
