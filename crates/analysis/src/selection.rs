//! Which measures a run reports.

use std::sync::Arc;

use dashpot_network::{Assembly, ConnectionOutputs};

use crate::{
    RunError,
    measures::{Family, Measure, by_default},
    solution::is_impactor,
};

/// A measure wanted of an element or a node.
#[derive(Debug, Clone)]
pub struct MeasureWish {
    /// Name of the element or node.
    pub target: String,
    /// The measure.
    pub measure: Arc<dyn Measure>,
}

impl MeasureWish {
    /// The measure `measure` of `target`.
    pub fn new(target: impl Into<String>, measure: impl Measure + 'static) -> Self {
        Self { target: target.into(), measure: Arc::new(measure) }
    }
}

/// A measure of an element or node of one network.
#[derive(Debug, Clone)]
pub(crate) struct Selected {
    /// `<target>.<kind>`; a further measure of the same target and kind has `-2`, `-3`, … at the
    /// end.
    pub(crate) key: String,
    pub(crate) name: String,
    pub(crate) target: usize,
    pub(crate) measure: Arc<dyn Measure>,
}

/// The measures that every run reports, and then those wanted.
///
/// A measure that is wanted of a target for which its kind is reported anyway takes that place.
pub(crate) fn select(
    assembly: &Assembly,
    wishes: &[MeasureWish],
) -> Result<Vec<Selected>, RunError> {
    let mut selected = Vec::new();
    let has_impactor = assembly.nodes.iter().any(is_impactor);
    let of_elements = by_default(Family::Element, has_impactor);
    for at in reported_elements(assembly) {
        add_defaults(&mut selected, &of_elements, &assembly.connections[at].name, at);
    }
    let of_nodes = by_default(Family::Node, has_impactor);
    for at in reported_nodes(assembly) {
        add_defaults(&mut selected, &of_nodes, &assembly.nodes[at].name, at);
    }
    let defaults = selected.len();
    let mut taken = vec![false; defaults];
    for wish in wishes {
        let target = find(assembly, wish)?;
        let key = key(&wish.target, wish.measure.as_ref());
        let place = selected[..defaults].iter().position(|entry| entry.key == key);
        match place {
            Some(place) if !taken[place] => {
                taken[place] = true;
                selected[place].measure = Arc::clone(&wish.measure);
            }
            _ => {
                let numbered = |count: usize| match count {
                    1 => key.clone(),
                    _ => format!("{key}-{count}"),
                };
                let is_new = |key: &String| selected.iter().all(|entry| entry.key != *key);
                let most = selected.len() + 1;
                let key = (1..=most).map(numbered).find(is_new).unwrap_or_default();
                let measure = Arc::clone(&wish.measure);
                selected.push(Selected { key, name: wish.target.clone(), target, measure });
            }
        }
    }
    Ok(selected)
}

fn add_defaults(
    selected: &mut Vec<Selected>,
    measures: &[Arc<dyn Measure>],
    name: &str,
    target: usize,
) {
    for measure in measures {
        let (key, measure) = (key(name, measure.as_ref()), Arc::clone(measure));
        selected.push(Selected { key, name: name.to_owned(), target, measure });
    }
}

fn key(target: &str, measure: &dyn Measure) -> String {
    format!("{target}.{}", measure.kind())
}

/// The elements that touch an impactor; without an impactor those that touch a mass; without a mass
/// all.
fn reported_elements(assembly: &Assembly) -> Vec<usize> {
    let touching = |wanted: &dyn Fn(usize) -> bool| -> Vec<usize> {
        let touches = |connection: &ConnectionOutputs| {
            connection.between.iter().any(|end| wanted(end.index()))
        };
        let connections = assembly.connections.iter().enumerate();
        connections.filter(|(_, connection)| touches(connection)).map(|(at, _)| at).collect()
    };
    if assembly.nodes.iter().any(is_impactor) {
        return touching(&|node| is_impactor(&assembly.nodes[node]));
    }
    let masses = touching(&|node| assembly.nodes[node].mass > 0.0);
    if masses.is_empty() { touching(&|_| true) } else { masses }
}

/// The impactors; without one the free masses that an element touches.
fn reported_nodes(assembly: &Assembly) -> Vec<usize> {
    let nodes = || assembly.nodes.iter().enumerate();
    let impactors: Vec<usize> =
        nodes().filter(|(_, node)| is_impactor(node)).map(|(at, _)| at).collect();
    if !impactors.is_empty() {
        return impactors;
    }
    let mut touched = vec![false; assembly.nodes.len()];
    for end in assembly.connections.iter().flat_map(|connection| connection.between) {
        touched[end.index()] = true;
    }
    nodes()
        .filter(|(at, node)| node.free && node.mass > 0.0 && touched[*at])
        .map(|(at, _)| at)
        .collect()
}

fn find(assembly: &Assembly, wish: &MeasureWish) -> Result<usize, RunError> {
    let (family, names): (_, Vec<&String>) = match wish.measure.applies_to() {
        Family::Element => ("element", assembly.connections.iter().map(|c| &c.name).collect()),
        Family::Node => ("node", assembly.nodes.iter().map(|node| &node.name).collect()),
    };
    names.iter().position(|name| **name == wish.target).ok_or_else(|| RunError::UnknownTarget {
        kind: wish.measure.kind(),
        target: wish.target.clone(),
        family,
        known: names.into_iter().cloned().collect(),
    })
}
