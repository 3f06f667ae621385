//! A whole scene as TOML text that is read back equal.

use std::{collections::BTreeMap, fmt::Write as _};

use dashpot_analysis::{MeasureWish, SolveSettings, Stop, measures::Measure};
use dashpot_dae::{Direction, Waveform};
use dashpot_network::{
    Connection, Element, Model, Network, Node, NodeId, Start, Support,
    elements::{Dashpot, Law, Spring},
    layers::{Layers, Resolution},
    parameters::Dimension,
    part,
    waveforms::Recognized,
};
use dashpot_rheology::Tree;
use dashpot_units::{exact_quantity, tidy};
use thiserror::Error;

use super::{
    comment_lines, key, law, quoted, write_effect, write_kind, write_material_table, write_pairs,
};
use crate::{
    quantities::basis::{AREA, Basis, DENSITY},
    sections::RunSettings,
};

/// What a scene cannot say.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum Unwritable {
    /// A load that is no line, sine, half-sine or haversine, or a motion that is none and whose velocity and
    /// acceleration are none.
    #[error("`{name}` is driven by a function of time that only its own text describes")]
    Function { name: String },
    /// A layer that is not linear.
    #[error(
        "the layer `{layer}` of `{element}` is not linear, so that no material of its own tells it"
    )]
    Layer { element: String, layer: String },
}

/// Writes a network and what is to be done with it as a scene, below comment lines.
///
/// # Errors
///
/// [`Unwritable`] where the network has something that its values alone do not tell.
pub fn write_scene(
    title: &str,
    comments: &[String],
    network: &Network,
    run: &RunSettings,
    asked: &SolveSettings,
) -> Result<String, Unwritable> {
    let mut text = comment_lines(comments);
    let _ = writeln!(text, "title = {}", quoted(title));
    let mut materials = Materials::default();
    let mut elements = String::new();
    for connection in network.connections() {
        element(network, connection, &mut materials, &mut elements)?;
    }
    for own in materials.0.values() {
        text.push('\n');
        text.push_str(own);
    }
    text.push_str("\n[nodes]\n");
    for (id, own) in network.nodes() {
        if id != network.ground() {
            let _ = writeln!(text, "{} = {{ {} }}", key(&own.name), node(own)?);
        }
    }
    text.push_str(&elements);
    if !network.effects().is_empty() {
        text.push_str("\n[effects]\n");
        for effect in network.effects() {
            let _ = writeln!(text, "{}", write_effect(effect.as_ref()));
        }
    }
    if !network.loads().is_empty() {
        text.push_str("\n[loads]\n");
    }
    for load in network.loads() {
        let force = write_waveform(&load.force, Dimension::FORCE);
        let force = force.ok_or_else(|| Unwritable::Function { name: load.name.clone() })?;
        let on = quoted(&network.node(load.node).name);
        let _ = writeln!(text, "{} = {{ on = {on}, force = {{ {force} }} }}", key(&load.name));
    }
    text.push_str(&wishes(&asked.measures));
    text.push_str(&super::limits::section(&asked.limits));
    text.push_str(&settings(run));
    Ok(text)
}

fn node(node: &Node) -> Result<String, Unwritable> {
    let mut parts = Vec::new();
    if node.mass > 0.0 {
        parts.push(format!("mass = {}", said(node.mass, Dimension::MASS)));
    }
    match node.start {
        Start::Rest => {}
        Start::Velocity(own) => {
            parts.push(format!("velocity = {}", said(own, Dimension::VELOCITY)));
        }
        Start::Drop(own) => parts.push(format!("drop = {}", said(own, Dimension::LENGTH))),
    }
    if node.position != 0.0 {
        parts.push(format!("position = {}", said(node.position, Dimension::LENGTH)));
    }
    match &node.support {
        Support::Free => {}
        Support::Fixed => parts.push("fixed = true".to_owned()),
        Support::Prescribed(motion) => {
            let motion = write_motion(motion);
            let none = || Unwritable::Function { name: node.name.clone() };
            parts.push(motion.ok_or_else(none)?);
        }
    }
    Ok(parts.join(", "))
}

fn element(
    network: &Network,
    connection: &Connection,
    materials: &mut Materials,
    text: &mut String,
) -> Result<(), Unwritable> {
    let name = |end: NodeId| quoted(&network.node(end).name);
    let [from, to] = connection.between.map(name);
    let _ = writeln!(text, "\n[elements.{}]\nbetween = [{from}, {to}]", key(&connection.name));
    if let Some(layers) = &connection.layers {
        return layered(&connection.name, layers, materials, text);
    }
    if let Some(thickness) = connection.thickness {
        let _ = writeln!(text, "thickness = {}", said(thickness, Dimension::LENGTH));
    }
    if let Some(area) = connection.area {
        let _ = writeln!(text, "area = {}", said(area, AREA));
    }
    let _ = writeln!(text, "{}", law(&connection.model, Basis::Model, true));
    Ok(())
}

