//! `[run]`: how long, by which methods, and when to stop.

use dashpot_analysis::Stop;
use dashpot_dae::{Direction, methods::METHODS};
use dashpot_network::{
    Assembly,
    parameters::{Dimension, InvalidParameter, Range},
};
use dashpot_units::parse_dimension;

use super::Reading;
use crate::{
    diagnostics::fault::Fault,
    quantities::arithmetic::names,
    text::{
        document::{Content, Entry, Item},
        source::Place,
        table::{Table, list_of, one_or_many, text_of, wrong_type},
    },
};

/// So many points of the output grid are written where the scene does not say.
const SAMPLES: usize = 501;

/// The output grid has at most so many points.
const MAX_SAMPLES: usize = 10_000_000;

/// What stands for a length that is to be found.
const AUTO: &str = "auto";

/// The longest run \[s\] that is found, unless more is allowed.
const AT_MOST: f64 = 1.0;

/// How a scene is to be run.
#[derive(Debug, Clone, PartialEq)]
pub struct RunSettings {
    /// Length of the run \[s\], zero or positive.
    pub duration: f64,
    /// The longest that it might have been \[s\], where the length was found.
    pub at_most: Option<f64>,
    /// Points of the output grid, 1 … 10⁷; the solution does not depend on it.
    pub samples: usize,
    /// Whether the scene says how many: they then lie at regular times, else where they resolve short contacts.
    pub samples_given: bool,
    /// Names of the methods, one or more; `auto` chooses.
    pub methods: Vec<String>,
    /// The methods' own relative tolerance, 1e-13 … 1e-1, where it is given.
    pub rtol: Option<f64>,
    /// Conditions that end the run early.
    pub stops: Vec<Stop>,
}

/// A condition whose output has not been looked up yet.
pub(crate) struct StopText {
    /// Name of the output, and where it stands.
    name: String,
    place: Place,
    level: Item,
    direction: Direction,
}

/// Reads the settings and the conditions to stop.
pub(crate) fn read_run(reading: &Reading<'_>) -> (RunSettings, Vec<StopText>) {
    let methods = vec!["auto".to_owned()];
    let mut run = RunSettings {
        duration: 0.0,
        at_most: None,
        samples: SAMPLES,
        samples_given: false,
        methods,
        rtol: None,
        stops: Vec::new(),
    };
    let Some(entry) = reading.library.section("run") else {
        reading.faults.missing(None, Fault::MissingSection { section: "run" });
        return (run, Vec::new());
    };
    let Some(table) = Table::new(&entry.item, "[run]", entry.key_place, reading.faults) else {
        return (run, Vec::new());
    };
    let quantities = reading.quantities();
    let given = table.require("duration", "duration = \"20 ms\"");
    run.at_most = read_at_most(reading, &table, given);
    let duration = given.filter(|_| run.at_most.is_none()).and_then(|own| {
        let check = |time| Range::NonNegative.check("duration", time);
        quantities.of("run.duration").read_checked(&own.item, Dimension::TIME, check)
    });
    let samples = table.take("samples").and_then(|table| samples(reading, table));
    let methods = table.take("methods").and_then(|table| methods_of(reading, table));
    run.rtol = table.take("rtol").and_then(|table| {
        quantities.read_checked(&table.item, Dimension::NUMBER, |rtol| {
            let invalid = || InvalidParameter::new("rtol", "from 1e-13 to 1e-1", rtol);
            if (1e-13..=1e-1).contains(&rtol) { Ok(()) } else { Err(invalid()) }
        })
    });
    let stops = table.take("stop").and_then(|table| list_of(&table.item, "`stop`", reading.faults));
    table.finish();
    let stops = stops.unwrap_or(&[]).iter().filter_map(|item| stop(reading, item)).collect();
    run.duration = duration.unwrap_or(run.duration);
    run.samples_given = samples.is_some();
    run.samples = samples.unwrap_or(run.samples);
    run.methods = methods.unwrap_or(run.methods);
    (run, stops)
}

fn samples(reading: &Reading<'_>, entry: &Entry) -> Option<usize> {
    let Content::Number(digits) = &entry.item.value else {
        wrong_type(&entry.item, "`samples`", "a whole number without quotes", reading.faults);
        return None;
    };
    let count = digits.parse::<usize>().ok().filter(|count| (1..=MAX_SAMPLES).contains(count));
    if count.is_none() {
        let range = "a whole number from 1 to 10 000 000";
        let invalid = InvalidParameter::new("samples", range, digits);
        reading.faults.error(entry.item.place, invalid.into());
    }
    count
}

