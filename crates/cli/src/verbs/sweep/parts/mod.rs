//! `--parquet`: a sweep that is written while it is solved, in files of so many points, each whole as soon as it is
//! there. Nothing but the file at hand is held, and what is there already is not solved again.

mod file;
mod summary;

use std::ops::{ControlFlow, Range};

use dashpot_analysis::{
    Limit,
    sweep::{
        Column, Estimates, Grid, Pose, SweepError, SweepOptions, points_of_shard, sweep_in_parts,
    },
};
use dashpot_report::Table;
use dashpot_scene::Scene;
use serde::Serialize;

use self::{
    file::Footer,
    summary::{Counted, Summary},
};
use super::{
    arguments::SweepArguments,
    identity::Identity,
    shards::Place,
    varied::Varied,
    words::{limit, name, solved, unit},
};
use crate::{
    cancel::{is_interrupted, notice_interrupts},
    error::{CliError, Status, unwritable},
    folder::{Folder, RESULT},
    input::title,
    operand::print_notes,
    output::{Pairs, Study, Text, emit, list, object},
    progress::Bar,
    said,
    terminal::{Terminal, note},
};
use dashpot_report::numbers::{bound, counted};
use dashpot_studies::origin;

/// The fewest and the most points of a file, whole groups of them: its rows are read at once, and some MB for each
/// column are held meanwhile.
const PART: [usize; 2] = [1 << 12, 1 << 18];
/// As many files are written of a sweep as far as that goes, so that little is lost where it is broken off.
const FILES: usize = 64;
/// Reasons why points have no solution, and kinds of warnings, that are told; all are in the result.
const MOST_TOLD: usize = 8;
const DIGITS: usize = 4;

pub(super) struct Wanted<'w> {
    pub(super) scene: &'w Scene,
    pub(super) varied: &'w Varied,
    pub(super) grid: &'w Grid,
    pub(super) pose: &'w Pose<'w>,
    pub(super) columns: &'w [Column],
    pub(super) estimates: Estimates,
    /// The hash of all on which its values depend.
    pub(super) sweep: String,
    pub(super) identity: Identity,
}

/// Solves what is not there yet of a sweep, or of its shard.
pub(super) fn written(
    arguments: &SweepArguments,
    wanted: &Wanted<'_>,
    terminal: Terminal,
) -> Result<Status, CliError> {
    let Wanted { varied, grid, pose, columns, .. } = *wanted;
    let all = match arguments.shard {
        Some(place) => points_of_shard(grid.len(), place.number, place.of),
        None => 0..grid.len(),
    };
    let words = varied.variations.iter().filter(|own| own.is_of_words());
    if let Some(own) = words.map(|own| &own.name).find(|own| file::SAID.contains(&own.as_str())) {
        return Err(CliError::ColumnTaken { name: own.clone() });
    }
    let [fewest, most] = PART;
    let length = (grid.len() / FILES).next_power_of_two().clamp(fewest, most);
    let starts = all.clone().step_by(length);
    let parts = list(starts.map(|start| start..all.end.min(start + length)));
    let names = parts.iter().map(file_name);
    let Some(mut folder) = Folder::wanted(arguments.output.out.as_deref(), names)? else {
        return Ok(Status::Done);
    };
    let there = there(&folder, wanted, &parts)?;
    let is_there = |part: &Range<usize>| there.iter().any(|own| own.points == *part);
    let (known, missing): (Vec<_>, Vec<_>) = parts.into_iter().partition(is_there);
    if !known.is_empty() {
        let (known, of) = (known.len(), known.len() + missing.len());
        note(&format!("{known} of {of} files are there, whole: they are not solved again"));
    }
    let limits = pose(&grid.places(0)).map_err(SweepError::NotPosed)?;
    let mut sum = Summary::default();
    let mut sizes: Vec<(Range<usize>, Summary)> =
        there.into_iter().map(|own| (own.points, own.summary)).collect();
    if !missing.is_empty() {
        let options = SweepOptions { threads: arguments.threads(), estimates: wanted.estimates };
        let mut bar = Bar::new("sweep", 0.0, terminal.error.attended);
        notice_interrupts();
        let mut show = |done: usize, of: usize| {
            if is_interrupted() { ControlFlow::Break(()) } else { bar.count(done, of) }
        };
        let take = |part: &Range<usize>, report| {
            let footer = Footer::of(wanted, part.clone(), &report);
            let name = file_name(part);
            let bytes = file::bytes((varied, grid), &footer, &report);
            folder.keep(&name, &bytes.map_err(unwritable(&folder.path().join(&name)))?)?;
            sizes.push((footer.points, footer.summary));
            Ok::<_, CliError>(())
        };
        let solved = sweep_in_parts(grid, pose, columns, options, &missing, take, &mut show);
        if is_interrupted() && matches!(solved, Err(CliError::Sweep(SweepError::BrokenOff))) {
            let kept = sizes.iter().map(|own| own.0.len()).sum();
            let path = folder.path().to_owned();
            return Err(CliError::Interrupted { kept, of: all.len(), path });
        }
        solved?;
    }
    sizes.sort_by_key(|own| own.0.start);
    let files = list(sizes.iter().map(|own| file_name(&own.0)));
    sizes.into_iter().for_each(|own| sum.add(own.1));
    let limits = limits.settings.limits.into_iter().filter_map(|own| {
        let is_it = |column: &Column| !column.is_share && column.key == own.key;
        Some((columns.iter().position(is_it)?, own))
    });
    let study = Parts {
        asked: arguments.in_words(wanted.estimates),
        place: arguments.shard,
        limits: limits.collect(),
        folder: folder.path().display().to_string(),
        files,
        sum,
        wanted,
    };
    let object = serde_json::to_string_pretty(&study.object())? + "\n";
    folder.keep(RESULT, object.as_bytes())?;
    print_notes(&wanted.scene.notes);
    emit(&study, arguments.output.json, None, terminal)?;
    Ok(study.status(arguments.enforce))
}

