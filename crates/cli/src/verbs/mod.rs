//! The register of verbs: each is a file or a folder of its own, with its arguments and what does it.
//! Those that find something out state it as a [`Study`](crate::output::Study).

mod check;
mod convert;
mod cushion;
mod design;
mod examples;
mod explain;
mod fit;
mod groups;
mod list;
mod printed;
pub(crate) mod run;
mod study;
pub(crate) mod sweep;
mod thesis;

use std::path::PathBuf;

use clap::{Parser, Subcommand};
use clap_complete::Shell;

pub(crate) use self::check::undefined;
use crate::{
    args::When,
    error::{CliError, Status},
    section::with_paths,
    terminal::Terminal,
};

/// The text of a scene where the files that its sections of options name are in the folders that `led` gives for theirs.
pub(crate) fn with_paths_of_sections(text: &str, led: &dyn Fn(&str) -> Option<String>) -> String {
    with_paths(text, &[fit::SECTION, design::SECTION], led)
}

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
        3 `compare` says that two models are not the same, `groups` that two scenes\n\
        are not similar, 4 `--enforce`: a limit is not kept, or not for certain.",
    mut_subcommands = examples::on_lines
)]
pub(crate) struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub(crate) command: Command,
    /// Colours in the output; `auto` is for terminals and honours `NO_COLOR`.
    #[arg(long, global = true, value_name = "WHEN", default_value = "auto")]
    pub(crate) color: When,
    /// Refuses numbers of scenes without a unit where one is expected, in place of reading them in SI.
    #[arg(long, global = true)]
    pub(crate) strict: bool,
}

/// The verbs.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Solves a scene and reports peaks, energies and their errors.
    Run(run::RunArguments),
    /// Says whether scenes are valid, without solving them.
    Check(check::CheckArguments),
    /// Shows what a scene says, and what is built from it: drawing, parts, effects, method.
    Explain(explain::ExplainArguments),
    /// Writes a model in another form that does the same, and says how nearly.
    Convert(convert::ConvertArguments),
    /// A study.
    #[command(flatten)]
    Study(study::StudyArguments),
    /// Solves a scene for many values of its numbers: tables, lines and maps of measures.
    Sweep(sweep::SweepArguments),
    /// Puts the shards of a sweep together: the bytes of one sweep, as if it had not been divided.
    Merge(sweep::MergeArguments),
    /// Searches the best numbers of a scene within its limits, and tells what no pad can beat.
    Design(design::DesignArguments),
    /// Draws cushion curves: peak g over static stress, for thicknesses and heights of the drop.
    Cushion(cushion::CushionArguments),
    /// Fits numbers of a scene, or a material, to measurements, and says what these cannot tell.
    Fit(fit::FitArguments),
    /// Recomputes the thesis behind this project: its numbers, figures, misprints and claims.
    Thesis(thesis::ThesisArguments),
    /// Shows dimensionless groups, whether scenes are similar, and designs laboratory tests.
    Groups(groups::GroupsArguments),
    /// Lists every kind that a scene may contain, with its parameters.
    List(list::ListArguments),
    /// Writes a commented scene to start from.
    New(printed::NewArguments),
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

impl Command {
    /// Does it.
    pub(crate) fn run(&self, terminal: Terminal) -> Result<Status, CliError> {
        match self {
            Self::Run(arguments) => run::run(arguments, terminal),
            Self::Check(arguments) => check::check(arguments, terminal),
            Self::Explain(arguments) => explain::explain(arguments, terminal),
            Self::Convert(arguments) => convert::convert(arguments, terminal),
            Self::Study(arguments) => arguments.run(terminal),
            Self::Sweep(arguments) => sweep::sweep(arguments, terminal),
            Self::Merge(arguments) => sweep::merged(arguments, terminal),
            Self::Design(arguments) => design::design(arguments, terminal),
            Self::Cushion(arguments) => cushion::cushion(arguments, terminal),
            Self::Fit(arguments) => fit::fit(arguments, terminal),
            Self::Thesis(arguments) => thesis::thesis(arguments, terminal),
            Self::Groups(arguments) => groups::groups(arguments, terminal),
            Self::List(arguments) => list::list(arguments, terminal),
            Self::New(arguments) => printed::new(arguments),
            Self::Schema => printed::schema(),
            Self::Man { out } => printed::man(out.as_deref()),
            Self::Completions { shell } => printed::completions(*shell),
        }
    }
}
