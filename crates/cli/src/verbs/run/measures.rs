//! All measures, one column for each method; which of them are nothing but rounding.

use std::collections::{HashMap, HashSet};

use dashpot_analysis::{Difference, MeasureReport, RunReport};
use dashpot_network::parameters::{Value, WindowWish};
use dashpot_report::Table;
pub(crate) use dashpot_studies::measure_units::{is_hic, is_index, measure_text, unit_of_kind};

use super::Answer;
use crate::output::{alike, each_once, list};
use dashpot_report::{
    layout as text,
    numbers::{self, MOST_DIGITS, Unit, bound, constant, quantity, share},
};

/// A run and what tells it from others: its method, or its design.
#[derive(Debug, Clone, Copy)]
pub(super) struct Column<'r> {
    pub(super) name: &'r str,
    pub(super) run: &'r RunReport,
}

/// What stands side by side.
#[derive(Debug)]
pub(super) struct Side<'r> {
    pub(super) columns: Vec<Column<'r>>,
    /// How far apart runs of one scene are; `None` where they are designs, which are to differ.
    pub(super) differences: Option<Vec<Difference>>,
    /// Of what the names are values, where that is one number or word of the scene.
    pub(super) by: Option<&'r str>,
}

impl<'r> Side<'r> {
    /// A heading of the first column, with what the names beside it are values of.
    pub(super) fn heading(&self, words: &str) -> String {
        self.by.map_or_else(|| words.to_owned(), |by| format!("{words}, by {by}"))
    }

    fn runs(&self) -> impl Iterator<Item = &'r RunReport> {
        self.columns.iter().map(|column| column.run)
    }
}

/// Runs that stand side by side, and the columns besides names and values.
#[derive(Debug, Clone, Copy)]
struct Block<'r> {
    runs: &'r [Column<'r>],
    errors: bool,
    times: bool,
    /// Whether the differences between all runs stand here.
    apart: bool,
}

/// All measures with their errors, times and differences.
pub(super) fn measures_table(side: &Side<'_>) -> Table {
    build(side, &whole(side))
}

fn whole<'s>(side: &'s Side<'_>) -> Block<'s> {
    let runs = &side.columns;
    if side.differences.is_none() {
        return Block { runs, errors: false, times: false, apart: false };
    }
    let has_errors =
        side.runs().flat_map(|run| &run.measures).any(|measure| measure.error.is_some());
    Block { runs, errors: has_errors, times: true, apart: runs.len() > 1 }
}

/// The same in tables of at most `limit` columns of text: where the methods do not fit side by
/// side, they stand below each other; times are left out to keep the limit.
pub(super) fn measures_tables(side: &Side<'_>, limit: usize) -> Vec<Table> {
    let fits = |block: &Block<'_>| {
        let table = build(side, block);
        (text::width(&table) <= limit).then_some(table)
    };
    let whole = whole(side);
    let without_times = Block { times: false, ..whole };
    if let Some(table) = fits(&whole).or_else(|| fits(&without_times)) {
        return vec![table];
    }
    let mut tables = Vec::new();
    let mut rest = whole.runs;
    while !rest.is_empty() {
        let block = |count: usize| Block {
            runs: &rest[..count],
            apart: whole.apart && count == rest.len(),
            ..without_times
        };
        let found = (1..=rest.len()).rev().find_map(|count| Some((count, fits(&block(count))?)));
        let (count, table) = found.unwrap_or_else(|| {
            let narrow = Block { errors: false, ..block(1) };
            (1, build(side, &narrow))
        });
        tables.push(table);
        rest = &rest[count..];
    }
    tables
}

fn build(side: &Side<'_>, block: &Block<'_>) -> Table {
    let mut header = vec![side.heading("measure")];
    for run in block.runs {
        header.push(run.name.to_owned());
        if block.errors {
            header.push("error".to_owned());
        }
    }
    header.push("unit".to_owned());
    if block.times {
        header.push("at".to_owned());
    }
    if block.apart {
        header.push("difference".to_owned());
    }
    let differences = side.differences.iter().flatten();
    let apart: HashMap<&str, &Difference> =
        differences.map(|difference| (difference.key.as_str(), difference)).collect();
    let [all_runs, shown_runs] = [&side.columns, block.runs]
        .map(|runs| runs.iter().map(|own| own.run.by_key()).collect::<Vec<_>>());
    let kinds = Kinds::of(&side.columns);
    let mut rows = Vec::new();
    for (key, first) in &kinds.measures {
        let all = all_runs.iter().filter_map(|run| run.get(key)).copied();
        let readings: Vec<Option<&MeasureReport>> =
            shown_runs.iter().map(|run| run.get(key).copied()).collect();
        let apart = apart.get(key);
        let largest = || largest(side.runs(), first.unit);
        for (at, unit) in units(all, first, largest).iter().enumerate() {
            let main = at == 0;
            let mut row = vec![if main { kinds.name(first) } else { String::new() }];
            for reading in &readings {
                row.push(reading.map_or("–".to_owned(), |reading| value(reading, unit)));
                if block.errors {
                    let text = |measure_report: &MeasureReport| error(measure_report, unit);
                    row.push(reading.filter(|_| main).map_or(String::new(), text));
                }
            }
            row.push(unit.symbol.clone());
            if block.times {
                let time = first.time.filter(|_| main);
                row.push(time.map_or(String::new(), |time| quantity(time, "s", 4)));
            }
            if block.apart {
                let apart = apart.filter(|_| main).map(|apart| share(apart.relative));
                row.push(apart.unwrap_or_default());
            }
            rows.push(row);
        }
    }
    Table { caption: "Measures".to_owned(), header, rows }
}

