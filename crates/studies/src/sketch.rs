//! Networks as drawings.

use std::{collections::HashMap, f64::consts::TAU, sync::Arc};

use dashpot_dae::{Piece, Waveform};
use dashpot_network::{
    Effect, Element, Network, Node, NodeId, Start, Support,
    effects::{EFFECTS, Separation, Stop},
    elements::{Contact, Friction, Law},
    parameters::Kind as _,
};
use dashpot_plot::{
    Sketch, SketchGravity, SketchKind, SketchLaw, SketchLink, SketchNode, SketchTree,
};
use dashpot_report::ReportFigure;
use dashpot_rheology::Tree;
use dashpot_scene::Scene;

use dashpot_report::numbers::{constant, rounded};

/// Digits of what is computed from a driving function.
const DIGITS: usize = 4;

/// Networks of more elements are not drawn: nothing could be read off the drawing.
pub const MOST_DRAWN: usize = 500;

/// The drawing of a network with what its effects put into it; motions and loads are described over
/// a run of `duration` \[s\].
pub fn sketch(network: &Network, duration: f64) -> Sketch {
    let built = Built::of(network);
    let network = &built.network;
    let used = |id: NodeId| {
        network.connections().iter().any(|connection| connection.between.contains(&id))
    };
    // The ground is there even where nothing stands on it.
    let nodes: Vec<(NodeId, &Node)> =
        network.nodes().filter(|(id, _)| *id != network.ground() || used(*id)).collect();
    let places: HashMap<NodeId, usize> =
        nodes.iter().enumerate().map(|(at, (id, _))| (*id, at)).collect();
    let place = |id: NodeId| places.get(&id).copied().unwrap_or(usize::MAX);
    let links = network.connections().iter().enumerate().map(|(at, connection)| SketchLink {
        name: connection.name.clone(),
        from: place(connection.between[0]),
        to: place(connection.between[1]),
        tree: tree(&connection.model, built.effect_of_connection(at)),
    });
    let gravity = network.effects().iter().find_map(|effect| effect.gravity());
    Sketch {
        links: links.collect(),
        nodes: nodes.iter().map(|(id, own)| node(&built, *id, own, duration)).collect(),
        gravity: gravity.map(|gravity| SketchGravity {
            label: constant(gravity.abs(), "m/s^2"),
            pulls_back: gravity < 0.0,
        }),
    }
}

/// The drawing of a scene for a page, unless there is too much to be drawn.
pub fn figure(scene: &Scene) -> Option<ReportFigure> {
    of_network(&scene.network, scene.run.duration)
}

/// The drawing of a scene's network as SVG, unless there is too much to be drawn.
pub fn drawing(scene: &Scene) -> Option<String> {
    figure(scene).map(|own| own.svg)
}

/// The drawing of a network for a page, likewise.
pub fn of_network(network: &Network, duration: f64) -> Option<ReportFigure> {
    let is_drawn = network.connections().len() <= MOST_DRAWN;
    is_drawn.then(|| ReportFigure::of_sketch("The network", sketch(network, duration).svg()))
}

/// A network with what its effects put into it; layers stay models, as they are written.
struct Built {
    network: Network,
    /// Words of the effects, each with the numbers of nodes and connections once it is there.
    stages: Vec<(&'static str, usize, usize)>,
    /// The same numbers without any effect.
    own: (usize, usize),
}

impl Built {
    fn of(network: &Network) -> Self {
        let mut effects: Vec<&Arc<dyn Effect>> = network.effects().iter().collect();
        effects.sort_by_key(|effect| EFFECTS.iter().position(|own| own.word == effect.kind()));
        let own = (network.nodes().count(), network.connections().len());
        let mut built = Self { network: network.clone(), stages: Vec::new(), own };
        for effect in effects {
            let mut next = built.network.clone();
            // What has no place is refused where the scene is compiled.
            if effect.rewrite(&mut next).is_ok() {
                built.stages.push((effect.kind(), next.nodes().count(), next.connections().len()));
                built.network = next;
            }
        }
        built
    }

    /// Whether an effect has put this node there.
    fn is_added(&self, node: NodeId) -> bool {
        node.index() >= self.own.0
    }

    /// The word of the effect that has put this connection there.
    fn effect_of_connection(&self, at: usize) -> Option<&'static str> {
        let stage = self.stages.iter().find(|(.., connections)| at < *connections)?;
        (at >= self.own.1).then_some(stage.0)
    }
}

fn node(built: &Built, id: NodeId, node: &Node, duration: f64) -> SketchNode {
    let kind = match (&node.support, node.mass > 0.0) {
        (Support::Fixed, _) => SketchKind::Fixed,
        (Support::Prescribed(_), _) => SketchKind::Prescribed,
        (Support::Free, true) if built.is_added(id) => SketchKind::HeavyFace,
        (Support::Free, false) if built.is_added(id) => SketchKind::Face,
        (Support::Free, true) => SketchKind::Mass,
        (Support::Free, false) => SketchKind::Massless,
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
    let loads = built.network.loads().iter().filter(|load| load.node == id);
    let loads =
        loads.map(|load| format!("{}: {}", load.name, waveform(&load.force, "N", duration)));
    SketchNode { name: node.name.clone(), kind, lines, loads: loads.collect() }
}

/// A driving function in words, over a run of `duration` \[s\].
pub fn waveform(waveform: &Waveform, si: &str, duration: f64) -> String {
    let pieces = waveform.pieces();
    let most = || rounded(waveform.bound(duration), si, DIGITS);
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
                && waveform.jumps().all(|jump| jump.0 < after.start) =>
        {
            let length = rounded(after.start - rising.start, "s", DIGITS);
            format!("ramp to {} in {length}", constant(after.value, si))
        }
        [_, rest @ ..] if pieces.iter().all(is_straight) => {
            format!("table of {} points, up to {}", rest.len() + waveform.jumps().count(), most())
        }
        _ => format!("up to {}", most()),
    }
}

