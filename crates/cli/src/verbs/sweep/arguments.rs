//! What `sweep` is asked for.

use std::{num::NonZero, path::PathBuf, thread::available_parallelism};

use clap::{Args, ValueEnum};
use dashpot_analysis::{
    Limit, RunError,
    sweep::{Column, Estimates, ScenePoint},
};
use dashpot_scene::Posed;
use serde::{Deserialize, Serialize};

use super::{
    files, gradient,
    shards::{self, Place, place},
    varied::Varied,
};
use crate::{
    args::{LimitArguments, SceneArguments, When, method_names, share, single},
    counts::{SWEEP_POINTS, threads},
    error::CliError,
    folder::Folder,
    varied::method,
};
use dashpot_studies::Budget;

/// `sweep`.
#[derive(Debug, Clone, Args, Serialize, Deserialize)]
#[command(after_help = "Examples:\n  \
    dashpot sweep pad.toml --vary \"K=5..30 MN/m,26,log\"\n  \
    dashpot sweep --vary \"head.velocity=2..12 m/s\" --measure padding.peak-force\n  \
    dashpot sweep pad.toml --points designs.csv\n  \
    dashpot sweep --vary \"padding.maxwell.spring=5..80 MN/m,41,log\" \
    --vary \"padding.kelvin.dashpot=1..16 kN s/m,41,log\" --out map\n  \
    dashpot sweep helmet.toml --vary liner.material=eps,epp,vn --vary \"drop=0.5..2 m\"\n  \
    dashpot sweep pad.toml --gradient K,head.mass\n  \
    dashpot sweep pad.toml --points designs.csv --shard 3/10 --out part-3\n  \
    dashpot sweep pad.toml --vary \"K=5..30 MN/m\" --vary \"C=2..9 kN s/m\" --sample 200\n\n\
    A number of the scene goes by its path, such as head.velocity, mount.dashpot, \
    padding.maxwell.spring or padding.thickness, or by its name under [values]. Its values are a \
    range, with their count and `lin` or `log`, or a list: \"K=5,10,20 MN/m\". A word of it, such as \
    that of a material, takes a list of words. In a pipe or file \
    the table is CSV, in SI units.")]
pub(crate) struct SweepArguments {
    #[command(flatten)]
    pub(super) scene: SceneArguments,
    #[command(flatten)]
    pub(super) limits: LimitArguments,
    /// Exits with 4 unless every point keeps every limit, however the errors lie.
    #[arg(long, conflicts_with = "gradient")]
    #[serde(skip)]
    pub(super) enforce: bool,
    /// A number of the scene and the values that it takes; repeatable, for all combinations.
    #[arg(long, value_name = "NAME=VALUES", required_unless_present_any = ["points", "gradient"])]
    pub(super) vary: Vec<String>,
    /// Designs from a table in place of all combinations: a CSV file whose first line names numbers and words of
    /// the scene with their units, such as `liner.thickness [mm],liner.material`; each row is one. Columns of
    /// other words name the designs.
    #[arg(long, value_name = "FILE", conflicts_with = "vary")]
    pub(super) points: Option<PathBuf>,
    /// So many designs in place of all combinations: a Latin hypercube of the ranges; of a list, and of a range
    /// with a count, each value is taken equally often.
    #[arg(long, value_name = "NUMBER", requires = "vary", value_parser = SWEEP_POINTS.read())]
    pub(super) sample: Option<usize>,
    /// Which designs `--sample` takes; the same number gives the same ones.
    #[arg(long, value_name = "NUMBER", requires = "sample", default_value_t = 1)]
    pub(super) seed: u64,
    /// Derivatives of the measures with respect to these numbers, at every point or, without `--vary`, of the scene
    /// itself: by how many percent a measure changes where a number rises by one.
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', conflicts_with_all = ["estimate", "neglect"])]
    pub(super) gradient: Vec<String>,
    /// Measures, such as padding.peak-force [default: all that the scene reports].
    #[arg(long, value_name = "KEY,…", value_delimiter = ',')]
    pub(super) measure: Vec<String>,
    /// Method for all points [default: the scene's, if it names one, else auto]; points are instantiated by
    /// auto and exact only.
    #[arg(long, value_name = "NAME", value_parser = method_names())]
    pub(super) method: Option<String>,
    /// Leaves out what moves no measure by more than this, relative, such as 0.5%; verified at
    /// points spread over the sweep [default: the scene's, else nothing].
    #[arg(long, value_name = "SHARE", value_parser = share)]
    pub(super) neglect: Option<f64>,
    /// Where errors are estimated by further solutions; some: at three of 64 points; the others
    /// have those of their steps where they are instantiated, else of those near them [default: some; of a table, whose rows need not be near each other, all].
    #[arg(long, value_enum, value_name = "WHERE")]
    pub(super) estimate: Option<EstimatedPoints>,
    /// Most work of each point, in units of a step of one unknown, 20 to 60 ns [default: 1e9, 20 to 60 s].
    #[arg(long, value_name = "UNITS", value_parser = single::<Budget>)]
    pub(super) budget: Option<Budget>,
    /// How many threads share the points; the results are the same [default: one per core].
    #[arg(long, value_name = "NUMBER", value_parser = threads)]
    #[serde(skip)]
    pub(super) threads: Option<NonZero<usize>>,
    /// One part of so many, such as 3/10, for a queue of jobs or several machines: only its points are solved, and
    /// `dashpot merge` puts the folders of all together, to the bytes of one sweep. A shard that is there, whole, is
    /// left as it is.
    #[arg(long, value_name = "NUMBER/OF", value_parser = place, requires = "out", conflicts_with_all = ["gradient", "enforce", "table"])]
    #[serde(skip)]
    pub(super) shard: Option<Place>,
    /// Writes the points into the folder as Parquet, in files of 4096 to 262 144 points, each whole as soon as it is there, in
    /// place of everything else: for sweeps of any size, in the memory of one file. The same command goes on where it
    /// was broken off.
    #[cfg(feature = "parquet")]
    #[arg(long, requires = "out", conflicts_with_all = ["gradient", "table"])]
    #[serde(skip)]
    pub(super) parquet: bool,
    #[command(flatten)]
    #[serde(skip)]
    pub(super) output: OutputArguments,
}

