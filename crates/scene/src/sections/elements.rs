//! `[elements]`: models between nodes, and pads of layers with mass.

use dashpot_network::{
    Network, NodeId, Support,
    layers::{Layer, Layers, MOST_SEGMENTS, Resolution},
    parameters::{Dimension, InvalidParameter, Range},
};

use super::Reading;
use crate::{
    diagnostics::fault::Fault,
    models::{LOADING, ModelReader, Read},
    quantities::basis::{AREA, DENSITY, SIZE},
    quantities::sizes::Size,
    text::{
        document::{Content, Entry, Item},
        table::{Table, check_name, list_of, text_of, wrong_type},
    },
};

/// The keys of an element besides its law.
pub(crate) const ELEMENT_KEYS: &[&str] =
    &["between", "shift", "thickness", "area", "pressed-by", LOADING, "layers"];

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
    // What is driven moves without any.
    let is_driven = network.nodes().any(|own| matches!(own.1.support, Support::Prescribed(_)));
    if reading.library.section("elements").is_none() && !is_driven {
        reading.faults.missing(None, Fault::MissingSection { section: "elements" });
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
        let value = reading.quantities().within(Range::Positive, key, &own.item, dimension)?;
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

/// The keys of a layer besides its material.
const LAYER_KEYS: &[&str] = &["shift", "thickness", "area", LOADING, "density"];

/// The relative error of the speed of waves where a pad does not say it.
const ACCURACY: f64 = 0.01;

/// Reads the layers of the element whose table is `element`.
pub(super) fn read_layers<'d>(
    reading: &Reading<'d>,
    models: &ModelReader<'d>,
    element: &Table<'d>,
    entry: &'d Entry,
) -> Option<Layers> {
    let resolution = read_resolution(reading, element);
    let items = list_of(&entry.item, "`layers`", reading.faults)?;
    if items.is_empty() {
        let expected = "a list of one layer or more";
        wrong_type(&entry.item, "`layers`", expected, reading.faults);
        return None;
    }
    // Every layer is read, so that all faults are found.
    let layer = |(at, item)| {
        read_layer(reading, models, format!("layer {} of {}", at + 1, element.owner), item)
    };
    let all: Vec<Option<Layer>> = items.iter().enumerate().map(layer).collect();
    Some(Layers { all: all.into_iter().collect::<Option<_>>()?, resolution: resolution? })
}

fn read_layer<'d>(
    reading: &Reading<'d>,
    models: &ModelReader<'d>,
    owner: String,
    item: &'d Item,
) -> Option<Layer> {
    let table = Table::new(item, owner, item.place, reading.faults)?;
    let quantities = reading.quantities();
    // The model reader looks at the size, too; what is wrong with it is told once.
    let size = |key: &'static str, dimension| {
        let entry = table.take(key)?;
        let check = |size| Range::Positive.check(key, size);
        quantities.unwatched().read_checked(&entry.item, dimension, check)
    };
    let material = table.require("material", "material = \"eva\"");
    let density = table.require("density", "density = \"120 kg/m^3\"");
    let density = density
        .and_then(|own| quantities.within(Range::NonNegative, "density", &own.item, DENSITY));
    let thickness = size("thickness", Dimension::LENGTH);
    let area = size("area", AREA);
    table.take("shift");
    table.take(LOADING);
    table.finish();
    let name = text_of(&material?.item, "`material`", reading.faults)?;
    let name = name.rsplit(':').next().unwrap_or(name).to_owned();
    let Table { owner, place, .. } = table;
    let model = models.element(item, owner, place, LAYER_KEYS)?.model;
    Some(Layer { name, thickness: thickness?, area: area?, density: density?, model })
}

/// How finely the layers are resolved.
fn read_resolution(reading: &Reading<'_>, element: &Table<'_>) -> Option<Resolution> {
    match (element.take("segments"), element.take("accuracy")) {
        (Some(_), Some(accuracy)) => {
            let fault = Fault::Exclusive { first: "segments", second: "accuracy" };
            reading.faults.error(accuracy.key_place, fault);
            None
        }
        (Some(own), None) => read_segments(reading, own).map(Resolution::Segments),
        (None, Some(own)) => {
            let check = |accuracy: f64| {
                let range = "more than 0 and less than 1, for instance \"1 %\"";
                let invalid = || InvalidParameter::new("accuracy", range, accuracy);
                if accuracy > 0.0 && accuracy < 1.0 { Ok(()) } else { Err(invalid()) }
            };
            let accuracy = reading.quantities().read_checked(&own.item, Dimension::NUMBER, check);
            accuracy.map(Resolution::Accuracy)
        }
        (None, None) => Some(Resolution::Accuracy(ACCURACY)),
    }
}

fn read_segments(reading: &Reading<'_>, entry: &Entry) -> Option<usize> {
    let number = match &entry.item.value {
        Content::Number(digits) => digits.parse::<usize>().ok(),
        _ => None,
    };
    let number = number.filter(|number| (1..=MOST_SEGMENTS).contains(number));
    if number.is_none() {
        let expected = format!("a whole number from 1 to {MOST_SEGMENTS}");
        wrong_type(&entry.item, "`segments`", &expected, reading.faults);
    }
    number
}
