//! Verbs that look at scenes many times, or at many of them.

use std::{num::NonZero, path::PathBuf};

use clap::Args;

use super::{
    SceneArguments, ValueArguments,
    values::{MethodNames, assignment, budget, method_names, share, within},
};

/// `sweep`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot sweep pad.toml --vary \"K=5..30 MN/m,26,log\"\n  \
    dashpot sweep --vary \"head.velocity=2..12 m/s\" --measure padding.peak-force\n  \
    dashpot sweep --vary \"padding.maxwell.spring=5..80 MN/m,41,log\" \\\n    \
    --vary \"padding.kelvin.dashpot=1..16 kN s/m,41,log\" --out map\n\n\
    A number of the scene goes by its path, such as head.velocity, mount.dashpot, \
    padding.maxwell.spring or padding.thickness, or by its name under [values]. Its values are a \
    range, with their count and `lin` or `log`, or a list: \"K=5,10,20 MN/m\". Without `--out` the \
    table is printed as CSV, in SI units.")]
pub(crate) struct SweepArguments {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// A number of the scene and the values that it takes; repeatable, for all combinations.
    #[arg(long, value_name = "NAME=VALUES", required = true)]
    pub(crate) vary: Vec<String>,
    /// Measures, such as padding.peak-force [default: all that the scene reports].
    #[arg(long, value_name = "KEY,…", value_delimiter = ',')]
    pub(crate) measure: Vec<String>,
    /// Method for all points [default: the scene's, if it names one, else auto]; points are instantiated by
    /// auto and exact only.
    #[arg(long, value_name = "NAME", value_parser = method_names())]
    pub(crate) method: Option<String>,
    /// Leaves out what moves no measure by more than this, relative, such as 0.5%; verified at
    /// points spread over the sweep [default: the scene's, else nothing].
    #[arg(long, value_name = "SHARE", value_parser = share)]
    pub(crate) neglect: Option<f64>,
    /// Most work of each point, in units of a step of one unknown, some 30 ns [default: 1e9, some 30 s].
    #[arg(long, value_name = "UNITS", value_parser = budget)]
    pub(crate) budget: Option<u64>,
    /// How many threads share the points; the results are the same [default: one per core].
    #[arg(long, value_name = "NUMBER")]
    pub(crate) threads: Option<NonZero<usize>>,
    /// Folder for CSV, JSON and SVG: lines over one parameter, maps over two.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Prints one JSON object, in SI units, in place of the table.
    #[arg(long)]
    pub(crate) json: bool,
}

/// `cost`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot cost                                     the built-in reference impact\n  \
    dashpot cost pad.toml --measure pad.peak-force   what one number costs\n  \
    dashpot cost pad.toml --method bdf,tsit45        some methods alone\n  \
    dashpot cost pad.toml --out cost                 CSV, JSON, SVG and HTML\n\n\
    Each method solves the scene at tolerances from 1e-3 to 1e-11. Errors are taken from the \
    exact solution, or from two solutions by methods of different families. Times are those of \
    this machine; the counts of work are the same everywhere.")]
pub(crate) struct CostArguments {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// Methods that are tried [default: all].
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', value_parser = MethodNames(method_names()))]
    pub(crate) method: Vec<String>,
    /// Measures by which methods are ranked, such as padding.peak-force [default: those that the
    /// scene wants an accuracy of, else all].
    #[arg(long, value_name = "KEY,…", value_delimiter = ',')]
    pub(crate) measure: Vec<String>,
    /// Most work of each solution, in units of a step of one unknown, some 30 ns [default: 1e9, some 30 s].
    #[arg(long, value_name = "UNITS", value_parser = budget)]
    pub(crate) budget: Option<u64>,
    /// How often each solution is repeated for its time [default: the more often, the fewer steps
    /// it has].
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) repeat: Option<u16>,
    /// Folder for CSV, JSON, SVG and HTML; it is made if need be.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Prints one JSON object, in SI units, in place of text.
    #[arg(long)]
    pub(crate) json: bool,
}

/// `thesis`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot thesis                                   numbers and claims, with verdicts\n  \
    dashpot thesis --out thesis                      figures, CSV, and the whole report\n  \
    dashpot thesis --json | jq '.claims[] | [.verdict, .claim]'\n\n\
    The values that the figures of the thesis used for a, b, c and d are lost; those shown are chosen. \
    Beside each curve stand its springs, dashpots, q and largest deformation; what exceeds the \
    thickness is dashed.")]
pub(crate) struct ThesisArguments {
    /// Folder for SVG, CSV, JSON, Markdown and HTML; it is made if need be.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Prints one JSON object in place of text.
    #[arg(long)]
    pub(crate) json: bool,
}

/// `groups`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot groups                                   of the built-in reference impact\n  \
    dashpot groups real.toml test.toml               are they similar?\n  \
    dashpot groups real.toml --lab \"mass=1 kg, speed=2 m/s, thickness=5 mm\" --out lab.toml\n  \
    dashpot groups --from \"a=26.6, b=66.66, c=8, d=80\" --out groups.toml\n\n\
    Similar scenes have one structure and equal groups; their answers differ by factors of \
    mass, length and time alone.\n\n\
    Exit codes: 0 done, or similar; 3 not similar; 2 the input is wrong, 1 a run failed.")]
pub(crate) struct GroupsArguments {
    /// File of the scene, `-` for standard input, or a built-in scene [default: reference].
    #[arg(value_name = "A")]
    pub(crate) first: Option<PathBuf>,
    /// Another scene: is it similar, and if not, what does each group do?
    #[arg(value_name = "B", conflicts_with_all = ["lab", "from"])]
    pub(crate) second: Option<PathBuf>,
    /// Groups are equal within this, relative.
    #[arg(long, value_name = "NUMBER", default_value = "1e-12", value_parser = within)]
    pub(crate) within: f64,
    /// Designs the laboratory test with these values: `mass`, `speed`, `thickness`, or any
    /// parameter by its name; what is left open stays as it is.
    #[arg(long, value_name = "NAME=VALUE,…", value_delimiter = ',', value_parser = assignment, conflicts_with = "from")]
    pub(crate) lab: Vec<(String, String)>,
    /// Takes other groups of the thesis (A, B, a, b, c, d, alpha, beta, gamma), and the parameters
    /// that follow from them.
    #[arg(long, value_name = "NAME=VALUE,…", value_delimiter = ',', value_parser = assignment)]
    pub(crate) from: Vec<(String, String)>,
    #[command(flatten)]
    pub(crate) values: ValueArguments,
    /// File to write the scene of `--lab` or `--from` to.
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Overwrites the file if there is one.
    #[arg(long, requires = "out")]
    pub(crate) force: bool,
    /// Prints one JSON object, in SI units, in place of text.
    #[arg(long)]
    pub(crate) json: bool,
}
