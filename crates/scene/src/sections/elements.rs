//! `[elements]`: models between nodes.

use dashpot_network::{
    Network, NodeId,
    parameters::{Dimension, Range},
};

use super::{Reading, layers::read_layers};
use crate::{
    diagnostics::fault::Fault,
    models::{ModelReader, Read},
    quantities::{
        basis::{AREA, SIZE},
        pad::Size,
    },
    text::{
        document::{Content, Entry},
        table::{Table, check_name, wrong_type},
    },
};

/// The keys of an element besides its law.
pub(crate) const ELEMENT_KEYS: &[&str] = &["between", "shift", "thickness", "area", "layers"];

/// Reads the elements into `network`.
pub(crate) fn read_elements<'d>(
    reading: &mut Reading<'d>,
    models: &ModelReader<'d>,
    network: &mut Network,
) {
    for entry in reading.section("elements") {
        check_name(&entry.key, entry.key_place, reading.faults);
        reading.elements.insert(&entry.key, entry);
        read_element(reading, models, entry, network);
    }
    if reading.library.section("elements").is_none() && !reading.faults.damaged() {
        reading.faults.error(None, Fault::MissingSection { section: "elements" });
    }
}

fn read_element<'d>(
    reading: &Reading<'d>,
    models: &ModelReader<'d>,
    entry: &'d Entry,
    network: &mut Network,
) -> Option<()> {
    let table = reading.table(entry, "element")?;
    let example = "between = [\"head\", \"ground\"]";
    let between = table.require("between", example).and_then(|own| ends(reading, own));
    if let Some(own) = table.take("layers") {
        let layers = read_layers(reading, models, &table, own);
        table.finish();
        let ([from, to], layers) = between.zip(layers)?;
        network.connect_layers(&*entry.key, from, to, layers);
        return Some(());
    }
    let size = |key: &'static str, dimension| {
        let own = table.take(key)?;
        let check = |size| Range::Positive.check(key, size);
        let value = reading.quantities().of(key).read_checked(&own.item, dimension, check)?;
        Some(Size { value, place: own.item.place })
    };
    // The model reader tells what is wrong with the area.
    let sizes = [size(SIZE[0], Dimension::LENGTH), size(SIZE[1], AREA)];
    // The model reader looks at the other keys.
    table.finish_missing();
    let Table { owner, place, .. } = table;
    let model = models.element(&entry.item, owner, place, ELEMENT_KEYS);
    let ([from, to], Read { model, extent, pads }) = between.zip(model)?;
    // What is a pad by itself has been compared with its own size.
    if !pads.is_empty() {
        extent.check(&format!("`{}`", entry.key), sizes, reading.faults);
    }
    let [thickness, area] = sizes.map(|size| size.map(|size| size.value));
    let pad = network.connect(&*entry.key, from, to, model);
    pad.thickness = thickness.or(extent.thickness);
    pad.area = area.or(extent.area);
    pad.pads = pads;
    Some(())
}

fn ends(reading: &Reading<'_>, entry: &Entry) -> Option<[NodeId; 2]> {
    match &entry.item.value {
        Content::List(ends) if ends.len() == 2 => {
            let from = reading.node(&ends[0]);
            let to = reading.node(&ends[1]);
            from.zip(to).map(|(from, to)| [from, to])
        }
        _ => {
            let expected = "a pair of nodes such as [\"head\", \"ground\"]";
            wrong_type(&entry.item, "`between`", expected, reading.faults);
            None
        }
    }
}
