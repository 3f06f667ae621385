//! `[measures]`: what is to be reported besides what every run reports, and of what.

use std::{cell::OnceCell, sync::Arc};

use dashpot_analysis::{Family, MEASURES, Measure, MeasureWish, measures::MeasureEntry};
use dashpot_network::{
    Network,
    parameters::{ModelValue, Parameter, ParameterKind, Value, registered},
};

use super::Reading;
use crate::{
    diagnostics::fault::Fault,
    kinds::{is_model, parameters::KindReader},
    models::ModelReader,
    text::{
        document::{Content, Entry, Item},
        nearest::list,
        source::Place,
        table::{one_or_many, text_of, wrong_type},
    },
};

/// Reads the measures that are wanted.
pub(crate) fn read_measures<'d>(
    reading: &Reading<'d>,
    targets: &Targets<'_, 'd>,
    models: &ModelReader<'d>,
) -> Vec<MeasureWish> {
    let mut wishes = Vec::new();
    for entry in reading.section("measures") {
        let inner = inner_targets(targets, entry);
        let own = inner.is_empty().then(|| (entry.key.to_string(), entry));
        for (target, entry) in inner.into_iter().chain(own) {
            let family = targets.family(&target, entry.key_place);
            for item in one_or_many(&entry.item) {
                wishes.extend(read_wish(reading, (targets, models), (&target, item), family));
            }
        }
    }
    wishes
}

/// What `pad.stop = […]` says without quotes, which is a table `stop` within `pad`; none where the
/// entry is that of a measure.
fn inner_targets<'d>(targets: &Targets<'_, 'd>, entry: &'d Entry) -> Vec<(String, &'d Entry)> {
    let entries = entry.item.table().unwrap_or(&[]);
    let named = |own: &'d Entry| (format!("{}.{}", entry.key, own.key), own);
    let is_target = |(name, own): &(String, &Entry)| {
        matches!(own.item.value, Content::List(_)) || targets.is_made(name)
    };
    if entries.iter().any(|entry| entry.key == "kind") {
        return Vec::new();
    }
    let inner: Vec<_> = entries.iter().map(named).collect();
    if inner.iter().any(is_target) { inner } else { Vec::new() }
}

/// The measure of this word for a family, with an error where there is none.
pub(super) fn measure_of(
    reading: &Reading<'_>,
    word: &str,
    family: Option<Family>,
    place: Place,
) -> Option<&'static MeasureEntry> {
    let fits = |measure_entry: &&MeasureEntry| {
        family.is_none_or(|family| measure_entry.about.family == family)
    };
    let found = registered(MEASURES, word);
    if let Some(found) = found.filter(fits) {
        return Some(found);
    }
    let known = MEASURES.iter().filter(fits).map(|own| own.word).collect();
    let other = found.map(|found| other_family(reading, word, found.about.family));
    let family = match family {
        Some(Family::Element) => "a measure of an element",
        Some(Family::Node) => "a measure of a node",
        None => "a measure",
    };
    let fault = Fault::UnknownWord { family: family.to_owned(), word: word.to_owned(), known };
    reading.faults.error(place, fault.with_any_help(other));
    None
}

/// Says of what `word` is a measure, and names some.
fn other_family(reading: &Reading<'_>, word: &str, family: Family) -> String {
    let (what, mut names): (_, Vec<&str>) = match family {
        Family::Element => ("elements", reading.elements.keys().copied().collect()),
        Family::Node => ("nodes", reading.nodes.keys().copied().collect()),
    };
    names.retain(|name| *name != "ground");
    names.sort_unstable();
    format!("`{word}` is a measure of {what}: {}", list(&names))
}

fn read_wish<'d>(
    reading: &Reading<'d>,
    (targets, models): (&Targets<'_, 'd>, &ModelReader<'d>),
    (target, item): (&str, &'d Item),
    family: Option<Family>,
) -> Option<MeasureWish> {
    let reader = reader(reading, &["kind"]);
    let measure = match &item.value {
        Content::Text(word) => {
            let measure = measure_of(reading, word, family, item.place)?;
            reader.defaults(measure, item.place)?
        }
        Content::Table(entries) => {
            let Some(kind) = entries.iter().find(|entry| entry.key == "kind") else {
                let (key, owner) = ("kind".to_owned(), format!("this measure of `{target}`"));
                let example = "kind = \"severity-index\"".to_owned();
                reading.faults.error(item.place, Fault::MissingKey { key, owner, example });
                return None;
            };
            let word = text_of(&kind.item, "`kind`", reading.faults)?;
            let measure = measure_of(reading, word, family, kind.item.place)?;
            read_table(reading, (targets, models), (target, item), measure, kind.item.place)?
        }
        _ => {
            let expected = "a word, or a table such as { kind = \"severity-index\" }";
            wrong_type(item, "a measure", expected, reading.faults);
            return None;
        }
    };
    family.map(|_| MeasureWish { target: target.to_owned(), measure })
}

fn reader<'d>(reading: &Reading<'d>, other_keys: &'static [&'static str]) -> KindReader<'d> {
    KindReader { other_keys, ..KindReader::new(reading.quantities()) }
}