/// The name of the file of these points: of the first one, counted from 1.
fn file_name(points: &Range<usize>) -> String {
    format!("points-{:08}.parquet", points.start + 1)
}

/// What is there already, whole; a folder with anything else is refused.
fn there(
    folder: &Folder,
    wanted: &Wanted<'_>,
    parts: &[Range<usize>],
) -> Result<Vec<Footer>, CliError> {
    let names = folder.whole()?.into_iter().filter(|own| own != RESULT);
    let footers = names.map(|own| Footer::read(&folder.path().join(own)));
    let is_ours = |own: &Footer| own.sweep == wanted.sweep && parts.contains(&own.points);
    let ours = |own: Option<Footer>| match own {
        Some(own) if is_ours(&own) => Ok(own),
        own => {
            let differences = own.map(|own| wanted.identity.differences(&own.identity));
            let fault = crate::error::shards::ShardFault::Taken(differences.unwrap_or_default());
            Err(CliError::Shard { path: folder.path().to_owned(), fault })
        }
    };
    footers.map(ours).collect()
}

/// The points that are there.
struct Parts<'w> {
    wanted: &'w Wanted<'w>,
    /// What the command line asked for, in words.
    asked: Vec<(&'static str, String)>,
    place: Option<Place>,
    limits: Vec<(usize, Limit)>,
    folder: String,
    files: Vec<String>,
    sum: Summary,
}

impl Parts<'_> {
    fn status(&self, is_enforced: bool) -> Status {
        let is_kept = self.sum.limits.iter().all(|own| own.pass == self.sum.points);
        match (self.sum.unsolved() == self.sum.points && self.sum.points > 0, is_kept) {
            (true, _) => Status::RunFailed,
            (false, false) if is_enforced => Status::LimitNotKept,
            (false, _) => Status::Done,
        }
    }

    /// How many keep each limit.
    fn kept(&self) -> impl Iterator<Item = String> {
        self.limits.iter().zip(&self.sum.limits).map(|((column, own), kept)| {
            let words = limit(&self.wanted.columns[*column], own);
            let (pass, fail, of) = (kept.pass, kept.fail, self.sum.points);
            let open = match kept.undecided {
                0 => String::new(),
                open => format!(", {open} undecided"),
            };
            format!("{} {words}: {pass} of {of} points pass, {fail} fail{open}", own.key)
        })
    }
}

