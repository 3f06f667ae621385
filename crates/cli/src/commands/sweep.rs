//! `dashpot sweep`.

use std::{fmt::Write as _, num::NonZero, thread::available_parallelism};

use dashpot_analysis::sweep::{Column, Grid, Pose, Posed, SweepReport, columns, sweep as solve};
use dashpot_scene::{Diagnostics, Scene, Tunables, Variation, read};

use crate::{
    answer::{
        sweep::{Document, Swept, remarks, summary},
        title,
    },
    args::SweepArguments,
    error::{CliError, Status},
    folder::Folder,
    input::Input,
    progress::Count,
    shown::Tone,
    sweep_folder::{csv, file_names, undrawn, write},
    terminal::{Terminal, WIDTH, print, print_data, remark},
    text::{table, wrapped},
};

/// Solves a scene for many values of its parameters.
pub(crate) fn sweep(arguments: &SweepArguments, terminal: Terminal) -> Result<Status, CliError> {
    let input = Input::of(arguments.scene.scene.as_deref())?;
    let set = &arguments.scene.values.set;
    let checked = read(input.text()?, &input.options(set)).map_err(CliError::Scene)?;
    terminal.diagnose(&checked.warnings);
    let scene = checked.value;
    let tunables = Tunables::of(input.text()?, Some(&input.file)).map_err(CliError::Scene)?;
    let variations: Vec<Variation> =
        arguments.vary.iter().map(|own| Variation::parse(own)).collect::<Result<_, _>>()?;
    let matched = tunables.matched(&variations)?;
    if let Some((name, _)) = set.iter().find(|own| is_varied(&tunables, &matched, &own.0)) {
        return Err(CliError::SetAndVaried { name: name.clone() });
    }
    let grid = Grid::new(variations.iter().map(Variation::len).collect())
        .filter(|grid| grid.len() <= MOST)
        .ok_or(CliError::TooManyPoints { most: MOST })?;
    let posed = |scene: Scene| {
        let method = match (&arguments.method, &scene.run.methods[..]) {
            (Some(wanted), _) => wanted,
            (None, [only]) => only,
            _ => "auto",
        };
        let mut settings = scene.settings(method);
        settings.budget = arguments.budget.unwrap_or(settings.budget);
        settings.accuracy.neglect_below = arguments.neglect.or(settings.accuracy.neglect_below);
        Posed { network: scene.network, settings }
    };
    let keys: Vec<String> = arguments.measure.iter().map(|own| own.trim().to_owned()).collect();
    let (columns, wishes) = columns(&posed(scene.clone()), &keys)?;
    let swept =
        Swept { scene: &scene, tunables: &tunables, variations: &variations, matched: &matched };
    let folder = Folder::wanted(arguments.out.as_deref(), file_names(&swept, &columns))?;
    let pose = |places: &[usize]| {
        let text = text_at(&tunables, &variations, &matched, places);
        let checked = read(&text, &input.options(set)).map_err(|faults| {
            let messages = faults.list.iter().map(dashpot_scene::Diagnostic::message);
            messages.collect::<Vec<_>>().join("; ")
        })?;
        let mut posed = posed(checked.value);
        posed.settings.measures.clone_from(&wishes);
        Ok(posed)
    };
    let mut told = checked.warnings.list;
    let before = told.len();
    // A fault at the ends of a range is shown in the scene's text, with the value under a caret.
    for point in grid.corners().into_iter().take(MOST_CORNERS) {
        let text = text_at(&tunables, &variations, &matched, &grid.places(point));
        let found = read(&text, &input.options(set)).map_err(CliError::Scene)?.warnings;
        let known: Vec<String> = told.iter().map(dashpot_scene::Diagnostic::message).collect();
        told.extend(found.list.into_iter().filter(|own| !known.contains(&own.message())));
    }
    terminal.diagnose(&Diagnostics { list: told.split_off(before), omitted: 0 });
    let report = solved(arguments, &grid, &pose, &columns, terminal)?;
    show(arguments, terminal, (&swept, &report), folder)
}

/// More points are not solved in one sweep.
const MOST: usize = 10_000_000;
/// So many corners of the grid are read before anything is solved.
const MOST_CORNERS: usize = 64;

/// Whether a named value is among the numbers that vary.
fn is_varied(tunables: &Tunables, matched: &[usize], name: &str) -> bool {
    let path = format!("values.{name}");
    matched.iter().any(|&at| tunables.all()[at].path == path)
}

fn text_at(
    tunables: &Tunables,
    variations: &[Variation],
    matched: &[usize],
    places: &[usize],
) -> String {
    let all = matched.iter().zip(variations).zip(places);
    let values: Vec<(usize, String)> =
        all.map(|((at, own), place)| (*at, own.text(*place))).collect();
    tunables.text_with(&values)
}

fn solved(
    arguments: &SweepArguments,
    grid: &Grid,
    pose: &Pose<'_>,
    columns: &[Column],
    terminal: Terminal,
) -> Result<SweepReport, CliError> {
    let all = || available_parallelism().map_or(1, NonZero::get);
    let threads = arguments.threads.map_or_else(all, NonZero::get);
    let mut bar = Count::new("sweep", terminal.error.attended);
    Ok(solve(grid, pose, columns, threads, &mut |done, of| bar.tell(done, of))?)
}

fn show(
    arguments: &SweepArguments,
    terminal: Terminal,
    (swept, report): (&Swept<'_>, &SweepReport),
    folder: Option<Folder>,
) -> Result<Status, CliError> {
    let json = serde_json::to_string_pretty(&Document::of(swept, report))? + "\n";
    if arguments.json {
        print_data(&json)?;
    } else if arguments.out.is_none() {
        print_data(&csv(swept, report))?;
    } else {
        print(&text(swept, report, terminal))?;
    }
    if arguments.json || arguments.out.is_none() {
        remarks(swept, report).iter().for_each(|own| remark(own));
    }
    if let Some(folder) = folder {
        folder.write(|files| write(files, swept, report), &json, arguments.json)?;
        undrawn(swept.variations).into_iter().for_each(remark);
    }
    let failed = report.gaps.iter().filter(|own| own.column.is_none()).count();
    let points = report.values.len() / report.columns.len().max(1);
    Ok(if failed == points { Status::RunFailed } else { Status::Done })
}

fn text(swept: &Swept<'_>, report: &SweepReport, terminal: Terminal) -> String {
    let mut text = String::new();
    for line in wrapped(title(swept.scene), WIDTH) {
        let _ = writeln!(text, "{}", terminal.toned(Tone::Heading, &line));
    }
    for line in swept.in_words().iter().flat_map(|own| wrapped(own, WIDTH - 2)) {
        let _ = writeln!(text, "  {}", terminal.toned(Tone::Faint, &line));
    }
    let (header, rows) = table(&summary(report));
    text.push('\n');
    for line in [header].iter().chain(&rows) {
        let _ = writeln!(text, "  {line}");
    }
    for line in remarks(swept, report).iter().flat_map(|own| wrapped(own, WIDTH - 2)) {
        let _ = writeln!(text, "  {line}");
    }
    text
}
