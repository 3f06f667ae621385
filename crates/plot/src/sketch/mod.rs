//! Drawings of networks: masses, springs, dashpots and supports, as SVG and as text.

mod blocks;
mod graph;
mod layout;
mod list;
mod order;
mod svg;
mod symbols;
mod text;

use std::collections::BTreeMap;

use symbols::SYMBOLS;

/// A network to be drawn, from the impactor on the left to the support on the right.
///
/// # Examples
///
/// ```
/// use dashpot_plot::{Sketch, SketchKind, SketchLink, SketchNode, SketchTree};
///
/// let sketch = Sketch {
///     nodes: vec![
///         SketchNode::new("head", SketchKind::Mass, ["10 kg"]),
///         SketchNode::new("ground", SketchKind::Fixed, []),
///     ],
///     links: vec![SketchLink {
///         name: "padding".into(),
///         from: 0,
///         to: 1,
///         tree: SketchTree::Parallel(vec![
///             SketchTree::element("spring", "20 MN/m"),
///             SketchTree::element("dashpot", "4 kN s/m"),
///         ]),
///     }],
///     gravity: None,
/// };
/// assert!(sketch.svg().contains("padding"));
/// assert!(sketch.text(80).contains("10 kg"));
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sketch {
    /// Nodes.
    pub nodes: Vec<SketchNode>,
    /// Links between nodes; several may join the same two.
    pub links: Vec<SketchLink>,
    /// Gravity, where it acts.
    pub gravity: Option<SketchGravity>,
}

/// Gravity along the axis of a [`Sketch`]: an arrow above the drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct SketchGravity {
    /// Its magnitude, as in `9.81 m/s²`.
    pub label: String,
    /// Whether it pulls away from the support, to the left.
    pub pulls_back: bool,
}

/// A node of a [`Sketch`].
#[derive(Debug, Clone, PartialEq)]
pub struct SketchNode {
    /// Name.
    pub name: String,
    /// What it is drawn as.
    pub kind: SketchKind,
    /// Values below the name, as in `10 kg` and `10 m/s →`.
    pub lines: Vec<String>,
    /// Forces on it: arrows with a text each.
    pub loads: Vec<String>,
}

impl SketchNode {
    /// A node with its values and without loads.
    pub fn new<'a>(
        name: impl Into<String>,
        kind: SketchKind,
        lines: impl IntoIterator<Item = &'a str>,
    ) -> Self {
        Self {
            name: name.into(),
            kind,
            lines: lines.into_iter().map(Into::into).collect(),
            loads: Vec::new(),
        }
    }
}

/// What a [`SketchNode`] is drawn as.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SketchKind {
    /// A body: a box.
    Mass,
    /// A joint without mass: a dot.
    Massless,
    /// The face of an element, without mass: a plate.
    Face,
    /// The face of an element, with mass: a thick plate.
    HeavyFace,
    /// A support: a hatched wall, drawn anew at each neighbour.
    Fixed,
    /// A node whose motion is given: a dashed box.
    Prescribed,
}

/// A link of a [`Sketch`].
#[derive(Debug, Clone, PartialEq)]
pub struct SketchLink {
    /// Name of the element; empty for none.
    pub name: String,
    /// Index of the node at its left end; a link to a node that does not exist is not drawn.
    pub from: usize,
    /// Index of the node at its right end.
    pub to: usize,
    /// What it is made of.
    pub tree: SketchTree,
}

/// What a [`SketchLink`] is made of.
#[derive(Debug, Clone, PartialEq)]
pub enum SketchTree {
    /// A single element with the symbol of its kind, or of its law.
    Element {
        /// Word of the kind, as in `spring`.
        kind: String,
        /// Text above the symbol, as in `20 MN/m`.
        label: String,
        /// What it is drawn as where its kind has no symbol of its own.
        law: SketchLaw,
    },
    /// One behind the other: the forces are equal.
    Series(Vec<SketchTree>),
    /// Side by side: the deformations are equal.
    Parallel(Vec<SketchTree>),
}

/// What an element is drawn as whose kind has no symbol of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SketchLaw {
    /// A spring that is not linear.
    Spring,
    /// A dashpot that is not linear.
    Dashpot,
    /// A gap with a spring behind it that is not linear.
    Impact,
    /// A box with the word of its kind.
    Other,
}

impl SketchTree {
    /// A single element of this kind; a box where the kind has no symbol.
    pub fn element(kind: impl Into<String>, label: impl Into<String>) -> Self {
        Self::Element { kind: kind.into(), label: label.into(), law: SketchLaw::Other }
    }
}

/// Numbers of elements and depth of nesting.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Census {
    /// Of each kind: its place among the [`SYMBOLS`], its word, and how many there are.
    of_kind: BTreeMap<(usize, String), usize>,
    others: usize,
    depth: usize,
}

