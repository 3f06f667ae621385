//! `dashpot run`.

use std::{fmt::Write as _, sync::Arc, time::Instant};

use dashpot_analysis::{Accuracy, RunReport, SolveSettings, solve_partial};
use dashpot_plot::{
    Table,
    figures::{Figure, ForceTime},
};
use dashpot_scene::Scene;

use crate::{
    answer::{
        Answer, document, energy_table, measures_tables, notes, reasons, solving_table, verdict,
    },
    args::{RunArguments, Switch, When},
    as_run::Changes,
    commands::check::hopeless,
    error::{CliError, Status},
    folder::Folder,
    input::read_scene,
    operand::tell,
    progress::Bar,
    run_folder::{file_names, write},
    series::curves,
    shown::Tone,
    terminal::{Terminal, WIDTH, print, print_data},
    text::{indented, labelled, table},
};

/// Lines of the plot.
const PLOT_HEIGHT: usize = 14;
/// Points of a curve in the plot: many more than dots, so that quick oscillations fill their band.
const PLOT_POINTS: usize = 8001;
/// Columns of the verdict's labels.
const LABELS: usize = 13;

/// Solves a scene by its methods, and reports.
pub(crate) fn run(arguments: &RunArguments, terminal: Terminal) -> Result<Status, CliError> {
    let checked = read_scene(arguments.scene.scene.as_deref(), &arguments.scene.values.set)?;
    terminal.diagnose(&checked.warnings);
    tell(&checked.value.notes);
    let folder = Folder::wanted(arguments.out.as_deref(), file_names())?;
    if let Ok(texts) = hopeless(&checked.value) {
        texts.iter().for_each(|text| terminal.warn(text));
    }
    let answer = solve_all(checked.value, arguments, terminal);
    tell_failures(&answer, terminal);
    let status = answer.failed.iter().map(|(_, error)| error.status()).max();
    if arguments.json || !answer.runs.is_empty() {
        show(&answer, arguments, terminal, folder)?;
    }
    Ok(status.unwrap_or(Status::Done))
}

/// Tells of each error once, with the methods that it is about unless that is all of them.
fn tell_failures(answer: &Answer, terminal: Terminal) {
    let mut told: Vec<String> = Vec::new();
    for (_, error) in &answer.failed {
        let text = error.to_string();
        if told.contains(&text) {
            continue;
        }
        let same = answer.failed.iter().filter(|(_, other)| other.to_string() == text);
        let methods: Vec<&str> = same.map(|(method, _)| method.as_str()).collect();
        let is_all = methods.len() == answer.asked.len();
        let prefix = if is_all { String::new() } else { format!("{}: ", methods.join(", ")) };
        terminal.fail(&prefix, error);
        told.push(text);
    }
}

fn solve_all(scene: Scene, arguments: &RunArguments, terminal: Terminal) -> Answer {
    let mut asked: Vec<SolveSettings> = Vec::new();
    let methods = if arguments.method.is_empty() { &scene.run.methods } else { &arguments.method };
    for method in methods {
        if asked.iter().all(|own| own.method != *method) {
            asked.push(settings(&scene, method, arguments));
        }
    }
    let assembly = Arc::new(scene.assembly.clone());
    let (mut runs, mut failed) = (Vec::<RunReport>::new(), Vec::new());
    let mut elapsed = Vec::new();
    for own in &asked {
        let mut bar = Bar::new(&own.method, own.duration, terminal.error.attended);
        let started = Instant::now();
        match solve_partial(&scene.network, &assembly, own, &mut bar) {
            // `auto` may choose what is asked for by name as well.
            Ok(report) if is_new(&runs, &report) => {
                runs.push(report);
                elapsed.push(started.elapsed());
            }
            Ok(_) => {}
            Err(error) => failed.push((own.method.clone(), CliError::Run(error))),
        }
    }
    Answer { scene, changes: Changes::of(arguments), asked, runs, elapsed, failed }
}

fn is_new(runs: &[RunReport], report: &RunReport) -> bool {
    runs.iter().all(|run| run.solver.method != report.solver.method)
}

