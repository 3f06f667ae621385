//! `dashpot cushion`.

mod asked;
mod batches;
mod beside;
mod files;
mod object;
mod words;

use std::{num::NonZero, ops::ControlFlow, path::PathBuf, thread::available_parallelism};

use clap::Args;
use dashpot_design::{
    cushion::{Cushion, Known, cushion as solve, with_scatter},
    optimum::Scattered,
};
use dashpot_scene::Scene;
use serde::Serialize;

use self::{asked::Wanted, batches::Batches};
use crate::{
    args::{NO_SCATTER, SceneArguments, method_names, probability, refuse},
    counts::{SCATTERED_SCENES, threads},
    error::{CliError, Status, StudyError},
    folder::{Folder, Staged},
    input::title,
    operand::{print_notes, read_scene_of},
    output::{Study, Text, emit},
    progress::Bar,
    terminal::Terminal,
};

const LABELS: usize = 11;

/// `cushion`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot cushion parcel.toml\n  \
    dashpot cushion parcel.toml --heights \"30,60,90 cm\" --thickness \"2..10 cm,5\" \
    --stress \"1..20 kPa,40,log\" --out curves\n  \
    dashpot cushion parcel.toml --heights \"76 cm\" --thickness \"2..10 cm,5\" \
    --limit \"50 g\" --over \"4..9 kPa\"\n\n\
    The layout of ASTM D1596: a flat platen is guided onto the cushion, and its static stress, \
    weight over area, is varied by its mass; the area is that of the scene. Gravity acts and the \
    platen may leave the cushion, whether or not the scene says so.")]
pub(crate) struct CushionArguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// The mass that falls [default: the only one that moves at first].
    #[arg(long, value_name = "NAME")]
    platen: Option<String>,
    /// The element that is the cushion [default: the only one with a thickness under the mass].
    #[arg(long, value_name = "NAME")]
    pad: Option<String>,
    /// Heights of the drop, such as "30,60,90 cm" [default: the scene's].
    #[arg(long, value_name = "LENGTHS")]
    heights: Option<String>,
    /// Thicknesses of the cushion, such as "2..10 cm,5" [default: the scene's].
    #[arg(long, value_name = "LENGTHS")]
    thickness: Option<String>,
    /// Static stresses, such as "1..20 kPa,40,log" [default: 40 about the best ones].
    #[arg(long, value_name = "PRESSURES")]
    stress: Option<String>,
    /// The most that the peak may be, such as "50 g" or "parcel.peak-acceleration<=50 g" [default: the scene's limit on the
    /// peak acceleration of the mass].
    #[arg(long, value_name = "ACCELERATION")]
    limit: Option<String>,
    /// The range of static stresses over which the thinnest cushion has to keep the limit, such as "4..9 kPa".
    #[arg(long, value_name = "PRESSURES")]
    over: Option<String>,
    /// Exits with 4 unless, from each height, a cushion that was asked for keeps the limit: over the range of `--over`,
    /// else at any static stress.
    #[arg(long)]
    enforce: bool,
    /// So many drops in a row on the same cushion, at every point of the curves.
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u16).range(2..=20))]
    drops: Option<u16>,
    /// The time from one drop to the next.
    #[arg(long, value_name = "TIME", default_value = "60 s", requires = "drops")]
    between: String,
    /// Compression under the weight that stays, after these times, such as "1 min,1 h,24 h".
    #[arg(long, value_name = "TIMES", value_delimiter = ',')]
    creep: Vec<String>,
    /// So many scattered designs are drawn where numbers of the scene have scatter, such as "20 ± 2 MN/m": bands of the
    /// curves, and how sure the thinnest cushion is.
    #[arg(long, value_name = "NUMBER", value_parser = SCATTERED_SCENES.read(), default_value_t = 100)]
    scatter: usize,
    /// Which of them are drawn; the same number gives the same ones.
    #[arg(long, value_name = "NUMBER", default_value_t = 1)]
    seed: u64,
    /// The part of them that has to keep the limit where it is told from which thickness on that is sure.
    #[arg(long, value_name = "PROBABILITY", value_parser = probability, default_value = "95%")]
    robust: f64,
    /// Method for all drops [default: the scene's, if it names one, else auto].
    #[arg(long, value_name = "NAME", value_parser = method_names())]
    method: Option<String>,
    /// How many threads share the drops; the results are the same [default: one per core].
    #[arg(long, value_name = "NUMBER", value_parser = threads)]
    threads: Option<NonZero<usize>>,
    /// Folder for CSV, JSON, one figure for each height, and report.html with everything on one page.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Prints one JSON object, in SI units, in place of text.
    #[arg(long, conflicts_with = "csv")]
    json: bool,
    /// Prints all points as CSV, in SI units, in place of text.
    #[arg(long, conflicts_with = "out")]
    csv: bool,
}

