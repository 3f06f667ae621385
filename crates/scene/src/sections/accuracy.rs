//! `[accuracy]`: how accurate the measures are to be.

use dashpot_analysis::Accuracy;
use dashpot_network::parameters::{Dimension, InvalidParameter};

use super::{
    Reading, Targets,
    of_measures::{Said, of_measures},
};
use crate::text::document::{Content, Entry, Item};

/// What a section says of measures here.
const SAID: Said = Said {
    noun: "accuracy",
    example: "\"1 %\"`; `default = \"1 %\"` is for all of them",
    is_value: |item: &Item| !matches!(item.value, Content::Table(_)),
};

/// Reads the wishes, relative to the size of each measure.
pub(crate) fn read_accuracy(reading: &Reading<'_>, targets: &Targets<'_, '_>) -> Accuracy {
    let mut accuracy = Accuracy::default();
    for entry in reading.section("accuracy") {
        match entry.key.as_str() {
            "default" => accuracy.default = wish(reading, entry).unwrap_or(accuracy.default),
            "neglect-below" => accuracy.neglect_below = wish(reading, entry),
            _ => {
                let found = of_measures(reading, targets, &SAID, entry).into_iter();
                let wishes = found.filter_map(|own| Some((own.key, wish(reading, own.entry)?)));
                accuracy.by_measure.extend(wishes);
            }
        }
    }
    accuracy
}

fn wish(reading: &Reading<'_>, entry: &Entry) -> Option<f64> {
    reading.quantities().read_checked(&entry.item, Dimension::NUMBER, |wish| {
        let range = "more than 0 and at most 0.2, for instance \"1 %\" or 0.01";
        let invalid = || InvalidParameter::new("accuracy", range, wish);
        if wish > 0.0 && wish <= Accuracy::LOOSEST { Ok(()) } else { Err(invalid()) }
    })
}