fn methods_of(reading: &Reading<'_>, entry: &Entry) -> Option<Vec<String>> {
    let known: Vec<&str> = METHODS.iter().map(|own| own.name).collect();
    let items = one_or_many(&entry.item);
    if items.is_empty() {
        let fault = Fault::EmptyList { key: entry.key.to_string() };
        reading.faults.error(entry.item.place, fault);
    }
    let mut methods = Vec::with_capacity(items.len());
    for item in items {
        let Some(word) = text_of(item, "a method", reading.faults) else { continue };
        if !known.contains(&word) {
            let (word, known) = (word.to_owned(), known.clone());
            reading.faults.error(
                item.place,
                Fault::UnknownWord { family: "a method".to_owned(), word, known },
            );
        } else if methods.iter().any(|method| method == word) {
            reading.faults.error(item.place, Fault::DuplicateKey { key: word.to_owned() });
        } else {
            methods.push(word.to_owned());
        }
    }
    (!methods.is_empty()).then_some(methods)
}

fn stop(reading: &Reading<'_>, item: &Item) -> Option<StopText> {
    let table = Table::new(item, "a condition in `stop`", item.place, reading.faults)?;
    let when = table.require("when", "when = \"padding.force\"");
    let falls = table.take("falls-below");
    let rises = table.take("rises-above");
    table.finish();
    if let (Some(_), Some(rises)) = (falls, rises) {
        let fault = Fault::Exclusive { first: "falls-below", second: "rises-above" };
        reading.faults.error(rises.key_place, fault);
    }
    let Some(level) = falls.or(rises) else {
        let fault = Fault::MissingKey {
            key: "falls-below` or `rises-above".to_owned(),
            owner: table.owner.clone(),
            example: "falls-below = \"0 N\"".to_owned(),
        };
        reading.faults.missing(table.place, fault);
        return None;
    };
    // It is read when the unit of the output is known.
    let (text, values) = (level.item.text().unwrap_or_default(), reading.library.values());
    let names = names(text, values).into_iter().chain([text.trim().to_owned()]);
    for known in names.filter_map(|name| values.get(&name)) {
        known.is_used.set(true);
    }
    let direction = if falls.is_some() { Direction::Falling } else { Direction::Rising };
    let when = &when?.item;
    let name = text_of(when, "`when`", reading.faults)?;
    // A known owner with an unknown quantity is told once the outputs are known.
    let owner = name.split('.').next().unwrap_or_default();
    if !reading.elements.contains_key(owner) && !reading.nodes.contains_key(owner) {
        let known = reading.elements.keys().chain(reading.nodes.keys()).copied();
        reading.unknown("element or node", owner, when.place, known);
        return None;
    }
    Some(StopText {
        name: name.to_owned(),
        place: when.place,
        level: level.item.clone(),
        direction,
    })
}

/// Looks up the outputs of the conditions to stop.
pub(crate) fn check_stops(
    reading: &Reading<'_>,
    stops: &[StopText],
    assembly: &Assembly,
) -> Vec<Stop> {
    let found = stops.iter().filter_map(|stop| {
        let name = stop.name.as_str();
        let outputs = &assembly.system.outputs;
        let Some(output) = outputs.iter().find(|output| output.name == name) else {
            let owner = name.split('.').next().unwrap_or_default();
            let names = outputs.iter().map(|output| output.name.to_string());
            let mut family: Vec<String> = names.collect();
            family.retain(|known| known.split('.').next() == Some(owner));
            reading.unknown("output", name, stop.place, family.iter().map(String::as_str));
            return None;
        };
        let dimension = parse_dimension(output.unit).unwrap_or(Dimension::NUMBER);
        let level = reading.quantities().read(&stop.level, dimension)?;
        Some(Stop { output: name.to_owned(), level, direction: stop.direction })
    });
    found.collect()
}

/// The longest run \[s\] that may be found, where `duration` asks for it; it is an error beside a length that is given.
fn read_at_most(reading: &Reading<'_>, table: &Table<'_>, duration: Option<&Entry>) -> Option<f64> {
    let is_auto = duration.is_some_and(|own| own.item.text().map(str::trim) == Some(AUTO));
    let Some(own) = table.take("at-most") else { return is_auto.then_some(AT_MOST) };
    if !is_auto {
        let message = "`at-most` bounds a length that is to be found, and `duration` gives one";
        let help = "write `duration = \"auto\"`, or remove `at-most`";
        reading.faults.error(own.key_place, Fault::odd(message, help));
        return None;
    }
    let check = |time: f64| {
        let invalid = || InvalidParameter::new("at-most", "positive", time);
        if time > 0.0 { Ok(()) } else { Err(invalid()) }
    };
    let quantities = reading.quantities().of("run.at-most");
    quantities.read_checked(&own.item, Dimension::TIME, check)
}
