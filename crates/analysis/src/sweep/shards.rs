//! Sweeps in shards: whole groups of a grid, solved at other times or by other machines, and what they yield together.

use std::{
    collections::BTreeMap,
    ops::{ControlFlow, Range},
    sync::atomic::{AtomicUsize, Ordering},
    time::{Duration, Instant},
};

use dashpot_network::Detail;
use serde::{Deserialize, Serialize};

use super::{
    Column, Estimates, Gap, Grid, PartialOfSweep, Pose, Row, SweepError, SweepOptions, SweepReport,
    Watch, decided,
    full::{Flaws, Full, check},
    instantiated::Plan,
    parallel::{GROUP, share},
    report::{self, Kinds},
    thinned::Thinned,
};
use crate::{Limit, RunReport, Warning};

/// What the points of one shard of a sweep yield. Its values and errors are no part of its serialised form.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Shard {
    /// The points, by their numbers in the whole grid.
    pub points: Range<usize>,
    /// One value for each column of each point; NaN where there is none.
    #[serde(skip)]
    pub values: Vec<f64>,
    /// The errors of those, without what may be left out; NaN where there is none.
    #[serde(skip)]
    pub errors: Vec<f64>,
    /// Why values are missing, in the order of the points.
    pub gaps: Vec<Gap>,
    /// Points and columns whose values may still grow after the end of their runs.
    pub cut: Vec<(usize, usize)>,
    /// Where runs are warned, one for each kind.
    pub raised: Vec<Raised>,
    /// How many points were instantiated.
    pub instantiated: usize,
    /// At how many points errors were estimated by further solutions.
    pub estimated: usize,
}

impl Shard {
    fn counted_from_its_first(mut self) -> Self {
        let first = self.points.start;
        self.points = 0..self.points.len();
        self.gaps.iter_mut().for_each(|own| own.point -= first);
        self.cut.iter_mut().for_each(|own| own.0 -= first);
        let ranges = self.raised.iter_mut().flat_map(|own| &mut own.points);
        ranges.for_each(|own| *own = own.start - first..own.end - first);
        self
    }

    /// Whether all that it says is about its own points and so many columns, in their order, with a value and an error
    /// for each.
    fn is_of(&self, columns: usize) -> bool {
        let (points, count) = (&self.points, self.points.len().checked_mul(columns));
        let has = |point: usize, column: Option<usize>| {
            points.contains(&point) && column.is_none_or(|own| own < columns)
        };
        let rises = |own: &Raised| {
            let ends = own.points.iter().flat_map(|own| [own.start, own.end - 1]);
            own.points
                .iter()
                .all(|own| !own.is_empty() && has(own.start, None) && own.end <= points.end)
                && ends.is_sorted()
        };
        [self.values.len(), self.errors.len()].map(Some) == [count; 2]
            && self.instantiated.max(self.estimated) <= points.len()
            && self.gaps.iter().all(|own| has(own.point, own.column))
            && self.gaps.is_sorted_by_key(|own| own.point)
            && self.cut.iter().all(|own| has(own.0, Some(own.1)))
            && self.cut.is_sorted()
            && self.raised.iter().all(|own| !own.points.is_empty() && rises(own))
    }
}

/// Where runs are warned of one kind.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Raised {
    /// The points, as rising ranges.
    pub points: Vec<Range<usize>>,
    /// The place of the warning among those of the first point.
    pub place: usize,
}

/// The points of the shard with this `number`, counted from 1, of so many: whole groups of 64, which are shared out
/// evenly; empty where there are fewer groups than shards, and where there is no such shard.
pub fn points_of_shard(points: usize, number: usize, of: usize) -> Range<usize> {
    let groups = points.div_ceil(GROUP);
    let end = |number: usize| points.min(GROUP * (groups * number.min(of) / of.max(1)));
    end(number.saturating_sub(1))..end(number)
}

