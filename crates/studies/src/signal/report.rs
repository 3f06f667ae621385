//! Channels as tables, figures and in words.

use std::path::Path;

use dashpot_network::parameters::Dimension;
use dashpot_plot::{Chart, Marker, Pattern, Series, Stroke};
use dashpot_report::{
    Block, Line, Place, Report, Table,
    numbers::{Unit, quantity},
};
use dashpot_signal::{Analysis, Band, Measure, Reading};
use dashpot_units::si_unit;

use super::{
    Group, Signal, Signals,
    words::{self, heading, repeats, table, treatment, unit},
};
use crate::{Cell, DataTable, VERSION, list};

/// All measures of all channels.
const MEASURES: &str = "measures.csv";
/// More figures are not plotted in texts.
const MOST_PLOTTED: usize = 2;
/// Milliseconds in a second.
const MS: f64 = 1e3;
/// Colour of the band about the mean.
const BAND: usize = 5;
/// Digits of a peak in a figure.
const DIGITS: usize = 4;

/// What files of results are named by: the names of files without folder and ending, each once.
pub(super) fn stems(files: &[String]) -> Vec<String> {
    let mut stems: Vec<String> = Vec::new();
    for file in files {
        let name =
            Path::new(file).file_stem().map_or("signal".into(), |stem| stem.to_string_lossy());
        let is_plain = |own: char| own.is_alphanumeric() || matches!(own, '-' | '_');
        let stem: String = name.chars().map(|own| if is_plain(own) { own } else { '-' }).collect();
        let is_known = |own: &str| stems.iter().any(|known| known == own);
        let mut numbered = (2..).map(|at| format!("{stem}-{at}"));
        let taken = is_known(&stem) || stem.is_empty();
        let stem = if taken { numbered.find(|own| !is_known(own)).unwrap_or(stem) } else { stem };
        stems.push(stem);
    }
    stems
}

/// The files that are written besides the object and the page.
pub(super) fn files(signals: &Signals) -> Vec<String> {
    let records = records(signals).into_iter().map(|record| record.0);
    let figures = (1..=signals.groups().len()).map(figure);
    records.chain(figures).chain([MEASURES.to_owned()]).collect()
}

fn figure(number: usize) -> String {
    format!("channel-{number}.svg")
}

/// Everything that is said of them.
pub(super) fn report(signals: &Signals) -> Report {
    let groups = signals.groups();
    let names: Vec<&str> = groups.iter().map(|group| group.name).collect();
    let mut report = Report::titled(format!("Measured: {}", names.join(", ")));
    report.warnings = words::warnings(signals);
    report.verdict = list(signals.verdicts().iter().map(|verdict| {
        let (label, text) = words::judged(verdict);
        Line { label: label.to_owned(), text: format!("{}: {text}", verdict.signal.file) }
    }));
    for signal in &signals.all {
        let (heading, table) = (heading(signal), table(&signal.analysis));
        let treated = treatment(&signal.analysis);
        report.block(Place::Terminals, Block::Heading(heading.clone(), String::new()));
        report.block(Place::Terminals, Block::Notes(treated.clone()));
        report.block(Place::Terminals, Block::Numbers(table.clone()));
        report.block(Place::Pages, Block::Table(Table { caption: heading.clone(), ..table }));
        report.details.push(Table::list(heading, treated));
    }
    report.tables(groups.iter().map(repeats));
    for (at, group) in groups.iter().enumerate() {
        if groups.len() <= MOST_PLOTTED {
            report.plot(figure(at + 1), chart(group));
        } else {
            report.figure(figure(at + 1), chart(group));
        }
    }
    report.details.push(Table::plain("Settings", [vec!["dashpot".to_owned(), VERSION.to_owned()]]));
    report.details.push(Table::list("Notes", signals.notes.iter().cloned()));
    report
}

