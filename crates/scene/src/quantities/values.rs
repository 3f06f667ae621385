//! The table of named values, and what overrides them.

use std::{
    cell::Cell,
    collections::{HashMap, HashSet},
};

use dashpot_network::parameters::Dimension;
use dashpot_units::{Quantity, UnitError, parse_quantity};

use super::{
    arithmetic::{constant, formula, note},
    bare::BareNumber,
    named::{Definition, Known, Values},
    words::example_text,
};
use crate::{
    diagnostics::{Faults, fault::Fault},
    text::{
        document::{Content, Item},
        source::{Place, set_source},
        table::{entries_of, wrong_type},
    },
    vary::variation::Written,
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
    /// As it is written, or set: a quantity, or what it is computed by.
    pub text: String,
}

/// Values set from outside, by name.
#[derive(Debug, Default)]
pub(crate) struct Overrides {
    definitions: HashMap<String, Definition>,
}

impl Overrides {
    /// The values in `set`, pairs of name and quantity; the last one of a name counts.
    pub(crate) fn new(set: &[(String, String)], faults: &Faults) -> Self {
        let definition = |own: &(String, String)| {
            let (name, text) = own;
            let source = set_source(own);
            let span = name.len() + 1..source.text.len();
            let number = faults.add_source(source);
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
                let name = name.clone();
                let fault = Fault::UnknownName { family: "value", name, known: names };
                faults.error(Place { start: 0, ..definition.place }, fault);
            }
        }
    }
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
        if let (Some(set), Some(own)) = (&set, &own)
            && let Some(bare) = BareNumber::of_set(
                &entry.key,
                &set.text,
                (&own.text, Written::split(&own.text).unit),
            )
        {
            faults.error(set.place, Fault::BareNumber(bare));
        }
        definitions.insert(entry.key.as_str(), set.or(own));
        order.push(entry.key.as_str());
    }
    resolve(&order, &definitions, faults)
}

/// So many values may refer to each other in a row.
const LONGEST_CHAIN: usize = 100;

/// Follows every name to its quantity.
fn resolve(
    order: &[&str],
    definitions: &HashMap<&str, Option<Definition>>,
    faults: &Faults,
) -> Values {
    let values = Values::with_capacity(order.len());
    let mut resolver =
        Resolver { order, definitions, faults, values, open: Vec::new(), referred: HashSet::new() };
    for &name in order {
        resolver.value(name);
    }
    let Resolver { values, referred, .. } = resolver;
    for known in referred.into_iter().filter_map(|name| values.get(name)) {
        known.is_used.set(true);
    }
    values
}

struct Resolver<'r> {
    order: &'r [&'r str],
    definitions: &'r HashMap<&'r str, Option<Definition>>,
    faults: &'r Faults,
    values: Values,
    /// The values that are being followed.
    open: Vec<(&'r str, Place)>,
    /// Those that others refer to.
    referred: HashSet<&'r str>,
}

impl<'r> Resolver<'r> {
    /// Makes the value of this name known, with those that it refers to.
    fn value(&mut self, name: &'r str) {
        if self.values.contains_key(name) {
            return;
        }
        if let Some(at) = self.open.iter().position(|own| own.0 == name) {
            let names = self.open[at..].iter().map(|own| own.0).chain([name]);
            let names = names.map(str::to_owned).collect();
            self.faults.error(self.open.last().map(|own| own.1), Fault::SelfReference { names });
            return;
        }
        let definition = self.definitions.get(name).and_then(Option::as_ref);
        if let Some(definition) = definition.filter(|_| self.open.len() >= LONGEST_CHAIN) {
            let fault = Fault::ValuesTooDeep { limit: LONGEST_CHAIN };
            self.faults.error(definition.place, fault);
            return;
        }
        let (quantity, definition) = match definition {
            None => (None, None),
            Some(definition) => {
                self.open.push((name, definition.place));
                let found = self.followed(definition);
                self.open.pop();
                found
            }
        };
        let known = Known { quantity, definition, is_used: Cell::new(false) };
        self.values.entry(name.to_owned()).or_insert(known);
    }

    /// The quantity of a definition, and where that stands in the end.
    fn followed(&mut self, own: &Definition) -> (Option<Quantity>, Option<Definition>) {
        let definitions = self.definitions;
        if let Some((next, _)) = definitions.get_key_value(own.text.trim()) {
            self.refer(next);
            let known = self.values.get(*next);
            return known.map_or((None, None), |own| (own.quantity, own.definition.clone()));
        }
        (self.quantity(own), Some(own.clone()))
    }

    fn refer(&mut self, name: &'r str) {
        self.referred.insert(name);
        self.value(name);
    }

    fn quantity(&mut self, own: &Definition) -> Option<Quantity> {
        let known = |order: &[&str]| order.iter().map(|&name| name.to_owned()).collect();
        let expected = Dimension::STIFFNESS;
        let definitions = self.definitions;
        if let Some(formula) = formula(&own.text, &|name| definitions.contains_key(name)) {
            let found = formula.and_then(|formula| {
                for name in formula.names() {
                    if let Some((name, _)) = definitions.get_key_value(name) {
                        self.refer(name);
                        // What is wrong with it has been told.
                        if self.values.get(*name).is_none_or(|known| known.quantity.is_none()) {
                            return Ok(None);
                        }
                    }
                }
                formula.quantity(&|name| constant(&self.values, name)).map(Some)
            });
            return found.unwrap_or_else(|error| {
                note(error, own, expected, (&self.values, known(self.order)), self.faults);
                None
            });
        }
        let error = match parse_quantity(&own.text) {
            Ok(quantity) => return Some(quantity),
            Err(error) => error,
        };
        let word = own.text.trim();
        let is_name = matches!(error, UnitError::NoNumber { .. }) && !word.is_empty();
        let fault = if is_name && self.order.len() > 1 {
            Fault::UnknownName { family: "value", name: word.to_owned(), known: known(self.order) }
        } else {
            Fault::BadValue { error, example: example_text(expected) }
        };
        self.faults.error(own.place, fault);
        None
    }
}