/// The measures of an answer, and how many of a kind each target has.
struct Kinds<'r> {
    /// Each key once, with the first measure of it.
    measures: Vec<(&'r str, &'r MeasureReport)>,
    counts: HashMap<(&'static str, &'r str), usize>,
}

impl<'r> Kinds<'r> {
    fn of(columns: &[Column<'r>]) -> Self {
        let (mut measures, mut counts) = (Vec::new(), HashMap::new());
        let mut known: HashSet<&str> = HashSet::new();
        for measure in columns.iter().flat_map(|column| column.run.told()) {
            if known.insert(&measure.key) {
                measures.push((measure.key.as_str(), measure));
                *counts.entry((measure.kind, measure.target.as_str())).or_default() += 1;
            }
        }
        Self { measures, counts }
    }

    /// The key; where the target has several measures of the kind, also what sets them apart.
    fn name(&self, measure: &MeasureReport) -> String {
        match self.counts.get(&(measure.kind, measure.target.as_str())) {
            Some(2..) => told_apart(measure),
            _ => measure.key.clone(),
        }
    }
}

/// The key of a measure with what sets it apart.
fn told_apart(measure: &MeasureReport) -> String {
    let window = measure.window_wish.map(|wish| match wish {
        WindowWish::Impact => "impact".to_owned(),
        WindowWish::Run => "run".to_owned(),
        WindowWish::Times(from, to) => format!("{}–{}", constant(from, "s"), constant(to, "s")),
    });
    let parameters = measure.parameters.iter().filter_map(|(name, value)| match value {
        Value::Number(number) => Some(format!("{name} {number}")),
        Value::Word(word) => Some(format!("{name} {word}")),
        _ => None,
    });
    let marks: Vec<String> = parameters.chain(window).collect();
    if marks.is_empty() {
        return measure.key.clone();
    }
    format!("{} ({})", measure.key, marks.join(", "))
}

/// The units in which a measure is shown, one below the other.
fn units<'r>(
    readings: impl Iterator<Item = &'r MeasureReport>,
    first: &MeasureReport,
    largest: impl FnOnce() -> f64,
) -> Vec<Unit> {
    let most = readings.filter_map(|own| own.value).map(f64::abs).fold(0.0, f64::max);
    match (unit_of_kind(first.kind, first.unit), first.unit) {
        (Some(own), "m/s^2") => vec![own, Unit::plain(first.unit)],
        (Some(own), _) => vec![own],
        (None, si) if most > 0.0 => vec![Unit::suiting(most, si)],
        (None, _) => vec![unit_of_zero(first, largest())],
    }
}

fn value(measure: &MeasureReport, unit: &Unit) -> String {
    match measure.value {
        None if measure.is_undetermined => "not determined".to_owned(),
        None => "–".to_owned(),
        Some(_) if is_zero(measure) => "0".to_owned(),
        Some(value) => unit.number(value, numbers::digits(value, measure.error, MOST_DIGITS)),
    }
}

/// The error relative to the value; that of what is next to nothing in its unit.
fn error(measure: &MeasureReport, unit: &Unit) -> String {
    let Some(absolute) = measure.error.filter(|_| measure.value.is_some()) else {
        return "–".to_owned();
    };
    if is_zero(measure) || measure.is_next_to_nothing() {
        // The unit stands behind it.
        return format!("±{}", unit.number(absolute, 1));
    }
    match measure.relative_error() {
        Some(error) => format!("±{}", bound(error)),
        None => "±0 %".to_owned(),
    }
}

/// What is to be said about single measures, each once.
pub(super) fn notes(answer: &Answer) -> Vec<String> {
    let told = answer.runs.iter().flat_map(RunReport::told);
    let notes = told.filter_map(|measure| Some((measure.note()?, measure.key.as_str())));
    list(
        alike(each_once(notes), |one, other| one.0 == other.0).iter().map(|group| {
            format!("{}: {}", list(group.iter().map(|own| own.1)).join(", "), group[0].0)
        }),
    )
}

/// Errors below this part of a size are rounding.
const ROUNDING: f64 = 1e-12;

/// Whether a measure has a value that cannot be told from zero.
pub(super) fn is_zero(measure: &MeasureReport) -> bool {
    measure.value == Some(0.0)
}

/// The unit of a zero: that of its size, or of the `largest` value that is measured so. A value that is lost in its
/// error has that of the error instead, which may be far below its size.
pub(super) fn unit_of_zero(measure: &MeasureReport, largest: f64) -> Unit {
    let error = measure.error.filter(|error| error.is_finite()).unwrap_or(0.0);
    let own = if error > ROUNDING * measure.size { error } else { measure.size };
    match largest.max(own) {
        0.0 => Unit::plain(measure.unit),
        size => Unit::suiting(size, measure.unit),
    }
}

/// The largest value that is measured in an SI unit in these runs, or the energy that they turn over.
pub(super) fn largest<'r>(runs: impl Iterator<Item = &'r RunReport>, unit: &str) -> f64 {
    let of_run = |run: &RunReport| {
        let alike = run.measures.iter().filter(|own| own.unit == unit);
        let values = alike.filter_map(|own| own.value).map(f64::abs);
        let energy = if unit == "J" { run.energy.turned_over } else { 0.0 };
        values.fold(energy, f64::max)
    };
    runs.map(of_run).fold(0.0, f64::max)
}
