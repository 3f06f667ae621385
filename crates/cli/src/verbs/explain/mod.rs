//! `dashpot explain`.

mod built;
mod effects;

use std::path::{Path, PathBuf};

use clap::Args;
use dashpot_analysis::{choice, contribution::SystemSize, reported_measures};
use dashpot_report::Table;
use dashpot_scene::{Scene, outline};

use crate::{
    args::SceneArguments,
    error::{CliError, Status},
    input::title,
    operand::{read_models_of, read_scene_of},
    output::Text,
    part::write_drawing,
    terminal::{Terminal, WIDTH, print},
};
use dashpot_report::{
    layout::{fitted, indented},
    numbers::constant,
};
use dashpot_studies::{
    non_identifiable::notes,
    sketch::{MOST_DRAWN, sketch},
};

/// What stands below the unknowns.
const UNKNOWNS: &str = "Each number is what the solver calls 1, so that its unknowns are near 1.";
/// What the default output leaves out.
const MORE: &str = "`--verbose` adds the modes, guards and matrix entries that each effect brings, and the \
                    unknowns by name.";
/// More rows of one table are only counted.
const MOST: usize = 20;

/// `explain`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot explain                                  the built-in reference impact\n  \
    dashpot explain pad.toml --out pad.svg           the drawing as a file, too\n  \
    dashpot explain pad.toml --verbose               unknowns, modes and guards")]
pub(crate) struct ExplainArguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// Shows what the solver sees besides: modes, guards, entries of matrices, names of unknowns.
    #[arg(long)]
    verbose: bool,
    /// Where the drawing goes as SVG: a file, or a folder for `network.svg`.
    #[arg(long, value_name = "FILE|DIR")]
    out: Option<PathBuf>,
}

/// Shows what a scene says, and what is built from it.
pub(crate) fn explain(
    arguments: &ExplainArguments,
    terminal: Terminal,
) -> Result<Status, CliError> {
    let SceneArguments { scene: path, values } = &arguments.scene;
    let input = crate::input::of(path.as_deref())?;
    if let Some(models) = read_models_of(&input, &values.set, terminal)? {
        if arguments.out.is_some() {
            return Err(CliError::setting("--out", "a file of models has no network to draw"));
        }
        let rows = written(input.text()?, &values.set);
        print(&Text::written(terminal, |text| {
            text.title(&input.file);
            section(text, &rows);
            text.blank();
            text.paragraphs([&models]);
        }))?;
        return Ok(Status::Done);
    }
    let scene = read_scene_of(&input, &values.set, terminal)?;
    let is_verbose = arguments.verbose;
    let (solving, effects) = (solving(&scene, is_verbose)?, effects::contributed(&scene)?);
    let mut text = Text::written(terminal, |text| {
        text.title(title(&scene));
        section(text, &written(&scene.text, &arguments.scene.values.set));
        text.heading("What it becomes");
        text.lines(&indented(&drawing(&scene)));
        for content in built::tables(&scene) {
            section(text, &content);
        }
        let notes_of_models = notes(&scene);
        if !notes_of_models.is_empty() {
            text.heading("Notes");
            text.paragraphs(notes_of_models);
        }
        effects::section(text, &effects, is_verbose);
        text.heading("Solving");
        solving.iter().for_each(|(label, words)| text.labelled(label, 10, words));
        if is_verbose {
            let unknowns = built::unknowns(&scene);
            section(text, &unknowns);
            if !unknowns.rows.is_empty() {
                text.blank();
                text.paragraphs([UNKNOWNS]);
            }
        } else {
            text.blank();
            text.faint(MORE);
        }
    });
    if let Some(path) = &arguments.out {
        let file = svg_path(path);
        write_drawing(&file, &sketch(&scene.network, scene.run.duration).svg())?;
        text.push_str("\nwrote ");
        text.push_str(&file.display().to_string());
        text.push('\n');
    }
    print(&text)?;
    Ok(Status::Done)
}

/// The file for the drawing: a folder gets `network.svg`.
fn svg_path(path: &Path) -> PathBuf {
    if path.is_dir() { path.join("network.svg") } else { path.to_owned() }
}

fn drawing(scene: &Scene) -> String {
    match scene.network.connections().len() {
        count if count > MOST_DRAWN => format!("{count} elements, too many to be drawn here\n"),
        _ => sketch(&scene.network, scene.run.duration).text(WIDTH - 4),
    }
}

/// The text of the scene, in its order and its units; a section is named in its first row.
fn written(scene: &str, set: &[(String, String)]) -> Table {
    let mut rows: Vec<Vec<String>> = Vec::new();
    let (mut last, mut count) = (String::new(), 0);
    let close = |rows: &mut Vec<Vec<String>>, count: usize| {
        if count > MOST {
            rows.push(vec![String::new(), format!("and {} more", count - MOST)]);
        }
    };
    for row in outline(scene, set) {
        let is_first = row.section != last;
        if is_first {
            close(&mut rows, count);
            count = 0;
        }
        count += 1;
        if count <= MOST {
            let section = if is_first { row.section.clone() } else { String::new() };
            rows.push(vec![section, row.name, row.words]);
        }
        last = row.section;
    }
    close(&mut rows, count);
    Table::plain("As it is written", rows)
}

fn solving(scene: &Scene, is_verbose: bool) -> Result<Vec<(&'static str, String)>, CliError> {
    let system = &scene.assembly.system;
    let (method, why) = choice(&scene.assembly, scene.run.duration);
    let first = scene.run.methods.first().map_or("auto", String::as_str);
    let measures = reported_measures(&scene.assembly, &scene.settings(first)?)?;
    let found = if scene.run.at_most.is_some() { ", found" } else { "" };
    let algebraic = match system.algebraic() {
        0 => "no algebraic unknown is left".to_owned(),
        1 => "1 algebraic unknown stays".to_owned(),
        count => format!("{count} algebraic unknowns stay"),
    };
    let switches = if scene.assembly.switching.is_some() { " at first, it switches" } else { "" };
    let mut rows = vec![
        ("system", format!("{} states{switches}; {algebraic}", system.states())),
        ("duration", constant(scene.run.duration, "s") + found),
        ("methods", scene.run.methods.join(", ")),
        ("auto", format!("would choose `{method}`: {why}")),
        ("measures", measures.join(", ")),
    ];
    if is_verbose {
        let size = SystemSize::of(&scene.assembly);
        let words = format!(
            "{} modes; at the start {} entries of matrices and {} guards",
            size.modes, size.entries, size.guards
        );
        rows.insert(1, ("size", words));
    }
    Ok(rows)
}

/// Adds a table without a header, its first rows.
fn section(text: &mut Text, content: &Table) {
    if content.rows.is_empty() {
        return;
    }
    text.heading(&content.caption);
    for line in fitted(content, WIDTH - 2).1 {
        text.line(&format!("  {}", line.replace('\u{a0}', " ")));
    }
}

/// Rows of a table of which so many are shown, and the rest is counted.
fn first_rows(mut rows: Vec<Vec<String>>) -> Vec<Vec<String>> {
    let count = rows.len();
    if count > MOST {
        rows.truncate(MOST);
        rows.push(vec![format!("and {} more", count - MOST)]);
    }
    rows
}
