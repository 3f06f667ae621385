//! The parts of a pad in which stress and strain are the same all over.

use super::{
    expand::Shape,
    inner_pads::{Located, located},
    outputs::{Listed, Outputs, total},
    parts::Parts,
    row::{Combination, Row},
};
use crate::{Connection, ConnectionOutputs, InnerPad, SegmentOutputs, SegmentPlace, layers::Piece};

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
            _ => 0..1,
        };
        if let (Shape::Row(_), Some(last)) = (&shapes[0], branches.clone().next_back()) {
            let force = forces[last].clone();
            let name = &connection.name;
            outputs.transmitted = force.map(|row| self.add(name, "transmitted-force", "N", &row));
        }
        let whole = connection.thickness.filter(|_| connection.pieces.is_empty());
        outputs.segments.extend(whole.map(|own| self::whole(own, connection, outputs)));
        if connection.pieces.is_empty() && connection.pads.is_empty() {
            return;
        }
        let composed =
            Composed { shapes, forces, listed, deformations: deformations(parts, shapes) };
        if connection.pieces.is_empty() {
            for (pad, Located { shape, path }) in located(connection, shapes) {
                let found = self.of_shape(parts, &composed, (shape, &path), outputs);
                outputs.segments.extend(found.map(|found| inner(pad, path, found)));
            }
            return;
        }
        for (at, (branch, pieces)) in branches.zip(&connection.pieces).enumerate() {
            let in_row = connection.model.branches().get(at).filter(|_| branch != 0);
            let path = in_row.map_or(connection.name.clone(), |in_row| {
                format!("{}.{}", connection.name, in_row.name)
            });
            let of_pieces: Vec<(usize, String)> = match &shapes[branch] {
                Shape::Series(children) if pieces.len() > 1 => {
                    let tree = in_row.map_or(&connection.model, |in_row| &in_row.tree);
                    let names =
                        tree.branches().iter().map(|branch| format!("{path}.{}", branch.name));
                    children.clone().zip(names).collect()
                }
                _ => vec![(branch, path)],
            };
            for ((shape, name), piece) in of_pieces.into_iter().zip(pieces) {
                let found = self.of_shape(parts, &composed, (shape, &name), outputs);
                outputs.segments.extend(found.map(|found| segment(piece, found)));
            }
        }
    }

    /// Force and deformation of a shape, which are added where they are not among the outputs yet;
    /// `None` for what takes no part and carries nothing.
    fn of_shape(
        &mut self,
        parts: &Parts<'_>,
        composed: &Composed<'_>,
        (shape, name): (usize, &str),
        outputs: &ConnectionOutputs,
    ) -> Option<Found> {
        let Composed { shapes, forces, listed, deformations } = composed;
        match &shapes[shape] {
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
                let force = force.map(|row| self.add(name, "force", "N", &row));
                Some((force, self.add(name, "deformation", "m", &deformation)))
            }
        }
    }
}

/// The shapes of a connection with what is known of them.
struct Composed<'a> {
    shapes: &'a [Shape],
    forces: &'a [Option<Row>],
    listed: &'a Listed,
    deformations: Vec<Option<Row>>,
}

/// The outputs of the force, where it is determined, and of the deformation.
type Found = (Option<usize>, usize);

/// A pad that is one segment.
fn whole(thickness: f64, connection: &Connection, outputs: &ConnectionOutputs) -> SegmentOutputs {
    SegmentOutputs {
        place: SegmentPlace::Whole,
        thickness,
        area: connection.area,
        force: outputs.force,
        deformation: outputs.deformation,
    }
}

fn segment(piece: &Piece, (force, deformation): Found) -> SegmentOutputs {
    let (name, depth) = (piece.layer.clone(), piece.from + 0.5 * piece.thickness);
    let place = SegmentPlace::Layer { name, depth };
    let (thickness, area) = (piece.thickness, Some(piece.area));
    SegmentOutputs { place, thickness, area, force, deformation }
}

fn inner(pad: &InnerPad, path: String, (force, deformation): Found) -> SegmentOutputs {
    let InnerPad { thickness, area, .. } = *pad;
    SegmentOutputs { place: SegmentPlace::Branch { path }, thickness, area, force, deformation }
}

/// The deformation of each shape as that of what takes part in it; `None` where that does not tell.
fn deformations(parts: &Parts<'_>, shapes: &[Shape]) -> Vec<Option<Row>> {
    let mut found: Vec<Option<Row>> = vec![None; shapes.len()];
    for (at, shape) in shapes.iter().enumerate().rev() {
        found[at] = match shape {
            Shape::Leaf(primitive) => parts.motion.deformation.get(*primitive),
            Shape::Series(children) => {
                let rows = children.clone().map(|child| found[child].as_ref());
                rows.collect::<Option<Vec<&Row>>>().map(|rows| total(&rows))
            }
            Shape::Parallel(children) => children.clone().find_map(|child| found[child].clone()),
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
        Some(parts.motion.position.row(body).plus(1.0, &parts.offsets.row(joint)))
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
                if end == 0 { children.clone().next() } else { children.clone().next_back() }?
            }
        };
    }
}
