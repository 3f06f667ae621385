//! Families of scenes: measures over a grid of parameters.
//!
//! A sweep is given its scenes by a closure, which poses the scene at any point of a [`Grid`]. Scenes
//! that one impactor strikes are *instantiated*: the form is compiled once, as it is until the impactor is let
//! go, and their numbers are read along the axes of the grid only. Linear ones are solved from them by the
//! powers of one small matrix exponential, without allocating anything, others in explicit steps. What is
//! reported that way is compared with full runs at points spread over the grid. All other scenes, and points
//! whose impact is not of the plain kind or not certain enough, are solved in full.
//!
//! Points are shared among threads; the result is the same to the bit whatever their number.

mod axes;
mod bracket;
mod columns;
mod estimates;
mod forces;
mod full;
mod instantiated;
mod parallel;
mod products;
mod propagate;
mod report;
mod scene_point;
mod serialized;
mod shown;
mod stamper;
mod stopped;
mod sums;
mod table;

#[cfg(test)]
mod tests;

use std::{
    sync::atomic::{AtomicUsize, Ordering},
    time::{Duration, Instant},
};

use dashpot_dae::Silent;
use dashpot_network::{Detail, Network};

pub(crate) use self::parallel::share;
pub use self::{
    axes::{Axis, Grid, Sweep, SweepRow, Swept, axis},
    columns::{columns, measure_named},
    estimates::{Estimates, SweepOptions},
    forces::{ContactForce, ContactForces, PoseAt},
    parallel::Watch,
    report::{Column, Gap, PartialOfSweep, SweepError, SweepReport, SweepWarning},
};
use self::{
    full::{Flaws, Full, check},
    instantiated::Plan,
    parallel::{GROUP, workers},
    report::Notice,
};
use crate::{
    Limit, SolveSettings, Warning,
    partial::{decide, spread},
};

/// A scene at a point.
#[derive(Debug, Clone)]
pub struct ScenePoint {
    /// Nodes, elements, loads and effects.
    pub network: Network,
    /// What is asked of its run.
    pub settings: SolveSettings,
}

/// Poses the scene where each parameter takes the value at this position, or says why there is none.
pub type Pose<'p> = dyn Fn(&[usize]) -> Result<ScenePoint, String> + Sync + 'p;

/// One point and its place in the result.
struct Row<'r> {
    point: usize,
    values: &'r mut [f64],
    errors: &'r mut [f64],
    flaws: Flaws,
    /// What a full run is warned of.
    warnings: Vec<Warning>,
    /// What is to be said of a point that was instantiated.
    notice: Option<Notice>,
}

/// Solves the scenes of a grid by so many threads.
///
/// Where their accuracy has a bound for what may be left out, that is decided at the corners of the
/// grid and at points spread over it, as in [`partial::sweep`](crate::partial::sweep()), and what
/// remains is solved everywhere. The errors then include the largest move that was found.
///
/// # Errors
///
/// A fault of the scene at the first point, and a sweep that was broken off. Points that fail are
/// [gaps](SweepReport::gaps).
pub fn sweep(
    grid: &Grid,
    pose: &Pose<'_>,
    columns: &[Column],
    options: SweepOptions,
    watch: &mut Watch<'_>,
) -> Result<SweepReport, SweepError> {
    let started = Instant::now();
    let first = pose(&grid.places(0)).map_err(SweepError::NotPosed)?;
    let partial = decided(grid, pose, &first)?;
    let details: &[Detail] = partial.as_ref().map_or(&[], |partial| &partial.1);
    let reduced = |places: &[usize]| {
        let mut scene_point = pose(places)?;
        if !details.is_empty() {
            scene_point.network = scene_point.network.without(details);
        }
        scene_point.settings.accuracy.neglect_below = None;
        scene_point.settings.estimate &= options.estimates != Estimates::Off;
        Ok(scene_point)
    };
    let full = Full { grid, pose: &reduced, columns };
    let mut report = solved(&full, options, watch)?;
    if let Some((own, _)) = partial {
        // As many threads would share the work in full.
        let wall_in_full = own.wall_in_full / workers(options.threads, grid.len());
        report.charge(PartialOfSweep { wall_in_full, ..own });
    }
    report.wall = started.elapsed();
    Ok(report)
}

