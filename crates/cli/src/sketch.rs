//! Networks as drawings.

use std::{f64::consts::TAU, sync::Arc};

use dashpot_dae::{Piece, Waveform};
use dashpot_network::{Element, Network, Node, NodeId, Start, Support, elements::Law};
use dashpot_plot::{Sketch, SketchKind, SketchLink, SketchNode, SketchTree};
use dashpot_rheology::Tree;

use crate::numbers::{constant, rounded};

/// Digits of what is computed from a driving function.
const DIGITS: usize = 4;
/// Deeper nesting is drawn as one box: no drawing shows it, and the way down is a recursion.
const DEEPEST: usize = 500;

/// The drawing of a network; motions and loads are described over a run of `duration` \[s\].
pub(crate) fn sketch(network: &Network, duration: f64) -> Sketch {
    let used = |id: NodeId| network.connections().iter().any(|own| own.between.contains(&id));
    // The ground is there even where nothing stands on it.
    let nodes: Vec<(NodeId, &Node)> =
        network.nodes().filter(|(id, _)| *id != network.ground() || used(*id)).collect();
    let place = |id: NodeId| nodes.iter().position(|(own, _)| *own == id).unwrap_or(usize::MAX);
    let links = network.connections().iter().map(|connection| SketchLink {
        name: connection.name.clone(),
        from: place(connection.between[0]),
        to: place(connection.between[1]),
        tree: tree(&connection.model, 0),
    });
    Sketch {
        links: links.collect(),
        nodes: nodes.iter().map(|(id, own)| node(network, *id, own, duration)).collect(),
    }
}

fn node(network: &Network, id: NodeId, node: &Node, duration: f64) -> SketchNode {
    let kind = match &node.support {
        Support::Fixed => SketchKind::Fixed,
        Support::Prescribed(_) => SketchKind::Prescribed,
        Support::Free if node.mass > 0.0 => SketchKind::Mass,
        Support::Free => SketchKind::Massless,
    };
    let mut lines = Vec::new();
    if node.mass > 0.0 {
        lines.push(constant(node.mass, "kg"));
    }
    lines.extend(match node.start {
        Start::Rest => None,
        Start::Velocity(velocity) => Some(format!("{} →", constant(velocity, "m/s"))),
        Start::Drop(height) => Some(format!("drop {} →", constant(height, "m"))),
    });
    if let Support::Prescribed(motion) = &node.support {
        lines.push(waveform(motion, "m", duration));
    }
    let loads = network.loads().iter().filter(|load| load.node == id);
    lines.extend(
        loads.map(|load| format!("{}: {}", load.name, waveform(&load.force, "N", duration))),
    );
    SketchNode { name: node.name.clone(), kind, lines }
}

/// A driving function in words, over a run of `duration` \[s\].
pub(crate) fn waveform(waveform: &Waveform, si: &str, duration: f64) -> String {
    let pieces = waveform.pieces();
    let most = || constant(waveform.bound(duration), si);
    let is_wave_only = |piece: &Piece| {
        piece.value == 0.0 && piece.slope == 0.0 && piece.curvature == 0.0 && piece.jerk == 0.0
    };
    let is_straight = |piece: &Piece| {
        let is_bent = piece.curvature != 0.0 || piece.jerk != 0.0;
        piece.sine == 0.0 && piece.cosine == 0.0 && !is_bent
    };
    let is_zero = |piece: &Piece| is_straight(piece) && piece.slope == 0.0 && piece.value == 0.0;
    match pieces {
        [one] if is_straight(one) && one.slope == 0.0 => {
            format!("constant {}", constant(one.value, si))
        }
        [one] if is_wave_only(one) && !one.is_swept() => {
            let frequency = rounded(one.omega / TAU, "Hz", DIGITS);
            format!("sine of {} at {frequency}", rounded(one.sine.hypot(one.cosine), si, DIGITS))
        }
        [before, arch, after]
            if is_zero(before)
                && is_zero(after)
                && is_wave_only(arch)
                && arch.sine != 0.0
                && arch.cosine == 0.0 =>
        {
            let length = rounded(after.start - arch.start, "s", DIGITS);
            format!("arch of {} in {length}", constant(arch.sine, si))
        }
        [before, rising, after]
            if is_zero(before)
                && is_straight(rising)
                && rising.value == 0.0
                && is_straight(after)
                && after.slope == 0.0
                && waveform.jump(after.start) == 0.0 =>
        {
            let length = rounded(after.start - rising.start, "s", DIGITS);
            format!("ramp to {} in {length}", constant(after.value, si))
        }
        [_, rest @ ..] if pieces.iter().all(is_straight) => {
            let jumps = rest.iter().filter(|piece| waveform.jump(piece.start) != 0.0).count();
            format!("table of {} points, up to {}", rest.len() + jumps, most())
        }
        _ => format!("up to {}", most()),
    }
}

/// An element's constant, where it has one.
pub(crate) fn element(element: &dyn Element) -> String {
    match element.law() {
        Law::Spring(stiffness) => constant(stiffness, "N/m"),
        Law::Dashpot(damping) => constant(damping, "N s/m"),
        Law::Rigid | Law::Nonlinear { .. } | Law::Phased => String::new(),
    }
}

fn tree(model: &Tree<Arc<dyn Element>>, depth: usize) -> SketchTree {
    if depth > DEEPEST {
        return SketchTree::Other { word: "…".to_owned(), label: String::new() };
    }
    let parts = |branches: &[dashpot_rheology::Branch<Arc<dyn Element>>]| {
        branches.iter().map(|branch| tree(&branch.tree, depth + 1)).collect()
    };
    match model {
        Tree::Part(part) => match part.law() {
            Law::Spring(_) => SketchTree::Spring { label: element(part.as_ref()) },
            Law::Dashpot(_) => SketchTree::Dashpot { label: element(part.as_ref()) },
            Law::Rigid => SketchTree::Rigid,
            Law::Nonlinear { .. } | Law::Phased => {
                SketchTree::Other { word: part.kind().to_owned(), label: String::new() }
            }
        },
        Tree::Series(branches) => SketchTree::Series(parts(branches)),
        Tree::Parallel(branches) => SketchTree::Parallel(parts(branches)),
    }
}
