//! `dashpot cost`.

use std::{fmt::Write as _, sync::Arc};

use dashpot_analysis::cost::{CostReport, Ladder, cost_assembly};
use dashpot_plot::Table;
use dashpot_scene::Scene;

use crate::{
    answer::{
        cost::{accuracies, answer, cheapest, document, errors, failures, slips, truth, work},
        title,
    },
    args::CostArguments,
    cost_folder::{file_names, write},
    error::{CliError, Status},
    folder::Folder,
    input::read_scene,
    operand::tell,
    progress::Bar,
    shown::Tone,
    terminal::{Terminal, WIDTH, print, print_data},
    text::{side_by_side, table, wrapped},
};

/// Finds out what accuracy costs in a scene.
pub(crate) fn cost(arguments: &CostArguments, terminal: Terminal) -> Result<Status, CliError> {
    let checked = read_scene(arguments.scene.scene.as_deref(), &arguments.scene.values.set)?;
    terminal.diagnose(&checked.warnings);
    tell(&checked.value.notes);
    let scene = checked.value;
    let folder = Folder::wanted(arguments.out.as_deref(), file_names())?;
    let assembly = Arc::new(scene.assembly.clone());
    let mut settings = scene.settings("auto");
    settings.budget = arguments.budget.unwrap_or(settings.budget);
    let mut bar = Bar::new("cost", settings.duration, terminal.error.attended);
    let report = cost_assembly(&assembly, &settings, &ladder(&scene, arguments), &mut bar)?;
    drop(bar);
    let accuracies = accuracies(scene.accuracy.default);
    let json = serde_json::to_string_pretty(&document(&scene, &report, &accuracies))? + "\n";
    if arguments.json {
        print_data(&json)?;
    } else {
        print(&text(&scene, &report, &accuracies, terminal))?;
    }
    if let Some(folder) = folder {
        folder.write(|files| write(files, &scene, &report, &accuracies), &json, arguments.json)?;
    }
    Ok(if report.points.is_empty() { Status::RunFailed } else { Status::Done })
}

/// What is tried: by default everything, judged by the measures that the scene wants an accuracy of.
fn ladder(scene: &Scene, arguments: &CostArguments) -> Ladder {
    let measures = if arguments.measure.is_empty() {
        scene.accuracy.by_measure.keys().cloned().collect()
    } else {
        arguments.measure.iter().map(|own| own.trim().to_owned()).collect()
    };
    Ladder {
        methods: arguments.method.clone(),
        measures,
        repeats: arguments.repeat.map(usize::from),
        ..Ladder::default()
    }
}

fn text(scene: &Scene, report: &CostReport, accuracies: &[f64], terminal: Terminal) -> String {
    let mut text = String::new();
    for line in wrapped(title(scene), WIDTH) {
        let _ = writeln!(text, "{}", terminal.toned(Tone::Heading, &line));
    }
    say(&mut text, &truth(report));
    show(&mut text, &errors(report), terminal);
    show(&mut text, &work(report), terminal);
    show(&mut text, &cheapest(report, accuracies), terminal);
    for (heading, lines) in
        [("Failed", failures(report)), ("Further off than it is said", slips(report))]
    {
        if !lines.is_empty() {
            let _ = writeln!(text, "\n{}", terminal.toned(Tone::Heading, heading));
            say(&mut text, &lines);
        }
    }
    text.push('\n');
    for line in wrapped(&answer(report, accuracies), WIDTH) {
        let _ = writeln!(text, "{line}");
    }
    text
}

/// Adds a table, if it has any rows, in parts where it is too wide.
fn show(text: &mut String, content: &Table, terminal: Terminal) {
    if content.rows.is_empty() {
        return;
    }
    let _ = writeln!(text, "\n{}", terminal.toned(Tone::Heading, &content.caption));
    for part in side_by_side(content, WIDTH - 2) {
        let (header, rows) = table(&part);
        for line in [header].iter().chain(&rows) {
            let _ = writeln!(text, "  {line}");
        }
    }
}

/// Adds sentences, each on lines of its own.
fn say(text: &mut String, lines: &[String]) {
    for line in lines {
        for (at, part) in wrapped(line, WIDTH - 4).into_iter().enumerate() {
            let _ = writeln!(text, "{}{part}", if at == 0 { "  " } else { "    " });
        }
    }
}