/// Where the result of a sweep goes, and how.
#[derive(Debug, Clone, Default, Args)]
pub(crate) struct OutputArguments {
    /// Folder for CSV, JSON, SVG and HTML: lines over one parameter, maps over two, and report.html with
    /// everything on one page.
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
    /// Prints one JSON object, in SI units, in place of the table.
    #[arg(long)]
    pub(super) json: bool,
    /// A table in handy units for people, in place of CSV in SI units; `auto` prints it on terminals.
    #[arg(long, value_name = "WHEN", default_value = "auto", conflicts_with = "json")]
    pub(super) table: When,
}

/// The points of a sweep at which errors are estimated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
pub(super) enum EstimatedPoints {
    /// Every point.
    All,
    /// Some points.
    Some,
    /// None.
    Off,
}

impl From<EstimatedPoints> for Estimates {
    fn from(points: EstimatedPoints) -> Self {
        match points {
            EstimatedPoints::All => Self::All,
            EstimatedPoints::Some => Self::Some,
            EstimatedPoints::Off => Self::Off,
        }
    }
}

impl SweepArguments {
    /// The folder that is asked for, where one is.
    pub(super) fn folder(
        &self,
        varied: &Varied,
        columns: &[Column],
    ) -> Result<Option<Folder>, CliError> {
        let names = match (self.gradient.is_empty(), self.shard) {
            (false, _) => vec![gradient::TABLE.to_owned()],
            (true, Some(_)) => vec![shards::VALUES.to_owned()],
            (true, None) => files::names(varied, columns),
        };
        Folder::wanted(self.output.out.as_deref(), names)
    }

    /// A point with this scene, which has to keep `further` limits.
    pub(super) fn scene_point(
        &self,
        posed: Posed,
        further: &[Limit],
    ) -> Result<ScenePoint, RunError> {
        let mut settings = posed.settings(method(&posed, self.method.as_deref()))?;
        settings.budget = self.budget.map_or(settings.budget, |budget| budget.0);
        Limit::add(&mut settings.limits, further.iter().cloned());
        settings.accuracy.neglect_below = self.neglect.or(settings.accuracy.neglect_below);
        Ok(ScenePoint { network: posed.network, settings })
    }

    pub(super) fn threads(&self) -> usize {
        self.threads.or(available_parallelism().ok()).map_or(1, NonZero::get)
    }
}