/// The channels of one file that have the same times, with the name of their table.
fn records(signals: &Signals) -> Vec<(String, Vec<&Signal>)> {
    let mut records: Vec<(String, Vec<&Signal>)> = Vec::new();
    let has_same = |one: &Signal, other: &Signal| {
        one.analysis.channel.times() == other.analysis.channel.times()
    };
    for own in &signals.all {
        let of_file = |record: &&mut (String, Vec<&Signal>)| record.1[0].stem == own.stem;
        let mut of_file: Vec<_> = records.iter_mut().filter(of_file).collect();
        let count = of_file.len();
        match of_file.iter_mut().find(|record| has_same(record.1[0], own)) {
            Some(record) => record.1.push(own),
            None if count == 0 => records.push((format!("{}.csv", own.stem), vec![own])),
            None => records.push((format!("{}.times-{}.csv", own.stem, count + 1), vec![own])),
        }
    }
    records
}

/// The channels over time, file by file, and all measures.
pub(super) fn tables(signals: &Signals) -> Vec<DataTable<'_>> {
    let header =
        ["file", "measure", "value", "error", "unit", "on samples", "bound"].map(str::to_owned);
    let rows = Box::new(signals.all.iter().flat_map(rows));
    let measures = DataTable { file: MEASURES.to_owned(), header: header.to_vec(), rows };
    list(records(signals).into_iter().map(over_time).chain([measures]))
}

/// Channels of the same times.
fn over_time((file, record): (String, Vec<&Signal>)) -> DataTable<'_> {
    let times = record.first().map_or(&[][..], |signal| signal.analysis.channel.times());
    let (names, columns): (Vec<String>, Vec<_>) = record.into_iter().flat_map(columns).unzip();
    let header = ["time [s]".to_owned()].into_iter().chain(names).collect();
    let row = move |(at, time): (usize, &f64)| {
        let values = columns.iter().map(|column| column.get(at).copied());
        [Some(*time)].into_iter().chain(values).map(Cell::Number).collect()
    };
    DataTable { file, header, rows: Box::new(times.iter().enumerate().map(row)) }
}

/// What is known of a channel over time, in SI units.
fn columns(own: &Signal) -> Vec<(String, &[f64])> {
    let channel = &own.analysis.channel;
    let name = channel.name();
    let mut all = vec![(format!("{name} [{}]", si_unit(channel.dimension())), channel.values())];
    if let Some(motion) = &own.analysis.motion {
        all.push((format!("{name} velocity [m/s]"), &motion.velocity));
        all.push((format!("{name} velocity error [m/s]"), &motion.velocity_error));
        all.push((format!("{name} displacement [m]"), &motion.displacement));
        all.push((format!("{name} displacement error [m]"), &motion.displacement_error));
    }
    all
}

fn rows(signal: &Signal) -> Vec<Vec<Cell>> {
    let channel = &signal.analysis.channel;
    let row = |reading: &Reading| {
        let unit = si_unit(reading.measure.dimension(channel.dimension()));
        let key = format!("{}.{}", channel.name(), reading.measure.word());
        let bound = reading.truth.word();
        vec![
            Cell::Text(signal.file.clone()),
            Cell::Text(key),
            Cell::Number(reading.value.ok()),
            Cell::Number(reading.bar()),
            Cell::Text(unit),
            Cell::Number(reading.on_samples),
            bound.map_or(Cell::Number(None), |bound| Cell::Text(bound.to_owned())),
        ]
    };
    list(signal.analysis.readings.iter().map(row))
}

