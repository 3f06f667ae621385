//! What can go wrong in the command, and the exit code of each.

mod help;

use std::{
    io,
    path::{Path, PathBuf},
    process::ExitCode,
};

use dashpot_analysis::{
    Limit, RunError, rheometer::RheometerError, similarity::SimilarityError, sweep::SweepError,
    vibration::VibrationError,
};
use dashpot_dae::SolveError;
use dashpot_design::cushion::NoCushion;
use dashpot_network::driving_point::DrivingPointError;
use dashpot_plot::PlotError;
use dashpot_rheology::conversion::Unfit;
use dashpot_scene::{
    Diagnostics, Fault, ListedFault, TableError, TunableFault, Unwritable, VariationFault, nearest,
};
use dashpot_signal::{ChannelFault, SettingsFault};
use dashpot_thesis::ThesisError;
use thiserror::Error;

use crate::{
    host,
    numbers::constant,
    verbs::{
        run::stated,
        sweep::{ShardFault, missing},
    },
};

pub(crate) use self::help::{is_unit, unquoted_help};

/// How a command ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Status {
    /// Done, warnings included.
    Done = 0,
    /// A run, or the writing of its results, failed.
    RunFailed = 1,
    /// The input is wrong.
    InputWrong = 2,
    /// Two models are not the same.
    NotSame = 3,
    /// A limit is not kept, or not for certain.
    LimitNotKept = 4,
}

impl From<Status> for ExitCode {
    fn from(status: Status) -> Self {
        Self::from(status as u8)
    }
}

