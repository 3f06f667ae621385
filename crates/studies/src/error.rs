//! What can go wrong in a study, and what to do about it.

use dashpot_analysis::{RunError, rheometer::RheometerError, vibration::VibrationError};
use dashpot_dae::{MethodKind as _, SolveError, methods::Tsit45};
use dashpot_network::driving_point::DrivingPointError;
use dashpot_plot::PlotError;
use dashpot_scene::{Diagnostics, Fault, TableError, nearest, suggestion, units::parse_dimension};
use thiserror::Error;

use crate::signal::SignalError;

/// Why a study did not do what it was asked for.
#[derive(Debug, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "what a field is stands in the sentence of its variant")]
pub enum StudyError {
    /// A scene that is not valid.
    #[error("{0}")]
    Scene(Diagnostics),
    /// A scene that cannot be read.
    #[error("`{name}` cannot be read: {reason}")]
    Unreadable { name: String, reason: String, similar: Option<String> },
    /// A node that a network does not have.
    #[error("there is no node `{name}`; the nodes are {}", .known.join(", "))]
    UnknownNode { name: String, known: Vec<String> },
    /// A response that cannot be given.
    #[error(transparent)]
    Response(#[from] DrivingPointError),
    /// A network with moving masses where a model of springs and dashpots is wanted.
    #[error("`{word}` has masses that move: no springs and dashpots alone respond like it")]
    MovingMasses { word: String },
    /// A model that is not linear, where one is wanted that is.
    #[error("`{kind}` in `{word}` is not linear")]
    NotLinear { word: String, kind: &'static str },
    /// A test that cannot be made.
    #[error(transparent)]
    Rheometer(#[from] RheometerError),
    /// A scene that cannot be shaken.
    #[error(transparent)]
    Vibration(#[from] VibrationError),
    /// More of something than there may be.
    #[error("these are more than {most} {of}")]
    TooMany { of: &'static str, most: usize },
    /// A parameter that no test which is made has; others may.
    #[error("none of these tests has a `{name}`; they have {}", .known.join(", "))]
    UnknownSetting { name: String, known: Vec<&'static str>, of_tests: Vec<&'static str> },
    /// A file with a measured curve that is no table.
    #[error("`{file}`, {fault}")]
    MeasuredTable { file: String, fault: Box<TableError> },
    /// A measured curve that cannot be read, or of which it is not clear what it measured.
    #[error("`{flag} {file}`: {reason}")]
    MeasuredColumn { flag: &'static str, file: String, reason: String },
    /// A parameter of a test with a value that cannot be used.
    #[error("`{name}`: {reason}")]
    WrongSetting { name: String, reason: String },
    /// A setting that is no quantity, or one of another dimension.
    #[error("`{name}`: {fault}")]
    Quantity { name: String, fault: Box<Fault> },
    /// An element that a scene does not have.
    #[error("there is no element `{name}`; the elements are {}", .known.join(", "))]
    UnknownElement { name: String, known: Vec<String> },
    /// Constants that are too far apart.
    #[error("the constants of `{word}` are too far apart for double precision")]
    OutOfRange { word: String },
    /// A response between a node and itself.
    #[error("both nodes are `{name}`: nothing deforms between a node and itself")]
    OneNode { name: String },
    /// A material and a pad.
    #[error("one of them is a material, in Pa, the other a model of a pad, in N/m")]
    MaterialAndPad,
    /// A material where a pad is wanted.
    #[error("`{word}` is a material; the impact needs a pad with thickness and area")]
    MaterialInImpact { word: String },
    /// Two networks whose responses are not known well enough.
    #[error("the responses are known only within {error:.0e}, too little to tell")]
    Undecided { error: f64 },
    /// A run that cannot be done.
    #[error(transparent)]
    Run(#[from] RunError),
    /// Limits are to be enforced, and there is none.
    #[error("`--enforce` has no limit to enforce")]
    NoLimits,
    /// Channels that cannot be read.
    #[error(transparent)]
    Signal(#[from] SignalError),
    /// A figure that cannot be drawn.
    #[error(transparent)]
    Plot(#[from] PlotError),
    /// The program that calls has asked the work to end.
    #[error("it was asked to end")]
    Ended,
}

/// What to do where there is no limit.
pub const NO_LIMITS_HELP: &str =
    "write [limits] in the scene, or `--limit \"head.peak-acceleration<=250 g\"`";

impl StudyError {
    /// What is wrong with a setting of this name.
    pub fn setting(name: &str, reason: impl Into<String>) -> Self {
        Self::WrongSetting { name: name.to_owned(), reason: reason.into() }
    }

    /// What is wrong with a quantity of this name.
    pub fn quantity(name: &str, fault: Fault) -> Self {
        Self::Quantity { name: name.to_owned(), fault: Box::new(fault) }
    }

    /// Whether what was asked for is wrong, rather than that it could not be done.
    pub fn is_of_input(&self) -> bool {
        match self {
            Self::Run(error) => matches!(
                error,
                RunError::Network(_)
                    | RunError::UnknownMethod { .. }
                    | RunError::UnknownTarget { .. }
                    | RunError::UnknownMeasure { .. }
                    | RunError::NoMeasure { .. }
                    | RunError::UnknownOutput { .. }
                    | RunError::InvalidSetting { .. }
                    | RunError::Solve(
                        SolveError::NotApplicable { .. } | SolveError::InvalidSetting { .. },
                    )
            ),
            Self::Vibration(VibrationError::Unbounded { .. } | VibrationError::Cancelled)
            | Self::Undecided { .. }
            | Self::Plot(_)
            | Self::Ended => false,
            _ => true,
        }
    }

    /// What to do, where that can be said.
    pub fn help(&self) -> Option<String> {
        match self {
            Self::Unreadable { name, similar: None, .. } if is_unit(name) => {
                Some(unquoted_help(name))
            }
            Self::Unreadable { similar: Some(near), .. } => Some(format!("did you mean `{near}`?")),
            Self::UnknownSetting { name, of_tests, known } if of_tests.is_empty() => {
                nearest(name, known.iter().copied()).map(|near| format!("did you mean `{near}`?"))
            }
            Self::UnknownSetting { name, of_tests, .. } => {
                Some(format!("`{name}` is a parameter of `--test {}`", of_tests.join(",")))
            }
            Self::Quantity { fault, .. } => fault.help(),
            Self::Signal(error) => error.help(),
            Self::MeasuredTable { fault, .. } => fault.help(),
            Self::Run(
                RunError::NoMeasure { key, known } | RunError::UnknownMeasure { key, known },
            ) => suggestion(key, "measures", known),
            Self::Vibration(VibrationError::NoDrive { known, .. }) if !known.is_empty() => {
                Some(format!("`--drive {name}` shakes `{name}`", name = known[0]))
            }
            Self::Run(RunError::Solve(SolveError::BudgetSpent { work, .. })) => Some(format!(
                "`--budget {:.0e}` grants more; a shorter `duration` or `--accuracy 1%` asks for less",
                10.0 * *work as f64
            )),
            _ => self.general_help().map(str::to_owned),
        }
    }

    /// What to do about any error of a kind.
    fn general_help(&self) -> Option<&'static str> {
        Some(match self {
            Self::Unreadable { .. } => {
                "`dashpot new --out pad.toml` writes a scene to start from, `dashpot run` alone solves the built-in one"
            }
            Self::NoLimits => NO_LIMITS_HELP,
            Self::NotLinear { .. } => {
                "only linear models can be converted and compared; `dashpot rheometer` tests any model, and a scene \
                 runs it"
            }
            Self::MovingMasses { .. } => "`dashpot compare` compares such networks",
            Self::MaterialAndPad | Self::MaterialInImpact { .. } => {
                "an element with `material`, `thickness` and `area` is a pad; name that"
            }
            Self::Vibration(error) => return vibration_help(error),
            Self::Run(RunError::NoneGetsThrough { .. }) => {
                "`--accuracy 1%` asks for less; a shorter `duration` gives what comes until then"
            }
            Self::Run(RunError::Solve(error)) => return solve_help(error),
            _ => return None,
        })
    }
}

/// What to do about a scene that cannot be shaken.
fn vibration_help(error: &VibrationError) -> Option<&'static str> {
    Some(match error {
        VibrationError::NoDrive { .. } => {
            "hold a node with `fixed = true`, or put a load on one under [loads]"
        }
        VibrationError::UnknownNode { .. } => {
            "`--of` takes a name, or a quantity behind it as in `padding.force`; `dashpot vibrate --help` lists them"
        }
        VibrationError::Loose { .. } => {
            "gravity presses parts together, `[effects]` with `gravity = { value = \"1 g0\" }`; or leave out the \
             separation: then it pulls as it pushes"
        }
        VibrationError::NotLinear { .. } | VibrationError::OnStop { .. } => {
            "`dashpot run` solves it in time: give the node that shakes `motion = { sine = { amplitude = \"1 mm\", \
             frequency = \"20 Hz\" } }` (a load likewise a `force`), a `duration` of many periods, and ask for its \
             measures with `window = \"run\"`; or leave out of [effects] what switches"
        }
        _ => return None,
    })
}

/// What to do about a solution that failed.
fn solve_help(error: &SolveError) -> Option<&'static str> {
    Some(match error {
        SolveError::NotApplicable { .. } => "`--method auto` chooses one that can",
        SolveError::TooManySteps { method, .. }
        | SolveError::StepTooSmall { method, .. }
        | SolveError::NewtonFailed { method, .. } => {
            if *method == Tsit45::KIND {
                "an explicit method takes short steps where parts are stiff, whatever the accuracy; `--method auto` \
                 chooses one that suits"
            } else {
                "`--method auto` tries another method where one gets stuck; `--accuracy 1%` asks for less"
            }
        }
        SolveError::TooLarge { .. } => {
            "a shorter `duration`, or a condition under [run] that ends it, keeps less"
        }
        SolveError::TooManySwitches { .. } => {
            "what loses nothing in its impacts bounces for ever, ever lower as others lose speed: a `restitution` \
             below 1 lets it come to rest; or a shorter `duration`"
        }
        _ => return None,
    })
}

/// Whether a word is a unit, which belongs to the quantity before it.
pub fn is_unit(word: &str) -> bool {
    !["", "1"].contains(&word.trim()) && parse_dimension(word).is_ok()
}

/// What to write where the blank before a unit has divided a quantity.
pub fn unquoted_help(unit: &str) -> String {
    format!("`{unit}` is a unit: quote what belongs together, such as \"K=25 {unit}\"")
}
