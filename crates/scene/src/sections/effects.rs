//! `[effects]`: what acts besides the elements, and only if named.

use dashpot_network::Network;

use super::Reading;
use crate::{document::Content, fault::Fault, kinds::registers, parameters::KindReader};

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