/// An element's constant, where it has one.
pub fn element(element: &dyn Element) -> String {
    match element.law() {
        Law::Spring(stiffness) => constant(stiffness, "N/m"),
        Law::Dashpot(damping) => constant(damping, "N s/m"),
        Law::Rigid | Law::Nonlinear { .. } | Law::Phased => String::new(),
    }
}

/// What stands above the symbol of an element: its constant, or its word where the symbol does not
/// say which law it is, and what a contact needs to be known.
fn label(own: &dyn Element, kind: &str) -> String {
    let value = |name: &str| own.value(name).and_then(|own| own.number());
    let number = |name: &str| value(name).filter(|value| *value > 0.0);
    let mut words: Vec<String> = match own.law() {
        Law::Spring(_) | Law::Dashpot(_) => return element(own),
        Law::Rigid => return String::new(),
        Law::Phased if own.kind() == Contact::KIND => Vec::new(),
        Law::Phased if own.kind() == Friction::KIND => {
            let force = number(Friction::KIND).unwrap_or(0.0);
            return format!("slides at {}", constant(force, "N"));
        }
        Law::Phased | Law::Nonlinear { .. } => vec![own.kind().to_owned()],
    };
    let gap = number("gap").map(|gap| constant(gap, "m"));
    let word = if kind == Stop::KIND { "at" } else { "gap" };
    words.extend(gap.map(|gap| format!("{word} {gap}")));
    words.extend(number("restitution").map(|part| format!("e = {}", constant(part, "1"))));
    words.join(", ")
}

/// What an element is drawn as where its kind has no symbol of its own.
fn law(own: &dyn Element) -> SketchLaw {
    match own.law() {
        Law::Dashpot(_) | Law::Nonlinear { stiffness: 0.0, .. } => SketchLaw::Dashpot,
        Law::Phased if own.value("gap").is_some() => SketchLaw::Impact,
        Law::Spring(_) | Law::Phased | Law::Nonlinear { .. } => SketchLaw::Spring,
        Law::Rigid => SketchLaw::Other,
    }
}

/// The drawing of a model; contacts are drawn as what the effect makes of them that has put it there.
fn tree(model: &Tree<Arc<dyn Element>>, effect: Option<&'static str>) -> SketchTree {
    let parts = |branches: &[dashpot_rheology::Branch<Arc<dyn Element>>]| {
        branches.iter().map(|branch| tree(&branch.tree, effect)).collect()
    };
    match model {
        Tree::Part(part) => {
            let drawn = effect.filter(|effect| [Separation::KIND, Stop::KIND].contains(effect));
            let kind = match drawn {
                Some(drawn) if part.kind() == Contact::KIND => drawn,
                _ => part.kind(),
            };
            SketchTree::Element {
                kind: kind.to_owned(),
                label: label(part.as_ref(), kind),
                law: law(part.as_ref()),
            }
        }
        Tree::Series(branches) => SketchTree::Series(parts(branches)),
        Tree::Parallel(branches) => SketchTree::Parallel(parts(branches)),
    }
}

#[cfg(test)]
mod tests {
    use dashpot_network::{
        elements::{ELEMENTS, Spring},
        part,
    };

    use super::*;

    fn on(model: Tree<Arc<dyn Element>>) -> Network {
        let mut network = Network::new();
        let head = network.add_node(Node::mass("head", 5.0).moving(4.0));
        network.connect("padding", head, network.ground(), model).thickness = Some(0.02);
        network
    }

    #[test]
    fn every_registered_element_is_drawn_with_a_symbol_of_its_own_kind() {
        for kind in ELEMENTS {
            let drawing = sketch(&on(Tree::Part(kind.example().unwrap())), 1.0);
            let svg = drawing.svg();
            assert!(svg.contains(&format!("<g class=\"{}\">", kind.word)), "{}", kind.word);
            assert!(!drawing.text(80).contains(&format!("[{}]", kind.word)), "{}", kind.word);
        }
    }

    #[test]
    fn every_registered_effect_is_seen_in_the_drawing() {
        for kind in EFFECTS {
            let mut network = on(part(Spring { stiffness: 1e5 }));
            let without = sketch(&network, 1.0).svg();
            network.add_shared_effect(kind.example().unwrap());
            assert_ne!(sketch(&network, 1.0).svg(), without, "{}", kind.word);
        }
    }

    #[test]
    fn a_stop_has_its_distance_and_a_slider_its_force() {
        let stop = Stop {
            element: "padding".into(),
            at: None,
            restitution: 0.5,
            stiffness: None,
            damping: 0.0,
        };
        let mut network = on(part(Friction { force: 200.0, ratio: 1.0 }));
        network.add_effect(stop);
        let svg = sketch(&network, 1.0).svg();
        for text in ["slides at 200 N", "at 20 mm, e = 0.5"] {
            assert!(svg.contains(&format!(">{text}</text>")), "{text} in {svg}");
        }
    }

    #[test]
    fn a_load_is_an_arrow_on_its_node() {
        let mut network = on(part(Spring { stiffness: 1e5 }));
        let head = network.node_named("head").unwrap();
        network.add_load("push", head, Waveform::constant(30.0));
        let drawing = sketch(&network, 1.0);
        assert!(drawing.svg().contains("<g class=\"load\">"));
        assert!(drawing.text(80).contains("⇒ push: constant 30 N"), "{}", drawing.text(80));
    }
}
