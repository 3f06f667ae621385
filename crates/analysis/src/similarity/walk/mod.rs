//! All parameters of a network, one after the other, and the network made of them again.

mod sizes;
mod waveforms;

use std::sync::Arc;

use dashpot_network::{
    Connection, Effect, Element, Model, Network, Node, Start, Support,
    elements::ELEMENTS,
    layers::{Layer, Layers, Resolution},
    parameters::{
        Dimension, InvalidParameter, ModelValue, Parameter, ParameterKind, Value, WindowWish,
        registered,
    },
};
use dashpot_rheology::{Branch, Tree};

use self::{
    sizes::{Pad, Stresses},
    waveforms::{walk_motion, walk_waveform},
};
use super::names::{again, gravity, speed_of_fall};

/// Area \[m²\].
const AREA: Dimension = Dimension::new(0, 2, 0);

/// Sees the parameters of a network.
pub(super) trait Visit {
    /// A number; what is returned stands in its place.
    fn quantity(&mut self, name: &str, dimension: Dimension, value: f64) -> f64;

    /// A number of the point `at` of a curve; what is returned stands in its place.
    fn point(
        &mut self,
        curve: &str,
        (at, axis): (usize, &str),
        dimension: Dimension,
        value: f64,
    ) -> f64 {
        self.quantity(&format!("{curve}[{at}].{axis}"), dimension, value)
    }

    /// What is no number: kinds, words, and what is joined to what.
    fn word(&mut self, _name: &str, _word: &str) {}

    /// A size that acts only in products with others, which are told; what is returned stands in its place.
    fn size(&mut self, _dimension: Dimension, value: f64) -> f64 {
        value
    }
}

/// Shows all parameters to `visit`, and makes the network of what it returns.
/// Errors: the first value that is out of range.
pub(super) fn walk(network: &Network, visit: &mut dyn Visit) -> Result<Network, InvalidParameter> {
    let mut again = network.clone();
    for node in again.nodes_mut() {
        walk_node(network, node, visit)?;
    }
    for connection in again.connections_mut() {
        walk_connection(network, connection, visit)?;
    }
    for load in again.loads_mut() {
        visit.word(&load.name, &format!("a load on {}", network.node(load.node).name));
        load.force = walk_waveform(&load.name, &load.force, Dimension::FORCE, visit)?;
    }
    for effect in again.effects_mut() {
        *effect = walk_effect(effect, visit)?;
    }
    drop_again(network, &mut again);
    Ok(again)
}

/// Lets fall what falls under gravity, from where it has its speed at touch.
fn drop_again(network: &Network, again: &mut Network) {
    let (Some(_), Some(pull)) = (gravity(network), gravity(again).filter(|own| *own > 0.0)) else {
        return;
    };
    for (node, (_, before)) in again.nodes_mut().iter_mut().zip(network.nodes().skip(1)) {
        if let (Start::Drop(_), Start::Velocity(speed)) = (before.start, node.start) {
            node.start = Start::Drop(0.5 * speed * speed / pull);
        }
    }
}

fn walk_node(
    network: &Network,
    node: &mut Node,
    visit: &mut dyn Visit,
) -> Result<(), InvalidParameter> {
    let name = &node.name;
    let mut word = if node.mass > 0.0 { "with mass" } else { "massless" }.to_owned();
    if node.mass > 0.0 {
        node.mass = visit.quantity(&format!("{name}.mass"), Dimension::MASS, node.mass);
    }
    let velocity = match node.start {
        Start::Rest => None,
        Start::Velocity(own) => Some(own),
        // Only its speed counts, and that is one parameter instead of two.
        Start::Drop(height) => Some(speed_of_fall(network, height)),
    };
    if let Some(own) = velocity {
        word += ", an impactor";
        let velocity = visit.quantity(&format!("{name}.velocity"), Dimension::VELOCITY, own);
        node.start = Start::Velocity(velocity);
    }
    if node.position != 0.0 {
        node.position =
            visit.quantity(&format!("{name}.position"), Dimension::LENGTH, node.position);
    }
    match &mut node.support {
        Support::Free => {}
        Support::Fixed => word += ", fixed",
        Support::Prescribed(motion) => {
            word += ", moved";
            *motion = walk_motion(name, motion, visit)?;
        }
    }
    visit.word(name, &word);
    Ok(())
}