/// Solves all points: by instantiating where that agrees with full runs, else in full.
fn solved(
    full: &Full<'_>,
    options: SweepOptions,
    watch: &mut Watch<'_>,
) -> Result<SweepReport, SweepError> {
    let SweepOptions { threads, estimates } = options;
    let &Full { grid, pose, columns } = full;
    let first = pose(&grid.places(0)).map_err(SweepError::NotPosed)?;
    let plan = Plan::of(grid, pose, &first, columns, options);
    let found = plan.as_ref().and_then(|plan| check(plan, full, threads));
    let plan = plan.filter(|_| found.is_some());
    let count = grid.len();
    let mut values = vec![f64::NAN; count * columns.len()];
    let mut errors = vec![f64::NAN; count * columns.len()];
    let mut rows = rows(columns.len(), &mut values, &mut errors);
    let estimated = AtomicUsize::new(0);
    let tool = || plan.as_ref().and_then(Plan::stamper);
    let is_whole = share(
        &mut rows,
        (GROUP, threads),
        &tool,
        &|stamper, rows| {
            if let Some(stamper) = stamper {
                estimated.fetch_add(stamper.group(rows), Ordering::Relaxed);
            }
            let others: Vec<&mut Row<'_>> =
                rows.iter_mut().filter(|row| row.notice.is_none()).collect();
            if !others.is_empty() {
                estimated.fetch_add(full.group(others, estimates), Ordering::Relaxed);
            }
        },
        watch,
    );
    if !is_whole {
        return Err(SweepError::BrokenOff);
    }
    let instantiated = rows.iter().filter(|row| row.notice.is_some()).count();
    let (checked, largest_difference) = found.filter(|_| instantiated > 0).unwrap_or_default();
    let gaps = rows.iter_mut().flat_map(|row| std::mem::take(&mut row.flaws.gaps)).collect();
    let cut = rows.iter().flat_map(|row| row.flaws.cut.iter().map(|column| (row.point, *column)));
    let cut = cut.collect();
    let at = |limit: &Limit| {
        let is_it = |own: &Column| !own.is_share && own.key == limit.key;
        Some((columns.iter().position(is_it)?, limit.clone()))
    };
    let limits = first.settings.limits.iter().filter_map(at).collect();
    let warnings = report::collect(&rows, plan.as_ref().map_or("", Plan::element));
    drop(rows);
    Ok(SweepReport {
        columns: columns.to_vec(),
        values,
        errors,
        gaps,
        cut,
        limits,
        warnings,
        instantiated,
        estimated: estimated.into_inner(),
        checked,
        largest_difference,
        partial: None,
        wall: Duration::ZERO,
    })
}

/// The points, each with its place among the values of so many columns.
fn rows<'r>(columns: usize, values: &'r mut [f64], errors: &'r mut [f64]) -> Vec<Row<'r>> {
    let width = columns.max(1);
    let places = values.chunks_mut(width).zip(errors.chunks_mut(width)).enumerate();
    let row = |(point, (values, errors))| {
        let (flaws, warnings, notice) = (Flaws::default(), Vec::new(), None);
        Row { point, values, errors, flaws, warnings, notice }
    };
    places.map(row).collect()
}

/// The corners of a grid are looked at up to so many parameters.
const MOST_CORNERED: usize = 6;

/// What may be left out of all points, where the scene at the first one allows that.
fn decided(
    grid: &Grid,
    pose: &Pose<'_>,
    first: &ScenePoint,
) -> Result<Option<(PartialOfSweep, Vec<Detail>)>, SweepError> {
    let Some(bound) = first.settings.accuracy.neglect_below else { return Ok(None) };
    let mut points = spread(grid.len());
    if grid.counts().len() <= MOST_CORNERED {
        points.extend(grid.corners());
    }
    points.sort_unstable();
    points.dedup();
    let scene_point: Vec<(usize, Network)> = points
        .into_iter()
        .filter_map(|point| Some((point, pose(&grid.places(point)).ok()?.network)))
        .collect();
    let networks: Vec<Network> = scene_point.iter().map(|own| own.1.clone()).collect();
    let all: Vec<usize> = (0..networks.len()).collect();
    let found = decide(&networks, &all, &first.settings, &mut Silent)?;
    let worst = found.worst();
    let report = PartialOfSweep {
        bound,
        checked: found.checked().map(|at| scene_point[at].0).collect(),
        worst,
        solves: found.solves(),
        wall_in_full: found.wall_in_full(grid.len()),
        left_out: found.left_out(),
        put_back: found.put_back.clone(),
    };
    Ok(Some((report, found.details())))
}
