//! `dashpot explain`.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use clap::Args;
use dashpot_analysis::{
    RunError, choice,
    contribution::{Contribution, Contributor, EffectState, SystemSize, contributions},
    reported_measures,
};
use dashpot_dae::{Silent, UnknownKind};
use dashpot_network::{
    Detail, Node, NodeId, Situation, Start, Support, elements::Law, segments::resolved,
};
use dashpot_plot::Table;
use dashpot_scene::{Scene, units::si_unit, write_effect};

use crate::{
    args::SceneArguments,
    error::{CliError, Status},
    input::title,
    non_identifiable::notes,
    numbers::{constant, estimate, estimated, quantity},
    output::Text,
    part::write_drawing,
    sketch::{MOST_DRAWN, element, sketch, waveform},
    terminal::{Terminal, WIDTH, print},
    text::{fitted, indented},
};

/// What stands below the unknowns.
const UNKNOWNS: &str =
    "\n  Each number is what the solver calls 1, so that its unknowns are near 1.\n";
/// More rows of one table are only counted.
const MOST: usize = 20;

/// `explain`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot explain                                  the built-in reference impact\n  \
    dashpot explain pad.toml --out pad.svg           the drawing as a file, too")]
pub(crate) struct ExplainArguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// Where the drawing goes as SVG: a file, or a folder for `network.svg`.
    #[arg(long, value_name = "FILE|DIR")]
    out: Option<PathBuf>,
}