fn walk_connection(
    network: &Network,
    own: &mut Connection,
    visit: &mut dyn Visit,
) -> Result<(), InvalidParameter> {
    let name = own.name.as_str();
    let [from, to] = own.between.map(|end| network.node(end).name.as_str());
    visit.word(name, &format!("between {from} and {to}"));
    if let Some(layers) = &mut own.layers {
        *layers = walk_layers(name, layers, visit)?;
        (own.thickness, own.model) = (Some(layers.thickness()), layers.model());
        own.area = own.area.map(|area| visit.size(AREA, area));
        return Ok(());
    }
    let before = own.thickness;
    own.thickness = before.map(|thickness| {
        visit.quantity(&format!("{name}.thickness"), Dimension::LENGTH, thickness)
    });
    own.area = own.area.map(|area| visit.size(AREA, area));
    own.model = match before.zip(own.thickness) {
        Some((before, after)) => walk_model(name, &own.model, &mut Pad { visit, before, after })?,
        None => walk_model(name, &own.model, visit)?,
    };
    for pad in &mut own.pads {
        pad.thickness = visit.size(Dimension::LENGTH, pad.thickness);
        pad.area = pad.area.map(|area| visit.size(AREA, area));
    }
    Ok(())
}

#[expect(clippy::float_cmp, reason = "what stays is the same to the last digit")]
fn walk_layers(
    name: &str,
    layers: &Layers,
    visit: &mut dyn Visit,
) -> Result<Layers, InvalidParameter> {
    let mut all = Vec::with_capacity(layers.all.len());
    for (at, layer) in layers.all.iter().enumerate() {
        let name = format!("{name}.{}-{}", layer.name, at + 1);
        let named = |key: &str| format!("{name}.{key}");
        let thickness = visit.quantity(&named("thickness"), Dimension::LENGTH, layer.thickness);
        // The stiffness of the layer is known, so that area and density act by its mass alone.
        let before = layer.density * layer.area * layer.thickness;
        let mass = visit.quantity(&named("mass"), Dimension::MASS, before);
        let area = visit.size(AREA, layer.area);
        let is_same = [mass, thickness, area] == [before, layer.thickness, layer.area];
        let density = if is_same { layer.density } else { mass / (area * thickness) };
        let model = walk_model(&name, &layer.model, visit)?;
        all.push(Layer { name: layer.name.clone(), thickness, area, density, model });
    }
    let resolution = match layers.resolution {
        Resolution::Segments(count) => {
            visit.word(&format!("{name}.segments"), &count.to_string());
            Resolution::Segments(count)
        }
        Resolution::Accuracy(own) => {
            let name = format!("{name}.accuracy");
            Resolution::Accuracy(visit.quantity(&name, Dimension::NUMBER, own))
        }
    };
    Ok(Layers { all, resolution })
}

/// The parameters of a model, below `name`.
pub(super) fn walk_model(
    name: &str,
    model: &Model,
    visit: &mut dyn Visit,
) -> Result<Model, InvalidParameter> {
    tell_shape(name, model, visit);
    let mut paths = model.parts().into_iter().map(|(path, _)| path);
    model.fold(
        |element| {
            let path = paths.next().unwrap_or_default();
            walk_element(name, &path, element, visit).map(Tree::Part)
        },
        |node, parts: Vec<Result<Model, InvalidParameter>>| {
            let parts = parts.into_iter().collect::<Result<Vec<Model>, InvalidParameter>>()?;
            let branches = node.branches().iter().zip(parts);
            let branches = branches.map(|(own, tree)| Branch::new(own.name.clone(), tree));
            let branches = branches.collect();
            Ok(if node.is_series() { Tree::Series(branches) } else { Tree::Parallel(branches) })
        },
    )
}

/// Says of each composition what it is.
fn tell_shape(name: &str, model: &Model, visit: &mut dyn Visit) {
    let mut left = vec![(format!("{name}.model"), model)];
    while let Some((path, tree)) = left.pop() {
        if tree.branches().is_empty() {
            continue;
        }
        let names: Vec<&str> = tree.branches().iter().map(|branch| &*branch.name).collect();
        let word = if tree.is_series() { "series" } else { "parallel" };
        visit.word(&path, &format!("{word} of {}", names.join(", ")));
        let branches = tree.branches().iter();
        left.extend(branches.map(|branch| (format!("{path}.{}", branch.name), &branch.tree)));
    }
}

