//! Verbs that look at models, and at what there is.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::{
    ValueArguments, When,
    values::{MethodNames, assignment, forms, method_names, template_names, test_names},
};

/// What may stand for a model.
const MODEL: &str = "FILE:NAME, a model, material or element of a file or of a built-in scene; \
                     FILE alone if it has one model; FILE:NODE,NODE for the response of a \
                     network without moving masses";
/// What may be compared.
const OPERAND: &str = "FILE:NAME, a model, material or element of a file or of a built-in scene; \
                       FILE alone if it has one model; FILE:NODE,NODE for the response of a \
                       whole network at two of its nodes";

/// `convert`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot convert reference:padding --to generalized-maxwell\n  \
    dashpot convert pads.toml:felt --to prony --out pads-prony.toml\n  \
    dashpot convert bridge.toml:head,ground --to generalized-kelvin\n\n\
    The text is that of FILE with the model replaced, its comments kept, so that \
    `dashpot run` takes it as it took FILE. The response at nodes becomes a table \
    [models.NAME] of its own.")]
pub(crate) struct ConvertArguments {
    /// The model.
    #[arg(value_name = "MODEL", help = MODEL)]
    pub(crate) model: String,
    /// The form.
    #[arg(long, value_name = "FORM", value_parser = forms())]
    pub(crate) to: String,
    #[command(flatten)]
    pub(crate) values: ValueArguments,
    /// File to write; without it the text is printed.
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Overwrites the file if there is one.
    #[arg(long, requires = "out")]
    pub(crate) force: bool,
}

/// `compare`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot compare pads.toml:burgers pads.toml:two-maxwell\n  \
    dashpot compare pads.toml:felt fibre.toml:felt --impact reference:padding\n  \
    dashpot compare bridge.toml:face,ground pads.toml:felt\n  \
    dashpot compare old.toml:head,ground new.toml:head,ground\n\n\
    `Same` means that all poles and residues agree within 1e-11, relatively.\n\n\
    Exit codes: 0 they are the same, 3 they are not, 2 the input is wrong.")]
pub(crate) struct CompareArguments {
    /// The model.
    #[arg(value_name = "FIRST", help = OPERAND)]
    pub(crate) first: String,
    /// The other one.
    #[arg(value_name = "SECOND")]
    pub(crate) second: String,
    /// Scene and element: solves this impact with each of the models in the element's place, and
    /// compares what is measured.
    #[arg(long, value_name = "SCENE:ELEMENT")]
    pub(crate) impact: Option<String>,
    #[command(flatten)]
    pub(crate) values: ValueArguments,
    /// Prints one JSON object, in SI units, in place of text.
    #[arg(long)]
    pub(crate) json: bool,
}

/// `rheometer`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot rheometer reference:padding\n  \
    dashpot rheometer pads.toml:felt --test load-hold-unload --with \"hold=5 ms\"\n  \
    dashpot rheometer pads.toml:felt --test sweep --out felt\n  \
    dashpot rheometer pads.toml:felt --method exact,bdf\n\n\
    Each test is computed from the model's poles and residues in closed form, and \
    independently from the equations of its network; both are shown. `dashpot list tests` \
    tells of each test and its parameters.")]
pub(crate) struct RheometerArguments {
    /// The model.
    #[arg(value_name = "MODEL", help = MODEL)]
    pub(crate) model: String,
    /// Tests [default: all].
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', value_parser = test_names())]
    pub(crate) test: Vec<String>,
    /// Sets a parameter of the tests that have it: `--with "hold=5 ms"`; repeatable.
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment)]
    pub(crate) with: Vec<(String, String)>,
    /// Methods that simulate the network.
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', default_value = "exact", value_parser = MethodNames(method_names()))]
    pub(crate) method: Vec<String>,
    #[command(flatten)]
    pub(crate) values: ValueArguments,
    /// Folder for CSV, JSON and SVG; it is made if need be.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Prints one JSON object, in SI units, in place of text.
    #[arg(long)]
    pub(crate) json: bool,
    /// Plots in the text; `auto` draws them on terminals.
    #[arg(long, value_name = "WHEN", default_value = "auto")]
    pub(crate) plot: When,
}

/// `list`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  dashpot list\n  dashpot list measures\n  dashpot list zener")]
pub(crate) struct ListArguments {
    /// One family alone (elements, forms, composites, shifts, waveforms, effects, measures,
    /// methods, tests, templates, scenes), or one kind, by any of its names.
    #[arg(value_name = "FAMILY|KIND")]
    pub(crate) what: Option<String>,
}

/// `new`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot new > pad.toml\n  \
    dashpot new chain --out chain.toml")]
pub(crate) struct NewArguments {
    /// What to start from.
    #[arg(default_value = "impact", value_parser = template_names())]
    pub(crate) template: String,
    /// File to write; without it the text is printed.
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Overwrites the file if there is one.
    #[arg(long, requires = "out")]
    pub(crate) force: bool,
}

/// Families of kinds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Family {
    /// Primitive laws of elements.
    Elements,
    /// Named models composed of them.
    Forms,
    /// Models that a few numbers describe as a whole.
    Composites,
    /// Shifts of the times of a model.
    Shifts,
    /// Functions of time for loads and motions.
    Waveforms,
    /// What acts on a network besides its elements.
    Effects,
    /// Numbers read off a run.
    Measures,
    /// Ways to solve.
    Methods,
    /// Tests of a model alone.
    Tests,
    /// Scenes to start from.
    Templates,
    /// Scenes that are built in.
    Scenes,
}