fn settings(scene: &Scene, method: &str, arguments: &RunArguments) -> SolveSettings {
    let mut settings = scene.settings(method);
    settings.estimate = arguments.estimate == Switch::On;
    settings.budget = arguments.budget.unwrap_or(settings.budget);
    settings.rtol = arguments.rtol.or(settings.rtol);
    if let Some(accuracy) = arguments.accuracy {
        let neglect_below = settings.accuracy.neglect_below;
        settings.accuracy = Accuracy { neglect_below, ..Accuracy::of_all(accuracy) };
        // A tolerance of the scene would keep the accuracy from being sought.
        settings.rtol = None;
    }
    settings.accuracy.neglect_below = arguments.neglect.or(settings.accuracy.neglect_below);
    settings
}

fn show(
    answer: &Answer,
    arguments: &RunArguments,
    terminal: Terminal,
    folder: Option<Folder>,
) -> Result<(), CliError> {
    let warnings = new_warnings(answer);
    // The report begins with them, so at one place they would be read twice.
    if arguments.json || !terminal.is_one {
        warnings.iter().for_each(|warning| terminal.warn(warning));
    }
    let json = || Ok::<_, CliError>(serde_json::to_string_pretty(&document(answer))? + "\n");
    if arguments.json {
        print_data(&json()?)?;
    } else {
        let plot = match arguments.plot {
            When::Auto => terminal.output.attended,
            When::Always => true,
            When::Never => false,
        };
        print(&report(answer, &warnings, plot, terminal))?;
    }
    match folder.filter(|_| !answer.runs.is_empty()) {
        Some(folder) => folder.write(|files| write(files, answer), &json()?, arguments.json),
        None => Ok(()),
    }
}

/// The warnings but those that the scene's own text has brought already.
fn new_warnings(answer: &Answer) -> Vec<String> {
    let known = &answer.scene.assembly.warnings;
    answer.warnings().into_iter().filter(|warning| !known.contains(warning)).collect()
}

fn report(answer: &Answer, warnings: &[String], plot: bool, terminal: Terminal) -> String {
    let mut text = String::new();
    for warning in warnings {
        for (at, line) in crate::text::wrapped(warning, WIDTH - 2).iter().enumerate() {
            let mark = if at == 0 { "!" } else { " " };
            text += &terminal.toned(Tone::Warning, &format!("{mark} {line}"));
            text.push('\n');
        }
    }
    for line in crate::text::wrapped(answer.title(), WIDTH) {
        text += &terminal.toned(Tone::Heading, &line);
        text.push('\n');
    }
    for line in answer.changes.told().iter().flat_map(|told| crate::text::wrapped(told, WIDTH)) {
        text += &line;
        text.push('\n');
    }
    text.push('\n');
    for line in verdict(answer) {
        text += &labelled(line.label, LABELS, &line.text, WIDTH);
    }
    if let Some(best) = answer.best().filter(|_| plot) {
        let _ = write!(text, "\n{}", plotted(best));
    }
    for table in measures_tables(answer, WIDTH - 2) {
        text += &section(&table, terminal);
    }
    for note in notes(answer) {
        text += &labelled("", 0, &note, WIDTH);
    }
    if let Some(best) = answer.best() {
        text += &section(&energy_table(best), terminal);
    }
    text += &section(&solving_table(answer), terminal);
    for (method, why) in reasons(answer) {
        text += &labelled(&method, 8, &why, WIDTH);
    }
    text
}

fn plotted(run: &RunReport) -> String {
    let chart = ForceTime.chart(&[curves(run, PLOT_POINTS)]);
    indented(&chart.text(WIDTH - 4, PLOT_HEIGHT))
}

fn section(content: &Table, terminal: Terminal) -> String {
    let (header, rows) = table(content);
    let mut text = format!("\n  {}\n", terminal.toned(Tone::Faint, &header));
    for row in rows {
        let _ = writeln!(text, "  {row}");
    }
    text
}
