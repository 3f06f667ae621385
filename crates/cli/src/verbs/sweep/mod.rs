//! `dashpot sweep`.

mod arguments;
mod best;
mod figures;
mod files;
mod gradient;
mod identity;
mod kept;
mod page;
#[cfg(feature = "parquet")]
mod parts;
mod points;
mod shards;
mod titles;
mod unmoved;
mod varied;
mod words;

use std::path::Path;

use dashpot_analysis::{
    Judgement,
    sweep::{
        Column, Estimates, Grid, Pose, Shard, SweepOptions, SweepReport, columns, merge,
        points_of_shard, sweep as solve, sweep_shard,
    },
};
use dashpot_scene::{
    BareNumbers, Checked, Diagnostic, Diagnostics, Posed, ReadOptions, Scene, Tunables, Variation,
    read,
};
use serde::Serialize;

pub(crate) use self::{
    arguments::SweepArguments,
    shards::{MergeArguments, merged},
};
use self::{
    arguments::{EstimatedPoints, OutputArguments},
    identity::Identity,
    shards::{OfShard, Place, Stored},
    varied::{Form, Varied},
    words::{notes, summary},
};
use crate::input::AsCommanded as _;
use crate::{
    args::{When, refuse},
    counts::{SWEEP_POINTS, check_memory},
    error::{CliError, Status, StudyError},
    folder::Staged,
    input::{Input, title},
    operand::print_notes,
    output::{Pairs, Study, Text, emit, list, object},
    progress::Bar,
    said,
    terminal::{Terminal, note},
    varied::posed,
};
use dashpot_report::numbers::counted;
use dashpot_studies::origin;

