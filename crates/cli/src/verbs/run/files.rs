//! What `run` draws, and what it writes into a folder; the page.

use std::io::{self, Write};

use clap::ValueEnum;
use dashpot_analysis::{
    EventReport, RunReport, regular_times, resolving_times, table_at, touching,
};
use dashpot_plot::{RunSeries, figures::FIGURES};
use dashpot_report::{Page, ReportFigure, Table};
use dashpot_scene::RunSettings;

use super::{
    Answer, compared, deviations,
    energy::energy_table,
    measures::{measures_table, notes},
    resolved_scene, scatter,
    series::curves_and_energies,
    solving::{reasons, settings_table, solving_table},
    verdict::verdict,
};
use crate::{
    error::CliError,
    folder::Staged,
    input::title,
    out::SceneText,
    output::{csv, list},
    said,
};
use dashpot_studies::sketch::{MOST_DRAWN, sketch};

/// What happened, in order of time.
pub(super) const EVENTS: &str = "events.csv";
/// The scene with what the command line changed.
const SCENE: &str = "scene-as-run.toml";
/// The drawing of the network.
const DRAWING: &str = "network.svg";
pub(super) const PAGE: &str = "report.html";
/// Figures show at least so many points, and at most so many.
const POINTS: (usize, usize) = (4001, 20_001);
/// Rows of a table that are in memory at once.
const CHUNK: usize = 4096;

/// What is written into a folder besides the result.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Written {
    /// All outputs over time as CSV, a file for each method.
    Curves,
    /// What happened, as CSV.
    Events,
    /// The figures as SVG, and the drawing of the network.
    Figures,
    /// Everything on one page.
    Page,
    /// The scene as it was run.
    Scene,
}

impl Written {
    /// Whether it is among what is wished for; nothing stands for all.
    pub(super) fn is_in(self, wished: &[Self]) -> bool {
        wished.is_empty() || wished.contains(&self)
    }
}

/// The files that are written besides the result and the tables of the methods.
pub(super) fn names() -> impl Iterator<Item = String> {
    let figures = FIGURES.iter().map(|figure| format!("{}.svg", figure.name));
    figures.chain([SCENE, DRAWING, EVENTS, PAGE].map(str::to_owned))
}

/// Adds everything that an answer holds but the result.
pub(super) fn write(files: &mut Staged<'_>, answer: &Answer) -> Result<(), CliError> {
    let has = |kind: Written| kind.is_in(&answer.wishes.written);
    if has(Written::Scene) {
        let text = resolved_scene::text(&answer.scene, &answer.changes);
        let (file, set) = (answer.scene.file.as_deref().unwrap_or_default(), &answer.changes.set);
        files.add_scene(SCENE, &SceneText { text: &text, file, set })?;
    }
    if has(Written::Figures) || has(Written::Page) {
        write_figures(files, answer)?;
    }
    if has(Written::Events) {
        let runs = answer.runs.iter().map(|run| (run.solver.method, run));
        files.add_with(EVENTS, |out| write_events("method", runs, out))?;
    }
    for run in answer.runs.iter().filter(|_| has(Written::Curves)) {
        let times = sample_times(run, &answer.scene.run);
        let name = format!("{}.csv", run.solver.method);
        files.add_with(name, |out| write_table(run, &times, out))?;
    }
    Ok(())
}

/// Adds the figures and the page that holds them, as far as they are asked for.
fn write_figures(files: &mut Staged<'_>, answer: &Answer) -> Result<(), CliError> {
    let has = |kind: Written| kind.is_in(&answer.wishes.written);
    let network = &answer.scene.network;
    let is_drawn = network.connections().len() <= MOST_DRAWN;
    let (low, high) = POINTS;
    let count = answer.scene.run.samples.clamp(low, high);
    let series = curves_and_energies(answer.runs.iter(), count);
    let series: Vec<_> = series.into_iter().map(|own| answer.with_measured(own)).collect();
    let mut drawn = None;
    if is_drawn {
        let svg = sketch(network, answer.scene.run.duration).svg();
        if has(Written::Figures) {
            files.add(DRAWING, &svg)?;
        }
        drawn = Some(ReportFigure::of_sketch("The network", svg));
    }
    let figures = add_figures(files, &series, &answer.wishes.written)?;
    if has(Written::Page) {
        files.add(PAGE, Page { network: drawn, figures, ..page(answer) }.html())?;
    }
    Ok(())
}

/// Adds the figures of runs where they are `wished` for; returns them for a page.
pub(super) fn add_figures(
    files: &mut Staged<'_>,
    series: &[RunSeries],
    wished: &[Written],
) -> Result<Vec<ReportFigure>, CliError> {
    let mut figures = Vec::new();
    for figure in FIGURES {
        let chart = figure.chart(series);
        // Of a rigid contact alone there is no force over a deformation.
        if chart.series.is_empty() {
            continue;
        }
        let drawing = ReportFigure::of(&chart)?;
        if Written::Figures.is_in(wished) {
            files.add(format!("{}.svg", figure.name), &drawing.svg)?;
        }
        figures.push(drawing);
    }
    Ok(figures)
}

