//! `[effects]`: what acts besides the elements, and only if named.

use dashpot_network::{
    Network,
    parameters::{Parameter, ParameterKind},
};

use super::Reading;
use crate::{
    document::{Content, Entry},
    fault::Fault,
    kinds::registers,
    parameters::KindReader,
    units::{parse_quantity, si_unit},
};

/// Reads the effects into `network`.
pub(crate) fn read_effects(reading: &Reading<'_>, network: &mut Network) {
    let kinds = &registers().effects;
    for entry in reading.section("effects") {
        let Some(kind) = kinds.iter().find(|kind| kind.word == entry.key) else {
            let known = kinds.iter().map(|kind| kind.word).collect();
            let (key, owner) = (entry.key.clone(), "[effects]".to_owned());
            reading.faults.error(entry.key_place, Fault::UnknownKey { key, owner, known });
            continue;
        };
        let optional = kind.parameters.iter().all(|parameter| parameter.default.is_some());
        let reader = KindReader::new(reading.quantities());
        let is_value = matches!(entry.item.value, Content::Number(_) | Content::Text(_));
        if let Some(first) = kind.parameters.first().filter(|_| optional && is_value) {
            note_bare_value(reading, entry, first);
            continue;
        }
        let effect = if optional && matches!(entry.item.value, Content::Switch(true)) {
            reader.defaults(kind, entry.item.place)
        } else {
            reader.read(kind, &entry.item, entry.key_place)
        };
        if let Some(effect) = effect {
            network.add_shared_effect(effect);
        }
    }
}

/// Notes a value where a table is expected that may hold it.
fn note_bare_value(reading: &Reading<'_>, entry: &Entry, first: &Parameter) {
    let value = match (&entry.item.value, first.kind) {
        (Content::Number(digits), ParameterKind::Quantity(dimension)) => {
            format!("{digits} {}", si_unit(dimension))
        }
        (Content::Text(text), ParameterKind::Quantity(dimension))
            if parse_quantity(text).is_ok_and(|own| own.dimension == Some(dimension)) =>
        {
            text.clone()
        }
        _ => first.default.unwrap_or_default().to_owned(),
    };
    let Entry { key, item, .. } = entry;
    let fault = Fault::WrongType {
        what: format!("`{key}`"),
        expected: "a table".to_owned(),
        found: item.type_name(),
    };
    let default = first.default.unwrap_or_default();
    let help = format!(
        "write `{key} = {{ {} = \"{value}\" }}`, or `{key} = {{}}` for {default}",
        first.name
    );
    reading.faults.error(item.place, fault.with_help(help));
}