/// Cushion curves of a scene.
struct Drawn {
    scene: Scene,
    wanted: Wanted,
    cushion: Cushion,
    /// What was drawn; nothing where no number of the scene has scatter.
    batches: Option<Batches>,
    is_csv: bool,
}

pub(crate) fn cushion(
    arguments: &CushionArguments,
    terminal: Terminal,
) -> Result<Status, CliError> {
    let input = crate::input::of(arguments.scene.scene.as_deref())?;
    let set = &arguments.scene.values.set;
    let scene = read_scene_of(&input, set, terminal)?;
    let wanted = Wanted::of(arguments, &scene, &input)?;
    if arguments.enforce && wanted.asked.limit.is_none() {
        return Err(StudyError::NoLimits.into());
    }
    let folder = Folder::wanted(arguments.out.as_deref(), files::names(&wanted.asked))?;
    let all = || available_parallelism().map_or(1, NonZero::get);
    let mut asked = wanted.asked.clone();
    asked.threads = arguments.threads.map_or_else(all, NonZero::get);
    let pose = wanted.pose(&input, set, arguments.method.as_deref());
    let batches = Batches::of((arguments, &wanted), &scene, &input)?;
    if batches.is_none() {
        refuse(&["--scatter", "--seed", "--robust"], NO_SCATTER)?;
    }
    if wanted.asked.limit.is_none() {
        refuse(&["--robust"], "there is no limit that a part of the designs has to keep")?;
    }
    // Scattered drops are the most by far.
    let plain = if batches.is_some() { 0.05 } else { 1.0 };
    let mut show = bar("cushion", (0.0, plain), terminal);
    let mut found = solve(&wanted.platen, &asked, &*pose, &mut show)?;
    if batches.is_some() {
        let scattered = wanted.scattered((&scene, &input), arguments, &*pose);
        let scattered = Scattered { probability: arguments.robust, pose: &*scattered };
        let mut show = bar("scatter", (plain, 1.0), terminal);
        with_scatter(&mut found, &asked, &*pose, scattered, &mut show)?;
    }
    drop(pose);
    let is_unsolved = |own: &Known| *own == Known::Unsolved;
    let mut points = found.curves.iter().flat_map(|own| &own.points);
    let has_failed = points.all(|own| is_unsolved(&own.known));
    let is_kept = found.is_kept();
    let drawn = Drawn { scene, wanted, cushion: found, batches, is_csv: arguments.csv };
    print_notes(&drawn.scene.notes);
    emit(&drawn, arguments.json, folder, terminal)?;
    Ok(match (has_failed, arguments.enforce && !is_kept) {
        (true, _) => Status::RunFailed,
        (false, true) => Status::LimitNotKept,
        (false, false) => Status::Done,
    })
}

/// Shows how far some work is, which goes from one share of all to another.
fn bar(
    name: &'static str,
    (from, to): (f64, f64),
    terminal: Terminal,
) -> impl FnMut(usize, usize) -> ControlFlow<()> {
    let mut bar = Bar::new(name, 0.0, terminal.error.attended);
    move |done, of| {
        let share = from + (to - from) * done as f64 / of as f64;
        bar.show(share, || format!("{done} of {of}"))
    }
}

impl Study for Drawn {
    fn warnings(&self) -> Vec<String> {
        words::missing(self)
    }

    fn text(&self, text: &mut Text) {
        text.warnings(&self.warnings());
        text.title(title(&self.scene));
        text.faint(&words::asked(self));
        text.blank();
        for line in words::lines(self) {
            text.labelled(line.label, LABELS, &line.text);
        }
        text.rows_below(&words::table(self));
        text.table(&beside::row_table(self));
        text.table(&beside::creep_table(self));
        text.blank();
        text.items(words::notes(self));
    }

    fn data(&self, _terminal: Terminal, out: &mut Vec<u8>) -> Option<()> {
        files::table(self, out).ok().filter(|()| self.is_csv)
    }

    fn object(&self) -> impl Serialize {
        object::object(self)
    }

    fn files(&self, files: &mut Staged<'_>) -> Result<(), CliError> {
        files::write(files, self)
    }
}