/// Solves some points of a sweep. What they yield is that of [`sweep`](super::sweep()) to the bit where they are a
/// [shard](points_of_shard): the form is compiled, and what may be left out is decided, of the whole grid.
///
/// # Errors
///
/// Those of [`sweep`](super::sweep()).
pub fn sweep_shard(
    grid: &Grid,
    pose: &Pose<'_>,
    columns: &[Column],
    options: SweepOptions,
    points: Range<usize>,
    watch: &mut Watch<'_>,
) -> Result<Shard, SweepError> {
    ready((grid, pose, columns), options, |ready| Ok(ready.solve(points, watch)?.0))
}

/// Solves a sweep in parts, which are handed over one after the other, so that no more than one of them is held. Each is
/// a report of its own, whose points are counted from the first one of the part; values and errors are those of
/// [`sweep`](super::sweep()) to the bit where parts begin and end with whole groups, as [shards](points_of_shard) do.
///
/// # Errors
///
/// Those of [`sweep`](super::sweep()), and what `take` does not take.
pub fn sweep_in_parts<E: From<SweepError>>(
    grid: &Grid,
    pose: &Pose<'_>,
    columns: &[Column],
    options: SweepOptions,
    parts: &[Range<usize>],
    mut take: impl FnMut(&Range<usize>, SweepReport) -> Result<(), E>,
    watch: &mut Watch<'_>,
) -> Result<(), E> {
    let mut solve = |ready: &Ready<'_>| {
        let (mut before, all) = (0, parts.iter().map(Range::len).sum());
        for part in parts {
            let started = Instant::now();
            let mut within = |done, _| watch(before + done, all);
            let (shard, warnings) = ready.solve(part.clone(), &mut within)?;
            let mut report = ready.report(vec![(shard.counted_from_its_first(), warnings)]);
            report.wall = started.elapsed();
            take(part, report)?;
            before += part.len();
        }
        Ok(())
    };
    ready((grid, pose, columns), options, |ready| Ok(solve(ready)))?
}

/// What the shards of a sweep, in the order of their points, yield together: the report of
/// [`sweep`](super::sweep()) to the bit. Of each kind of warning in a shard the group of the first point is solved again,
/// and nothing else but the points that tell what may be left out, and whether instantiated points agree with full runs.
///
/// # Errors
///
/// Points that are in no shard or in two, shards that speak of other points than theirs, and those of
/// [`sweep`](super::sweep()).
pub fn merge(
    grid: &Grid,
    pose: &Pose<'_>,
    columns: &[Column],
    options: SweepOptions,
    shards: Vec<Shard>,
) -> Result<SweepReport, SweepError> {
    let started = Instant::now();
    let mut at = 0;
    for shard in &shards {
        if shard.points.start != at || shard.points.end < at {
            return Err(SweepError::NotWhole { point: at });
        }
        if !shard.is_of(columns.len()) {
            return Err(SweepError::OtherPoints { point: at });
        }
        at = shard.points.end;
    }
    if at != grid.len() {
        return Err(SweepError::NotWhole { point: at });
    }
    let mut report = ready((grid, pose, columns), options, |ready| {
        let mut known = BTreeMap::new();
        let told = |shard: Shard| {
            let warnings = shard.raised.iter().map(|own| ready.warning(own, &mut known));
            let warnings = warnings.collect::<Result<_, _>>()?;
            Ok((shard, warnings))
        };
        let told = shards.into_iter().map(told).collect::<Result<Vec<_>, SweepError>>()?;
        Ok(ready.report(told))
    })?;
    report.wall = started.elapsed();
    Ok(report)
}

/// Points that are solved, and the warnings that are raised there.
type Solved = (Shard, Vec<Warning>);

