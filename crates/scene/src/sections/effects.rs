//! `[effects]`: what acts besides the elements, and only if named.

use std::sync::Arc;

use dashpot_network::{
    Effect, Network, NetworkError,
    effects::{EFFECTS, EffectEntry},
    parameters::{Parameter, ParameterKind, registered},
};
use dashpot_units::{parse_quantity, si_unit};

use super::Reading;
use crate::{
    diagnostics::fault::Fault,
    kinds::{Example, parameters::KindReader},
    quantities::quantity::{Quantities, Target},
    text::{
        document::{Content, Entry, Item, value_of},
        table::unknown_key,
    },
};

/// Reads the effects into `network`.
pub(crate) fn read_effects(reading: &Reading<'_>, network: &mut Network) {
    for entry in reading.section("effects") {
        let Some(kind) = registered(EFFECTS, &entry.key) else {
            let known = EFFECTS.iter().map(|kind| kind.word).collect();
            reading.faults.error(entry.key_place, unknown_key(entry, "[effects]", known));
            continue;
        };
        if !kind.about.is_per_element {
            let effect = Wanted { reading, kind, target: "", path: &entry.key, entry }.read();
            add(network, effect);
            continue;
        }
        let Some(own) = entry.item.table() else {
            note_missing_element(reading, kind, entry);
            continue;
        };
        for own in own {
            let path = format!("{}.{}", entry.key, own.key);
            let wanted = Wanted { reading, kind, target: &own.key, path: &path, entry: own };
            add(network, wanted.read_on_element());
        }
    }
}

fn add(network: &mut Network, effect: Option<Arc<dyn Effect>>) {
    if let Some(effect) = effect {
        network.add_shared_effect(effect);
    }
}

/// An effect that a scene asks for.
struct Wanted<'r> {
    reading: &'r Reading<'r>,
    kind: &'static EffectEntry,
    /// Name of the element that it acts on; empty where it acts on the network.
    target: &'r str,
    /// Its word, and the name of the element.
    path: &'r str,
    /// What is said about it.
    entry: &'r Entry,
}

impl Wanted<'_> {
    fn read_on_element(&self) -> Option<Arc<dyn Effect>> {
        let Self { reading, kind, target, entry, .. } = self;
        let Some(element) = reading.elements.get(target) else {
            let mut known: Vec<String> =
                reading.elements.keys().map(|name| (*name).to_owned()).collect();
            known.sort();
            let (family, name) = ("element", (*target).to_owned());
            let is_parameter = kind.parameters.iter().any(|parameter| parameter.name == *target);
            let help = known.first().filter(|_| is_parameter);
            let help = help.map(|name| {
                let example = entry.item.text().unwrap_or("…");
                format!("write `{}.{name} = {{ {target} = \"{example}\" }}`", kind.word)
            });
            let fault = Fault::UnknownName { family, name, known }.with_any_help(help);
            reading.faults.missing(entry.key_place, fault);
            return None;
        };
        let effect = self.read();
        let nodes =
            kind.parameters.iter().filter(|parameter| parameter.kind == ParameterKind::Node);
        for item in nodes.filter_map(|node| value_of(entry, node.name)) {
            self.check_end(element, item);
        }
        effect
    }

    /// The element that it acts on, where it acts on one.
    fn element(&self) -> Option<Target<'_>> {
        let entry = self.reading.elements.get(self.target)?;
        let given = value_of(entry, "thickness");
        let thickness = given.and_then(|item| self.reading.quantities().peek(item));
        Some(Target {
            name: self.target,
            thickness: thickness.filter(|thickness| *thickness > 0.0),
        })
    }

    /// Notes a node that is no end of the element.
    fn check_end(&self, element: &Entry, item: &Item) -> Option<()> {
        let name = item.text()?;
        self.reading.node(item)?;
        let Content::List(ends) = &value_of(element, "between")?.value else { return None };
        let [from, to] = &**ends else { return None };
        let ends = [from.text()?, to.text()?];
        if !ends.contains(&name) {
            let help = format!("write \"{}\" or \"{}\"", ends[0], ends[1]);
            let fault = Fault::Network(NetworkError::NotAnEnd {
                effect: self.kind.word,
                element: self.target.to_owned(),
                node: name.to_owned(),
                ends: ends.map(str::to_owned),
            });
            self.reading.faults.error(item.place, fault.with_help(help));
        }
        Some(())
    }

    fn read(&self) -> Option<Arc<dyn Effect>> {
        let Self { reading, kind, target, path, entry } = self;
        let optional = kind.parameters.iter().all(|parameter| parameter.default.is_some());
        let is_value = matches!(entry.item.value, Content::Number(_) | Content::Text(_));
        if let Some(first) = kind.parameters.first().filter(|_| optional && is_value) {
            note_bare_value(reading, path, entry, first);
            return None;
        }
        let defaults = Item { value: Content::Table(Box::default()), place: entry.item.place };
        let is_on = optional && matches!(entry.item.value, Content::Switch(true));
        let item = if is_on { &defaults } else { &entry.item };
        let quantities = Quantities { element: self.element(), ..reading.quantities() };
        KindReader::new(quantities).read_as(
            (path, kind.parameters),
            &|values| (kind.make)(values).map(|own| own.on(target).unwrap_or(own)),
            item,
            entry.key_place,
        )
    }
}

/// Notes an effect on elements that names none.
fn note_missing_element(reading: &Reading<'_>, kind: &EffectEntry, entry: &Entry) {
    let fault = Fault::WrongType {
        what: format!("`{}`", entry.key),
        expected: "a table with the names of elements".to_owned(),
        found: entry.item.type_name(),
    };
    let mut names: Vec<&str> = reading.elements.keys().copied().collect();
    names.sort_unstable();
    let name = names.first().copied().unwrap_or("padding");
    let value = Example::PLAIN.value(kind.parameters);
    let help = format!("write `{}.{name} = {value}`", kind.word);
    reading.faults.error(entry.item.place, fault.with_help(help));
}

/// Notes a value where a table is expected that may hold it.
fn note_bare_value(reading: &Reading<'_>, path: &str, entry: &Entry, first: &Parameter) {
    let value = match (&entry.item.value, first.kind) {
        (Content::Number(digits), ParameterKind::Quantity(dimension)) => {
            format!("{digits} {}", si_unit(dimension))
        }
        (Content::Text(text), ParameterKind::Quantity(dimension))
            if parse_quantity(text).is_ok_and(|own| own.dimension == Some(dimension)) =>
        {
            text.to_string()
        }
        (Content::Text(text), ParameterKind::Node) => text.to_string(),
        _ if first.follows => "…".to_owned(),
        _ => first.default.unwrap_or_default().to_owned(),
    };
    let fault = Fault::WrongType {
        what: format!("`{path}`"),
        expected: "a table".to_owned(),
        found: entry.item.type_name(),
    };
    let default = first.default.unwrap_or_default();
    let help = format!(
        "write `{path} = {{ {} = \"{value}\" }}`, or `{path} = {{}}` for {default}",
        first.name
    );
    reading.faults.error(entry.item.place, fault.with_help(help));
}
