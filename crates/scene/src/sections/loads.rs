//! `[loads]`: forces on nodes.

use dashpot_network::{Network, parameters::Dimension};

use super::Reading;
use crate::{
    diagnostics::fault::Fault,
    text::{
        document::{Content, Entry},
        table::check_name,
    },
};

/// Reads the loads into `network`.
pub(crate) fn read_loads(reading: &Reading<'_>, network: &mut Network) {
    for entry in reading.section("loads") {
        check_name(&entry.key, entry.key_place, reading.faults);
        read_load(reading, entry, network);
    }
}

fn read_load<'d>(reading: &Reading<'d>, entry: &'d Entry, network: &mut Network) -> Option<()> {
    if entry.item.table().is_none() {
        note_bare_force(reading, entry);
        return None;
    }
    let table = reading.table(entry, "load")?;
    let node = table.require("on", "on = \"head\"").and_then(|own| reading.node(&own.item));
    let example = "force = { half-sine = { peak = \"2 kN\", duration = \"10 ms\" } }";
    let force =
        table.require("force", example).and_then(|own| reading.waveform(own, Dimension::FORCE));
    table.finish();
    network.add_load(&*entry.key, node?, force?);
    Some(())
}

/// Notes a load that is not a table; its name is that of a node where the force alone was given.
fn note_bare_force(reading: &Reading<'_>, entry: &Entry) {
    let Entry { key, item, .. } = entry;
    let force = match &item.value {
        Content::Text(text) => text.to_string(),
        Content::Number(digits) => format!("{digits} N"),
        _ => "2 kN".to_owned(),
    };
    let node = if reading.nodes.contains_key(key.as_str()) { key } else { "head" };
    let fault = Fault::WrongType {
        what: format!("load `{key}`"),
        expected: "a table".to_owned(),
        found: item.type_name(),
    };
    let help = format!(
        "write [loads.name] with `on = \"{node}\"` and `force = {{ constant = \"{force}\" }}`"
    );
    reading.faults.error(item.place, fault.with_help(help));
}