/// Reads the measure of `kind` in the table `item`, of the node or element `owner`.
fn read_table<'d>(
    reading: &Reading<'d>,
    (targets, models): (&Targets<'_, 'd>, &ModelReader<'d>),
    (owner, item): (&str, &'d Item),
    kind: &MeasureEntry,
    place: Place,
) -> Option<Arc<dyn Measure>> {
    let entries = item.table().unwrap_or(&[]);
    let given = |key: &str| entries.iter().find(|entry| entry.key == key);
    for own in kind.parameters.iter().filter(|parameter| parameter.kind == ParameterKind::Node) {
        if let Some(entry) = given(own.name) {
            targets.node(&entry.item)?;
        }
    }
    let model = kind.parameters.iter().position(is_model);
    let entry = model.and_then(|at| given(kind.parameters[at].name));
    let (Some(at), Some(entry)) = (model, entry) else {
        return reader(reading, &["kind"]).read(kind, item, place);
    };
    let called = format!("the model of `{}` of `{owner}`", kind.word);
    let model = models.given(&entry.item, called, entry.key_place)?;
    let others: Vec<Parameter> =
        kind.parameters.iter().filter(|parameter| !is_model(parameter)).copied().collect();
    let make = |values: &[Value]| {
        let mut values = values.to_vec();
        values.insert(at, Value::Model(ModelValue::new(model.clone())));
        (kind.make)(&values)
    };
    reader(reading, &["kind", "model"]).read_as((kind.word, &others), &make, item, place)
}

/// The elements and nodes that a report shows by name.
pub(crate) struct Targets<'r, 'd> {
    reading: &'r Reading<'d>,
    network: &'r Network,
    /// Names that are not in the text, once one is asked for; none where the effects have no place in the network.
    made: OnceCell<Option<Vec<(String, Family)>>>,
}

impl<'r, 'd> Targets<'r, 'd> {
    /// Those of the scene in `reading`, whose effects are those of `network`.
    pub(crate) fn new(reading: &'r Reading<'d>, network: &'r Network) -> Self {
        Self { reading, network, made: OnceCell::new() }
    }

    /// Whether a name is that of an element or a node, with an error where it is neither.
    pub(super) fn family(&self, name: &str, place: Place) -> Option<Family> {
        let reading = self.reading;
        if reading.elements.contains_key(name) {
            return Some(Family::Element);
        }
        if reading.nodes.contains_key(name) {
            return Some(Family::Node);
        }
        // What is wrong with the effects is told when the network is compiled.
        let made = self.made()?;
        if let Some((_, family)) = made.iter().find(|own| own.0 == name) {
            return Some(*family);
        }
        let known = reading.elements.keys().chain(reading.nodes.keys()).copied();
        let known = known.chain(made.iter().map(|own| own.0.as_str()));
        reading.unknown("element or node", name, place, known);
        None
    }

    /// Checks that a text names a node.
    pub(super) fn node(&self, item: &Item) -> Option<()> {
        let made = item.text().and_then(|name| {
            self.made()?.iter().find(|own| own.0 == name && own.1 == Family::Node)
        });
        if made.is_some() { Some(()) } else { self.reading.node(item).map(|_| ()) }
    }

    /// Whether a name is one that effects or layers bring.
    pub(super) fn is_made(&self, name: &str) -> bool {
        self.made().is_some_and(|made| made.iter().any(|own| own.0 == name))
    }

    fn made(&self) -> Option<&[(String, Family)]> {
        let names = || {
            let network = self.network.with_effects().ok()?;
            let reading = self.reading;
            let elements = network.connections().iter().map(|connection| &connection.name);
            let elements = elements.filter(|name| !reading.elements.contains_key(name.as_str()));
            let nodes = network.nodes().map(|(_, own)| &own.name);
            let nodes = nodes.filter(|name| !reading.nodes.contains_key(name.as_str()));
            let elements = elements.map(|name| (name.clone(), Family::Element));
            Some(elements.chain(nodes.map(|name| (name.clone(), Family::Node))).collect())
        };
        self.made.get_or_init(names).as_deref()
    }
}
