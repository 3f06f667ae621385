//! Which measures a run reports.

use std::{collections::HashMap, sync::Arc};

use dashpot_network::{
    Assembly,
    parameters::{Value, WindowWish, registered},
};

use crate::{
    Limit, RunError,
    impact::contacts,
    measures::{Family, MEASURES, Measure, by_default, of_layers},
    memory::is_large,
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
    /// `<target>.<kind>`; a further measure of the same target and kind has `-2`, `-3`, … at the end.
    pub(crate) key: String,
    pub(crate) name: String,
    pub(crate) target: usize,
    pub(crate) measure: Arc<dyn Measure>,
}

/// The measures that every run reports, then those wanted, and those that limits are on.
///
/// A measure that is wanted of a target for which its kind is reported anyway takes that place, if it
/// looks at the same part of the run.
pub(crate) fn select(
    assembly: &Assembly,
    wishes: &[MeasureWish],
    limits: &[Limit],
) -> Result<Vec<Selected>, RunError> {
    let mut selected = select_wished(assembly, wishes)?;
    for limit in limits {
        if selected.iter().any(|own| own.key == limit.key) {
            continue;
        }
        let Some(wish) = wish(&limit.key) else {
            let known = selected.into_iter().map(|own| own.key).collect();
            return Err(RunError::UnknownMeasure { key: limit.key.clone(), known });
        };
        let target = Names::of(assembly, std::slice::from_ref(&wish)).find(assembly, &wish)?;
        let (key, name) = (limit.key.clone(), wish.target);
        selected.push(Selected { key, name, target, measure: wish.measure });
    }
    Ok(selected)
}

/// The measure that a key asks for, with its parameters as they are by default, where its word is known.
pub(crate) fn wish(key: &str) -> Option<MeasureWish> {
    let (target, word) = key.rsplit_once('.')?;
    let measure = registered(MEASURES, word).map(|own| (own.about.default)())?;
    Some(MeasureWish { target: target.to_owned(), measure })
}

fn select_wished(assembly: &Assembly, wishes: &[MeasureWish]) -> Result<Vec<Selected>, RunError> {
    let mut selected = Vec::new();
    let has_impactor = assembly.has_impactor();
    // In a large network without an impactor nothing stands out.
    let has_defaults = has_impactor || !is_large(assembly);
    let of_elements = by_default(Family::Element, has_impactor);
    for at in reported_elements(assembly).into_iter().filter(|_| has_defaults) {
        add_defaults(&mut selected, &of_elements, &assembly.connections[at].name, at);
    }
    let of_layers = of_layers();
    for (at, connection) in assembly.connections.iter().enumerate() {
        if connection.has_layers {
            add_defaults(&mut selected, &of_layers, &connection.name, at);
        }
    }
    let of_nodes = by_default(Family::Node, has_impactor);
    for at in reported_nodes(assembly).into_iter().filter(|_| has_defaults) {
        add_defaults(&mut selected, &of_nodes, &assembly.nodes[at].name, at);
    }
    let defaults = selected.len();
    let mut taken = vec![false; defaults];
    let mut known: HashMap<String, usize> =
        selected.iter().enumerate().map(|(at, entry)| (entry.key.clone(), at)).collect();
    let names = Names::of(assembly, wishes);
    for wish in wishes {
        let target = names.find(assembly, wish)?;
        let key = key(&wish.target, wish.measure.as_ref());
        match known.get(&key).copied().filter(|&place| place < defaults) {
            Some(place) if !taken[place] && is_of_impact(wish.measure.as_ref(), has_impactor) => {
                taken[place] = true;
                selected[place].measure = Arc::clone(&wish.measure);
            }
            _ => {
                let numbered = |count: usize| match count {
                    1 => key.clone(),
                    _ => format!("{key}-{count}"),
                };
                let is_new = |key: &String| !known.contains_key(key);
                let most = selected.len() + 1;
                let key = (1..=most).map(numbered).find(is_new).unwrap_or_default();
                known.insert(key.clone(), selected.len());
                let measure = Arc::clone(&wish.measure);
                selected.push(Selected { key, name: wish.target.clone(), target, measure });
            }
        }
    }
    Ok(selected)
}

