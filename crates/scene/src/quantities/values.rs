//! The table of named values, and what overrides them.

use std::{
    cell::Cell,
    collections::{HashMap, HashSet},
    sync::Arc,
};

use dashpot_network::parameters::Dimension;

use super::{
    quantity::{Definition, Known, Values},
    words::example_text,
};
use crate::{
    diagnostics::{Faults, fault::Fault},
    text::{
        document::{Content, Item},
        nearest::list,
        source::{Place, SET, Source},
        table::{entries_of, wrong_type},
    },
    units::{Quantity, parse_quantity},
};

/// A value that a scene gives a name.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedValue {
    /// Its name.
    pub name: String,
    /// The value in SI units.
    pub value: f64,
    /// What it measures, where a unit was given.
    pub dimension: Option<Dimension>,
}

/// Values set from outside, by name.
#[derive(Debug, Default)]
pub(crate) struct Overrides {
    definitions: HashMap<String, Definition>,
}

impl Overrides {
    /// The values in `set`, pairs of name and quantity; the last one of a name counts.
    pub(crate) fn new(set: &[(String, String)], faults: &Faults) -> Self {
        let definition = |(name, text): &(String, String)| {
            let source = Source::new(SET, format!("{name}={text}"));
            let span = name.len() + 1..source.text.len();
            let number = faults.add_source(Arc::new(source));
            (name.clone(), Definition { text: text.clone(), place: Place::new(number, &span) })
        };
        Self { definitions: set.iter().map(definition).collect() }
    }

    /// Notes the names that none of `known` has.
    pub(crate) fn check(&self, known: &[&Values], faults: &Faults) {
        for (name, definition) in &self.definitions {
            if !known.iter().any(|values| values.contains_key(name)) {
                let mut names: Vec<String> =
                    known.iter().flat_map(|values| values.keys().cloned()).collect();
                names.sort();
                let help = name.contains('.').then(|| path_help(name, &definition.text, &names));
                let name = name.clone();
                let fault = Fault::UnknownName { family: "value", name, known: names };
                let fault = fault.with_any_help(help);
                faults.error(Place { start: 0, ..definition.place }, fault);
            }
        }
    }
}

/// What to do where a path into the scene stands for the name of a value.
fn path_help(path: &str, text: &str, names: &[String]) -> String {
    let known = match names {
        [] => "of which this scene has none".to_owned(),
        names => format!("here {}", list(names)),
    };
    format!(
        "`--set` takes names under [values], {known}; a path goes with \
         `dashpot sweep --vary \"{path}={}\"`, one value or many",
        text.trim()
    )
}

/// The values of the table `item`, where the scene has one.
pub(crate) fn read(item: Option<&Item>, overrides: &Overrides, faults: &Faults) -> Values {
    let entries = item.and_then(|item| entries_of(item, "[values]", faults)).unwrap_or(&[]);
    let mut definitions = HashMap::new();
    let mut order = Vec::with_capacity(entries.len());
    for entry in entries {
        if entry.key.trim() != entry.key || parse_quantity(&entry.key).is_ok() {
            let reason = "it reads like a number";
            faults.error(entry.key_place, Fault::BadName { name: entry.key.to_string(), reason });
        }
        let own = match &entry.item.value {
            Content::Text(text) => Some(text.to_string()),
            Content::Number(digits) => Some(digits.to_string()),
            _ => {
                wrong_type(&entry.item, "a value", "a number or a quantity in quotes", faults);
                None
            }
        };
        let own = own.map(|text| Definition { text, place: entry.item.place });
        let set = overrides.definitions.get(entry.key.as_str()).cloned();
        definitions.insert(entry.key.as_str(), set.or(own));
        order.push(entry.key.as_str());
    }
    resolve(&order, &definitions, faults)
}

/// Follows every name to its quantity.
fn resolve(
    order: &[&str],
    definitions: &HashMap<&str, Option<Definition>>,
    faults: &Faults,
) -> Values {
    let mut values = Values::with_capacity(order.len());
    let mut referred = HashSet::new();
    for &start in order {
        let mut path = Vec::new();
        let mut name = start;
        let found = loop {
            if let Some(known) = values.get(name) {
                break (known.quantity, known.definition.clone());
            }
            if let Some(at) = path.iter().position(|&(passed, _)| passed == name) {
                let names = path[at..].iter().map(|&(name, _)| name).chain([name]);
                let names = names.map(str::to_owned).collect();
                faults.error(path.last().map(|entry| entry.1), Fault::SelfReference { names });
                break (None, None);
            }
            let Some(Some(definition)) = definitions.get(name) else {
                break (None, None);
            };
            path.push((name, definition.place));
            let Some((next, _)) = definitions.get_key_value(definition.text.trim()) else {
                let quantity = quantity(definition, order, faults);
                break (quantity, Some(definition.clone()));
            };
            referred.insert(*next);
            name = *next;
        };
        let (quantity, definition) = found;
        for name in path.into_iter().map(|entry| entry.0).chain([start]) {
            let (definition, is_used) = (definition.clone(), Cell::new(false));
            values.insert(name.to_owned(), Known { quantity, definition, is_used });
        }
    }
    for known in referred.into_iter().filter_map(|name| values.get(name)) {
        known.is_used.set(true);
    }
    values
}

fn quantity(definition: &Definition, names: &[&str], faults: &Faults) -> Option<Quantity> {
    use crate::units::UnitError;
    let error = match parse_quantity(&definition.text) {
        Ok(quantity) => return Some(quantity),
        Err(error) => error,
    };
    let word = definition.text.trim();
    let is_name = matches!(error, UnitError::NoNumber { .. }) && !word.is_empty();
    let fault = if is_name && names.len() > 1 {
        let known = names.iter().map(|&name| name.to_owned()).collect();
        Fault::UnknownName { family: "value", name: word.to_owned(), known }
    } else {
        Fault::BadValue { error, example: example_text(Dimension::STIFFNESS) }
    };
    faults.error(definition.place, fault);
    None
}