impl Census {
    fn elements(&self) -> usize {
        self.of_kind.values().sum::<usize>() + self.others
    }

    /// Counts without recursion, since nesting may be deeper than a stack.
    fn of<'a>(trees: impl Iterator<Item = &'a SketchTree>) -> Self {
        let mut census = Self { of_kind: BTreeMap::new(), others: 0, depth: 0 };
        let mut open: Vec<(&SketchTree, usize)> = trees.map(|tree| (tree, 1)).collect();
        while let Some((tree, depth)) = open.pop() {
            census.depth = census.depth.max(depth);
            match tree {
                SketchTree::Element { kind, law, .. } => {
                    let place = SYMBOLS.iter().position(|symbol| symbol.kind == kind);
                    if place.is_none() && *law == SketchLaw::Other {
                        census.others += 1;
                    } else {
                        let place = place.unwrap_or(SYMBOLS.len());
                        *census.of_kind.entry((place, kind.clone())).or_default() += 1;
                    }
                }
                SketchTree::Series(parts) | SketchTree::Parallel(parts) => {
                    open.extend(parts.iter().map(|part| (part, depth + 1)));
                }
            }
        }
        census
    }
}

impl Sketch {
    fn census(&self) -> Census {
        Census::of(self.links.iter().map(|link| &link.tree))
    }

    /// Whether at most `most` elements and as many links and nodes, nested readably, leave room for a drawing.
    fn is_drawable(&self, most: usize) -> bool {
        const DEEPEST: usize = 24;
        let census = self.census();
        census.elements().max(self.links.len()).max(self.nodes.len()) <= most
            && census.depth <= DEEPEST
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    pub(crate) fn spring(label: &str) -> SketchTree {
        SketchTree::element("spring", label)
    }

    pub(crate) fn dashpot(label: &str) -> SketchTree {
        SketchTree::element("dashpot", label)
    }

    fn link(name: &str, from: usize, to: usize, tree: SketchTree) -> SketchLink {
        SketchLink { name: name.into(), from, to, tree }
    }

    /// The thesis' head on a padded panel.
    pub(crate) fn reference() -> Sketch {
        let pad = SketchTree::Series(vec![
            spring("20 MN/m"),
            dashpot("6 kN s/m"),
            SketchTree::Parallel(vec![spring("20 MN/m"), dashpot("4 kN s/m")]),
        ]);
        let mount = SketchTree::Parallel(vec![spring("50 MN/m"), dashpot("10 kN s/m")]);
        Sketch {
            nodes: vec![
                SketchNode::new("head", SketchKind::Mass, ["10 kg", "10 m/s →"]),
                SketchNode::new("panel", SketchKind::Mass, ["100 kg"]),
                SketchNode::new("ground", SketchKind::Fixed, []),
            ],
            links: vec![link("padding", 0, 1, pad), link("mount", 1, 2, mount)],
            gravity: None,
        }
    }

    /// Branches, a loop, parallel links, a link over several layers, a second part, every kind of node and law.
    pub(crate) fn tangled() -> Sketch {
        let mut sketch = reference();
        let node = |name: &str, kind| SketchNode::new(name, kind, []);
        sketch.nodes.extend([
            node("knee", SketchKind::Mass),
            node("<joint> & pivot", SketchKind::Massless),
            SketchNode::new("base", SketchKind::Prescribed, ["sine 5 mm, 20 Hz"]),
            node("Körper 頭", SketchKind::Mass),
            node("alone", SketchKind::Mass),
        ]);
        let foam = SketchTree::element("jelly", "60 g/l");
        sketch.links.extend([
            link("knee pad", 3, 4, foam),
            link("bar", 4, 1, SketchTree::element("rigid", "")),
            link("strap", 0, 2, spring("1 kN/m")),
            link("second pad", 0, 1, dashpot("1 kN s/m")),
            link("back", 1, 3, spring("2 kN/m")),
            link("", 5, 6, SketchTree::Series(vec![])),
            link("nowhere", 5, 99, spring("3 kN/m")),
        ]);
        sketch
    }

    pub(crate) fn chain(masses: usize) -> Sketch {
        Sketch {
            nodes: (0..masses)
                .map(|i| SketchNode::new(format!("m{i}"), SketchKind::Mass, ["1 kg"]))
                .collect(),
            links: (1..masses)
                .map(|i| link(&format!("k{i}"), i - 1, i, spring("1 kN/m")))
                .collect(),
            gravity: None,
        }
    }

    #[test]
    fn deep_nesting_is_counted_without_a_stack() {
        let mut tree = spring("1 N/m");
        for _ in 0..5_000 {
            tree = SketchTree::Series(vec![tree]);
        }
        let census = Census::of([&tree].into_iter());
        assert_eq!((census.elements(), census.depth), (1, 5_001));
    }
}
