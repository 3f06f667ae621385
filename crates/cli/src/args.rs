//! The arguments of the command: types only.

use std::{ffi::OsStr, num::NonZero, path::PathBuf};

use clap::{
    Args, Parser, Subcommand, ValueEnum,
    builder::{PossibleValue, PossibleValuesParser, TypedValueParser},
    error::{ContextKind, ContextValue, ErrorKind},
};
use clap_complete::Shell;
use dashpot_analysis::{
    Accuracy,
    rheometer::{ProtocolKind, ProtocolVisitor, visit_protocols},
};
use dashpot_dae::methods;
use dashpot_rheology::conversion::Target;
use dashpot_scene::{templates, units::parse_quantity};

use crate::input::{is_unit, unquoted_help};

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
    `Same` means that all poles and strengths agree within 1e-11, relatively.\n\n\
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
    Each test is computed from the model's poles and strengths in closed form, and \
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
    /// Method for all points [default: the scene's, if it names one, else auto]; points are stamped by
    /// auto and exact only.
    #[arg(long, value_name = "NAME", value_parser = method_names())]
    pub(crate) method: Option<String>,
    /// Leaves out what moves no measure by more than this, relative, such as 0.5%; verified at
    /// points spread over the sweep [default: the scene's, else nothing].
    #[arg(long, value_name = "SHARE", value_parser = share)]
    pub(crate) neglect: Option<f64>,
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

/// On or off.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Switch {
    /// On.
    On,
    /// Off.
    Off,
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

/// The names of methods, blanks around them allowed.
#[derive(Debug, Clone)]
struct MethodNames(PossibleValuesParser);

impl TypedValueParser for MethodNames {
    type Value = String;

    fn parse_ref(
        &self,
        command: &clap::Command,
        argument: Option<&clap::Arg>,
        value: &OsStr,
    ) -> Result<String, clap::Error> {
        let trimmed = value.to_str().map_or(value, |text| OsStr::new(text.trim()));
        self.0.parse_ref(command, argument, trimmed)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        self.0.possible_values()
    }
}

fn method_names() -> PossibleValuesParser {
    let methods = methods::all();
    PossibleValuesParser::new(methods.iter().map(|method| PossibleValue::new(method.name())))
}

fn template_names() -> PossibleValuesParser {
    let value =
        |shipped: &dashpot_scene::Shipped| PossibleValue::new(shipped.name).help(shipped.summary);
    PossibleValuesParser::new(templates().iter().map(value))
}

fn forms() -> PossibleValuesParser {
    PossibleValuesParser::new(
        Target::all()
            .into_iter()
            .map(|form| PossibleValue::new(form.word).aliases(form.aliases).help(form.summary)),
    )
}

fn test_names() -> PossibleValuesParser {
    struct Collect(Vec<PossibleValue>);
    impl ProtocolVisitor for Collect {
        fn visit<P: ProtocolKind>(&mut self) {
            self.0.push(PossibleValue::new(P::KIND).help(P::SUMMARY));
        }
    }
    let mut collect = Collect(Vec::new());
    visit_protocols(&mut collect);
    PossibleValuesParser::new(collect.0)
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

fn assignment(text: &str) -> Result<(String, String), String> {
    let (name, value) = text.split_once('=').unwrap_or((text, ""));
    if name.trim().is_empty() || value.trim().is_empty() {
        return Err("write a name, `=` and a value, such as \"K=25 MN/m\"".to_owned());
    }
    Ok((name.trim().to_owned(), value.trim().to_owned()))
}

fn within(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(number) if (0.0..=1.0).contains(&number) => Ok(number),
        _ => Err("it must be a number from 0 to 1, such as 1e-12".to_owned()),
    }
}

fn share(text: &str) -> Result<f64, String> {
    use dashpot_network::parameters::Dimension;
    let quantity = parse_quantity(text).map_err(|error| error.to_string())?;
    let is_number = quantity.dimension.is_none_or(|own| own == Dimension::NUMBER);
    let value = quantity.value;
    // A bare number of this size may be meant in percent.
    let is_doubtful = quantity.dimension.is_none()
        && !text.contains('%')
        && (0.01..=100.0 * Accuracy::LOOSEST).contains(&value);
    if is_number && value > 0.0 && value <= Accuracy::LOOSEST && !is_doubtful {
        return Ok(value);
    }
    Err(if is_doubtful {
        let percent = 100.0 * value;
        let other =
            if value > Accuracy::LOOSEST { String::new() } else { format!(" or \"{percent}%\"") };
        format!("a bare {value} is {percent}%; write \"{value}%\"{other}")
    } else {
        "\n  it must be more than 0 and at most 20%, such as 0.1% or 1e-3".to_owned()
    })
}

fn frequency(text: &str) -> Result<f64, String> {
    use dashpot_network::parameters::Dimension;
    let quantity = parse_quantity(text).map_err(|error| error.to_string())?;
    let is_frequency = quantity.dimension.is_none_or(|own| own == Dimension::FREQUENCY);
    if quantity.angle != 0 {
        let frequency = quantity.value / std::f64::consts::TAU;
        Err(format!("that is an angular frequency; write \"{frequency:.6} Hz\""))
    } else if is_frequency && quantity.value > 0.0 {
        Ok(quantity.value)
    } else {
        Err("it must be a positive frequency, such as \"20 Hz\"".to_owned())
    }
}