/// Regular times where the scene says how many, else times closer to each other in short contacts.
pub(super) fn sample_times(run: &RunReport, settings: &RunSettings) -> Vec<f64> {
    let (end, count) = (run.trajectory.t_end, settings.samples);
    if settings.samples_given {
        return regular_times(end, count);
    }
    resolving_times((0.0, end), &touching(&run.solution()), count)
}

/// Writes all outputs at these times \[s\] as CSV.
pub(super) fn write_table(run: &RunReport, times: &[f64], out: &mut dyn Write) -> io::Result<()> {
    let at = |times: &[f64]| table_at(&run.assembly, &run.trajectory, times.to_vec());
    let columns = at(&[]).columns.into_iter();
    let header = columns.map(|column| format!("{} [{}]", column.name, column.unit));
    let rows = times.chunks(CHUNK).flat_map(|chunk| {
        let table = at(chunk);
        let row = |(row, time): (usize, &f64)| {
            let values = table.columns.iter().map(|column| column.values[row]);
            // A zero has no sign.
            list([*time].into_iter().chain(values).map(|own| own + 0.0))
        };
        list(table.times.iter().enumerate().map(row))
    });
    csv(out, ["time [s]".to_owned()].into_iter().chain(header), rows)
}

/// Writes all events of runs as CSV, each behind what tells its run from others.
pub(super) fn write_events<'r>(
    which: &str,
    runs: impl Iterator<Item = (&'r str, &'r RunReport)>,
    out: &mut dyn Write,
) -> io::Result<()> {
    let header = [which, "time [s]", "error [s]", "event", "what"].map(str::to_owned);
    let rows = runs.flat_map(|(name, run)| {
        let row = move |own: &EventReport| {
            let error = own.error.filter(|error| error.is_finite());
            (name, own.time, error, own.what.code(), own.what.to_string())
        };
        run.events.iter().map(row)
    });
    csv(out, header, rows)
}

/// The page without its drawings.
fn page(answer: &Answer) -> Page {
    let mut tables = vec![measures_table(&answer.side())];
    tables.extend(answer.best().and_then(scatter::table));
    let by_curve = answer.by_curve();
    tables.extend(
        by_curve.iter().flat_map(|own| [deviations::table(own), compared::table(own)]).flatten(),
    );
    let remarks = said::notes(&answer.scene).into_iter().chain(notes(answer));
    let remarks = list(remarks.chain(by_curve.iter().flat_map(|own| deviations::remarks(own))));
    tables.extend(Some(Table::list("Remarks", remarks)).filter(|own| !own.rows.is_empty()));
    tables.extend(answer.best().map(energy_table));
    let why = reasons(answer).into_iter().map(|(method, why)| vec![method, why]);
    let failed = answer.failed.iter().map(|(method, error)| format!("{method} failed: {error}"));
    let details =
        vec![solving_table(answer), Table::plain("Why these methods", why), settings_table(answer)];
    let changes = answer.changes.description().into_iter();
    let verdict = verdict(answer).into_iter();
    let lines = verdict.map(|line| format!("{}: {}", line.label, line.text));
    let warnings = answer.warnings();
    Page {
        title: title(&answer.scene).to_owned(),
        warnings: failed.chain(said::warnings(&answer.scene, &warnings)).chain(warnings).collect(),
        verdict: changes.chain(lines).collect(),
        tables,
        details,
        scene_text: resolved_scene::text(&answer.scene, &answer.changes),
        ..Page::default()
    }
}

#[cfg(test)]
mod tests {
    use dashpot_analysis::Solve;
    use dashpot_scene::{ReadOptions, read};

    use super::*;

    #[test]
    fn samples_resolve_a_short_contact_unless_the_scene_says_how_many() {
        let text = "[nodes]\nhead = { mass = \"4 kg\", drop = \"1 m\" }\n[elements]\n\
        pad = { between = [\"head\", \"ground\"], spring = \"1 MN/m\" }\n[effects]\n\
        separation.pad = {}\ngravity = { value = \"9.81 m/s^2\" }\n[run]\n";
        let times = |run: &str| {
            let scene = read(&format!("{text}{run}"), &ReadOptions::default()).unwrap().value;
            let report = scene.network.solve_with(&scene.settings("exact").unwrap()).unwrap();
            sample_times(&report, &scene.run)
        };
        let met = (2.0_f64 / 9.81).sqrt();
        let left = met + std::f64::consts::PI * (4.0_f64 / 1e6).sqrt();
        let within = |times: &[f64]| times.iter().filter(|t| (met..left).contains(*t)).count();
        let free = times("duration = \"600 ms\"\n");
        assert_eq!((free.len(), free[0], free[500]), (501, 0.0, 0.6));
        assert!(within(&free) > 200, "{}", within(&free));
        let given = times("duration = \"600 ms\"\nsamples = 501\n");
        assert_eq!(given, regular_times(0.6, 501));
    }
}
