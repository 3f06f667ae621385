//! The parts of a pad in which stress and strain are the same all over.

use std::collections::BTreeMap;

use super::{
    Parts,
    expand::Shape,
    outputs::{Outputs, total},
    row::{Combination, Row},
};
use crate::{Connection, ConnectionOutputs, SegmentOutputs, layers::Piece};

/// Where the outputs of primitives stand, by the number of the primitive; those that take no part
/// have none.
pub(super) type Listed = BTreeMap<usize, usize>;

impl Outputs<'_> {
    /// Completes the outputs of a connection by its segments, and by the force at its second end
    /// where masses stand between the two. Its shapes come with a force for each.
    pub(super) fn add_segments(
        &mut self,
        parts: &Parts<'_>,
        connection: &Connection,
        (shapes, forces, listed): (&[Shape], &[Option<Row>], &Listed),
        outputs: &mut ConnectionOutputs,
    ) {
        let branches = match &shapes[0] {
            Shape::Row(branches) => branches.clone(),
            _ => vec![0],
        };
        if let (Shape::Row(_), Some(&last)) = (&shapes[0], branches.last()) {
            let force = forces[last].clone();
            let name = format!("{}.transmitted-force", connection.name);
            outputs.transmitted = force.map(|row| self.add(name, "N", &row));
        }
        if connection.pieces.is_empty() {
            outputs.segments = connection
                .thickness
                .map(|own| whole(own, connection, outputs))
                .into_iter()
                .collect();
            return;
        }
        let deformations = deformations(parts, shapes);
        for (at, (&branch, pieces)) in branches.iter().zip(&connection.pieces).enumerate() {
            let in_row = connection.model.branches().get(at).filter(|_| branch != 0);
            let path = in_row
                .map_or(connection.name.clone(), |own| format!("{}.{}", connection.name, own.name));
            let of_pieces: Vec<(usize, String)> = match &shapes[branch] {
                Shape::Series(children) if pieces.len() > 1 => {
                    let tree = in_row.map_or(&connection.model, |own| &own.tree);
                    let names = tree.branches().iter().map(|own| format!("{path}.{}", own.name));
                    children.iter().copied().zip(names).collect()
                }
                _ => vec![(branch, path)],
            };
            for ((shape, name), piece) in of_pieces.into_iter().zip(pieces) {
                let found = match &shapes[shape] {
                    Shape::Leaf(primitive) => listed.get(primitive).map(|&own| {
                        let own = &self.primitives[own];
                        (Some(own.force), own.deformation)
                    }),
                    _ if shape == 0 => Some((outputs.force, outputs.deformation)),
                    _ => {
                        let deformation = deformations[shape].clone();
                        let deformation = deformation.or_else(|| between(parts, shapes, shape));
                        let deformation = deformation.unwrap_or_default();
                        let force = forces[shape].clone();
                        let force = force.map(|row| self.add(format!("{name}.force"), "N", &row));
                        Some((force, self.add(format!("{name}.deformation"), "m", &deformation)))
                    }
                };
                // What takes no part carries nothing.
                let Some((force, deformation)) = found else { continue };
                outputs.segments.push(segment(piece, force, deformation));
            }
        }
    }
}

/// A pad that is one segment.
fn whole(thickness: f64, connection: &Connection, outputs: &ConnectionOutputs) -> SegmentOutputs {
    SegmentOutputs {
        layer: None,
        depth: 0.5 * thickness,
        thickness,
        area: connection.area,
        force: outputs.force,
        deformation: outputs.deformation,
    }
}

fn segment(piece: &Piece, force: Option<usize>, deformation: usize) -> SegmentOutputs {
    SegmentOutputs {
        layer: Some(piece.layer.clone()),
        depth: piece.from + 0.5 * piece.thickness,
        thickness: piece.thickness,
        area: Some(piece.area),
        force,
        deformation,
    }
}

/// The deformation of each shape as that of what takes part in it; `None` where that does not tell.
fn deformations(parts: &Parts<'_>, shapes: &[Shape]) -> Vec<Option<Row>> {
    let mut found: Vec<Option<Row>> = vec![None; shapes.len()];
    for (at, shape) in shapes.iter().enumerate().rev() {
        found[at] = match shape {
            Shape::Leaf(primitive) => parts.motion.deformation[*primitive].clone(),
            Shape::Series(children) => {
                let rows = children.iter().map(|&child| found[child].as_ref());
                rows.collect::<Option<Vec<&Row>>>().map(|rows| total(&rows))
            }
            Shape::Parallel(children) => children.iter().find_map(|&child| found[child].clone()),
            Shape::Row(_) => None,
        };
    }
    found
}

/// The deformation of a shape by the places of its ends.
fn between(parts: &Parts<'_>, shapes: &[Shape], shape: usize) -> Option<Row> {
    let position = |end: usize| {
        let joint = joint(parts, shapes, shape, end)?;
        let body = parts.bodies.of_joint[joint];
        Some(parts.motion.position[body].plus(1.0, &parts.offsets[joint]))
    };
    Some(position(0)?.plus(-1.0, &position(1)?))
}

/// The joint at one end of a shape, 0 on the impactor's side and 1 on the other.
fn joint(parts: &Parts<'_>, shapes: &[Shape], shape: usize, end: usize) -> Option<usize> {
    let mut at = shape;
    loop {
        at = match &shapes[at] {
            Shape::Leaf(primitive) => {
                return Some(parts.expansion.primitives[*primitive].ends[end]);
            }
            Shape::Series(children) | Shape::Row(children) | Shape::Parallel(children) => {
                *if end == 0 { children.first() } else { children.last() }?
            }
        };
    }
}
