//! `dashpot check`.

use std::path::{Path, PathBuf};

use clap::Args;
use dashpot_analysis::{Choice, Note, RunError, reported_measures, undefined_measures};
use dashpot_dae::Run;
use dashpot_scene::Scene;

use crate::{
    args::ValueArguments,
    error::{CliError, Status},
    operand::{read_models_of, read_scene_of},
    terminal::{Terminal, WIDTH, note, print},
};
use dashpot_report::{layout::hanging, numbers::counted};
use dashpot_studies::non_identifiable::notes;

/// `check`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot check pad.toml\n  \
    dashpot check scenes/*.toml\n\n\
    Exit codes: 0 all are valid (warnings included), 2 one is not.")]
pub(crate) struct CheckArguments {
    /// Files of scenes, or of models alone; `-` for standard input.
    #[arg(value_name = "SCENE", required = true)]
    scenes: Vec<PathBuf>,
    #[command(flatten)]
    values: ValueArguments,
}

/// Says of each scene whether it is valid.
pub(crate) fn check(arguments: &CheckArguments, terminal: Terminal) -> Result<Status, CliError> {
    let several = arguments.scenes.len() > 1;
    let mut status = Status::Done;
    for path in &arguments.scenes {
        let prefix = if several { format!("{}: ", path.display()) } else { String::new() };
        match checked(path, &arguments.values.set, terminal) {
            Ok(text) => print(&(hanging(&format!("{prefix}ok: {text}"), WIDTH) + "\n"))?,
            Err(error) => {
                terminal.error(&error);
                if several {
                    print(&format!("{prefix}not valid\n"))?;
                }
                status = status.max(error.status());
            }
        }
    }
    Ok(status)
}

fn checked(path: &Path, set: &[(String, String)], terminal: Terminal) -> Result<String, CliError> {
    let input = crate::input::read_input(path)?;
    if let Some(models) = read_models_of(&input, set, terminal)? {
        return Ok(models);
    }
    let scene = read_scene_of(&input, set, terminal)?;
    can_run(&scene)?;
    undefined(&scene)?.iter().for_each(|text| terminal.warn(text));
    notes(&scene).iter().for_each(|text| note(text));
    let system = &scene.assembly.system;
    let nodes = scene.network.nodes().count() - 1;
    let structure = match (system.is_linear(), system.algebraic()) {
        (true, 0) => "linear".to_owned(),
        (true, count) => format!("linear with {count} algebraic"),
        (false, count) => format!("not linear, {count} algebraic"),
    };
    let parts = scene.assembly.switching.as_ref().map_or(0, |switching| switching.parts().len());
    let structure = if parts > 0 {
        format!("{structure} at first; {} that can switch", counted(parts, "part"))
    } else {
        structure
    };
    Ok(format!(
        "{}, {}, {}, {structure}",
        counted(nodes, "node"),
        counted(scene.network.connections().len(), "element"),
        counted(system.len(), "unknown"),
    ))
}

/// Whether what the scene asks of a run can be done by all of its methods.
fn can_run(scene: &Scene) -> Result<(), CliError> {
    for name in &scene.run.methods {
        let settings = scene.settings(name)?;
        reported_measures(&scene.assembly, &settings)?;
        if let Choice::Method(method) = &settings.method {
            let run = Run::to(settings.duration);
            method.applies(&scene.assembly.system, &run).map_err(RunError::from)?;
        }
    }
    Ok(())
}

/// What is to be said about measures that can have no value.
pub(crate) fn undefined(scene: &Scene) -> Result<Vec<String>, CliError> {
    let Some(method) = scene.run.methods.first() else { return Ok(Vec::new()) };
    let found = undefined_measures(&scene.assembly, &scene.settings(method)?)?;
    let text = |(key, why): &(String, Note)| format!("`{key}` can have no value: {why}");
    Ok(found.iter().map(text).collect())
}