/// What was varied, in what, and what was found.
struct Swept {
    scene: Scene,
    varied: Varied,
    grid: Grid,
    /// Where errors were to be estimated.
    estimates: Estimates,
    /// What the command line asked for, in words.
    asked: Vec<(&'static str, String)>,
    report: SweepReport,
    /// When its table is for people.
    table: When,
}

/// Solves a scene for many values of its parameters.
pub(crate) fn sweep(arguments: &SweepArguments, terminal: Terminal) -> Result<Status, CliError> {
    solved_or_merged(arguments, None, terminal)
}

/// The result of a sweep, of which all points are solved, or those of a shard; or all stand in `stored` shards.
fn solved_or_merged(
    arguments: &SweepArguments,
    stored: Option<Vec<Stored>>,
    terminal: Terminal,
) -> Result<Status, CliError> {
    let Asked { input, set, scene, known, varied, grid } = Asked::read(arguments, terminal)?;
    if !arguments.gradient.is_empty() {
        refuse(&["--limit"], "derivatives are judged by no limit")?;
    }
    let further = arguments.limits.beside(&scene.limits)?;
    let scene_point = |posed: Posed| arguments.scene_point(posed, &further);
    let keys: Vec<String> = arguments.measure.iter().map(|own| own.trim().to_owned()).collect();
    if arguments.enforce && scene.limits.is_empty() && further.is_empty() {
        return Err(StudyError::NoLimits.into());
    }
    let (columns, wishes) = columns(&scene_point(scene.clone().into())?, &keys)?;
    let hash = shards::fingerprint(arguments, &scene, &columns);
    if let Some(own) = stored.iter().flatten().find(|own| own.sweep != hash) {
        return Err(own.fault(crate::error::shards::ShardFault::Changed));
    }
    let of_values = |tunables: &Tunables, values: &[(usize, String)]| {
        scene_point(posed((tunables, values), &input, &set)?).map_err(|error| error.to_string())
    };
    let at = |places: &[usize]| {
        let mut scene_point = of_values(&varied.tunables, &varied.written_at(places))?;
        scene_point.settings.measures.clone_from(&wishes);
        Ok(scene_point)
    };
    let usual = if varied.is_apart() { EstimatedPoints::All } else { EstimatedPoints::Some };
    let estimates: Estimates = arguments.estimate.unwrap_or(usual).into();
    let of = (&varied, &grid, arguments.points.as_deref());
    let identity = Identity::of(arguments, &scene, &columns, estimates);
    #[cfg(feature = "parquet")]
    if arguments.parquet {
        terminal.diagnose(&of_ends(of, (&input, &set), known)?);
        let (scene, varied, grid, columns) = (&scene, &varied, &grid, &columns[..]);
        let (pose, sweep): (&Pose<'_>, _) = (&at, hash);
        let wanted =
            parts::Wanted { scene, varied, grid, pose, columns, estimates, sweep, identity };
        return parts::written(arguments, &wanted, terminal);
    }
    if let Some(place) = arguments.shard
        && Stored::found(&arguments.output, place, (&hash, &identity))?
    {
        return Ok(Status::Done);
    }
    check_size(arguments, &varied, &grid, &columns)?;
    let folder = arguments.folder(&varied, &columns)?;
    terminal.diagnose(&of_ends(of, (&input, &set), known)?);
    if !arguments.gradient.is_empty() {
        let of = (scene, varied, grid);
        return gradient::gradient(arguments, of, &keys, &of_values, folder, terminal);
    }
    let found = found((arguments, estimates, stored), (&grid, &at, &columns), terminal)?;
    let OutputArguments { json, table, .. } = arguments.output;
    match found {
        Found::Shard(place, shard) => {
            let of = (&scene, hash, identity);
            let study = OfShard::of((arguments, place), of, grid.len(), shard);
            print_notes(&scene.notes);
            emit(&study, json, folder, terminal)?;
            Ok(study.status())
        }
        Found::All(report) => {
            let asked = arguments.in_words(estimates);
            let swept = Swept { scene, varied, grid, estimates, asked, report: *report, table };
            let has_folder = folder.is_some();
            print_notes(&swept.scene.notes);
            emit(&swept, json, folder, terminal)?;
            figures::undrawn(&swept.varied).filter(|_| has_folder).into_iter().for_each(note);
            Ok(status(&swept.report, arguments.enforce))
        }
    }
}

/// The scene of a sweep, and its grid.
struct Asked {
    input: Input,
    /// Values of the table [values] that are set.
    set: Vec<(String, String)>,
    scene: Scene,
    /// What is odd about it.
    known: Vec<Diagnostic>,
    varied: Varied,
    grid: Grid,
}

impl Asked {
    fn read(arguments: &SweepArguments, terminal: Terminal) -> Result<Self, CliError> {
        let input = crate::input::of(arguments.scene.scene.as_deref())?;
        let set = &arguments.scene.values.set;
        let checked = read(input.text()?, &input.options(set)).map_err(StudyError::Scene)?;
        terminal.diagnose(&checked.warnings);
        let scene = checked.value;
        let varied = Varied::of(arguments, &scene.text, &input.file)?;
        if let Some((name, _)) = set.iter().find(|own| varied.has(&own.0)) {
            return Err(CliError::SetAndVaried { name: name.clone() });
        }
        // What is set by a path stands in that text.
        let is_named =
            |own: &&(String, String)| scene.values.iter().any(|known| known.name == own.0);
        let set: Vec<(String, String)> = set.iter().filter(is_named).cloned().collect();
        let grid =
            varied.grid().ok_or(StudyError::TooMany { of: "points", most: SWEEP_POINTS.most() })?;
        Ok(Self { input, set, scene, known: checked.warnings.list, varied, grid })
    }
}

/// Memory \[B\] that a point takes while it is solved, and that a number takes as text.
const POINT_BYTES: usize = 200;
const NUMBER_BYTES: usize = 20;

/// Refuses points whose values take too much memory as a whole.
fn check_size(
    arguments: &SweepArguments,
    varied: &Varied,
    grid: &Grid,
    columns: &[Column],
) -> Result<(), CliError> {
    let (points, numbers) = match arguments.shard {
        Some(place) => (points_of_shard(grid.len(), place.number, place.of).len(), 0),
        None => (grid.len(), varied.variations.len() + 2 * columns.len()),
    };
    let of_point = POINT_BYTES + 16 * columns.len() + NUMBER_BYTES * numbers;
    check_memory(
        || format!("{points} points of {}", counted(columns.len(), "measure")),
        points.saturating_mul(of_point),
        "`--parquet --out DIR` writes them while they are solved, in the memory of one file; `--shard 1/10 --out DIR` \
         solves a part; `--measure` with fewer measures takes less",
    )
}

/// What a sweep or a shard of it yields.
enum Found {
    Shard(Place, Shard),
    All(Box<SweepReport>),
}

/// Solves the points of the grid, or of a shard, or puts together what is `stored`.
fn found(
    (arguments, estimates, stored): (&SweepArguments, Estimates, Option<Vec<Stored>>),
    (grid, pose, columns): (&Grid, &Pose<'_>, &[Column]),
    terminal: Terminal,
) -> Result<Found, CliError> {
    let options = SweepOptions { threads: arguments.threads(), estimates };
    let mut bar = Bar::new("sweep", 0.0, terminal.error.attended);
    let mut show = |done, of| bar.count(done, of);
    if let Some(place) = arguments.shard {
        let points = points_of_shard(grid.len(), place.number, place.of);
        let shard = sweep_shard(grid, pose, columns, options, points, &mut show)?;
        return Ok(Found::Shard(place, shard));
    }
    Ok(Found::All(Box::new(match stored {
        Some(all) => {
            let shards = all.into_iter().map(|own| own.shard).collect();
            merge(grid, pose, columns, options, shards)?
        }
        None => solve(grid, pose, columns, options, &mut show)?,
    })))
}

/// What became of all points, where each has to keep every limit if that is `enforced`.
fn status(report: &SweepReport, enforced: bool) -> Status {
    let failed = report.gaps.iter().filter(|gap| gap.column.is_none()).count();
    let is_kept = |limit| report.judged(limit).iter().all(|own| *own == Some(Judgement::Pass));
    match (failed == report.points(), (0..report.limits.len()).all(is_kept)) {
        (true, _) => Status::RunFailed,
        (false, false) if enforced => Status::LimitNotKept,
        (false, _) => Status::Done,
    }
}

/// What is odd at the ends of ranges and of words besides what is `known` of the scene. A fault of a word, or of all ends, is
/// shown in the scene's text, with the value under a caret; that of some ends is left to the points.
fn of_ends(
    (varied, grid, file): (&Varied, &Grid, Option<&Path>),
    (input, set): (&Input, &[(String, String)]),
    known: Vec<Diagnostic>,
) -> Result<Diagnostics, CliError> {
    let mut shown = known;
    let (before, points) = (shown.len(), varied.telling(grid));
    let mut bare = input.options(set).bare;
    let ends = points.into_iter().map(|point| {
        let text = varied.text_at(&grid.places(point));
        let options = ReadOptions { bare, ..input.options(set) };
        let found = read(&text, &options).map_err(StudyError::Scene);
        // One end tells of numbers without a unit, but where they are refused.
        if found.is_ok() && bare == BareNumbers::Warned {
            bare = BareNumbers::Silent;
        }
        (point, found)
    });
    let mut ends: Vec<(usize, Result<Checked<Scene>, StudyError>)> = list(ends);
    let has_words = varied.variations.iter().any(Variation::is_of_words);
    if !has_words && ends.iter().any(|own| own.1.is_ok()) {
        ends.retain(|own| own.1.is_ok());
    }
    for (point, found) in ends {
        let in_line = varied.lines.get(point).zip(file);
        if let (Err(_), Some((line, file))) = (&found, in_line) {
            note(&format!("line {line} of `{}` gives these values:", file.display()));
        }
        let found = found?.warnings;
        let known: Vec<String> = shown.iter().map(Diagnostic::message).collect();
        shown.extend(found.list.into_iter().filter(|own| !known.contains(&own.message())));
    }
    Ok(Diagnostics { list: shown.split_off(before), omitted: 0 })
}

#[derive(Serialize)]
#[serde(untagged)]
enum Values<'v> {
    Numbers(&'v [f64]),
    Words(&'v [String]),
}

impl Study for Swept {
    fn warnings(&self) -> Vec<String> {
        words::missing(self)
    }

    fn text(&self, text: &mut Text) {
        text.warnings(&self.warnings());
        text.title(title(&self.scene));
        self.varied.in_words().iter().for_each(|in_word| text.faint(in_word));
        text.blank();
        text.items(page::verdict(self, &best::best(self)));
        let (table, more) = points::table(self);
        if !table.rows.is_empty() {
            text.blank();
            text.rows_led(&table, self.varied.variations.len());
        }
        if more > 0 && !table.rows.is_empty() {
            text.faint(&format!(
                "and {}: all are in the CSV, in a pipe or by `--out`",
                counted(more, "more design")
            ));
        }
        let is_sample = matches!(self.varied.form, Form::Sampled);
        if more > 0 || is_sample {
            text.table(&summary(&self.report, is_sample));
        }
        text.blank();
        text.items(notes(self).into_iter().skip(self.report.limits.len()));
    }

    fn data(&self, terminal: Terminal, out: &mut Vec<u8>) -> Option<()> {
        if self.table.is_now(terminal.output.attended) {
            None
        } else {
            files::table(self, out).ok()
        }
    }

    fn notes(&self) -> Vec<String> {
        notes(self)
    }

    /// Values stand in the order of the points: the last parameter varies fastest; `listed` tells that those of a point
    /// are of one place, in place of all combinations.
    fn object(&self) -> impl Serialize {
        let Self { scene, report, .. } = self;
        let parameters = self.varied.variations.iter().zip(&self.varied.matched).enumerate();
        let parameters = list(parameters.map(|(at, (own, &tunable))| {
            object! {
                name: &own.name,
                path: tunable.map(|at| &self.varied.tunables.all()[at].path),
                unit: self.varied.unit(at),
                values: if own.is_of_words() { Values::Words(&own.words) } else { Values::Numbers(&own.values) },
            }
        }));
        object! {
            #[serde(flatten)]
            head: origin::head(scene, &crate::input::load),
            listed: self.varied.is_of_rows(),
            parameters,
            asked: self.asked.iter().map(|(name, value)| (*name, value.as_str())).collect::<Pairs<_, _>>(),
            scene_warnings: said::warning_objects(scene),
            scene_notes: said::note_objects(scene),
            #[serde(flatten)]
            report,
        }
    }

    fn files(&self, files: &mut Staged<'_>) -> Result<(), CliError> {
        files::write(files, self)
    }
}