impl Study for Parts<'_> {
    fn text(&self, text: &mut Text) {
        let (sum, columns) = (&self.sum, self.wanted.columns);
        text.title(title(self.wanted.scene));
        self.wanted.varied.in_words().iter().for_each(|own| text.faint(own));
        text.blank();
        if let Some(Place { number, of }) = self.place {
            text.items([format!("shard {number} of {of}")]);
        }
        text.items([solved(sum.instantiated, sum.points)]);
        text.items(self.kept());
        text.items(sum.checked.map(|(points, most)| {
            let most = bound(most);
            format!("{points} of them solved in full as well: the largest difference is {most}")
        }));
        if sum.cut > 0 {
            let cut = counted(sum.cut, "value");
            text.items([format!("{cut} may still grow after the end of their runs")]);
        }
        text.items(sum.left_out.iter().map(summary::LeftOut::in_words));
        let first = |own: &Counted| self.wanted.varied.at(self.wanted.grid, own.first);
        let points = |own: &Counted| match sum.points {
            all if all == own.points => format!("all {all} points"),
            all => format!("{} of {all} points", own.points),
        };
        text.items(told(&sum.failed, |own| {
            format!("no solution at {}, first at {}: {}", points(own), first(own), own.text)
        }));
        text.items(told(&sum.warnings, |own| {
            let code = &own.code;
            format!("warning `{code}` at {}, first at {}: {}", points(own), first(own), own.text)
        }));
        let rows = columns.iter().zip(&sum.extremes).map(|(column, own)| {
            let text = |own: f64| unit(column, own).text(own, DIGITS);
            let both = own.map_or(["–".to_owned(), "–".to_owned()], |own| own.map(text));
            list([name(column)].into_iter().chain(both))
        });
        text.table(&Table::new("", &["measure", "lowest", "highest"], rows));
        text.blank();
        let files = counted(self.files.len(), "file");
        text.faint(&format!("{files} of points as Parquet and {RESULT} are in {}", self.folder));
    }

    fn object(&self) -> impl Serialize {
        let Wanted { scene, varied, columns, .. } = *self.wanted;
        let parameters = varied.variations.iter().zip(&varied.matched).enumerate();
        let parameters = list(parameters.map(|(at, (own, &tunable))| {
            object! {
                name: &own.name,
                path: tunable.map(|at| &varied.tunables.all()[at].path),
                unit: varied.unit(at),
                count: own.len(),
            }
        }));
        let measures = list(columns.iter().zip(&self.sum.extremes).map(|(column, own)| {
            object! {
                key: &column.key,
                over_thickness: column.is_share,
                unit: column.unit,
                lowest: own.map(|own| own[0]),
                highest: own.map(|own| own[1]),
            }
        }));
        let limits = list(self.limits.iter().zip(&self.sum.limits).map(|((column, own), kept)| {
            object! {
                key: &own.key,
                bound: own.bound.word(),
                level: own.bound.level(),
                from: &own.from,
                of_mean: own.of_mean,
                unit: columns[*column].unit,
                points: kept,
            }
        }));
        object! {
            #[serde(flatten)]
            head: origin::head(scene, &crate::input::load),
            sweep: &self.wanted.sweep,
            listed: varied.is_of_rows(),
            parameters,
            asked: self.asked.iter().map(|(name, value)| (*name, value.as_str())).collect::<Pairs<_, _>>(),
            scene_warnings: said::warning_objects(scene),
            scene_notes: said::note_objects(scene),
            shard: self.place,
            points: self.sum.points,
            instantiated: self.sum.instantiated,
            estimated: self.sum.estimated,
            measures,
            limits,
            failed: &self.sum.failed,
            warnings: &self.sum.warnings,
            checked: self.sum.checked.map(|own| own.0),
            largest_difference: self.sum.checked.map(|own| own.1),
            cut: self.sum.cut,
            left_out: &self.sum.left_out,
            parquet: &self.files,
        }
    }
}

/// What is said of some points, the rest counted.
fn told(all: &[Counted], words: impl Fn(&Counted) -> String) -> Vec<String> {
    let mut told = list(all.iter().take(MOST_TOLD).map(words));
    if all.len() > MOST_TOLD {
        told.push(format!("{} more are in {RESULT}", all.len() - MOST_TOLD));
    }
    told
}
