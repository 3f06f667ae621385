//! The graph behind a drawing: copies of supports, connected parts, layers from left to right.

use super::{Sketch, SketchKind};

/// A node as drawn; a support has one at each of its neighbours.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct DrawnNode {
    pub(super) node: usize,
    /// Column among nodes, from the left.
    pub(super) layer: usize,
}

/// A link as drawn, from left to right; `reversed` when it runs against the scene's order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct DrawnLink {
    pub(super) link: usize,
    pub(super) left: usize,
    pub(super) right: usize,
    pub(super) reversed: bool,
}

/// A connected part; links refer to its own nodes.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(super) struct Part {
    pub(super) nodes: Vec<DrawnNode>,
    pub(super) links: Vec<DrawnLink>,
}

/// The connected parts of a sketch, each in layers.
pub(super) fn parts(sketch: &Sketch) -> Vec<Part> {
    let (nodes, ends) = copies(sketch);
    let mut part_of: Vec<usize> = (0..nodes.len()).collect();
    for _ in 0..nodes.len() {
        let before = part_of.clone();
        for &(_, from, to) in &ends {
            let least = part_of[from].min(part_of[to]);
            part_of[from] = least;
            part_of[to] = least;
        }
        if part_of == before {
            break;
        }
    }
    let mut roots = part_of.clone();
    roots.sort_unstable();
    roots.dedup();
    let part = |root: usize| {
        let members: Vec<usize> = (0..nodes.len()).filter(|v| part_of[*v] == root).collect();
        let local = |v: usize| members.iter().position(|m| *m == v);
        let inner = ends.iter().filter_map(|own| Some((own.0, local(own.1)?, local(own.2)?)));
        layered(members.iter().map(|v| nodes[*v]).collect(), &inner.collect::<Vec<_>>())
    };
    roots.into_iter().map(part).collect()
}

/// Drawn nodes as indices of the sketch's nodes, and links as (link, from, to) between drawn nodes.
fn copies(sketch: &Sketch) -> (Vec<usize>, Vec<(usize, usize, usize)>) {
    let count = sketch.nodes.len();
    let mut nodes: Vec<usize> = (0..count).collect();
    let mut copies: Vec<((usize, usize, bool), usize)> = Vec::new();
    let mut copied = vec![false; count];
    let mut copy = |node: usize, other: usize, is_left: bool, nodes: &mut Vec<usize>| {
        let key = (node, other, is_left);
        if let Some((_, at)) = copies.iter().find(|(k, _)| *k == key) {
            return *at;
        }
        // The first copy is the node itself.
        let at = if std::mem::replace(&mut copied[node], true) {
            nodes.push(node);
            nodes.len() - 1
        } else {
            node
        };
        copies.push((key, at));
        at
    };
    let is_support = |v: usize| sketch.nodes[v].kind == SketchKind::Fixed;
    let mut ends = Vec::new();
    for (index, link) in sketch.links.iter().enumerate() {
        if link.from.max(link.to) >= count {
            continue;
        }
        let from = if is_support(link.from) {
            copy(link.from, link.to, true, &mut nodes)
        } else {
            link.from
        };
        let to = if is_support(link.to) || link.from == link.to {
            copy(link.to, link.from, false, &mut nodes)
        } else {
            link.to
        };
        // A link from a body to itself leads to a second drawing of that body.
        let to = if from == to { copy(link.to, usize::MAX, false, &mut nodes) } else { to };
        if from != to {
            ends.push((index, from, to));
        }
    }
    (nodes, ends)
}

/// Layers by the longest path from the left; links that would close a cycle are drawn against their direction.
fn layered(nodes: Vec<usize>, ends: &[(usize, usize, usize)]) -> Part {
    let count = nodes.len();
    let order = depth_first(count, ends);
    let mut rank = vec![0; count];
    for (position, v) in order.iter().enumerate() {
        rank[*v] = position;
    }
    let drawn = |&(link, from, to): &(usize, usize, usize)| {
        let reversed = rank[from] > rank[to];
        let (left, right) = if reversed { (to, from) } else { (from, to) };
        DrawnLink { link, left, right, reversed }
    };
    let links: Vec<DrawnLink> = ends.iter().map(drawn).collect();

    let mut layer = vec![0; count];
    for v in &order {
        for link in links.iter().filter(|l| l.left == *v) {
            layer[link.right] = layer[link.right].max(layer[*v] + 1);
        }
    }
    // A node that nothing leads to stands right before what it acts on.
    for v in 0..count {
        let has_left = links.iter().any(|l| l.right == v);
        let nearest = links.iter().filter(|l| l.left == v).map(|l| layer[l.right]).min();
        if let (false, Some(nearest)) = (has_left, nearest) {
            layer[v] = nearest - 1;
        }
    }
    let first = layer.iter().min().copied().unwrap_or(0);
    let nodes = nodes
        .into_iter()
        .zip(&layer)
        .map(|(node, layer)| DrawnNode { node, layer: layer - first })
        .collect();
    Part { nodes, links }
}

/// An order of the nodes in which only links that close a cycle run backwards.
fn depth_first(count: usize, ends: &[(usize, usize, usize)]) -> Vec<usize> {
    let next = |v: usize| ends.iter().filter(move |e| e.1 == v).map(|e| e.2);
    let led_to = |v: usize| ends.iter().any(|e| e.2 == v);
    let starts = (0..count).filter(|v| !led_to(*v)).chain((0..count).filter(|v| led_to(*v)));
    let mut seen = vec![false; count];
    let mut finished = Vec::with_capacity(count);
    for start in starts {
        let mut open = vec![(start, false)];
        while let Some((v, is_done)) = open.pop() {
            if is_done {
                finished.push(v);
            } else if !std::mem::replace(&mut seen[v], true) {
                open.push((v, true));
                let ahead: Vec<usize> = next(v).filter(|w| !seen[*w]).collect();
                open.extend(ahead.into_iter().rev().map(|w| (w, false)));
            }
        }
    }
    finished.reverse();
    finished
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sketch::tests::{chain, reference, tangled};

    #[test]
    fn a_chain_has_one_layer_per_mass() {
        let parts = parts(&chain(5));
        assert_eq!(parts.len(), 1);
        let layers: Vec<usize> = parts[0].nodes.iter().map(|n| n.layer).collect();
        assert_eq!(layers, [0, 1, 2, 3, 4]);
    }

    #[test]
    fn every_link_runs_to_the_right_even_in_loops() {
        let sketch = tangled();
        let parts = parts(&sketch);
        let links: usize = parts.iter().map(|p| p.links.len()).sum();
        assert_eq!(links, sketch.links.len() - 1, "all but the one to a node that does not exist");
        for part in &parts {
            for link in &part.links {
                assert!(part.nodes[link.left].layer < part.nodes[link.right].layer, "{part:?}");
            }
        }
        let reversed = parts.iter().flat_map(|p| &p.links).filter(|l| l.reversed).count();
        assert_eq!(reversed, 1, "{parts:?}");
    }

    #[test]
    fn a_support_is_drawn_at_each_neighbour() {
        let mut sketch = reference();
        let strap = crate::SketchLink { from: 0, ..sketch.links[1].clone() };
        sketch.links.push(strap);
        let parts = parts(&sketch);
        let grounds = parts.iter().flat_map(|p| &p.nodes).filter(|n| n.node == 2).count();
        assert_eq!(grounds, 2);
    }
}
