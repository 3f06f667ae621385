//! Faults of a network, brought to the places in the text that they are about.

use std::collections::HashMap;

use dashpot_network::{
    HeldTable, NetworkError, NetworkErrors, NetworkWarning, Subject, parameters::Dimension,
};
use dashpot_units::format_short;

use crate::{
    diagnostics::fault::Fault,
    sections::Reading,
    text::{
        document::{Content, Entry, Item, value_of},
        source::Place,
    },
};

/// The entries of a scene by what they describe.
struct Entries<'d> {
    nodes: HashMap<&'d str, &'d Entry>,
    elements: HashMap<&'d str, &'d Entry>,
    loads: &'d [Entry],
    effects: &'d [Entry],
}

/// Notes all errors of a network.
pub(crate) fn note_errors(reading: &Reading<'_>, errors: &NetworkErrors) {
    let entries = Entries::of(reading);
    for error in &errors.0 {
        let place = entries.place_of(error);
        let fault = match error {
            NetworkError::Invalid { invalid, .. } => Fault::Invalid(invalid.clone()),
            error => Fault::Network(error.clone()),
        };
        reading.faults.error(place, fault);
    }
}

/// Notes what is odd about a network, at the first element or node that each is about.
pub(crate) fn note_warnings(reading: &Reading<'_>, warnings: &[NetworkWarning]) {
    let entries = Entries::of(reading);
    for warning in warnings {
        let entry = warning.names().into_iter().find_map(|name| entries.named(name));
        let between = entry.and_then(|entry| value_of(entry, "between"));
        let (mut place, mut help) = (entry.map(|entry| entry.key_place), None);
        if let Some(between) =
            between.filter(|_| matches!(warning, NetworkWarning::Reversed { .. }))
        {
            place = Some(between.place);
            if let Content::List(ends) = &between.value
                && let [Some(from), Some(to)] = [0, 1].map(|at| ends.get(at).and_then(Item::text))
            {
                help = Some(format!("write [\"{to}\", \"{from}\"]"));
            }
        }
        reading.faults.warning(place, Fault::Odd { message: warning.to_string(), help });
    }
}

/// Notes tables that hold a value in the run, each at its function of time.
pub(crate) fn note_held(reading: &Reading<'_>, held: &[HeldTable]) {
    let entries = Entries::of(reading);
    for own in held {
        let entry = if own.dimension == Dimension::FORCE {
            entries.loads.iter().find(|entry| entry.key == own.name.as_str())
        } else {
            entries.nodes.get(own.name.as_str()).copied()
        };
        let keys = ["force", "motion", "acceleration", "velocity"];
        let value = entry.and_then(|entry| keys.iter().find_map(|key| value_of(entry, key)));
        let place = value.map(|item| item.place).or(entry.map(|entry| entry.key_place));
        let message = own.message(|value, dimension| format_short(value, dimension, 4));
        reading.faults.warning(place, Fault::odd(message, own.help()));
    }
}

impl<'d> Entries<'d> {
    fn of(reading: &'d Reading<'_>) -> Self {
        let by_name = |entry: &'d Entry| (entry.key.as_str(), entry);
        Self {
            nodes: reading.section("nodes").iter().map(by_name).collect(),
            elements: reading.section("elements").iter().map(by_name).collect(),
            loads: reading.section("loads"),
            effects: reading.section("effects"),
        }
    }

    /// The entry of an element or node, or of the element to which a part or inner node belongs.
    fn named(&self, name: &str) -> Option<&'d Entry> {
        let find = |name| self.elements.get(name).or_else(|| self.nodes.get(name)).copied();
        let outer = name.split(['.', ' ']).next().unwrap_or_default();
        find(name).or_else(|| find(outer))
    }

    fn place_of(&self, error: &NetworkError) -> Option<Place> {
        let entry = match error.subject()? {
            Subject::Node(name) => {
                self.nodes.get(name.as_str()).copied().or_else(|| self.named(&name))?
            }
            Subject::Element { name, .. } => self.named(&name)?,
            Subject::Load(name) => self.loads.iter().find(|entry| entry.key == name.as_str())?,
            Subject::Effect(word) => self.effects.iter().find(|entry| entry.key == word)?,
            Subject::EffectOn(word, element) => {
                let of_kind = self.effects.iter().find(|entry| entry.key == word)?;
                let own = of_kind.item.table().unwrap_or(&[]).iter();
                own.clone().find(|entry| entry.key == element.as_str()).unwrap_or(of_kind)
            }
        };
        let keys: &[&str] = match error {
            NetworkError::Invalid { invalid, .. } => &[invalid.parameter],
            NetworkError::BothEndsAtOneNode { .. } => &["between"],
            NetworkError::StartSpeed { .. } => &["velocity", "drop", "energy"],
            NetworkError::StartPosition { .. } => &["position"],
            NetworkError::StepAcrossDashpots { .. } => &["motion"],
            NetworkError::OutsideTable { .. } => &["force", "motion", "acceleration"],
            NetworkError::NotAnEnd { .. } | NetworkError::TwoFaces { .. } => &["at"],
            _ => &[],
        };
        let own = entry.item.table().unwrap_or(&[]).iter();
        let value = own.filter(|own| keys.contains(&own.key.as_str())).map(|own| own.item.place);
        value.min_by_key(|place| place.start).or(Some(entry.key_place))
    }
}
