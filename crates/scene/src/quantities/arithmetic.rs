//! Values that are computed: `"2 * area * 100 kPa"`.

use dashpot_formula::{Formula, FormulaError, FormulaFault, is_arithmetic};
use dashpot_network::parameters::Dimension;
use dashpot_units::{Quantity, parse_quantity};

use super::{
    named::{Definition, Values},
    words::example_text,
};
use crate::diagnostics::{Faults, fault::Fault};

/// The formula in `text` over named values; `None` where it is a quantity, the name of a value, or meant to be one.
pub(crate) fn formula(
    text: &str,
    is_name: &dyn Fn(&str) -> bool,
) -> Option<Result<Formula, FormulaError>> {
    is_arithmetic(text, is_name).then(|| Formula::parse(text, is_name))
}

/// The quantity that a text stands for: one as it is written, a named value, or what is computed of them; `None`
/// where it is faulty.
pub(crate) fn quietly(text: &str, values: &Values) -> Option<Quantity> {
    if let Some(known) = values.get(text.trim()) {
        return known.quantity;
    }
    match formula(text, &|name| values.contains_key(name)) {
        Some(formula) => formula.ok()?.quantity(&|name| constant(values, name)).ok(),
        None => parse_quantity(text).ok(),
    }
}

/// The value of a name in a formula.
pub(super) fn constant(values: &Values, name: &str) -> Option<Quantity> {
    // In arithmetic a `g` is the gram.
    values.get(name)?.quantity.map(|own| Quantity { is_gram: false, ..own })
}

/// The names of `text` where it is computed, in their order, each once.
pub(crate) fn names(text: &str, values: &Values) -> Vec<String> {
    let found = formula(text, &|name| values.contains_key(name)).and_then(Result::ok);
    let mut names: Vec<String> = Vec::new();
    for name in found.iter().flat_map(Formula::names) {
        if !names.iter().any(|own| own == name) {
            names.push(name.to_owned());
        }
    }
    names
}

/// Notes what is wrong with the formula `own`, where a quantity of the dimension `expected` may stand, among values
/// whose names are `known`.
pub(crate) fn note(
    error: FormulaError,
    own: &Definition,
    expected: Dimension,
    (values, known): (&Values, Vec<String>),
    faults: &Faults,
) {
    let place = faults.within(own.place, &error.span);
    let fault = match error.fault {
        FormulaFault::UnknownName { name } => Fault::UnknownName { family: "value", name, known },
        FormulaFault::Quantity(error) => Fault::BadValue { error, example: example_text(expected) },
        fault => told_with(Fault::Formula(fault), &names(&own.text, values), values, faults),
    };
    faults.error(place, fault);
}

/// `fault` with the definitions of these names, and of what they are computed of where that has no unit.
pub(super) fn told_with(fault: Fault, names: &[String], values: &Values, faults: &Faults) -> Fault {
    let mut all = names.to_vec();
    let mut at = 0;
    while let Some(name) = all.get(at) {
        let definition = values.get(name).and_then(|known| known.definition.as_ref());
        for inner in definition.map_or(Vec::new(), |own| self::names(&own.text, values)) {
            if !all.contains(&inner) {
                all.push(inner);
            }
        }
        at += 1;
    }
    let is_bare = |name: &String| {
        values.get(name).and_then(|own| own.quantity).is_some_and(|own| own.dimension.is_none())
    };
    let told = all.iter().enumerate().filter(|own| own.0 < names.len() || is_bare(own.1));
    let notes = told.filter_map(|(_, name)| {
        let Definition { text, place } = values.get(name)?.definition.as_ref()?;
        Some(format!("`{name}` is \"{}\", {}", text.trim(), faults.origin(*place)))
    });
    let notes = notes.collect::<Vec<_>>();
    if notes.is_empty() { fault } else { fault.with_note(notes.join("; ")) }
}
