//! What `signal` draws, and what it writes into a folder.

use std::path::PathBuf;

use dashpot_network::parameters::Dimension;
use dashpot_plot::{Chart, Marker, Pattern, Series, Stroke};
use dashpot_report::{Page, ReportFigure, Table};
use dashpot_signal::{Analysis, Band, Measure};
use dashpot_units::si_unit;

use super::{
    Group, Signal, Signals,
    words::{self, heading, repeats, table, treatment, unit},
};
use crate::{
    error::CliError,
    folder::Staged,
    output::{PAGE, VERSION, csv, list},
};
use dashpot_report::numbers::{Unit, quantity};

/// All measures of all channels.
const MEASURES: &str = "measures.csv";
/// Milliseconds in a second.
const MS: f64 = 1e3;
/// Colour of the band about the mean.
const BAND: usize = 5;
/// Digits of a peak in a figure.
const DIGITS: usize = 4;

/// What files of results are named by: the names of files without folder and ending, each once.
pub(super) fn stems(files: &[PathBuf]) -> Vec<String> {
    let mut stems: Vec<String> = Vec::new();
    for file in files {
        let name = file.file_stem().map_or("signal".into(), |own| own.to_string_lossy());
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

/// The files that are written besides the result.
pub(super) fn names(signals: &Signals) -> Vec<String> {
    let records = records(signals).into_iter().map(|own| own.0);
    let figures = signals.groups().len();
    let figures = (1..=figures).map(|at| format!("channel-{at}.svg"));
    records.chain(figures).chain([MEASURES.to_owned(), PAGE.to_owned()]).collect()
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

/// Adds all files but the result.
pub(super) fn write(files: &mut Staged<'_>, signals: &Signals) -> Result<(), CliError> {
    for (name, record) in records(signals) {
        let columns: Vec<(String, &[f64])> = record.iter().flat_map(|own| columns(own)).collect();
        let times = record.first().map_or(&[][..], |own| own.analysis.channel.times());
        let header =
            ["time [s]".to_owned()].into_iter().chain(columns.iter().map(|own| own.0.clone()));
        let row = |at: usize| {
            let values = columns.iter().map(move |own| own.1.get(at).copied());
            list([times.get(at).copied()].into_iter().chain(values))
        };
        files.add_with(name, |out| csv(out, header, (0..times.len()).map(row)))?;
    }
    let header =
        ["file", "measure", "value", "error", "unit", "on samples", "bound"].map(str::to_owned);
    files.add_with(MEASURES, |out| csv(out, header, signals.all.iter().flat_map(rows)))?;
    let figures: Vec<ReportFigure> =
        charts(signals).iter().map(ReportFigure::of).collect::<Result<_, _>>()?;
    for (at, own) in figures.iter().enumerate() {
        files.add(format!("channel-{}.svg", at + 1), &own.svg)?;
    }
    files.add(PAGE, page(signals, figures).html())
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

fn rows(own: &Signal) -> Vec<impl serde::Serialize + use<>> {
    let channel = &own.analysis.channel;
    let row = |reading: &dashpot_signal::Reading| {
        let unit = si_unit(reading.measure.dimension(channel.dimension()));
        let key = format!("{}.{}", channel.name(), reading.measure.word());
        let value = reading.value.ok();
        let (bar, bound) = (reading.bar(), reading.truth.word());
        (own.file.clone(), key, value, bar, unit, reading.on_samples, bound)
    };
    list(own.analysis.readings.iter().map(row))
}

/// One figure for each name of a channel, with all its tests.
fn charts(signals: &Signals) -> Vec<Chart> {
    signals.groups().iter().map(chart).collect()
}

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

fn page(signals: &Signals, figures: Vec<ReportFigure>) -> Page {
    let names: Vec<&str> = signals.groups().iter().map(|own| own.name).collect();
    let verdicts = signals.verdicts();
    let verdict = verdicts.iter().map(|own| {
        let (label, text) = words::judged(own);
        format!("{label}: {}: {text}", own.signal.file)
    });
    let of_each =
        signals.all.iter().map(|own| Table { caption: heading(own), ..table(&own.analysis) });
    let groups = signals.groups();
    let of_all = groups.iter().map(repeats);
    let treated = signals.all.iter().map(|own| Table::list(heading(own), treatment(&own.analysis)));
    let version = Table::plain("Settings", [vec!["dashpot".to_owned(), VERSION.to_owned()]]);
    Page {
        title: format!("Measured: {}", names.join(", ")),
        warnings: words::warnings(signals),
        verdict: verdict.collect(),
        tables: of_each.chain(of_all).filter(|own| !own.rows.is_empty()).collect(),
        figures,
        details: treated
            .chain([version, Table::list("Notes", signals.notes.iter().cloned())])
            .filter(|own| !own.rows.is_empty())
            .collect(),
        ..Page::default()
    }
}
