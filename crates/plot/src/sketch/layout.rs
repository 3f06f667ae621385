//! Places of nodes, links and wires, in pixels or in characters alike.
//!
//! Each connected part is drawn in columns: nodes in even ones, links in odd ones. A link over several layers stands
//! in the middle one and is wired through the others, where its wire keeps room like a box. So nothing overlaps
//! but wires that cross.

use super::Sketch;
use super::graph::{DrawnNode, Part, parts};
use super::order::{Extent, Vertex, heights};

/// Sizes that the layout works with.
pub(super) struct Metrics<'a> {
    /// Extent of a node by its index in the sketch.
    pub(super) node: &'a dyn Fn(usize) -> Extent,
    /// Extent of a link by its index in the sketch.
    pub(super) link: &'a dyn Fn(usize) -> Extent,
    /// Extent of a wire that passes between boxes.
    pub(super) through: Extent,
    /// Least vertical distance between boxes.
    pub(super) gap: f64,
    /// Horizontal distance of a vertical wire from the columns beside it.
    pub(super) lead: f64,
    /// Horizontal distance between vertical wires.
    pub(super) track: f64,
    /// Thickness of a wire: one character, or next to nothing.
    pub(super) wire: f64,
}

/// A placed box: its left end and the height of its connecting line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Placed {
    pub(super) index: usize,
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) extent: Extent,
    /// Drawn against the scene's order.
    pub(super) reversed: bool,
    /// Whether anything is wired to the left and to the right end.
    pub(super) wired: (bool, bool),
}

#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Plan {
    pub(super) width: f64,
    pub(super) height: f64,
    pub(super) nodes: Vec<Placed>,
    pub(super) links: Vec<Placed>,
    pub(super) wires: Vec<Vec<(f64, f64)>>,
}

/// Lays all parts of a sketch out, one below the other.
pub(super) fn plan(sketch: &Sketch, metrics: &Metrics<'_>) -> Plan {
    let mut whole = Plan::default();
    for part in parts(sketch) {
        let below = if whole.height > 0.0 { whole.height + 2.0 * metrics.gap } else { 0.0 };
        let mut plan = Columns::new(&part, metrics).plan(&part, metrics);
        for placed in plan.nodes.iter_mut().chain(&mut plan.links) {
            placed.y += below;
        }
        plan.wires.iter_mut().flatten().for_each(|point| point.1 += below);
        whole.width = whole.width.max(plan.width);
        whole.height = below + plan.height;
        whole.nodes.append(&mut plan.nodes);
        whole.links.append(&mut plan.links);
        whole.wires.append(&mut plan.wires);
    }
    whole
}

/// What a vertex stands for.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Role {
    Node(usize),
    Link(usize),
    Through,
}

struct Columns {
    vertices: Vec<Vertex>,
    roles: Vec<Role>,
}

impl Columns {
    fn new(part: &Part, metrics: &Metrics<'_>) -> Self {
        let mut columns = Self { vertices: Vec::new(), roles: Vec::new() };
        for (index, DrawnNode { node, layer }) in part.nodes.iter().enumerate() {
            columns.add(2 * layer, (metrics.node)(*node), Role::Node(index));
        }
        for (index, link) in part.links.iter().enumerate() {
            let (first, last) = (part.nodes[link.left].layer, part.nodes[link.right].layer);
            let middle = 2 * (first + (last - first - 1) / 2) + 1;
            let mut before = link.left;
            for column in 2 * first + 1..2 * last {
                let vertex = if column == middle {
                    columns.add(column, (metrics.link)(link.link), Role::Link(index))
                } else {
                    columns.add(column, metrics.through, Role::Through)
                };
                columns.wire(before, vertex);
                before = vertex;
            }
            columns.wire(before, link.right);
        }
        columns
    }

    fn add(&mut self, column: usize, extent: Extent, role: Role) -> usize {
        self.vertices.push(Vertex { column, extent, left: Vec::new(), right: Vec::new() });
        self.roles.push(role);
        self.vertices.len() - 1
    }

    fn wire(&mut self, left: usize, right: usize) {
        self.vertices[left].right.push(right);
        self.vertices[right].left.push(left);
    }

    fn plan(&self, part: &Part, metrics: &Metrics<'_>) -> Plan {
        let heights = heights(&self.vertices, metrics.gap);
        let count = self.vertices.iter().map(|v| v.column + 1).max().unwrap_or(0);
        let mut plan = Plan::default();
        let mut places = vec![0.0; self.vertices.len()];
        let mut channels = Vec::new();
        let mut x = 0.0;
        for column in 0..count {
            let inside = || (0..self.vertices.len()).filter(|v| self.vertices[*v].column == column);
            let width = inside().map(|v| self.vertices[v].extent.width).fold(0.0, f64::max);
            for v in inside() {
                places[v] = x + ((width - self.vertices[v].extent.width) / 2.0).floor();
            }
            x += width;
            let tracks = self.tracks(column, &heights);
            let room = tracks.len().saturating_sub(1) as f64 * metrics.track;
            channels.push((x + metrics.lead, tracks));
            if column + 1 < count {
                x += 2.0 * metrics.lead + room + metrics.wire;
            }
        }
        for (v, vertex) in self.vertices.iter().enumerate() {
            plan.height = plan.height.max(heights[v] + vertex.extent.down + metrics.wire);
            self.place(part, v, (places[v], heights[v]), &mut plan);
            let (start, tracks) = &channels[vertex.column];
            for w in &vertex.right {
                let key = self.rail(v, *w);
                let track = tracks.iter().position(|t| *t == key).unwrap_or(0);
                let turn = start + track as f64 * metrics.track;
                let from = (places[v] + vertex.extent.width - metrics.wire, heights[v]);
                let to = (places[*w], heights[*w]);
                plan.wires.push(vec![from, (turn, from.1), (turn, to.1), to]);
            }
        }
        plan.width = x;
        plan
    }

