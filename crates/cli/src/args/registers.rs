//! Verbs that show what there is.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::kinds::template_names;

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