/// Why a command did not do what it was asked for.
#[derive(Debug, Error)]
pub(crate) enum CliError {
    /// A scene that is not valid.
    #[error("{0}")]
    Scene(Diagnostics),
    /// A file that is no table of designs.
    #[error("`{}`: {fault}", .file.display())]
    Listed { file: PathBuf, fault: Box<ListedFault> },
    /// Two limits of which no value keeps both.
    #[error("no value keeps both limits, `{}` {} and {}", .limits[0].key, stated(&.limits[0], None), stated(&.limits[1], None))]
    Contradiction { limits: Box<[Limit; 2]> },
    /// So few scattered designs show no such probability, even if all of them keep everything.
    #[error("that probability takes {least} scattered designs or more to show")]
    TooFewScattered { least: f64 },
    /// Limits are to be enforced, and there is none.
    #[error("`--enforce` has no limit to enforce")]
    NoLimits,
    /// What is made least is held by nothing.
    #[error("nothing holds `{name}`: there is no limit that a design has to keep")]
    NothingToKeep { name: String },
    /// No design can be solved, the first of them for this reason.
    #[error("{reason}")]
    NoDesign { reason: String },
    /// A scene that is no drop onto a cushion.
    #[error(transparent)]
    Cushion(Box<NoCushion>),
    /// A time is asked for that the run does not reach \[s\].
    #[error(
        "`--at {}` lies beyond the end of the run, {}",
        constant(*.time, "s"),
        constant(*.end, "s")
    )]
    BeyondEnd { time: f64, end: f64 },
    /// A scene that cannot be read.
    #[error("`{name}` cannot be read: {reason}")]
    Unreadable { name: String, reason: String, similar: Option<String> },
    /// A file that is there already.
    #[error("`{}` exists already", .path.display())]
    Foreign { path: PathBuf, help: &'static str },
    /// A file or folder that cannot be written.
    #[error("`{}` cannot be written: {}", .path.display(), unwritten(.path, .source))]
    Unwritable { path: PathBuf, source: io::Error },
    /// A scene that would not be the same where it is to be written.
    #[error("as `{}` the scene would not be the same: {reason}", .path.display())]
    WrittenOtherwise { path: PathBuf, reason: String },
    /// A folder that another process writes to.
    #[error("another run is writing to `{}`", .path.display())]
    Busy { path: PathBuf },
    /// A file where a folder is wanted.
    #[error("`{}` is a file; `--out` wants a folder", .path.display())]
    NotAFolder { path: PathBuf },
    /// A word that no register has.
    #[error("there is no kind `{word}`")]
    UnknownKind { word: String, near: Option<String> },
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
    /// A model that cannot be brought into a form.
    #[error("`{word}` cannot be written as `{form}`: {reason}")]
    Unfit { word: String, form: &'static str, reason: Unfit },
    /// A test that cannot be made.
    #[error(transparent)]
    Rheometer(#[from] RheometerError),
    /// A scene that cannot be shaken.
    #[error(transparent)]
    Vibration(#[from] VibrationError),
    /// Values of a parameter that cannot be read.
    #[error("`--vary`: {0}")]
    Variation(#[from] VariationFault),
    /// A number that a scene does not have, or not alone.
    #[error("`{flag}`: {fault}")]
    Tunable { flag: &'static str, fault: TunableFault },
    /// A number that is to be derived by, and that a scene does not have, or not alone.
    #[error("`--gradient`: {0}")]
    Gradient(TunableFault),
    /// A named value that is both set and varied.
    #[error("`{name}` is set and varied: leave out one of both")]
    SetAndVaried { name: String },
    /// A result that takes more memory than one may.
    #[error("{what} take some {} MB of memory: they are refused beyond {} MB", bytes / 1_000_000, most / 1_000_000)]
    TooLarge { what: String, bytes: usize, most: usize, help: &'static str },
    /// More of something than there may be.
    #[error("these are more than {most} {of}")]
    TooMany { of: &'static str, most: usize },
    /// A sweep that cannot be done.
    #[error(transparent)]
    Sweep(SweepError),
    /// A folder that holds no whole shard of the sweep.
    #[error("`{}`: {fault}", .path.display())]
    Shard { path: PathBuf, fault: ShardFault },
    /// A sweep that was interrupted, of which so many points are kept.
    #[error("{}", interrupted(*.kept, *.of, .path))]
    Interrupted { kept: usize, of: usize, path: PathBuf },
    /// Words of a table of designs under a heading that its results have.
    #[error("the points have a column `{name}` of their own beside that of the table of designs")]
    ColumnTaken { name: String },
    /// Shards that are not there.
    #[error("{}", missing(.numbers, *.of))]
    ShardsMissing { numbers: Vec<usize>, of: usize },
    /// A parameter that no test has.
    #[error("no test has a `{name}`; there are {}", .known.join(", "))]
    UnknownSetting { name: String, known: Vec<&'static str> },
    /// A file with a measured curve that is no table.
    #[error("`{file}`, {fault}")]
    MeasuredTable { file: String, fault: Box<TableError> },
    /// A measured curve that cannot be read, or of which it is not clear what it measured.
    #[error("`{flag} {file}`: {reason}")]
    MeasuredColumn { flag: &'static str, file: String, reason: String },
    /// Something that nothing can be fitted to.
    #[error("`--to {text}`: {reason}")]
    Fit { text: String, reason: String },
    /// A file with channels that cannot be read, or of which it is not clear what they are.
    #[error("`{file}`: {reason}")]
    SignalFile { file: String, reason: String },
    /// Samples that are no signal.
    #[error("`{file}`{}, channel `{channel}`: {fault}", .line.map_or_else(String::new, |own| format!(", line {own}")))]
    SignalSamples { file: String, line: Option<usize>, channel: String, fault: Box<ChannelFault> },
    /// A channel that cannot be read as it is asked for.
    #[error("`{file}`, channel `{channel}`: {fault}")]
    Signal { file: String, channel: String, fault: Box<SettingsFault> },
    /// A limit on what no channel has.
    #[error("no channel has the measure `{key}`")]
    SignalLimit { key: String, known: Vec<String>, meant: Option<String> },
    /// An output that a scene does not have, or that cannot be measured.
    #[error("`{flag} {file}`: there is no `{name}` over time to stand beside")]
    NotMeasurable { flag: &'static str, file: String, name: String, known: Vec<String> },
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
    /// A text in which a model cannot be replaced.
    #[error("the text of `{word}` cannot be rewritten with another model")]
    NotReplaced { word: String },
    /// Standard output that cannot be written.
    #[error("the output cannot be written: {0}")]
    Output(io::Error),
    /// A scene that has no such similar one.
    #[error(transparent)]
    Similarity(#[from] SimilarityError),
    /// A scene that cannot be written.
    #[error(transparent)]
    Unwritten(#[from] Unwritable),
    /// A run that cannot be done.
    #[error(transparent)]
    Run(#[from] RunError),
    /// The thesis cannot be recomputed.
    #[error(transparent)]
    Thesis(#[from] ThesisError),
    /// A figure that cannot be drawn.
    #[error(transparent)]
    Plot(#[from] PlotError),
    /// The program that calls has asked the work to end.
    #[error("{}", host::ENDED)]
    Ended,
    /// Results that cannot be written as JSON.
    #[error("the results cannot be written as JSON: {0}")]
    Json(#[from] serde_json::Error),
}

impl From<SweepError> for CliError {
    fn from(error: SweepError) -> Self {
        match error {
            // What is wrong with a run is told as in a run.
            SweepError::Run(error) => Self::Run(error),
            error => Self::Sweep(error),
        }
    }
}

impl From<NoCushion> for CliError {
    fn from(error: NoCushion) -> Self {
        match error {
            NoCushion::Run(error) => Self::Run(error),
            NoCushion::Sweep(error) => error.into(),
            error => Self::Cushion(Box::new(error)),
        }
    }
}

fn interrupted(kept: usize, of: usize, path: &Path) -> String {
    match kept {
        0 => format!("interrupted before the first file was whole: none of {of} points is kept"),
        kept => format!("interrupted: {kept} of {of} points are kept in `{}`", path.display()),
    }
}

/// Why a file cannot be written: first of all because its folder is not there.
fn unwritten(path: &Path, error: &io::Error) -> String {
    match path.parent().filter(|own| **own != *"" && !own.exists()) {
        Some(folder) if error.kind() == io::ErrorKind::NotFound => {
            format!("there is no folder `{}`", folder.display())
        }
        _ => reason(error),
    }
}

/// An error of the system at this path.
pub(crate) fn unwritable(path: &Path) -> impl Fn(io::Error) -> CliError + use<> {
    let path = path.to_owned();
    move |source| CliError::Unwritable { path: path.clone(), source }
}

impl CliError {
    /// What is wrong with a setting of this name.
    pub(crate) fn unknown_kind<'k>(word: &str, known: impl IntoIterator<Item = &'k str>) -> Self {
        let near = nearest(word, known).map(str::to_owned);
        Self::UnknownKind { word: word.to_owned(), near }
    }

    pub(crate) fn setting(name: &str, reason: impl Into<String>) -> Self {
        Self::WrongSetting { name: name.to_owned(), reason: reason.into() }
    }

    /// What is wrong with a quantity of this name.
    pub(crate) fn quantity(name: &str, fault: Fault) -> Self {
        Self::Quantity { name: name.to_owned(), fault: Box::new(fault) }
    }

    /// The one table of exit codes.
    pub(crate) fn status(&self) -> Status {
        match self {
            // The place is wrong; all else, such as a full disk, is a failure.
            Self::Unwritable { source, .. } if is_wrong_place(source) => Status::InputWrong,
            Self::Run(error) => match error {
                RunError::Network(_)
                | RunError::UnknownMethod { .. }
                | RunError::UnknownTarget { .. }
                | RunError::UnknownMeasure { .. }
                | RunError::NoMeasure { .. }
                | RunError::UnknownOutput { .. }
                | RunError::InvalidSetting { .. }
                | RunError::Solve(
                    SolveError::NotApplicable { .. } | SolveError::InvalidSetting { .. },
                ) => Status::InputWrong,
                _ => Status::RunFailed,
            },
            Self::Sweep(error) => match error {
                SweepError::NotPosed(_) | SweepError::NoPoints | SweepError::NoneReported => {
                    Status::InputWrong
                }
                _ => Status::RunFailed,
            },
            Self::Vibration(VibrationError::Unbounded { .. } | VibrationError::Cancelled)
            | Self::Undecided { .. }
            | Self::Busy { .. }
            | Self::Interrupted { .. }
            | Self::Unwritable { .. }
            | Self::Output(_)
            | Self::Thesis(_)
            | Self::Plot(_)
            | Self::Ended
            | Self::Json(_) => Status::RunFailed,
            _ => Status::InputWrong,
        }
    }
}

/// Whether a place that cannot be written is one that was badly chosen.
fn is_wrong_place(error: &io::Error) -> bool {
    use io::ErrorKind::{
        AlreadyExists, InvalidFilename, IsADirectory, NotADirectory, NotFound, PermissionDenied,
        ReadOnlyFilesystem,
    };
    matches!(
        error.kind(),
        AlreadyExists
            | InvalidFilename
            | IsADirectory
            | NotADirectory
            | NotFound
            | PermissionDenied
            | ReadOnlyFilesystem
    )
}

/// An error of the system in plain words.
pub(crate) fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "there is no such file".to_owned(),
        io::ErrorKind::PermissionDenied => "permission denied".to_owned(),
        io::ErrorKind::IsADirectory => "it is a folder".to_owned(),
        io::ErrorKind::NotADirectory | io::ErrorKind::AlreadyExists => {
            "a file stands in the way of a folder".to_owned()
        }
        io::ErrorKind::ReadOnlyFilesystem => "the file system is read-only".to_owned(),
        _ => {
            let text = error.to_string();
            // The number is of no use to people.
            text.split_once(" (os error").map_or(text.clone(), |(words, _)| words.to_owned())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::CliError;

    #[test]
    fn a_sweep_interrupted_before_its_first_file_keeps_nothing() {
        let told = |kept: usize| {
            let own = CliError::Interrupted { kept, of: 10_000, path: "pts".into() };
            (own.to_string(), own.help())
        };
        let (text, help) = told(0);
        assert!(text.ends_with("none of 10000 points is kept") && help.is_none(), "{text}");
        let (text, help) = told(4096);
        assert_eq!(text, "interrupted: 4096 of 10000 points are kept in `pts`");
        assert!(help.is_some());
    }
}
