//! `[accuracy]`: how accurate the measures are to be, and what may be left out.

use dashpot_analysis::Accuracy;
use dashpot_network::parameters::{Dimension, InvalidParameter};

use super::{
    Reading,
    measures::{family_of, measure_of},
};
use crate::document::{Content, Entry};

/// Reads the wishes, relative to the size of each measure.
pub(crate) fn read_accuracy(reading: &Reading<'_>) -> Accuracy {
    let mut accuracy = Accuracy::default();
    for entry in reading.section("accuracy") {
        if entry.key == "default" {
            accuracy.default = wish(reading, entry).unwrap_or(accuracy.default);
            continue;
        }
        if entry.key == "neglect-below" {
            accuracy.neglect_below = wish(reading, entry);
            continue;
        }
        if let Content::Table(measures) = &entry.item.value {
            let family = family_of(reading, &entry.key, entry.key_place);
            for own in measures {
                check_measure(reading, &own.key, family, own);
                let key = format!("{}.{}", entry.key, own.key);
                accuracy.by_measure.extend(wish(reading, own).map(|wish| (key, wish)));
            }
            continue;
        }
        let (target, measure) = entry.key.rsplit_once('.').unwrap_or((&entry.key, ""));
        if let Some(family) = family_of(reading, target, entry.key_place) {
            check_measure(reading, measure, Some(family), entry);
        }
        let key = entry.key.clone();
        accuracy.by_measure.extend(wish(reading, entry).map(|wish| (key, wish)));
    }
    accuracy
}

/// Notes a measure that does not exist. The second one of a kind has `-2` at its end.
fn check_measure(
    reading: &Reading<'_>,
    word: &str,
    family: Option<dashpot_analysis::Family>,
    entry: &Entry,
) {
    let number = |end: &str| !end.is_empty() && end.bytes().all(|byte| byte.is_ascii_digit());
    let plain = word.rsplit_once('-').filter(|(_, end)| number(end)).map_or(word, |(word, _)| word);
    measure_of(reading, plain, family, entry.key_place);
}

fn wish(reading: &Reading<'_>, entry: &Entry) -> Option<f64> {
    reading.quantities().read_checked(&entry.item, Dimension::NUMBER, |wish| {
        let range = "more than 0 and at most 0.2, for instance \"1 %\" or 0.01";
        let invalid = || InvalidParameter::new("accuracy", range, wish);
        if wish > 0.0 && wish <= Accuracy::LOOSEST { Ok(()) } else { Err(invalid()) }
    })
}