/// A sweep of which everything is known that concerns all points.
pub(super) struct Ready<'r> {
    full: Full<'r>,
    options: SweepOptions,
    /// How points are instantiated, where that agrees with full runs.
    plan: Option<Plan<'r>>,
    /// The points where that was seen, and the largest difference.
    found: (Vec<usize>, f64),
    limits: Vec<Limit>,
    partial: Option<PartialOfSweep>,
}

/// Finds what concerns all points, and does some `work` with it.
///
/// Where their accuracy has a bound for what may be left out, that is decided at the corners of the
/// grid and at points spread over it, as in [`partial::sweep`](crate::partial::sweep()), and what
/// remains is solved everywhere. The errors then include the largest move that was found.
pub(super) fn ready<R>(
    (grid, pose, columns): (&Grid, &Pose<'_>, &[Column]),
    options: SweepOptions,
    work: impl FnOnce(&Ready<'_>) -> Result<R, SweepError>,
) -> Result<R, SweepError> {
    let first = pose(&grid.places(0)).map_err(SweepError::NotPosed)?;
    let (partial, details) = decided(grid, pose, &first)?.unzip();
    let details: Vec<Detail> = details.unwrap_or_default();
    let reduced = |places: &[usize]| {
        let mut scene_point = pose(places)?;
        if !details.is_empty() {
            scene_point.network = scene_point.network.without(&details);
        }
        scene_point.settings.accuracy.neglect_below = None;
        scene_point.settings.estimate &= options.estimates != Estimates::Off;
        Ok(scene_point)
    };
    let full = Full { grid, pose: &reduced, columns };
    let first = reduced(&grid.places(0)).map_err(SweepError::NotPosed)?;
    let plan = Plan::of(grid, &reduced, &first, columns, options);
    let found = plan.as_ref().and_then(|plan| check(plan, &full, options.threads));
    let plan = plan.filter(|_| found.is_some());
    let found = found.unwrap_or_default();
    work(&Ready { full, options, plan, found, limits: first.settings.limits, partial })
}

impl Ready<'_> {
    /// Solves these points.
    pub(super) fn solve(
        &self,
        points: Range<usize>,
        watch: &mut Watch<'_>,
    ) -> Result<Solved, SweepError> {
        let width = self.full.columns.len();
        let count = points.len() * width;
        let (mut values, mut errors) = (vec![f64::NAN; count], vec![f64::NAN; count]);
        let mut rows = rows(&points, width, &mut values, &mut errors);
        let estimated = self.write(&mut rows, watch).ok_or(SweepError::BrokenOff)?;
        let instantiated = rows.iter().filter(|row| row.notice.is_some()).count();
        let gaps = rows.iter_mut().flat_map(|row| std::mem::take(&mut row.flaws.gaps)).collect();
        let cut =
            rows.iter().flat_map(|row| row.flaws.cut.iter().map(|at| (row.point, *at))).collect();
        let (warnings, raised) = report::collect(&rows, self.element());
        drop(rows);
        let shard = Shard { points, values, errors, gaps, cut, raised, instantiated, estimated };
        Ok((shard, warnings))
    }

    /// Solves rows, whole groups of them; at how many errors were estimated. `None` where the watcher broke it off.
    fn write(&self, rows: &mut [Row<'_>], watch: &mut Watch<'_>) -> Option<usize> {
        let SweepOptions { threads, estimates } = self.options;
        let estimated = AtomicUsize::new(0);
        let tool = || self.plan.as_ref().and_then(Plan::stamper);
        let is_whole = share(
            rows,
            (GROUP, threads),
            &tool,
            &|stamper, rows| {
                if let Some(stamper) = stamper {
                    estimated.fetch_add(stamper.group(rows), Ordering::Relaxed);
                }
                let mut others: Vec<&mut Row<'_>> =
                    rows.iter_mut().filter(|row| row.notice.is_none()).collect();
                let solved = { self.full }.thin(&mut others, estimates);
                let is_estimated = |run: &&RunReport| run.solver.solves_for_error > 0;
                let count = solved.iter().filter(is_estimated).count();
                estimated.fetch_add(count, Ordering::Relaxed);
            },
            watch,
        );
        is_whole.then(|| estimated.into_inner())
    }

    /// The element that is struck where points are instantiated.
    fn element(&self) -> &str {
        self.plan.as_ref().map_or("", Plan::element)
    }

    /// The warning that was raised at the first of these points. Of groups that are solved again all warnings are
    /// kept, those of each row.
    fn warning(
        &self,
        raised: &Raised,
        known: &mut BTreeMap<usize, Vec<Vec<Warning>>>,
    ) -> Result<Warning, SweepError> {
        let point = raised.points.first().map_or(0, |own| own.start);
        let start = point / GROUP * GROUP;
        let group = known.entry(start).or_insert_with(|| {
            let points = start..self.full.grid.len().min(start + GROUP);
            let width = self.full.columns.len();
            let count = points.len() * width;
            let (mut values, mut errors) = (vec![f64::NAN; count], vec![f64::NAN; count]);
            let mut rows = rows(&points, width, &mut values, &mut errors);
            self.write(&mut rows, &mut |_, _| ControlFlow::Continue(()));
            rows.iter().map(|row| row.told(self.element())).collect()
        });
        let own = group.get(point - start).and_then(|row| row.get(raised.place));
        own.cloned().ok_or(SweepError::OtherWarnings { point })
    }

    /// What shards in the order of their points yield together.
    pub(super) fn report(&self, shards: Vec<Solved>) -> SweepReport {
        let (mut kinds, mut sum) = (Kinds::default(), Shard::default());
        for (own, warnings) in shards {
            for (raised, warning) in own.raised.iter().zip(&warnings) {
                let kind = kinds.of(warning, raised.place);
                raised.points.iter().cloned().flatten().for_each(|point| kinds.add(kind, point));
            }
            join(&mut sum.values, own.values);
            join(&mut sum.errors, own.errors);
            join(&mut sum.gaps, own.gaps);
            join(&mut sum.cut, own.cut);
            sum.instantiated += own.instantiated;
            sum.estimated += own.estimated;
        }
        let columns = self.full.columns;
        let at = |limit: &Limit| {
            let is_it = |own: &Column| !own.is_share && own.key == limit.key;
            Some((columns.iter().position(is_it)?, limit.clone()))
        };
        let is_instantiated = sum.instantiated > 0;
        let (checked, largest_difference) =
            Some(self.found.clone()).filter(|_| is_instantiated).unwrap_or_default();
        let mut report = SweepReport {
            columns: columns.to_vec(),
            values: sum.values,
            errors: sum.errors,
            gaps: sum.gaps,
            cut: sum.cut,
            limits: self.limits.iter().filter_map(at).collect(),
            warnings: kinds.told(),
            instantiated: sum.instantiated,
            estimated: sum.estimated,
            checked,
            largest_difference,
            partial: None,
            wall: Duration::ZERO,
        };
        if let Some(own) = self.partial.clone() {
            report.charge(own);
        }
        report
    }
}

/// Appends what is `own`, without a copy where it is the first.
fn join<T>(all: &mut Vec<T>, own: Vec<T>) {
    if all.is_empty() {
        *all = own;
    } else {
        all.extend(own);
    }
}

/// The rows of some points, each with its place among the values of so many columns.
fn rows<'r>(
    points: &Range<usize>,
    columns: usize,
    values: &'r mut [f64],
    errors: &'r mut [f64],
) -> Vec<Row<'r>> {
    let width = columns.max(1);
    let places = values.chunks_mut(width).zip(errors.chunks_mut(width));
    let row = |(point, (values, errors))| {
        let (flaws, warnings, notice) = (Flaws::default(), Vec::new(), None);
        Row { point, values, errors, flaws, warnings, notice }
    };
    points.clone().zip(places).map(row).collect()
}