/// One figure for each name of a channel, with all its tests.
fn chart(group: &Group<'_>) -> Chart {
    let (name, tests) = (group.name, group.analyses());
    let (dimension, largest) = tests.iter().fold((Dimension::NUMBER, 0.0_f64), |best, own| {
        (own.channel.dimension(), best.1.max(own.channel.largest().1))
    });
    let unit = unit(largest, dimension);
    // Of several tests the lines as recorded would cover all others.
    let is_treated = tests.len() == 1 && tests.iter().any(|own| own.settings.cfc.is_some());
    let shown = shown(&tests);
    let line = |times: &[f64], values: &[f64], start: f64| {
        let points = times.iter().map(|time| time - start).zip(values);
        let points = points.filter(|own| (shown.0..=shown.1).contains(&own.0));
        points.map(|(time, value)| (MS * time, unit.of(*value))).collect::<Vec<_>>()
    };
    let start = |own: &Analysis| origin(own, &tests);
    let mut series = Vec::new();
    for (colour, Signal { stem, analysis: own, .. }) in group.tests.iter().enumerate() {
        let stroke = |pattern| Some(Stroke { colour, pattern });
        if is_treated {
            let points = line(own.raw.times(), own.raw.values(), start(own));
            let name = format!("{stem} as recorded");
            series.push(Series { name, points, stroke: stroke(Pattern::Broad) });
        }
        let points = line(own.channel.times(), own.channel.values(), start(own));
        series.push(Series { name: stem.clone(), points, stroke: stroke(Pattern::Solid) });
    }
    let band = Band::of(&tests);
    let below = band.as_ref().map(|band| Box::new(off_the_mean(group, band, (shown, &unit))));
    if let Some(band) = &band {
        // The mean stands over the tests, and its band under them.
        series.insert(0, deviations(band, band.mean.iter().copied(), (shown, &unit)));
        let points = line(&band.times, &band.mean, 0.0);
        let stroke = Some(Stroke { colour: 0, pattern: Pattern::Measured });
        series.push(Series { name: "mean".to_owned(), points, stroke });
    }
    let markers = tests.iter().filter(|_| tests.len() == 1).filter_map(|own| {
        let peak = own.reading(Measure::Peak)?;
        let (time, at) = (peak.time?, own.channel.largest().0);
        let value = *own.channel.values().get(at)?;
        let label =
            format!("{} at {}", unit.text(peak.value.ok()?, DIGITS), quantity(time, "s", DIGITS));
        Some(Marker { x: MS * time, y: unit.of(value), label })
    });
    let since = if tests.len() > 1 { "time since contact (ms)" } else { "time (ms)" };
    Chart {
        title: name.to_owned(),
        x_label: since.to_owned(),
        y_label: format!("{name} ({})", unit.symbol),
        markers: markers.collect(),
        series,
        below,
        ..Chart::default()
    }
}

/// The standard deviation about a curve, as a band.
fn deviations(
    band: &Band,
    about: impl Iterator<Item = f64>,
    ((from, to), unit): ((f64, f64), &Unit),
) -> Series {
    let each = band.times.iter().zip(about).zip(&band.deviation);
    let each = each.filter(|((time, _), _)| (from..=to).contains(*time));
    let rows = each.map(|((time, about), deviation)| {
        (MS * time, unit.of(about - deviation), unit.of(about + deviation))
    });
    Series::band("± std dev", BAND, rows)
}

/// How far each test is off the mean.
fn off_the_mean(group: &Group<'_>, band: &Band, (shown, unit): ((f64, f64), &Unit)) -> Chart {
    let tests = group.analyses();
    let of_test = |(colour, own): (usize, &&Analysis)| {
        let start = origin(own, &tests);
        let rows = band.times.iter().zip(&band.mean);
        let rows = rows.filter(|row| (shown.0..=shown.1).contains(row.0));
        let value = |time: f64| own.channel.value(time + start);
        let points = rows.map(|(time, mean)| (MS * time, unit.of(value(*time) - mean))).collect();
        let stroke = Some(Stroke { colour, pattern: Pattern::Solid });
        Series { name: String::new(), points, stroke }
    };
    let mut all = deviations(band, band.mean.iter().map(|_| 0.0), (shown, unit));
    all.name.clear();
    let series = [all].into_iter().chain(tests.iter().enumerate().map(of_test)).collect();
    Chart { y_label: format!("off the mean ({})", unit.symbol), series, ..Chart::default() }
}

/// Several tests stand over each other from the beginning of their contacts.
fn origin(own: &Analysis, tests: &[&Analysis]) -> f64 {
    if tests.len() > 1 { own.contact.window.0 } else { 0.0 }
}

/// What a figure shows: the contacts, once their length before and twice behind them; the rest is in the tables.
fn shown(tests: &[&Analysis]) -> (f64, f64) {
    let around = tests.iter().map(|own| {
        let (start, end) = own.contact.window;
        let origin = origin(own, tests);
        (2.0 * start - end - origin, 3.0 * end - 2.0 * start - origin)
    });
    let all = around.reduce(|one, other| (one.0.min(other.0), one.1.max(other.1)));
    all.unwrap_or((f64::NEG_INFINITY, f64::INFINITY))
}
