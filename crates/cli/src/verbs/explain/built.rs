//! What a scene becomes: what moves and what is massless, layers, parts, loads, and the unknowns.

use dashpot_dae::UnknownKind;
use dashpot_network::{
    Node, NodeId, NodeOutputs, PadOutputs, PrimitiveOutputs, Situation, Start, Support,
    elements::Law, segments::resolved,
};
use dashpot_report::Table;
use dashpot_scene::{Scene, units::si_unit};

use super::first_rows;
use dashpot_report::numbers::{constant, estimate, quantity};
use dashpot_studies::sketch::{element, waveform};

/// All of it but the unknowns.
pub(super) fn tables(scene: &Scene) -> [Table; 5] {
    [nodes, layers, parts, loads, scattered].map(|of| of(scene))
}

fn rows(caption: &str, rows: impl Iterator<Item = Vec<String>>) -> Table {
    Table::plain(caption, first_rows(rows.collect()))
}

fn nodes(scene: &Scene) -> Table {
    let network = &scene.network;
    let is_used = |id: NodeId| {
        let mut all = network.connections().iter();
        id != network.ground() || all.any(|connection| connection.between.contains(&id))
    };
    let own = network.nodes().filter(|(id, _)| is_used(*id)).map(|(id, node)| {
        let outputs = &scene.assembly.nodes[id.index()];
        let (state, words) = described(scene, node, outputs);
        vec![state.to_owned(), node.name.clone(), words]
    });
    rows("Nodes", own.chain(scene.assembly.pads.iter().filter_map(|pad| face(scene, pad))))
}

/// The face that an effect has given to an element.
fn face(scene: &Scene, pad: &PadOutputs) -> Option<Vec<String>> {
    let own = scene.assembly.nodes.get(pad.face?)?;
    let contact = scene.assembly.connections.get(pad.contact?)?;
    let state = if own.mass > 0.0 { "moves" } else { "massless" };
    let words = match scene.assembly.primitives.get(contact.primitives.clone()) {
        Some([_, ..]) => format!("a face: it lets go where `{}` opens", contact.name),
        _ => "a face".to_owned(),
    };
    let mass = (own.mass > 0.0).then(|| format!("mass {}, ", constant(own.mass, "kg")));
    Some(vec![state.to_owned(), own.name.clone(), mass.unwrap_or_default() + &words])
}

/// What becomes of a node of the scene.
fn described(scene: &Scene, node: &Node, outputs: &NodeOutputs) -> (&'static str, String) {
    let (state, kind) = match &node.support {
        Support::Fixed => ("fixed", String::new()),
        Support::Prescribed(motion) => ("driven", waveform(motion, "m", scene.run.duration)),
        Support::Free => motion(scene, outputs),
    };
    let start = match node.start {
        Start::Rest => String::new(),
        Start::Velocity(own) => format!("impactor, starts at {}", constant(own, "m/s")),
        Start::Drop(own) => {
            let dropped = format!("impactor, dropped from {}", constant(own, "m"));
            if outputs.fall > 0.0 {
                format!("{dropped}: falls for {}", constant(outputs.fall, "s"))
            } else {
                let speed = constant(outputs.start_velocity.unwrap_or(0.0), "m/s");
                format!("{dropped}: begins at touch with {speed}")
            }
        }
    };
    let place = match node.position {
        0.0 => String::new(),
        own => format!("begins at {}", constant(own, "m")),
    };
    let words = [kind, start, place].into_iter().filter(|own| !own.is_empty());
    (state, words.collect::<Vec<_>>().join(", "))
}

/// How a free node moves.
fn motion(scene: &Scene, outputs: &NodeOutputs) -> (&'static str, String) {
    if outputs.mass > 0.0 {
        return ("moves", format!("mass {}", constant(outputs.mass, "kg")));
    }
    let mut all = scene.assembly.nodes.iter();
    let heavy = all.find(|own| own.body == outputs.body && (own.mass > 0.0 || !own.free));
    match heavy {
        Some(heavy) => ("moves", format!("as one with {}", heavy.name)),
        None => ("massless", "the forces on it are in balance".to_owned()),
    }
}

fn layers(scene: &Scene) -> Table {
    let network = &scene.network;
    let rows_of = |connection| {
        let all = resolved(network, connection).unwrap_or_default().into_iter();
        all.map(|layer| {
            let mut row = vec![format!("{}, {}", connection.name, layer.name)];
            row.push(match layer.segments {
                0 => "no mass".to_owned(),
                1 => "1 segment".to_owned(),
                count => format!("{count} segments"),
            });
            if let Some(wave) = layer.wave {
                row.push(format!(
                    "waves at {} cross it in {}, impedance {}",
                    quantity(wave.speed, "m/s", 4),
                    quantity(wave.transit, "s", 4),
                    quantity(wave.impedance, "N s/m", 4)
                ));
            }
            row
        })
    };
    rows("Layers", network.connections().iter().flat_map(rows_of))
}

fn parts(scene: &Scene) -> Table {
    let described = scene.assembly.primitives.iter().map(|primitive| {
        let own = match primitive.element.law() {
            Law::Spring(_) | Law::Dashpot(_) => element(primitive.element.as_ref()),
            Law::Rigid | Law::Nonlinear { .. } | Law::Phased => primitive.element.kind().to_owned(),
        };
        let phases = primitive.element.phases().map(|phase| phase.names().join(" / "));
        let words: Vec<String> = phases.into_iter().chain(extent(primitive)).collect();
        vec![own, primitive.name.to_string(), words.join(", ")]
    });
    rows("Parts that take part", described)
}

/// How far a law holds in compression: `up to 13.5 mm and 34.9 kN`.
fn extent(primitive: &PrimitiveOutputs) -> Option<String> {
    let (_, most) = primitive.element.range().filter(|own| own.1.is_finite() && own.1 > 0.0)?;
    let force = primitive.element.force(most, 0.0);
    Some(format!("up to {} and {}", quantity(most, "m", 4), quantity(force, "N", 4)))
}

fn loads(scene: &Scene) -> Table {
    let situation = Situation::of(&scene.network, scene.run.duration);
    let described = scene.network.loads().iter().map(|load| {
        let node = &scene.network.node(load.node).name;
        let share = situation.impact.as_ref().map(|impact| {
            let share = load.force.bound(scene.run.duration) / impact.force();
            estimate("F/(V0 √(K m1))", share)
        });
        vec![
            load.name.clone(),
            format!("on {node}"),
            waveform(&load.force, "N", scene.run.duration),
            share.unwrap_or_default(),
        ]
    });
    rows("Loads", described)
}

fn scattered(scene: &Scene) -> Table {
    let described = scene.scatter.iter().map(|own| {
        let unit = own.dimension.map_or_else(|| "1".to_owned(), si_unit);
        let [mean, deviation] = [own.mean, own.deviation].map(|value| constant(value, &unit));
        vec![own.name.clone(), format!("mean {mean}"), format!("standard deviation {deviation}")]
    });
    rows("Numbers with scatter, used as their means; `run` samples them", described)
}

pub(super) fn unknowns(scene: &Scene) -> Table {
    let system = &scene.assembly.system;
    let described = system.unknowns.iter().map(|unknown| {
        let kind = match unknown.kind {
            UnknownKind::Differential => "state",
            UnknownKind::Algebraic => "algebraic",
        };
        let scale = quantity(unknown.scale, unknown.unit, 4);
        vec![kind.to_owned(), scale, unknown.name.clone()]
    });
    let scale = quantity(system.time_scale, "s", 4);
    rows(&format!("Unknowns with their units (that of time is {scale})"), described)
}