/// Whether a measure looks at the impact, which is the whole run where there is no impactor.
fn is_of_impact(measure: &dyn Measure, has_impactor: bool) -> bool {
    measure.values().iter().all(|value| match value {
        Value::Window(WindowWish::Run) => !has_impactor,
        Value::Window(WindowWish::Times(..)) => false,
        _ => true,
    })
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

/// The elements or nodes, by position, that a run tells of without being asked.
pub fn reported(assembly: &Assembly, family: Family) -> Vec<usize> {
    match family {
        Family::Element => reported_elements(assembly),
        Family::Node => reported_nodes(assembly),
    }
}

/// The elements that touch an impactor; without an impactor those that touch a mass; without a mass
/// all. Rigid links count as parts of what they join.
fn reported_elements(assembly: &Assembly) -> Vec<usize> {
    let touching = |wanted: &[bool]| -> Vec<usize> {
        let connections = assembly.connections.iter().enumerate();
        let touching = connections
            .filter(|(_, connection)| contacts::is_touching(assembly, connection, wanted));
        touching.map(|(at, _)| at).collect()
    };
    let impactors = contacts::with_impactor(assembly);
    if impactors.contains(&true) {
        let mut found = touching(&impactors);
        // What is struck through its face by one of them.
        let behind = |&at: &usize| assembly.pad_behind(at).map(|pad| pad.element);
        let behind: Vec<usize> = found.iter().filter_map(behind).collect();
        found.extend(behind);
        found.sort_unstable();
        found.dedup();
        return found;
    }
    let mut masses = vec![false; contacts::count(assembly)];
    for node in assembly.nodes.iter().filter(|node| node.mass > 0.0) {
        masses[node.body] = true;
    }
    let found = touching(&masses);
    if found.is_empty() { touching(&vec![true; masses.len()]) } else { found }
}

/// The impactors; without one the free masses that an element touches.
fn reported_nodes(assembly: &Assembly) -> Vec<usize> {
    let nodes = || assembly.nodes.iter().enumerate();
    let impactors: Vec<usize> =
        nodes().filter(|(_, node)| node.is_impactor()).map(|(at, _)| at).collect();
    if !impactors.is_empty() {
        return impactors;
    }
    let mut touched = vec![false; contacts::count(assembly)];
    for connection in assembly.connections.iter().filter(|connection| !connection.is_rigid) {
        for body in contacts::between(assembly, connection) {
            touched[body] = true;
        }
    }
    nodes()
        .filter(|(_, node)| node.free && node.mass > 0.0 && touched[node.body])
        .map(|(at, _)| at)
        .collect()
}

/// Elements and nodes by name, where any is asked for.
struct Names<'a> {
    elements: HashMap<&'a str, usize>,
    nodes: HashMap<&'a str, usize>,
}

impl<'a> Names<'a> {
    fn of(assembly: &'a Assembly, wishes: &[MeasureWish]) -> Self {
        let mut names = Self { elements: HashMap::new(), nodes: HashMap::new() };
        let is_asked = |family| wishes.iter().any(|wish| wish.measure.applies_to() == family);
        // The first of a name counts.
        if is_asked(Family::Element) {
            let own = assembly.connections.iter().enumerate().rev();
            names.elements = own.map(|(at, own)| (own.name.as_str(), at)).collect();
        }
        if is_asked(Family::Node) {
            let own = assembly.nodes.iter().enumerate().rev();
            names.nodes = own.map(|(at, own)| (own.name.as_str(), at)).collect();
        }
        names
    }

    fn find(&self, assembly: &Assembly, wish: &MeasureWish) -> Result<usize, RunError> {
        let (family, names) = match wish.measure.applies_to() {
            Family::Element => ("element", &self.elements),
            Family::Node => ("node", &self.nodes),
        };
        names.get(wish.target.as_str()).copied().ok_or_else(|| RunError::UnknownTarget {
            kind: wish.measure.kind(),
            target: wish.target.clone(),
            family,
            known: match wish.measure.applies_to() {
                Family::Element => assembly.connections.iter().map(|c| c.name.clone()).collect(),
                Family::Node => assembly.nodes.iter().map(|node| node.name.clone()).collect(),
            },
        })
    }
}