    fn place(&self, part: &Part, v: usize, (x, y): (f64, f64), plan: &mut Plan) {
        let vertex = &self.vertices[v];
        let wired = (!vertex.left.is_empty(), !vertex.right.is_empty());
        let placed =
            |index, reversed| Placed { index, x, y, extent: vertex.extent, reversed, wired };
        match self.roles[v] {
            Role::Node(node) => plan.nodes.push(placed(part.nodes[node].node, false)),
            Role::Link(link) => {
                let drawn = &part.links[link];
                plan.links.push(placed(drawn.link, drawn.reversed));
            }
            Role::Through => {}
        }
    }

    /// The vertex whose vertical wire the wire from `v` to `w` turns on: the one of the node column, so that the
    /// branches at a node share a rail.
    fn rail(&self, v: usize, w: usize) -> usize {
        if self.vertices[v].column.is_multiple_of(2) { v } else { w }
    }

    /// The vertical wires right of a column, from the left.
    fn tracks(&self, column: usize, heights: &[f64]) -> Vec<usize> {
        let differ = |v: usize, w: usize| (heights[v] - heights[w]).abs() > 0.25;
        let wires: Vec<(usize, usize)> = (0..self.vertices.len())
            .filter(|v| self.vertices[*v].column == column)
            .flat_map(|v| self.vertices[v].right.iter().map(move |w| (v, *w)))
            .filter(|(v, w)| differ(*v, *w))
            .collect();
        let mut tracks: Vec<usize> = Vec::new();
        for (v, w) in &wires {
            let rail = self.rail(*v, *w);
            if !tracks.contains(&rail) {
                tracks.push(rail);
            }
        }
        // Where one wire leaves at the height at which another one arrives, it must turn first, else the two lie on
        // each other.
        let must_lead = |a: usize, b: usize| {
            let of = |rail| wires.iter().filter(move |(v, w)| self.rail(*v, *w) == rail);
            of(a).any(|(leaving, _)| of(b).any(|(_, arriving)| !differ(*leaving, *arriving)))
        };
        for _ in 0..tracks.len() {
            for i in 1..tracks.len() {
                let (first, second) = (tracks[i - 1], tracks[i]);
                if must_lead(second, first) && !must_lead(first, second) {
                    tracks.swap(i - 1, i);
                }
            }
        }
        tracks
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sketch::tests::{chain, reference, tangled};
    use crate::{SketchKind, SketchLink};

    fn boxes(plan: &Plan) -> Vec<(f64, f64, f64, f64)> {
        let all = plan.nodes.iter().chain(&plan.links);
        all.map(|p| (p.x, p.x + p.extent.width, p.y - p.extent.up, p.y + p.extent.down)).collect()
    }

    fn laid_out(sketch: &Sketch) -> Plan {
        let extent = |width| move |_| Extent { width, up: 20.0, down: 13.0 };
        let metrics = Metrics {
            node: &extent(60.0),
            link: &extent(110.0),
            through: Extent::default(),
            gap: 14.0,
            lead: 10.0,
            track: 8.0,
            wire: 0.0,
        };
        plan(sketch, &metrics)
    }

    /// Boxes neither overlap nor leave the drawing, and no wire runs through one.
    fn assert_apart(plan: &Plan) {
        let boxes = boxes(plan);
        for (i, a) in boxes.iter().enumerate() {
            assert!(a.0 >= 0.0 && a.1 <= plan.width && a.2 >= 0.0 && a.3 <= plan.height, "{a:?}");
            for b in &boxes[..i] {
                let apart = a.1 <= b.0 || b.1 <= a.0 || a.3 <= b.2 || b.3 <= a.2;
                assert!(apart, "{a:?} and {b:?}");
            }
        }
        for run in plan.wires.iter().flat_map(|wire| wire.windows(2)) {
            let (x0, x1) = (run[0].0.min(run[1].0), run[0].0.max(run[1].0));
            let (y0, y1) = (run[0].1.min(run[1].1), run[0].1.max(run[1].1));
            for b in &boxes {
                let crosses = x1 > b.0 && x0 < b.1 && y1 > b.2 && y0 < b.3;
                assert!(!crosses, "{run:?} through {b:?}");
            }
        }
    }

    #[test]
    fn boxes_and_wires_keep_apart_in_branches_and_loops() {
        assert_apart(&laid_out(&reference()));
        assert_apart(&laid_out(&tangled()));
    }

    #[test]
    fn random_graphs_keep_their_boxes_apart() {
        let mut state = 7_usize;
        let mut random = move |below: usize| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) % below
        };
        for _ in 0..200 {
            let mut sketch = chain(2 + random(8));
            let count = sketch.nodes.len();
            for node in &mut sketch.nodes {
                let kinds =
                    [SketchKind::Mass, SketchKind::Massless, SketchKind::Fixed, SketchKind::Mass];
                node.kind = kinds[random(4)];
            }
            let link = sketch.links[0].clone();
            for _ in 0..random(8) {
                sketch.links.push(SketchLink {
                    from: random(count),
                    to: random(count),
                    ..link.clone()
                });
            }
            assert_apart(&laid_out(&sketch));
            let text = sketch.text(80);
            assert!(text.lines().all(|line| crate::text_metrics::columns(line) <= 80), "{text}");
            crate::well_formed::assert_well_formed(&sketch.svg());
        }
    }

    #[test]
    fn the_reference_network_lies_on_one_line() {
        let plan = laid_out(&reference());
        assert!(
            plan.nodes.iter().chain(&plan.links).all(|p| (p.y - 20.0).abs() < 1e-12),
            "{plan:?}"
        );
    }
}
