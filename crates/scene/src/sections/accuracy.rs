//! `[accuracy]`: how accurate the measures are to be, and what may be left out.

use dashpot_analysis::{Accuracy, Family};
use dashpot_network::parameters::{Dimension, InvalidParameter};

use super::{Reading, Targets, measures::measure_of};
use crate::{
    diagnostics::fault::Fault,
    text::{
        document::{Content, Entry},
        source::Place,
    },
};

/// Reads the wishes, relative to the size of each measure.
pub(crate) fn read_accuracy(reading: &Reading<'_>, targets: &Targets<'_, '_>) -> Accuracy {
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
            let mut found = Vec::new();
            read_target(reading, targets, (&entry.key, entry.key_place), measures, &mut found);
            accuracy.by_measure.extend(found);
            continue;
        }
        let Some((target, measure)) = entry.key.rsplit_once('.') else {
            if let Some(family) = targets.family(&entry.key, entry.key_place) {
                without_measure(reading, family, entry);
            }
            continue;
        };
        if let Some(family) = targets.family(target, entry.key_place) {
            check_measure(reading, measure, Some(family), entry);
        }
        let key = entry.key.to_string();
        accuracy.by_measure.extend(wish(reading, entry).map(|wish| (key, wish)));
    }
    accuracy
}

/// Notes a wish for all of an element or a node.
fn without_measure(reading: &Reading<'_>, family: Family, entry: &Entry) {
    let measure = match family {
        Family::Element => "peak-force",
        Family::Node => "peak-acceleration",
    };
    let fault = Fault::WrongType {
        what: format!("the accuracy of `{}`", entry.key),
        expected: "a table of its measures".to_owned(),
        found: entry.item.type_name(),
    };
    let help = format!(
        "name a measure, as in `{}.{measure} = \"1 %\"`; `default = \"1 %\"` is for all of them",
        entry.key
    );
    reading.faults.error(entry.key_place, fault.with_help(help));
}

/// Reads the wishes for the measures of one target, and of what an effect has put beside it:
/// `pad.stop.peak-force` without quotes is a table `stop` within `pad`.
fn read_target(
    reading: &Reading<'_>,
    targets: &Targets<'_, '_>,
    (target, place): (&str, Place),
    measures: &[Entry],
    found: &mut Vec<(String, f64)>,
) {
    let family = targets.family(target, place);
    for measure in measures {
        let key = format!("{target}.{}", measure.key);
        match &measure.item.value {
            Content::Table(inner) if targets.is_made(&key) => {
                read_target(reading, targets, (&key, measure.key_place), inner, found);
            }
            _ => {
                check_measure(reading, &measure.key, family, measure);
                found.extend(wish(reading, measure).map(|wish| (key, wish)));
            }
        }
    }
}

/// Notes a measure that does not exist. The second one of a kind has `-2` at its end.
fn check_measure(reading: &Reading<'_>, word: &str, family: Option<Family>, entry: &Entry) {
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