fn walk_element(
    name: &str,
    path: &str,
    element: &Arc<dyn Element>,
    visit: &mut dyn Visit,
) -> Result<Arc<dyn Element>, InvalidParameter> {
    let kind = element.kind();
    let place = if path.is_empty() { name.to_owned() } else { format!("{name}.{path}") };
    visit.word(&format!("{place}.law"), kind);
    let Some(maker) = registered(ELEMENTS, kind) else {
        let range = "a law with parameters, which can be scaled";
        return Err(InvalidParameter::new(kind, range, "given as a function"));
    };
    let is_said = path.rsplit('.').next() == Some(kind);
    let prefix = match maker.parameters {
        [_] if is_said => place,
        [_] => format!("{place}.{kind}"),
        _ => place,
    };
    let before = element.values();
    let area = maker
        .parameters
        .iter()
        .position(|parameter| parameter.kind == ParameterKind::Quantity(AREA));
    let after = match area.zip(area.and_then(|at| before.get(at))) {
        Some((at, Value::Number(area))) => {
            let after = visit.size(AREA, *area);
            let mut stresses = Stresses { visit, before: *area, after };
            let mut values = walk_values(&prefix, maker.parameters, &before, &mut stresses)?;
            values[at] = Value::Number(after);
            values
        }
        _ => walk_values(&prefix, maker.parameters, &before, visit)?,
    };
    if after == before { Ok(Arc::clone(element)) } else { (maker.make)(&after) }
}

fn walk_effect(
    effect: &Arc<dyn Effect>,
    visit: &mut dyn Visit,
) -> Result<Arc<dyn Effect>, InvalidParameter> {
    let kind = effect.kind();
    let prefix = match effect.target() {
        Some(target) => format!("{kind}.{target}"),
        None => kind.to_owned(),
    };
    visit.word(&prefix, "on");
    let before = effect.values();
    let mut after = Vec::with_capacity(before.len());
    for (parameter, value) in effect.parameters().iter().zip(&before) {
        // An effect has other things by name, so a single parameter keeps its own.
        let name = format!("{prefix}.{}", parameter.name);
        after.push(walk_value(&name, parameter, value, visit)?);
    }
    if after == before { Ok(Arc::clone(effect)) } else { again(effect, effect.target(), &after) }
}

/// The values of parameters; a single one goes by the `prefix` alone.
pub(super) fn walk_values(
    prefix: &str,
    parameters: &[Parameter],
    values: &[Value],
    visit: &mut dyn Visit,
) -> Result<Vec<Value>, InvalidParameter> {
    let named = |parameter: &Parameter| match parameters {
        [_] => prefix.to_owned(),
        _ => format!("{prefix}.{}", parameter.name),
    };
    let pairs = parameters.iter().zip(values);
    pairs.map(|(own, value)| walk_value(&named(own), own, value, visit)).collect()
}

fn walk_value(
    name: &str,
    parameter: &Parameter,
    value: &Value,
    visit: &mut dyn Visit,
) -> Result<Value, InvalidParameter> {
    Ok(match (parameter.kind, value) {
        (ParameterKind::Quantity(dimension), Value::Number(number)) => {
            Value::Number(visit.quantity(name, dimension, *number))
        }
        (ParameterKind::TemperatureDifference, Value::Number(number)) => {
            Value::Number(visit.quantity(name, Dimension::TEMPERATURE, *number))
        }
        (ParameterKind::Curve(first, second), Value::Table(points)) => {
            let point = |(at, point): (usize, &(f64, f64))| {
                let x = visit.point(name, (at, "x"), first, point.0);
                (x, visit.point(name, (at, "y"), second, point.1))
            };
            Value::Table(points.iter().enumerate().map(point).collect())
        }
        (_, Value::Formula(formula)) => {
            let mut at = 0;
            Value::Formula(formula.renumbered(&mut |dimension, value| {
                at += 1;
                (dimension, visit.quantity(&format!("{name}[{at}]"), dimension, value))
            }))
        }
        (_, Value::Window(WindowWish::Times(from, to))) => {
            let mut time =
                |key: &str, own| visit.quantity(&format!("{name}.{key}"), Dimension::TIME, own);
            Value::Window(WindowWish::Times(time("from", *from), time("to", *to)))
        }
        (_, Value::Model(value)) => match value.model() {
            Some(model) => Value::Model(ModelValue::new(walk_model(name, model, visit)?)),
            None => Value::Model(value.clone()),
        },
        (_, Value::LeftOut) => Value::LeftOut,
        (_, other) => {
            visit.word(name, &word_of(other));
            other.clone()
        }
    })
}

/// A value that is no number of a dimension, in words.
fn word_of(value: &Value) -> String {
    match value {
        Value::Word(own) => own.clone(),
        Value::Number(own) => own.to_string(),
        Value::Flag => "set".to_owned(),
        Value::Window(WindowWish::Impact) => "the impact".to_owned(),
        Value::Window(WindowWish::Run) => "the run".to_owned(),
        other => format!("{other:?}"),
    }
}
