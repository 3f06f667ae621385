//! `[loads]`: forces on nodes.

use dashpot_network::{Network, parameters::Dimension};

use super::Reading;
use crate::{document::Entry, table::check_name};

/// Reads the loads into `network`.
pub(crate) fn read_loads(reading: &Reading<'_>, network: &mut Network) {
    for entry in reading.section("loads") {
        check_name(&entry.key, entry.key_place, reading.faults);
        read_load(reading, entry, network);
    }
}

fn read_load<'d>(reading: &Reading<'d>, entry: &'d Entry, network: &mut Network) -> Option<()> {
    let table = reading.table(entry, "load")?;
    let node = table.require("on", "on = \"head\"").and_then(|own| reading.node(&own.item));
    let example = "force = { half-sine = { peak = \"2 kN\", duration = \"10 ms\" } }";
    let force =
        table.require("force", example).and_then(|own| reading.waveform(own, Dimension::FORCE));
    table.finish();
    network.add_load(&*entry.key, node?, force?);
    Some(())
}
