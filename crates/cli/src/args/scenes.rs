//! Verbs that look at one scene.

use std::path::PathBuf;

use clap::Args;

use super::{
    SceneArguments, Switch, ValueArguments, When,
    values::{MethodNames, budget, frequency, method_names, share},
};

/// `run`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot run                                      the built-in reference impact\n  \
    dashpot run pad.toml --set \"K=25 MN/m\"           with another stiffness\n  \
    dashpot run pad.toml --method exact,bdf          two methods side by side\n  \
    dashpot run pad.toml --accuracy 0.01%            more digits\n  \
    dashpot run pad.toml --neglect 0.5%              without what matters less\n  \
    dashpot run pad.toml --out results               CSV, JSON, SVG and HTML\n  \
    dashpot run pad.toml --json | jq .runs[0].measures\n\n\
    Units: --accuracy and --neglect are relative (0.1%, 1e-3), --rtol a number; all values of --json are SI.")]
pub(crate) struct RunArguments {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// Methods in place of the scene's, side by side; `dashpot list methods` tells of each.
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', value_parser = MethodNames(method_names()))]
    pub(crate) method: Vec<String>,
    /// Accuracy of every measure, relative, such as 0.1% [default: the scene's, else 0.1 %].
    #[arg(long, value_name = "SHARE", value_parser = share)]
    pub(crate) accuracy: Option<f64>,
    /// Leaves out what moves no measure by more than this, relative, such as 0.5%; verified by a
    /// solution with it [default: the scene's, else nothing].
    #[arg(long, value_name = "SHARE", value_parser = share)]
    pub(crate) neglect: Option<f64>,
    /// The method's own relative tolerance, 1e-13 to 1e-3, in place of the search for one.
    #[arg(long, value_name = "NUMBER", conflicts_with = "accuracy")]
    pub(crate) rtol: Option<f64>,
    /// Whether errors are estimated by further solutions; `off` is for bulk work.
    #[arg(long, value_name = "SWITCH", default_value = "on")]
    pub(crate) estimate: Switch,
    /// Most work of each run, in units of a step of one unknown, some 30 ns [default: 1e9, some 30 s].
    #[arg(long, value_name = "UNITS", value_parser = budget)]
    pub(crate) budget: Option<u64>,
    /// Folder for CSV, JSON, SVG and HTML; it is made if need be.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Prints one JSON object, in SI units, in place of text.
    #[arg(long)]
    pub(crate) json: bool,
    /// A plot of the forces in the text; `auto` draws it on terminals.
    #[arg(long, value_name = "WHEN", default_value = "auto")]
    pub(crate) plot: When,
}

/// `check`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot check pad.toml\n  \
    dashpot check scenes/*.toml\n\n\
    Exit codes: 0 all are valid (warnings included), 2 one is not.")]
pub(crate) struct CheckArguments {
    /// Files of scenes; `-` for standard input.
    #[arg(value_name = "SCENE", required = true)]
    pub(crate) scenes: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) values: ValueArguments,
}

/// `explain`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot explain                                  the built-in reference impact\n  \
    dashpot explain pad.toml --out pad.svg           the drawing as a file, too")]
pub(crate) struct ExplainArguments {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// Where the drawing goes as SVG: a file, or a folder for `network.svg`.
    #[arg(long, value_name = "FILE|DIR")]
    pub(crate) out: Option<PathBuf>,
}

/// `vibrate`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot vibrate crate.toml\n  \
    dashpot vibrate crate.toml --from \"1 Hz\" --to \"200 Hz\" --out crate-vibration\n  \
    dashpot vibrate crate.toml --at \"20 Hz\" --amplitude \"0.5 g0\"\n  \
    dashpot vibrate reference --drive ground --of head\n\n\
    One load or motion is a sine of any small size, all others are silent: the functions of \
    time in the scene, weights and start speeds do not matter. A fixed node such as `ground` may \
    be shaken too. Scenes that switch or are not linear are refused.")]
pub(crate) struct VibrateArguments {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// The load that pushes or the node that is moved [default: the only one of the scene].
    #[arg(long, value_name = "NAME")]
    pub(crate) drive: Option<String>,
    /// Lowest frequency [default: a tenth of the lowest natural frequency].
    #[arg(long, value_name = "FREQUENCY", value_parser = frequency)]
    pub(crate) from: Option<f64>,
    /// Highest frequency [default: ten times the highest natural frequency].
    #[arg(long, value_name = "FREQUENCY", value_parser = frequency)]
    pub(crate) to: Option<f64>,
    /// How many frequencies, at equal ratios; resonances are found between them.
    #[arg(long, value_name = "NUMBER", default_value_t = 200)]
    pub(crate) points: usize,
    /// Nodes to look at, or supports where a load drives [default: all masses, all supports].
    #[arg(long, value_name = "NODE,…", value_delimiter = ',')]
    pub(crate) of: Vec<String>,
    /// Peaks of the steady state at this frequency, in place of the table over frequency.
    #[arg(long, value_name = "FREQUENCY", value_parser = frequency, requires = "amplitude")]
    pub(crate) at: Option<f64>,
    /// Amplitude of the drive there: of a force, or of a displacement or an acceleration.
    #[arg(long, value_name = "QUANTITY", requires = "at")]
    pub(crate) amplitude: Option<String>,
    /// Folder for CSV, JSON and SVG; it is made if need be.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Prints one JSON object, in SI units, in place of text.
    #[arg(long)]
    pub(crate) json: bool,
    /// A plot in the text; `auto` draws it on terminals.
    #[arg(long, value_name = "WHEN", default_value = "auto")]
    pub(crate) plot: When,
}