/// Shows what was built from a scene.
pub(crate) fn explain(
    arguments: &ExplainArguments,
    terminal: Terminal,
) -> Result<Status, CliError> {
    let scene = arguments.scene.read(terminal)?;
    let count = scene.network.connections().len();
    let drawing = || sketch(&scene.network, scene.run.duration);
    let drawn = if count > MOST_DRAWN {
        format!("{count} elements, too many to be drawn here\n")
    } else {
        drawing().text(WIDTH - 4)
    };
    let (solving, effects) = (solving(&scene)?, effects(&scene)?);
    let mut text = Text::written(terminal, |text| {
        text.title(title(&scene));
        text.blank();
        text.lines(&indented(&drawn));
        for content in [nodes, elements, layers, parts, loads, scattered].map(|of| of(&scene)) {
            section(text, &content);
        }
        let notes_of_models = notes(&scene);
        if !notes_of_models.is_empty() {
            text.heading("Notes");
            text.paragraphs(notes_of_models);
        }
        effects_section(text, &effects);
        text.heading("Solving");
        solving.iter().for_each(|(label, words)| text.labelled(label, 10, words));
        let unknowns = unknowns(&scene);
        section(text, &unknowns);
        if !unknowns.rows.is_empty() {
            text.lines(UNKNOWNS);
        }
    });
    if let Some(path) = &arguments.out {
        let file = svg_path(path);
        write_drawing(&file, &drawing().svg())?;
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

fn rows(caption: &str, rows: Vec<Vec<String>>) -> Table {
    Table::new(caption, &[], rows)
}

fn nodes(scene: &Scene) -> Table {
    let described = |id: NodeId, node: &Node| {
        let kind = match &node.support {
            Support::Fixed => "fixed".to_owned(),
            Support::Prescribed(motion) => {
                format!("motion given, {}", waveform(motion, "m", scene.run.duration))
            }
            Support::Free if node.mass > 0.0 => constant(node.mass, "kg"),
            Support::Free => "massless".to_owned(),
        };
        let start = match node.start {
            Start::Rest => String::new(),
            Start::Velocity(own) => format!("impactor, starts at {}", constant(own, "m/s")),
            Start::Drop(own) => {
                let dropped = format!("impactor, dropped from {}", constant(own, "m"));
                let outputs = &scene.assembly.nodes[id.index()];
                if outputs.fall > 0.0 {
                    format!("{dropped}: falls for {}", constant(outputs.fall, "s"))
                } else {
                    let speed = constant(outputs.start_velocity.unwrap_or(0.0), "m/s");
                    format!("{dropped}: begins at touch with {speed}")
                }
            }
        };
        let place = match node.position {
            0.0 => String::new(),
            own => format!("begins at {}", constant(own, "m")),
        };
        vec![
            node.name.clone(),
            kind,
            [start, place].into_iter().filter(|own| !own.is_empty()).collect::<Vec<_>>().join(", "),
        ]
    };
    let network = &scene.network;
    let is_used = network
        .connections()
        .iter()
        .any(|connection| connection.between.contains(&network.ground()));
    let ground = is_used.then(|| described(network.ground(), network.node(network.ground())));
    let others = network.nodes().filter(|(id, _)| *id != network.ground());
    rows("Nodes", others.map(|(id, node)| described(id, node)).chain(ground).collect())
}

fn elements(scene: &Scene) -> Table {
    let described = scene.network.connections().iter().map(|connection| {
        let [from, to] = connection.between.map(|id| scene.network.node(id).name.as_str());
        let thickness =
            connection.thickness.map(|thickness| format!("{} thick", constant(thickness, "m")));
        vec![connection.name.clone(), format!("{from} → {to}"), thickness.unwrap_or_default()]
    });
    rows("Elements", described.collect())
}

fn layers(scene: &Scene) -> Table {
    let network = &scene.network;
    let rows_of = |connection| {
        let all = resolved(network, connection).unwrap_or_default().into_iter();
        all.map(|layer| {
            let mut row = vec![format!("{}, {}", connection.name, layer.name)];
            row.push(match layer.segments {
                0 => "no mass".to_owned(),
                1 => "1 segment".to_owned(),
                count => format!("{count} segments"),
            });
            if let Some(wave) = layer.wave {
                row.push(format!(
                    "waves at {} cross it in {}, impedance {}",
                    quantity(wave.speed, "m/s", 4),
                    quantity(wave.transit, "s", 4),
                    quantity(wave.impedance, "N s/m", 4)
                ));
            }
            row
        })
    };
    rows("Layers", network.connections().iter().flat_map(rows_of).collect())
}

fn parts(scene: &Scene) -> Table {
    let described = scene.assembly.primitives.iter().map(|primitive| {
        let own = match primitive.element.law() {
            Law::Spring(_) | Law::Dashpot(_) => element(primitive.element.as_ref()),
            Law::Rigid | Law::Nonlinear { .. } | Law::Phased => primitive.element.kind().to_owned(),
        };
        let phases = primitive.element.phases().map(|phase| phase.names().join(" / "));
        vec![own, primitive.name.clone(), phases.unwrap_or_default()]
    });
    rows("Parts that take part", described.collect())
}

fn loads(scene: &Scene) -> Table {
    let situation = Situation::of(&scene.network, scene.run.duration);
    let described = scene.network.loads().iter().map(|load| {
        let node = &scene.network.node(load.node).name;
        let share = situation.impact.as_ref().map(|impact| {
            let share = load.force.bound(scene.run.duration) / impact.force();
            estimate("F/(V0 √(K m1))", share)
        });
        vec![
            load.name.clone(),
            format!("on {node}"),
            waveform(&load.force, "N", scene.run.duration),
            share.unwrap_or_default(),
        ]
    });
    rows("Loads", described.collect())
}

fn scattered(scene: &Scene) -> Table {
    let described = scene.scatter.iter().map(|own| {
        let unit = own.dimension.map_or_else(|| "1".to_owned(), si_unit);
        let [mean, deviation] = [own.mean, own.deviation].map(|value| constant(value, &unit));
        vec![own.name.clone(), format!("mean {mean}"), format!("standard deviation {deviation}")]
    });
    rows("Numbers with scatter, used as their means; `run` samples them", described.collect())
}

fn unknowns(scene: &Scene) -> Table {
    let system = &scene.assembly.system;
    let described = system.unknowns.iter().map(|unknown| {
        let kind = match unknown.kind {
            UnknownKind::Differential => "state",
            UnknownKind::Algebraic => "algebraic",
        };
        let scale = quantity(unknown.scale, unknown.unit, 4);
        vec![kind.to_owned(), scale, unknown.name.clone()]
    });
    let scale = quantity(system.time_scale, "s", 4);
    rows(&format!("Unknowns with their units (that of time is {scale})"), described.collect())
}

fn solving(scene: &Scene) -> Result<Vec<(&'static str, String)>, CliError> {
    let system = &scene.assembly.system;
    let (method, why) = choice(&scene.assembly, scene.run.duration);
    let first = scene.run.methods.first().map_or("auto", String::as_str);
    let measures = reported_measures(&scene.assembly, &scene.settings(first)?)?;
    let found = if scene.run.at_most.is_some() { ", found" } else { "" };
    let algebraic = match system.algebraic() {
        0 => "no algebraic unknown is left".to_owned(),
        count => format!("{count} algebraic unknowns stay"),
    };
    Ok(vec![
        ("system", format!("{} states; {algebraic}", system.states())),
        ("duration", constant(scene.run.duration, "s") + found),
        ("methods", scene.run.methods.join(", ")),
        ("auto", format!("would choose `{method}`: {why}")),
        ("measures", measures.join(", ")),
    ])
}

/// Adds a table without a header, its first rows.
fn section(text: &mut Text, content: &Table) {
    if content.rows.is_empty() {
        return;
    }
    text.heading(&content.caption);
    let rows: Vec<Vec<String>> = content.rows.iter().take(MOST).cloned().collect();
    for line in fitted(&Table { rows, ..Table::default() }, WIDTH - 2) {
        text.line(&format!("  {line}"));
    }
    more(text, content.rows.len());
}

/// Says how many rows are only counted.
fn more(text: &mut Text, count: usize) {
    if count > MOST {
        text.line(&format!("  and {} more", count - MOST));
    }
}

/// What the columns mean.
const MEANING: &str = "What each adds, or would add with its defaults: unknowns, modes as a \
                       factor, and entries of the matrices and guards at the start, where it \
                       may change which phases hold; `2 fewer` says that it removes two. \
                       `number` measures how much it matters: little where it is far below 1.";

/// What each effect of a scene contributes.
fn effects(scene: &Scene) -> Result<Vec<Contribution>, RunError> {
    let settings = scene.settings(scene.run.methods.first().map_or("auto", String::as_str))?;
    let assembly = Arc::new(scene.assembly.clone());
    Ok(contributions(&scene.network, &assembly, &settings, MOST, &mut Silent))
}

fn effects_section(text: &mut Text, rows: &[Contribution]) {
    let shown = &rows[..rows.len().min(MOST)];
    text.table(&counts(shown));
    more(text, rows.len());
    text.blank();
    for row in shown {
        let number = row
            .influence
            .as_ref()
            .map(|influence| format!("; {}", estimate(&influence.formula, influence.value)));
        let words = format!("{}{}", description(row), number.unwrap_or_default());
        text.labelled(&row.name, LABELS, &words);
    }
    text.blank();
    text.paragraphs([MEANING]);
}

/// Columns of the effects' names.
const LABELS: usize = 20;

fn description(row: &Contribution) -> String {
    match &row.contributor {
        Contributor::Effect(effect) => write_effect(effect.as_ref()),
        Contributor::Kind(summary) => (*summary).to_owned(),
        Contributor::Other(Detail::Inertia(_)) => {
            "the layers have mass: waves travel in them".to_owned()
        }
        Contributor::Other(_) => "what is struck rests on a support that gives".to_owned(),
    }
}

fn counts(rows: &[Contribution]) -> Table {
    let header = ["effect", "state", "unknowns", "modes", "entries", "guards", "number"];
    let row = |contribution: &Contribution| {
        let adds = |of: fn(&SystemSize) -> usize| match &contribution.sizes {
            Some([with, without]) => change(of(with), of(without)),
            None => "–".to_owned(),
        };
        let modes = match &contribution.sizes {
            Some([with, without]) if with.modes > without.modes && without.modes > 0 => {
                format!("×{}", with.modes / without.modes)
            }
            _ => "–".to_owned(),
        };
        let state = match contribution.state {
            EffectState::On => "on",
            EffectState::Off => "off",
            EffectState::LeftOut => "dropped",
            EffectState::PutBack => "put back",
        };
        let number = contribution.influence.as_ref().map(|influence| estimated(influence.value));
        vec![
            contribution.name.clone(),
            state.to_owned(),
            adds(|size| size.unknowns),
            modes,
            adds(|size| size.entries),
            adds(|size| size.guards),
            number.unwrap_or_else(|| "–".to_owned()),
        ]
    };
    Table::new("Effects", &header, rows.iter().map(row))
}

fn change(with: usize, without: usize) -> String {
    if with >= without { (with - without).to_string() } else { format!("{} fewer", without - with) }
}
