//! Sections whose keys are measures: `"head.hic15" = …`, `head.hic15 = …`, and of what an effect has put beside
//! an element `pad.stop.peak-force = …`, which is a table `stop` within `pad`.

use dashpot_analysis::{Family, measures::MeasureEntry};

use super::{Reading, Targets, measures::measure_of};
use crate::{
    diagnostics::fault::Fault,
    text::{
        document::{Entry, Item},
        source::Place,
    },
};

/// What a section says of measures.
pub(super) struct Said {
    /// What it is called.
    pub(super) noun: &'static str,
    /// An example of it, and what else helps.
    pub(super) example: &'static str,
    /// Whether it is this, and not a table of measures.
    pub(super) is_value: fn(&Item) -> bool,
}

/// What is said of one measure.
pub(super) struct OfMeasure<'d> {
    pub(super) key: String,
    /// Its kind; `None` where that is faulty.
    pub(super) kind: Option<&'static MeasureEntry>,
    pub(super) entry: &'d Entry,
}

/// All that an entry of a section says of measures.
pub(super) fn of_measures<'d>(
    reading: &Reading<'_>,
    targets: &Targets<'_, '_>,
    said: &Said,
    entry: &'d Entry,
) -> Vec<OfMeasure<'d>> {
    let mut found = Vec::new();
    if let Some(measures) = entry.item.table().filter(|_| !(said.is_value)(&entry.item)) {
        of_target(reading, targets, said, (&entry.key, entry.key_place), measures, &mut found);
    } else if let Some((target, word)) = entry.key.rsplit_once('.') {
        let family = targets.family(target, entry.key_place);
        let kind = family.and_then(|family| kind_of(reading, word, Some(family), entry));
        found.push(OfMeasure { key: entry.key.to_string(), kind, entry });
    } else if let Some(family) = targets.family(&entry.key, entry.key_place) {
        without_measure(reading, said, family, entry);
    }
    found
}

fn of_target<'d>(
    reading: &Reading<'_>,
    targets: &Targets<'_, '_>,
    said: &Said,
    (target, place): (&str, Place),
    measures: &'d [Entry],
    found: &mut Vec<OfMeasure<'d>>,
) {
    let family = targets.family(target, place);
    for entry in measures {
        let key = format!("{target}.{}", entry.key);
        match entry.item.table().filter(|_| !(said.is_value)(&entry.item)) {
            Some(inner) if targets.is_made(&key) => {
                of_target(reading, targets, said, (&key, entry.key_place), inner, found);
            }
            _ => {
                let kind = kind_of(reading, &entry.key, family, entry);
                found.push(OfMeasure { key, kind, entry });
            }
        }
    }
}

/// The kind of a measure, with an error where it does not exist. The second one of a kind has `-2` at its end.
fn kind_of(
    reading: &Reading<'_>,
    word: &str,
    family: Option<Family>,
    entry: &Entry,
) -> Option<&'static MeasureEntry> {
    let number = |end: &str| !end.is_empty() && end.bytes().all(|byte| byte.is_ascii_digit());
    let plain = word.rsplit_once('-').filter(|(_, end)| number(end)).map_or(word, |(word, _)| word);
    measure_of(reading, plain, family, entry.key_place)
}

/// Notes what is said of all of an element or a node.
fn without_measure(reading: &Reading<'_>, said: &Said, family: Family, entry: &Entry) {
    let measure = match family {
        Family::Element => "peak-force",
        Family::Node => "peak-acceleration",
    };
    let fault = Fault::WrongType {
        what: format!("the {} of `{}`", said.noun, entry.key),
        expected: "a table of its measures".to_owned(),
        found: entry.item.type_name(),
    };
    let help = format!("name a measure, as in `{}.{measure} = {}", entry.key, said.example);
    reading.faults.error(entry.key_place, fault.with_help(help));
}
