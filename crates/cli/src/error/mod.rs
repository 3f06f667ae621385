//! What can go wrong in the command, and the exit code of each.

mod help;
pub(crate) mod shards;

use std::{
    io,
    path::{Path, PathBuf},
    process::ExitCode,
};

use dashpot_analysis::{Limit, RunError, similarity::SimilarityError, sweep::SweepError};
use dashpot_design::cushion::NoCushion;
use dashpot_network::driving_point::DrivingPointError;
use dashpot_plot::PlotError;
use dashpot_rheology::conversion::Unfit;
use dashpot_scene::{ListedFault, TunableFault, Unwritable, VariationFault, nearest};
use dashpot_thesis::ThesisError;
use thiserror::Error;

use dashpot_report::numbers::constant;
use dashpot_studies::measure_units::stated;
pub(crate) use dashpot_studies::{StudyError, is_unit, unquoted_help};

use self::shards::{ShardFault, missing};

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
    /// A study that was not done.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// A file that is no table of designs.
    #[error("`{}`: {fault}", .file.display())]
    Listed { file: PathBuf, fault: Box<ListedFault> },
    /// Two limits of which no value keeps both.
    #[error("no value keeps both limits, `{}` {} and {}", .limits[0].key, stated(&.limits[0], None), stated(&.limits[1], None))]
    Contradiction { limits: Box<[Limit; 2]> },
    /// So few scattered designs show no such probability, even if all of them keep everything.
    #[error("that probability takes {least} scattered designs or more to show")]
    TooFewScattered { least: f64 },
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
    /// A model that cannot be brought into a form.
    #[error("`{word}` cannot be written as `{form}`: {reason}")]
    Unfit { word: String, form: &'static str, reason: Unfit },
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
    /// Something that nothing can be fitted to.
    #[error("`--to {text}`: {reason}")]
    Fit { text: String, reason: String },
    /// An output that a scene does not have, or that cannot be measured.
    #[error("`{flag} {file}`: there is no `{name}` over time to stand beside")]
    NotMeasurable { flag: &'static str, file: String, name: String, known: Vec<String> },
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
    /// The thesis cannot be recomputed.
    #[error(transparent)]
    Thesis(#[from] ThesisError),
    /// Results that cannot be written as JSON.
    #[error("the results cannot be written as JSON: {0}")]
    Json(#[from] serde_json::Error),
}

/// What a study would say, where the command asks itself.
macro_rules! as_of_studies {
    ($($error:ty),*) => { $(impl From<$error> for CliError {
        fn from(error: $error) -> Self {
            StudyError::from(error).into()
        }
    })* };
}

as_of_studies!(RunError, DrivingPointError, PlotError);

impl From<SweepError> for CliError {
    fn from(error: SweepError) -> Self {
        match error {
            // What is wrong with a run is told as in a run.
            SweepError::Run(error) => error.into(),
            error => Self::Sweep(error),
        }
    }
}

impl From<NoCushion> for CliError {
    fn from(error: NoCushion) -> Self {
        match error {
            NoCushion::Run(error) => error.into(),
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
    /// A word that no register has, with the one that is nearest among the `known` ones.
    pub(crate) fn unknown_kind<'k>(word: &str, known: impl IntoIterator<Item = &'k str>) -> Self {
        let near = nearest(word, known).map(str::to_owned);
        Self::UnknownKind { word: word.to_owned(), near }
    }

    /// What is wrong with a setting of this name.
    pub(crate) fn setting(name: &str, reason: impl Into<String>) -> Self {
        StudyError::setting(name, reason).into()
    }

    /// The one table of exit codes.
    pub(crate) fn status(&self) -> Status {
        match self {
            // The place is wrong; all else, such as a full disk, is a failure.
            Self::Unwritable { source, .. } if is_wrong_place(source) => Status::InputWrong,
            Self::Study(error) if error.is_of_input() => Status::InputWrong,
            Self::Sweep(error) => match error {
                SweepError::NotPosed(_) | SweepError::NoPoints | SweepError::NoneReported => {
                    Status::InputWrong
                }
                _ => Status::RunFailed,
            },
            Self::Study(_)
            | Self::Busy { .. }
            | Self::Interrupted { .. }
            | Self::Unwritable { .. }
            | Self::Output(_)
            | Self::Thesis(_)
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
