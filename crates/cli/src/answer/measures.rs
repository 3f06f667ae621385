//! All measures, one column for each method.

use dashpot_analysis::{MeasureReport, measures::STANDARD_GRAVITY};
use dashpot_plot::Table;

use super::{Answer, verdict::is_index};
use crate::{
    numbers::{self, MOST_DIGITS, Unit, bound, quantity, share},
    text,
};

/// Decimals of what cannot be told from zero.
const ZERO_DECIMALS: usize = 3;

/// The columns besides names and values.
#[derive(Debug, Clone, Copy)]
struct Columns {
    errors: bool,
    times: bool,
}

/// All measures with their errors, times and differences; with a limit in columns of text, what
/// matters less is left out to keep it.
pub(crate) fn measures_table(answer: &Answer, limit: Option<usize>) -> Table {
    let choices = [(true, true), (true, false), (false, false)];
    let mut tables =
        choices.map(|(errors, times)| build(answer, Columns { errors, times })).into_iter();
    let full = tables.next().unwrap_or_default();
    let Some(limit) = limit.filter(|&limit| text::width(&full) > limit) else { return full };
    let mut last = full;
    for table in tables {
        let fits = text::width(&table) <= limit;
        last = table;
        if fits {
            break;
        }
    }
    last
}

fn build(answer: &Answer, columns: Columns) -> Table {
    let mut header = vec!["measure".to_owned()];
    for run in &answer.runs {
        header.push(run.solver.method.to_owned());
        if columns.errors {
            header.push("error".to_owned());
        }
    }
    header.push("unit".to_owned());
    let several = answer.runs.len() > 1;
    if columns.times {
        header.push("at".to_owned());
    }
    if several {
        header.push("apart".to_owned());
    }
    let differences = answer.differences();
    let mut keys: Vec<&str> = Vec::new();
    for measure in answer.runs.iter().flat_map(|run| &run.measures) {
        if !keys.contains(&measure.key.as_str()) {
            keys.push(&measure.key);
        }
    }
    let mut rows = Vec::new();
    for key in keys {
        let readings: Vec<Option<&MeasureReport>> =
            answer.runs.iter().map(|run| run.measure(key)).collect();
        let Some(first) = readings.iter().flatten().next() else { continue };
        let apart = differences.iter().find(|difference| difference.key == key);
        let units = units(&readings, first);
        for (at, unit) in units.iter().enumerate() {
            let main = at == 0;
            let mut row = vec![if main { key.to_owned() } else { String::new() }];
            for reading in &readings {
                row.push(reading.map_or("–".to_owned(), |reading| value(reading, unit)));
                if columns.errors {
                    row.push(reading.filter(|_| main).map_or(String::new(), error));
                }
            }
            row.push(unit.symbol.clone());
            if columns.times {
                let time = first.time.filter(|_| main);
                row.push(time.map_or(String::new(), |time| quantity(time, "s", 4)));
            }
            if several {
                let apart = apart.filter(|_| main).map(|apart| share(apart.relative));
                row.push(apart.unwrap_or_default());
            }
            rows.push(row);
        }
    }
    Table { caption: "Measures".to_owned(), header, rows }
}

/// The units in which a measure is shown, one below the other.
fn units(readings: &[Option<&MeasureReport>], first: &MeasureReport) -> Vec<Unit> {
    let values = readings.iter().flatten().filter_map(|reading| Some((reading.value?, *reading)));
    // What cannot be told from zero is shown in the unit of its error.
    let size = |(value, reading): (f64, &MeasureReport)| {
        value.abs().max(reading.error.filter(|error| error.is_finite()).unwrap_or(0.0))
    };
    let largest = values.map(size).fold(0.0, f64::max);
    match first.unit {
        "m/s^2" => vec![Unit::new("g", STANDARD_GRAVITY), Unit::plain(first.unit)],
        "s" if is_index(first.kind) => vec![Unit::plain("s")],
        si => vec![Unit::suiting(largest, si)],
    }
}

fn value(measure: &MeasureReport, unit: &Unit) -> String {
    let Some(value) = measure.value else { return "–".to_owned() };
    match measure.error {
        Some(error) if error >= value.abs() => {
            unit.decimal(value, unit.decimals(error, ZERO_DECIMALS))
        }
        error => unit.number(value, numbers::digits(value, error, MOST_DIGITS)),
    }
}

fn error(measure: &MeasureReport) -> String {
    match measure.relative_error() {
        Some(error) => format!("±{}", bound(error)),
        None if measure.error.is_some() && measure.value.is_some() => "±0 %".to_owned(),
        None => "–".to_owned(),
    }
}

/// What is to be said about single measures, each once.
pub(crate) fn notes(answer: &Answer) -> Vec<String> {
    let mut notes: Vec<(String, Vec<&str>)> = Vec::new();
    for measure in answer.runs.iter().flat_map(|run| &run.measures) {
        let Some(note) = &measure.note else { continue };
        match notes.iter_mut().find(|(known, _)| known == note) {
            Some((_, keys)) if keys.contains(&measure.key.as_str()) => {}
            Some((_, keys)) => keys.push(&measure.key),
            None => notes.push((note.clone(), vec![&measure.key])),
        }
    }
    notes.into_iter().map(|(note, keys)| format!("{}: {note}", keys.join(", "))).collect()
}