fn layered(
    element: &str,
    layers: &Layers,
    materials: &mut Materials,
    text: &mut String,
) -> Result<(), Unwritable> {
    text.push_str("layers = [\n");
    for layer in &layers.all {
        let per_size = layer.thickness / layer.area;
        let material = of_material(&layer.model, per_size).ok_or_else(|| {
            let (element, layer) = (element.to_owned(), layer.name.clone());
            Unwritable::Layer { element, layer }
        })?;
        let name = materials.name(&layer.name, &material);
        let _ = writeln!(
            text,
            "  {{ material = {}, thickness = {}, area = {}, density = {} }},",
            quoted(&name),
            said(layer.thickness, Dimension::LENGTH),
            said(layer.area, AREA),
            said(layer.density, DENSITY),
        );
    }
    text.push_str("]\n");
    let _ = match layers.resolution {
        Resolution::Segments(count) => writeln!(text, "segments = {count}"),
        Resolution::Accuracy(own) => writeln!(text, "accuracy = {:?}", tidy(own)),
    };
    Ok(())
}

/// Tables of materials by name.
#[derive(Default)]
struct Materials(BTreeMap<String, String>);

impl Materials {
    /// The name under which a material is written: that of the layer, or a numbered one where that
    /// is another material's.
    fn name(&mut self, layer: &str, model: &Model) -> String {
        for count in 1_u32.. {
            let name = if count == 1 { layer.to_owned() } else { format!("{layer}-{count}") };
            let text = write_material_table(&name, model, &[]);
            match self.0.get(&name) {
                Some(known) if *known != text => {}
                Some(_) => return name,
                None => {
                    self.0.insert(name.clone(), text);
                    return name;
                }
            }
        }
        layer.to_owned()
    }
}

/// The model of 1 m² of the material, 1 m thick; `None` where it is not linear.
fn of_material(model: &Model, per_size: f64) -> Option<Model> {
    let of_size = |element: &std::sync::Arc<dyn Element>| match element.law() {
        Law::Spring(own) => Ok(part(Spring { stiffness: own * per_size })),
        Law::Dashpot(own) => Ok(part(Dashpot { damping: own * per_size })),
        Law::Rigid => Ok(Tree::Part(std::sync::Arc::clone(element))),
        Law::Nonlinear { .. } | Law::Phased => Err(()),
    };
    model.try_map(of_size).ok()
}

fn wishes(measures: &[MeasureWish]) -> String {
    let mut by_target: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for wish in measures {
        let own = measure(wish.measure.as_ref());
        by_target.entry(&wish.target).or_default().push(own);
    }
    if by_target.is_empty() {
        return String::new();
    }
    let mut text = "\n[measures]\n".to_owned();
    for (target, all) in by_target {
        let _ = writeln!(text, "{} = [{}]", key(target), all.join(", "));
    }
    text
}

fn measure(measure: &dyn Measure) -> String {
    let pairs =
        write_pairs(Basis::Model, measure.parameters(), &measure.values(), Dimension::FORCE);
    let kind = format!("kind = {}", quoted(measure.kind()));
    let all: Vec<String> = std::iter::once(kind).chain(pairs).collect();
    format!("{{ {} }}", all.join(", "))
}

fn settings(run: &RunSettings) -> String {
    let mut text = match run.at_most {
        Some(at_most) => {
            format!("\n[run]\nduration = \"auto\"\nat-most = {}\n", said(at_most, Dimension::TIME))
        }
        None => format!("\n[run]\nduration = {}\n", said(run.duration, Dimension::TIME)),
    };
    if run.samples_given {
        let _ = writeln!(text, "samples = {}", run.samples);
    }
    let methods: Vec<String> = run.methods.iter().map(|method| quoted(method)).collect();
    let _ = writeln!(text, "methods = [{}]", methods.join(", "));
    if let Some(rtol) = run.rtol {
        let _ = writeln!(text, "rtol = {rtol:?}");
    }
    if !run.stops.is_empty() {
        let all: Vec<String> = run.stops.iter().map(stop).collect();
        let _ = writeln!(text, "stop = [{}]", all.join(", "));
    }
    text
}

fn stop(stop: &Stop) -> String {
    let word = if stop.direction == Direction::Rising { "rises-above" } else { "falls-below" };
    // A bare number is in the unit of the output, whatever that is.
    format!("{{ when = {}, {word} = {:?} }}", quoted(&stop.output), tidy(stop.level))
}

/// A quantity as a text in quotes.
fn said(value: f64, dimension: Dimension) -> String {
    quoted(&exact_quantity(value, dimension))
}

/// A driving function of what is measured in `driven`, as `word = …`; `None` where it is of a kind
/// that does not show in its pieces.
fn write_waveform(waveform: &Waveform, driven: Dimension) -> Option<String> {
    Recognized::of(waveform).map(|own| written(&own, driven))
}

/// The motion of a node as `motion = { … }`, or as the `acceleration` that it was made of, with the velocity at its start,
/// or as its `velocity`.
fn write_motion(motion: &Waveform) -> Option<String> {
    let acceleration = || {
        let (own, speed) = Recognized::as_acceleration(motion)?;
        let own = format!("acceleration = {{ {} }}", written(&own, Dimension::ACCELERATION));
        let begin = || format!("velocity = {}, ", said(speed, Dimension::VELOCITY));
        Some(if speed == 0.0 { own } else { begin() + &own })
    };
    let own = write_waveform(motion, Dimension::LENGTH);
    let velocity = || {
        let own = written(&Recognized::as_velocity(motion)?, Dimension::VELOCITY);
        Some(format!("velocity = {{ {own} }}"))
    };
    own.map(|own| format!("motion = {{ {own} }}")).or_else(acceleration).or_else(velocity)
}

fn written(recognized: &Recognized, driven: Dimension) -> String {
    write_kind(recognized.word, recognized.parameters, &recognized.values, driven)
}
