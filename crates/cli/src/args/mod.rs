//! The arguments of the command: types only.

mod models;
mod scenes;
mod studies;
mod values;

use std::path::PathBuf;

use clap::{
    Args, Parser, Subcommand, ValueEnum,
    error::{ContextKind, ContextValue, ErrorKind},
};
use clap_complete::Shell;

use self::values::assignment;
pub(crate) use self::{
    models::{
        CompareArguments, ConvertArguments, Family, ListArguments, NewArguments, RheometerArguments,
    },
    scenes::{CheckArguments, ExplainArguments, RunArguments, VibrateArguments},
    studies::{CostArguments, GroupsArguments, SweepArguments, ThesisArguments},
};
use crate::error::{is_unit, unquoted_help};

/// Impacts on viscoelastic padding: spring-dashpot-mass networks, solved with stated errors.
#[derive(Debug, Parser)]
#[command(
    name = "dashpot",
    version,
    arg_required_else_help = true,
    max_term_width = 80,
    after_help = "Begin with:\n  \
        dashpot run                     the built-in reference impact, by two methods\n  \
        dashpot new --out pad.toml      a commented scene to start from\n  \
        dashpot run pad.toml            solve it: forces, g, depth, and their errors\n\n\
        Exit codes: 0 done (warnings included), 1 a run failed, 2 the input is wrong,\n\
        3 `compare` says that two models are not the same, `groups` that two scenes
        are not similar."
)]
pub(crate) struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub(crate) command: Command,
    /// Colours in the output; `auto` is for terminals and honours `NO_COLOR`.
    #[arg(long, global = true, value_name = "WHEN", default_value = "auto")]
    pub(crate) color: When,
}

/// The verbs.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Solves a scene and reports peaks, energies and their errors.
    Run(RunArguments),
    /// Says whether scenes are valid, without solving them.
    Check(CheckArguments),
    /// Shows what was built from a scene: drawing, parts, unknowns, effects, method.
    Explain(ExplainArguments),
    /// Writes a model in another form that does the same, and says how nearly.
    Convert(ConvertArguments),
    /// Says whether two models or networks are the same from outside, by their poles.
    Compare(CompareArguments),
    /// Tests a model alone: creep, relaxation, oscillation, in closed form and by simulation.
    Rheometer(RheometerArguments),
    /// Shows what accuracy costs: true errors of every method against time and work.
    Cost(CostArguments),
    /// Solves a scene for many values of its numbers: tables, lines and maps of measures.
    Sweep(SweepArguments),
    /// Shakes a linear scene with a sine: transmissibility, resonances, peaks of the steady state.
    Vibrate(VibrateArguments),
    /// Recomputes the thesis behind this project: its numbers, figures, misprints and claims.
    Thesis(ThesisArguments),
    /// Shows dimensionless groups, whether scenes are similar, and designs laboratory tests.
    Groups(GroupsArguments),
    /// Lists every kind that a scene may contain, with its parameters.
    List(ListArguments),
    /// Writes a commented scene to start from.
    New(NewArguments),
    /// Prints the JSON schema of scenes, for completion and checks in editors.
    Schema,
    /// Writes the manual pages of all verbs to a folder, or prints that of the command.
    Man {
        /// Folder to write to, made if it is not there.
        #[arg(long, value_name = "DIR", value_hint = clap::ValueHint::DirPath)]
        out: Option<PathBuf>,
    },
    /// Prints the completions for a shell.
    Completions {
        /// The shell.
        shell: Shell,
    },
}

/// Which scene.
#[derive(Debug, Args)]
pub(crate) struct SceneArguments {
    /// File of the scene, `-` for standard input, or a built-in scene (reference,
    /// reference-stiff, reference-gravity) [default: reference].
    #[arg(value_name = "SCENE")]
    pub(crate) scene: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) values: ValueArguments,
}

/// Which named values.
#[derive(Debug, Args)]
pub(crate) struct ValueArguments {
    /// Sets a value of the scene's table [values]: `--set "K=25 MN/m"`; repeatable.
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
}

/// When something is done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum When {
    /// On terminals.
    Auto,
    /// Always.
    Always,
    /// Never.
    Never,
}

impl When {
    /// Whether it is done where a terminal is attended, or not.
    pub(crate) fn is_now(self, attended: bool) -> bool {
        self == Self::Always || self == Self::Auto && attended
    }
}

/// On or off.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Switch {
    /// On.
    On,
    /// Off.
    Off,
}

/// The error with what to write where a unit stands alone.
pub(crate) fn explained(mut error: clap::Error) -> clap::Error {
    let Some(ContextValue::String(word)) = error.get(ContextKind::InvalidArg) else { return error };
    let unit = word.split(',').next().unwrap_or_default();
    if error.kind() == ErrorKind::UnknownArgument && is_unit(unit) {
        let help = unquoted_help(unit).into();
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![help]));
    }
    error
}
